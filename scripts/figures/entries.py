"""All figures, each in one entry: its category, the results it needs, what its script is given.

A new figure is a script NAME.py and a template NAME.rst of its caption in this folder, and an entry
here. Figures of what a user's file adds are named KIND/NAME, for example scenes/strong_delay.
`<results>` stands for the folder of the results.
"""

import ast
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

from scripts.results.paths import (
    curves_of_atlas,
    cycles_in_atlas,
    cycles_of_lines,
    exponents_of_scenes,
    paths_of_scenes,
    places_in_atlas,
    places_in_plane,
    runs_of_route,
    runs_of_routes,
    scenes_of,
    sweeps_beside_cycles,
    sweeps_on_lines,
    tables_of_routes,
    with_plane_alone,
)

FOLDER = "scripts/figures"
OWN_VARIABLES = ("u", "v")
"""Variables that the figure of a user's scene draws."""


@dataclass(frozen=True, kw_only=True)
class Entry:
    """What the workflow, the page and the report know of a figure."""

    category: str
    """Where it stands on the page and in the report."""
    inputs: dict[str, str | list[str] | Callable[[dict], list[str]]] = field(default_factory=dict)
    """Results by their names in the script: a path, or paths by the configuration."""
    rows: tuple[str, ...] = ()
    """Kinds of results that it needs of each scene in its rows, which the configuration lists."""
    variables: tuple[str, ...] = ()
    """Variables that it draws of the trajectories among its inputs."""
    params: dict[str, Callable[[dict], dict]] = field(default_factory=dict)
    """What else its script is given, by the configuration."""
    script: str = ""
    """Name of its script, where that is not its own."""
    caption: str = ""
    """Name of its caption, where that is not its own."""
    shows_classes: bool = False
    """Whether its colours are those of classes of motion, which the page keeps in the dark."""


ENTRIES = {
    "figure_1": Entry(category="Figures"),
    "figure_2": Entry(
        category="Figures",
        inputs={"curves": "<results>/hopf/tau_of_epsilon.nc"},
        params={"scenes": lambda config: places_in_plane(config, "tau_of_epsilon")},
    ),
    "figure_3": Entry(
        category="Figures",
        inputs={"curves": "<results>/hopf/xi_of_epsilon.nc"},
        params={"scenes": lambda config: places_in_plane(config, "xi_of_epsilon")},
    ),
    "figure_4": Entry(
        category="Figures",
        inputs={"table": "<results>/tables/attractors.tsv"},
        rows=("trajectories",),
        variables=("u", "v"),
    ),
    "figure_5": Entry(
        category="Figures",
        inputs={"table": "<results>/tables/attractors.tsv"},
        rows=("trajectories",),
        variables=("u", "v"),
    ),
    "figure_6": Entry(category="Figures", rows=("spectra",)),
    "figure_7": Entry(category="Figures", rows=("spectra",)),
    "figure_8": Entry(
        category="Figures", inputs={"response": "<results>/friction/velocity_step.nc"}
    ),
    "exponents": Entry(
        category="Supplement",
        inputs={"runs": exponents_of_scenes, "table": "<results>/tables/exponents.tsv"},
    ),
    "fault_limit": Entry(
        category="Supplement", inputs={"table": "<results>/tables/fault-limit.tsv"}
    ),
    "events": Entry(category="Supplement", rows=("slip_events",)),
    "stability": Entry(category="Solver", inputs={"table": "<results>/tables/stability.tsv"}),
    "work_precision": Entry(
        category="Solver",
        inputs={
            "table": "<results>/tables/work-precision.tsv",
            "others": "benchmarks/measured.tsv",
        },
    ),
    "atlas": Entry(
        category="Atlas",
        inputs={
            "table": "<results>/tables/atlas.tsv",
            "curves": curves_of_atlas,
            "cycles": cycles_in_atlas,
        },
        params={"scenes": places_in_atlas},
        shows_classes=True,
    ),
    "true_torus": Entry(
        category="Atlas",
        inputs={"table": "<results>/tables/attractors.tsv"},
        rows=("trajectories", "attractors/scenes", "spectra"),
        variables=("v",),
    ),
    "routes": Entry(
        category="Atlas",
        inputs={"tables": tables_of_routes, "runs": runs_of_routes},
        params={"scenes": places_in_atlas},
        shows_classes=True,
    ),
    "cycles": Entry(
        category="Atlas",
        inputs={"cycles": cycles_of_lines, "sweeps": sweeps_beside_cycles},
        params={"scenes": places_in_atlas, "sweeps": sweeps_on_lines},
    ),
}
"""In the order of the page."""
FIGURES = list(ENTRIES)


def entry_of_scene(scene: str) -> Entry:
    """A scene: in time, phase portrait, spectrum, section, exponents and class, roots."""
    return Entry(
        category="Scenes",
        inputs={
            "trajectory": f"<results>/trajectories/{scene}.nc",
            "spectrum": f"<results>/spectra/{scene}.nc",
            "attractors": f"<results>/attractors/scenes/{scene}.nc",
            "roots": f"<results>/linear_stability/{scene}.nc",
        },
        variables=OWN_VARIABLES,
        script="scene",
        caption="own/scene",
    )


