"""All figures, each in one entry: its category, the results it needs, what its script is given.

A new figure is a script NAME.py and a template NAME.rst of its caption in this folder, and an entry
here.
"""

import ast
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

from scripts.workflow.result_files import (
    curves_of_atlas,
    cycles_in_atlas,
    cycles_of_lines,
    exponents_of_scenes,
    paths_of_scenes,
    places_in_atlas,
    places_of_scenes,
    runs_of_routes,
    scenes_of,
    sweeps_beside_cycles,
    sweeps_on_lines,
    tables_of_routes,
)

FOLDER = "scripts/figures"


@dataclass(frozen=True, kw_only=True)
class Entry:
    """What the workflow, the page and the report know of a figure."""

    category: str
    """Where it stands on the page and in the report."""
    inputs: dict[str, str | Callable[[dict], list[str]]] = field(default_factory=dict)
    """Results by their names in the script: a path, or paths by the configuration."""
    rows: tuple[str, ...] = ()
    """Kinds of results that it needs of each scene in its rows, which the configuration lists."""
    variables: tuple[str, ...] = ()
    """Variables that it draws of the trajectories among its inputs."""
    params: dict[str, Callable[[dict], dict]] = field(default_factory=dict)
    """What else its script is given, by the configuration."""


ENTRIES = {
    "figure_1": Entry(category="Figures"),
    "figure_2": Entry(
        category="Figures",
        inputs={"curves": "results/hopf/tau_of_epsilon.nc"},
        params={"scenes": places_of_scenes},
    ),
    "figure_3": Entry(
        category="Figures",
        inputs={"curves": "results/hopf/xi_of_epsilon.nc"},
        params={"scenes": places_of_scenes},
    ),
    "figure_4": Entry(
        category="Figures",
        inputs={"table": "results/tables/attractors.tsv"},
        rows=("trajectories",),
        variables=("u", "v"),
    ),
    "figure_5": Entry(
        category="Figures",
        inputs={"table": "results/tables/attractors.tsv"},
        rows=("trajectories",),
        variables=("u", "v"),
    ),
    "figure_6": Entry(category="Figures", rows=("spectra",)),
    "figure_7": Entry(category="Figures", rows=("spectra",)),
    "figure_8": Entry(category="Figures", inputs={"response": "results/friction/velocity_step.nc"}),
    "exponents": Entry(
        category="Supplement",
        inputs={"runs": exponents_of_scenes, "table": "results/tables/exponents.tsv"},
    ),
    "events": Entry(category="Supplement", rows=("slip_events",)),
    "stability": Entry(category="Solver", inputs={"table": "results/tables/stability.tsv"}),
    "work_precision": Entry(
        category="Solver",
        inputs={
            "table": "results/tables/work-precision.tsv",
            "others": "benchmarks/measured.tsv",
        },
    ),
    "atlas": Entry(
        category="Atlas",
        inputs={
            "table": "results/tables/atlas.tsv",
            "curves": curves_of_atlas,
            "cycles": cycles_in_atlas,
        },
        params={"scenes": places_in_atlas},
    ),
    "true_torus": Entry(
        category="Atlas",
        inputs={"table": "results/tables/attractors.tsv"},
        rows=("trajectories", "attractors/scenes", "spectra"),
        variables=("v",),
    ),
    "routes": Entry(
        category="Atlas",
        inputs={"tables": tables_of_routes, "runs": runs_of_routes},
        params={"scenes": places_in_atlas},
    ),
    "cycles": Entry(
        category="Atlas",
        inputs={"cycles": cycles_of_lines, "sweeps": sweeps_beside_cycles},
        params={"scenes": places_in_atlas, "sweeps": sweeps_on_lines},
    ),
}
"""In the order of the page."""
FIGURES = list(ENTRIES)


def template_of(figure: str) -> str:
    """Its caption before numbers and verdicts are filled in, in the project's folder."""
    return f"{FOLDER}/{figure}.rst"


def caption_of(figure: str) -> str:
    """Its caption."""
    return f"results/figures/{figure}.rst"


def title_of(figure: str) -> str:
    """The first line of its script, which says what is drawn."""
    script = Path(__file__).with_name(f"{figure}.py").read_text(encoding="utf-8")
    return ast.get_docstring(ast.parse(script)).splitlines()[0]


def inputs_of(figure: str, config: dict) -> dict[str, str | list[str]]:
    """The results that it needs, by their names in the script."""
    entry = ENTRIES[figure]
    inputs = {
        name: needed(config) if callable(needed) else needed
        for name, needed in entry.inputs.items()
    }
    for kind in entry.rows:
        inputs[kind.partition("/")[0]] = paths_of_scenes(kind, scenes_of(config, figure))
    return inputs


def files_of(figure: str, config: dict) -> list[str]:
    """The same as one list."""
    return [
        path
        for needed in inputs_of(figure, config).values()
        for path in ([needed] if isinstance(needed, str) else needed)
    ]


def params_of(figure: str, config: dict) -> dict:
    """What else its script is given; of a figure with rows its settings."""
    entry = ENTRIES[figure]
    params = {name: given(config) for name, given in entry.params.items()}
    return {**params, "settings": config["figures"][figure]} if entry.rows else params


def variables_used(config: dict, scene: str) -> set[str]:
    """Variables of a scene's trajectory that figures draw, and that its spectrum is computed of."""
    used = set()
    for figure, entry in ENTRIES.items():
        files = files_of(figure, config)
        if f"results/trajectories/{scene}.nc" in files:
            used |= set(entry.variables)
        if f"results/spectra/{scene}.nc" in files:
            used.add("v")
    return used
