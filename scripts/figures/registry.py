"""All figures, in the order of the page: those of the paper, and those that a user's file adds.

A figure is a module NAME.py with a template NAME.rst of its caption beside it. The first line of
the module's docstring is the title of the figure. It has

- inputs(config): results that it reads, by name: a path or a list of paths, in which `<results>`
  stands for the folder of the results;
- params(config): what else it needs of the configuration, by name;
- draw(...): the figure;
- numbers(...): numbers of the caption, by their names in the template;
- VARIABLES: variables that it draws of the trajectories among its inputs;
- SHOWS_CLASSES: True if its colours are those of classes of motion, which a dark page keeps.

Arguments of draw and numbers are named as inputs and params. An input is passed as its contents: an
xarray.Dataset, the rows of a table, or a list of these. Only draw must be there.

Figures of a user's file are named KIND/NAME, for example scenes/strong_delay. Their configuration
has the entry NAME alone in its section.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from types import ModuleType

from scripts.figures import (
    atlas,
    cycles,
    events,
    exponents,
    fault_limit,
    figure_1,
    figure_2,
    figure_3,
    figure_4,
    figure_5,
    figure_6,
    figure_7,
    figure_8,
    plane,
    routes,
    scene,
    stability,
    true_torus,
    work_precision,
)

PROJECT = Path(__file__).parents[2]
OF_THE_PAPER = {
    "Figures": [figure_1, figure_2, figure_3, figure_4, figure_5, figure_6, figure_7, figure_8],
    "Supplement": [exponents, fault_limit, events],
    "Solver": [stability, work_precision],
    "Atlas": [atlas, true_torus, routes, cycles],
}
"""By their category on the page and in the report."""


@dataclass(frozen=True)
class Kind:
    """Figures that a user's file adds, one for each entry of a section."""

    category: str
    module: ModuleType
    section: tuple[str, ...]
    """Keys of the section in the configuration."""


OF_USERS = {
    "scenes": Kind("Scenes", scene, ("scenes",)),
    "exponents": Kind("Exponents", exponents, ("scenes",)),
    "planes": Kind("Hopf curves", plane, ("hopf_curves",)),
    "routes": Kind("Routes", routes, ("routes", "lines")),
    "cycles": Kind("Cycles", cycles, ("cycles", "lines")),
    "atlas": Kind("Atlas", atlas, ("atlas", "planes")),
}
"""By kind."""


def name_of(module: ModuleType) -> str:
    """Name of a module of this folder."""
    return module.__name__.rpartition(".")[2]


CATEGORIES = {
    name_of(module): category for category, modules in OF_THE_PAPER.items() for module in modules
}
MODULES = {name_of(module): module for modules in OF_THE_PAPER.values() for module in modules}
FIGURES = list(MODULES)
"""Names of the paper's figures."""


def user_figures(config: dict, names: dict[str, list[str]]) -> list[str]:
    """Figures of what a file adds, given its names by section."""
    measured = [scene for scene in names["scenes"] if "exponents" in config["scenes"][scene]]
    names = {**names, "exponents": measured}
    return [f"{kind}/{name}" for kind in OF_USERS for name in names[kind]]


def module_of(figure: str) -> ModuleType:
    """The module of a figure."""
    kind, _, name = figure.partition("/")
    return OF_USERS[kind].module if name else MODULES[figure]


def config_of(figure: str, config: dict) -> dict:
    """The configuration, for a figure of a user's file with one entry alone in its section."""
    kind, _, name = figure.partition("/")
    return with_entry_alone(config, OF_USERS[kind].section, name) if name else config


def with_entry_alone(config: dict, section: Sequence[str], name: str) -> dict:
    """The configuration with one entry alone in the section with these keys."""
    key, *below = section
    alone = with_entry_alone(config[key], below, name) if below else {name: config[key][name]}
    return {**config, key: alone}


def inputs_of(figure: str, config: dict) -> dict[str, str | list[str]]:
    """Results that a figure reads, by name."""
    module = module_of(figure)
    return module.inputs(config_of(figure, config)) if hasattr(module, "inputs") else {}


def files_of(figure: str, config: dict) -> list[str]:
    """Results that a figure reads, as one list."""
    return [
        path
        for paths in inputs_of(figure, config).values()
        for path in ([paths] if isinstance(paths, str) else paths)
    ]


def params_of(figure: str, config: dict) -> dict:
    """What else a figure needs of the configuration, by name."""
    module = module_of(figure)
    return module.params(config_of(figure, config)) if hasattr(module, "params") else {}


def numbers_of(figure: str) -> Callable[..., dict]:
    """The function that gives the numbers of a caption."""
    return getattr(module_of(figure), "numbers", lambda: {})


def category_of(figure: str) -> str:
    """The heading of a figure on the page and in the report."""
    kind, _, name = figure.partition("/")
    return OF_USERS[kind].category if name else CATEGORIES[figure]


def shows_classes(figure: str) -> bool:
    """Whether the colours of a figure are those of classes of motion."""
    return getattr(module_of(figure), "SHOWS_CLASSES", False)


def title_of(figure: str) -> str:
    """The first line of a figure's docstring, which says what is drawn."""
    return module_of(figure).__doc__.splitlines()[0]


def script_of(figure: str) -> str:
    """Path of a figure's module in the folder of scripts."""
    return f"figures/{name_of(module_of(figure))}.py"


def template_of(figure: str) -> str:
    """Path of the caption's template in the project."""
    return f"scripts/figures/{name_of(module_of(figure))}.rst"


def caption_of(figure: str) -> str:
    """The caption as a run fills it."""
    return f"<results>/figures/{figure}.rst"


def variables_used(config: dict, scene: str, figures: Sequence[str] = tuple(FIGURES)) -> set[str]:
    """Variables of a scene's trajectory that figures draw, and that its spectrum is computed of."""
    used = set()
    for figure in figures:
        files = files_of(figure, config)
        if f"<results>/trajectories/{scene}.nc" in files:
            used |= set(module_of(figure).VARIABLES)
        if f"<results>/spectra/{scene}.nc" in files:
            used.add("v")
    return used
