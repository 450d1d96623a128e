"""What the plan of a study may declare: runs, tables, figures, and where a user's entries stand.

Paths of results begin in the folder of the results. Where other results are named, `<results>`
stands for this folder. A plan loads nothing that draws, fits or derives.
"""

from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import PurePath

# Priorities: the paper's figures can be looked at while long runs go on. Long runs start before
# short ones, the longest first, so that no core is idle at the end. Snakemake adds the priorities
# of jobs that fit at the same time: a build, which takes two cores, must have more than two jobs of
# the paper.
BUILD, PAPER, LONGEST, LONG = 10, 3, 2, 1
LONG_RUN = {"priority": LONG, "minutes": 20}
MAIN = "Figures"
"""The category of the paper's own figures."""


@dataclass(frozen=True)
class Run:
    """One kind of run: a command, its namelist and its output."""

    rule: str
    command: str
    output: str
    """Path of the output, with wildcards."""
    groups: Callable[..., dict]
    """Groups of the namelist by the configuration and the values of the wildcards."""
    data: str = ""
    """Name by which tests of claims read the outputs."""
    needs: dict[str, str] = field(default_factory=dict)
    """Other results that the program reads."""
    horizons: bool = False
    """Whether the table `horizons` of what it needs ends its cases early."""
    priority: int = 0
    minutes: int = 0
    """The longest time of a run on a cluster, ten times as long as measured; without it the run is
    made by the workflow itself."""
    quad: bool = False
    """Whether it is computed in quadruple precision."""

    @property
    def program(self) -> str:
        """Name of the program that has the command."""
        return "spring_block_quad" if self.quad else "spring_block"


@dataclass(frozen=True)
class Table:
    """A table, or another file that a script makes of results."""

    rule: str
    output: str
    """Path of the output, with wildcards."""
    inputs: Callable[..., dict] = lambda _config: {}
    """Results that it is made of, by the configuration and the values of the wildcards."""
    params: dict[str, Callable] = field(default_factory=dict)
    """What else it needs, each by the configuration and the values of the wildcards."""
    script: str = "table.py"
    """The script that makes it: a file in the folder of the study, or one of scripts/tables/ with
    this folder."""
    more_outputs: dict[str, str] = field(default_factory=dict)
    """Further outputs by name; the first one is then named, too: `table`."""
    data: str = ""
    """Name by which tests of claims and findings read it; by default its own, with underscores."""
    wanted: Callable[[dict], bool] | None = None
    """Whether the configuration has entries to list. Without it, only what reads the table asks
    for it."""
    of_all_laws: bool = False
    """Whether claims about one law read its rows of other laws, too."""
    priority: int = 0


@dataclass(frozen=True)
class Figure:
    """A figure, or a kind of figures: one for each entry of a section that a user's file adds.

    The figure is drawn by a module of the study, which has

    - draw(...): the figure;
    - numbers(...), if the caption has numbers: these by their names in the template.

    Arguments of draw and numbers are named as inputs and params. An input is passed as its
    contents: an xarray.Dataset, the rows of a table, or a list of these.
    """

    name: str
    """Name of the figure; a figure of a kind is KIND/ENTRY, for example scenes/strong_delay."""
    category: str
    """The heading on the page and in the report."""
    place: int
    """Figures stand on the page in ascending order of their places."""
    title: str = ""
    """What is drawn; by default the first line of the plan."""
    inputs: Callable[[dict], dict] = lambda _config: {}
    """Results that it reads, by name: a path or a list of paths."""
    params: Callable[[dict], dict] = lambda _config: {}
    """What else it needs of the configuration, by name."""
    variables: tuple[str, ...] = ()
    """Variables that it draws of the trajectories among its inputs."""
    shows: tuple[str, ...] = ()
    """Keys of the only entry that it gets of a section: ("figures", "figure_4"). Of a kind: keys of
    the section."""
    shows_entry: Callable[[dict, str], bool] = lambda _config, _entry: True
    """Of a kind: whether it shows an entry, by the configuration and the name."""
    module: str = "figure"
    caption: str = "caption.rst"
    """Template of the caption."""
    study: str = ""
    """The study that declares it; filled in by what finds the studies."""

    @property
    def drawing(self) -> str:
        """Name of the module that draws, in the package of studies."""
        return f"{self.study}.{self.module}"

    @property
    def template(self) -> str:
        """Path of the caption's template in the project."""
        return f"scripts/studies/{self.study}/{self.caption}"

    @property
    def filled_caption(self) -> str:
        """The caption as a run fills it."""
        return f"<results>/figures/{self.name}.rst"

    def inputs_of(self, config: dict) -> dict[str, str | list[str]]:
        """Results that the figure reads, by name."""
        return self.inputs(with_entry_alone(config, self.shows))

    def params_of(self, config: dict) -> dict:
        """What else the figure needs of the configuration, by name."""
        return self.params(with_entry_alone(config, self.shows))

    def files_of(self, config: dict) -> list[str]:
        """Results that the figure reads, as one list."""
        return [
            path
            for paths in self.inputs_of(config).values()
            for path in ([paths] if isinstance(paths, str) else paths)
        ]


@dataclass(frozen=True)
class Study:
    """All that planning knows of a study."""

    reads: tuple[str, ...] = ()
    """Other studies whose results, sections or verdicts it reads: it cannot be without them."""
    entries: dict[str, tuple[str, ...]] = field(default_factory=dict)
    """Keys of the sections with entries that a user names, by the wildcard for their names."""
    wildcards: dict[str, str | Callable[[dict], list[str]]] = field(default_factory=dict)
    """What other wildcards stand for: a pattern, or names by the configuration."""
    runs: tuple[Run, ...] = ()
    tables: tuple[Table, ...] = ()
    figures: tuple[Figure, ...] = ()
    kinds: tuple[Figure, ...] = ()
    """Kinds of figures of a user's file."""
    measured: tuple[str, ...] = ()
    """How paths of results begin that hold times, in which two runs differ."""
    uses: Callable[[dict], dict[str, list[str]]] = lambda _config: {}
    """Entries of other sections that its own entries need, by the wildcards for their names."""
    of_user: Callable[[dict], None] = lambda _config: None
    """What it changes in the configuration of a user's file."""
    title: str = ""
    """The first line of its plan; filled in by what finds the studies."""


def stem_of(path: str) -> str:
    """A path without its ending: log, benchmark and namelist of an output have the same."""
    return str(PurePath(path).with_suffix(""))


def with_entry_alone(config: dict, keys: tuple[str, ...]) -> dict:
    """The configuration with one entry alone in its section, given by its keys."""
    if len(keys) < 2:
        return {keys[0]: config[keys[0]]} if keys else config
    return {**config, keys[0]: with_entry_alone(config[keys[0]], keys[1:])}
