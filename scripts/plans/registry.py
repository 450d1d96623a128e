"""All figures, in the order of the page: those of the paper, and those that a user's file adds.

What planning needs of a figure is a module NAME.py here, which loads nothing that draws. The first
line of its docstring is the title of the figure. It may have

- inputs(config): results that the figure reads, by name: a path or a list of paths, in which
  `<results>` stands for the folder of the results;
- params(config): what else it needs of the configuration, by name;
- VARIABLES: variables that it draws of the trajectories among its inputs.

The figure is drawn by the module of the same name in scripts/figures, with the template NAME.rst of
its caption beside it. It has

- draw(...): the figure;
- numbers(...), if the caption has numbers: these by their names in the template.

Arguments of draw and numbers are named as inputs and params. An input is passed as its contents: an
xarray.Dataset, the rows of a table, or a list of these.

A figure may show one entry of a section of the configuration, as figure_5 shows the second entry of
`figures` by the module of figure_4. Figures of a user's file are named KIND/ENTRY, for example
scenes/strong_delay.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from types import ModuleType

from scripts.plans import (
    atlas,
    chain,
    chain_exponents,
    chain_modes,
    cycles,
    event_sizes,
    events,
    exponents,
    fault_limit,
    figure_1,
    figure_4,
    figure_6,
    figure_8,
    friction_laws,
    plane,
    routes,
    scene,
    stability,
    synchrony,
    true_torus,
    work_precision,
)

PROJECT = Path(__file__).parents[2]


@dataclass(frozen=True)
class Figure:
    """A figure, or a kind of figures that a user's file adds, one for each entry of a section."""

    category: str
    """The heading on the page and in the report."""
    module: ModuleType
    section: tuple[str, ...] = ()
    """Keys of the section in the configuration of which the module shows one entry."""
    entry: str = ""


OF_THE_PAPER = {
    "figure_1": Figure("Figures", figure_1),
    "figure_2": Figure("Figures", plane, ("hopf_curves",), "tau_of_epsilon"),
    "figure_3": Figure("Figures", plane, ("hopf_curves",), "xi_of_epsilon"),
    "figure_4": Figure("Figures", figure_4, ("figures",), "figure_4"),
    "figure_5": Figure("Figures", figure_4, ("figures",), "figure_5"),
    "figure_6": Figure("Figures", figure_6, ("figures",), "figure_6"),
    "figure_7": Figure("Figures", figure_6, ("figures",), "figure_7"),
    "figure_8": Figure("Figures", figure_8),
    "exponents": Figure("Supplement", exponents),
    "fault_limit": Figure("Supplement", fault_limit),
    "events": Figure("Supplement", events),
    "stability": Figure("Solver", stability),
    "work_precision": Figure("Solver", work_precision),
    "atlas": Figure("Atlas", atlas),
    "true_torus": Figure("Atlas", true_torus),
    "routes": Figure("Atlas", routes),
    "cycles": Figure("Atlas", cycles),
    "friction_laws": Figure("Atlas", friction_laws),
    "chain": Figure("Chains", chain),
    "synchrony": Figure("Chains", synchrony),
    "chain_exponents": Figure("Chains", chain_exponents),
    "chain_modes": Figure("Chains", chain_modes),
    "event_sizes": Figure("Chains", event_sizes),
}
"""By name, in the order of the page."""
FIGURES = list(OF_THE_PAPER)
PAPERS = [name for name, figure in OF_THE_PAPER.items() if figure.category == "Figures"]
"""Figures 1 to 8."""
TITLES = {
    "figure_2": "Figure 2: Hopf curves tau(epsilon) at fixed xi and gamma.",
    "figure_3": "Figure 3: Hopf curves xi(epsilon) at fixed tau and gamma.",
    "figure_5": "Figure 5: velocity and phase portrait, rows a (the paper's torus) and b (chaos).",
    "figure_7": "Figure 7: power spectrum of the chaotic scene.",
}
"""Of figures by the module of another one; else the first line of the module is the title."""
OF_USERS = {
    "scenes": Figure("Scenes", scene, ("scenes",)),
    "exponents": Figure("Exponents", exponents, ("scenes",)),
    "planes": Figure("Hopf curves", plane, ("hopf_curves",)),
    "routes": Figure("Routes", routes, ("routes", "lines")),
    "cycles": Figure("Cycles", cycles, ("cycles", "lines")),
    "atlas": Figure("Atlas", atlas, ("atlas", "planes")),
    "chains": Figure("Chains", chain, ("chains",)),
    "mode_planes": Figure("Chains", chain_modes, ("chain_modes", "planes")),
    "event_chains": Figure("Chains", event_sizes, ("event_sizes", "chains")),
}
"""By kind."""


def user_figures(config: dict, names: dict[str, list[str]]) -> list[str]:
    """Figures of what a file adds, given its names by section."""
    measured = [scene for scene in names["scenes"] if "exponents" in config["scenes"][scene]]
    names = {**names, "exponents": measured}
    return [f"{kind}/{name}" for kind in OF_USERS for name in names[kind]]


def find(figure: str) -> Figure:
    """The figure of this name."""
    kind, _, entry = figure.partition("/")
    return replace(OF_USERS[kind], entry=entry) if entry else OF_THE_PAPER[figure]


def with_entry_alone(config: dict, section: Sequence[str], entry: str) -> dict:
    """The configuration with one entry alone in the section with these keys."""
    if not section:
        return {entry: config[entry]}
    key, *below = section
    return {**config, key: with_entry_alone(config[key], below, entry)}


def ask_module(figure: str, function: str, config: dict) -> dict:
    """What `inputs` or `params` of a figure's module returns; empty if it has no such function."""
    found = find(figure)
    if found.entry:
        config = with_entry_alone(config, found.section, found.entry)
    return getattr(found.module, function, lambda _: {})(config)


def inputs_of(figure: str, config: dict) -> dict[str, str | list[str]]:
    """Results that a figure reads, by name."""
    return ask_module(figure, "inputs", config)


def params_of(figure: str, config: dict) -> dict:
    """What else a figure needs of the configuration, by name."""
    return ask_module(figure, "params", config)


def files_of(figure: str, config: dict) -> list[str]:
    """Results that a figure reads, as one list."""
    return [
        path
        for paths in inputs_of(figure, config).values()
        for path in ([paths] if isinstance(paths, str) else paths)
    ]


def title_of(figure: str) -> str:
    """What is drawn."""
    return TITLES.get(figure) or find(figure).module.__doc__.splitlines()[0]


def module_name(figure: str) -> str:
    """Name of a figure's modules, of planning and of drawing."""
    return find(figure).module.__name__.rpartition(".")[2]


def template_of(figure: str) -> str:
    """Path of the caption's template in the project."""
    name = figure if figure in OF_THE_PAPER else module_name(figure)
    return f"scripts/figures/{name}.rst"


def caption_of(figure: str) -> str:
    """The caption as a run fills it."""
    return f"<results>/figures/{figure}.rst"


def variables_used(config: dict, scene: str, figures: Sequence[str] = tuple(FIGURES)) -> set[str]:
    """Variables of a scene's trajectory that figures draw, and that its spectrum is computed of."""
    used = set()
    for figure in figures:
        files = files_of(figure, config)
        if f"<results>/trajectories/{scene}.nc" in files:
            used |= set(find(figure).module.VARIABLES)
        if f"<results>/spectra/{scene}.nc" in files:
            used.add("v")
    return used