def entry_of_plane(plane: str) -> Entry:
    """Hopf curves in a plane, as in figures 2 and 3."""
    return Entry(
        category="Hopf curves",
        inputs={"curves": f"<results>/hopf/{plane}.nc"},
        params={"scenes": lambda config: places_in_plane(config, plane)},
        script="figure_2",
        caption="own/plane",
    )


def entry_of_route(line: str) -> Entry:
    """Motions along a parameter."""
    return Entry(
        category="Routes",
        inputs={
            "tables": [f"<results>/tables/routes/{line}.tsv"],
            "runs": lambda config: runs_of_route(config, line),
        },
        params={"scenes": places_in_atlas},
        script="routes",
        shows_classes=True,
        caption="own/route",
    )


def entry_of_atlas(plane: str) -> Entry:
    """A plane of the atlas."""
    return Entry(
        category="Atlas",
        inputs={
            "table": f"<results>/tables/atlas/{plane}.tsv",
            "curves": lambda config: curves_of_atlas(with_plane_alone(config, plane)),
            "cycles": lambda config: cycles_in_atlas(with_plane_alone(config, plane)),
        },
        params={"scenes": places_in_atlas},
        script="atlas",
        shows_classes=True,
        caption="own/atlas",
    )


def entry_of_exponents(scene: str) -> Entry:
    """Exponents of a scene."""
    return Entry(
        category="Exponents",
        inputs={
            "runs": [f"<results>/exponents/{scene}.nc"],
            "table": "<results>/tables/exponents.tsv",
        },
        script="exponents",
        caption="own/exponents",
    )


def entry_of_cycles(line: str) -> Entry:
    """Branches of cycles along a parameter."""
    return Entry(
        category="Cycles",
        inputs={
            "cycles": [f"<results>/cycles/{line}.nc"],
            "sweeps": lambda config: sweeps_on_lines(config)[line],
        },
        params={
            "scenes": places_in_atlas,
            "sweeps": lambda config: {line: sweeps_on_lines(config)[line]},
        },
        script="cycles",
        caption="own/cycles",
    )


OF_ONES_OWN = {
    "scenes": entry_of_scene,
    "exponents": entry_of_exponents,
    "planes": entry_of_plane,
    "routes": entry_of_route,
    "cycles": entry_of_cycles,
    "atlas": entry_of_atlas,
}
"""Entries of what a user's file adds, by kind."""


def own_figures(config: dict, names: dict[str, list[str]]) -> list[str]:
    """Figures of what a file adds, given its names by section."""
    measured = [scene for scene in names["scenes"] if "exponents" in config["scenes"][scene]]
    names = {**names, "exponents": measured}
    return [f"{kind}/{name}" for kind in OF_ONES_OWN for name in names[kind]]


def entry_of(figure: str) -> Entry:
    """The entry of a figure, or of one of a user's file."""
    kind, _, name = figure.partition("/")
    return OF_ONES_OWN[kind](name) if name else ENTRIES[figure]


def script_of(figure: str) -> str:
    """Name of its script in the folder of figures, without the ending."""
    return entry_of(figure).script or figure


def name_of_caption(figure: str) -> str:
    """Name of its caption, which figures of one kind in a user's file share."""
    return entry_of(figure).caption or figure


def template_of(figure: str) -> str:
    """Its caption before numbers and verdicts are filled in, in the project's folder."""
    return f"{FOLDER}/{name_of_caption(figure)}.rst"


def caption_of(figure: str) -> str:
    """Its caption as a run fills it."""
    return f"<results>/figures/{figure}.rst"


def title_of(figure: str) -> str:
    """The first line of its script, which says what is drawn."""
    script = Path(__file__).with_name(f"{script_of(figure)}.py").read_text(encoding="utf-8")
    return ast.get_docstring(ast.parse(script)).splitlines()[0]


def inputs_of(figure: str, config: dict) -> dict[str, str | list[str]]:
    """The results that it needs, by their names in the script."""
    entry = entry_of(figure)
    inputs = {
        name: needed(config) if callable(needed) else needed
        for name, needed in entry.inputs.items()
    }
    for kind in entry.rows:
        inputs[kind.partition("/")[0]] = paths_of_scenes(kind, scenes_of(config, figure))
    return inputs


def files_of(figure: str, config: dict) -> list[str]:
    """The results that a figure needs, as one list."""
    return [
        path
        for needed in inputs_of(figure, config).values()
        for path in ([needed] if isinstance(needed, str) else needed)
    ]


def params_of(figure: str, config: dict) -> dict:
    """What else its script is given; of a figure with rows its settings."""
    entry = entry_of(figure)
    params = {name: given(config) for name, given in entry.params.items()}
    return {**params, "settings": config["figures"][figure]} if entry.rows else params


def variables_used(config: dict, scene: str) -> set[str]:
    """Variables of a scene's trajectory that figures draw, and that its spectrum is computed of."""
    used = set()
    for figure, entry in ENTRIES.items():
        files = files_of(figure, config)
        if f"<results>/trajectories/{scene}.nc" in files:
            used |= set(entry.variables)
        if f"<results>/spectra/{scene}.nc" in files:
            used.add("v")
    return used
