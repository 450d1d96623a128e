"""What a run is for: the paper, or what a user's file adds; read from the configuration."""

import copy
import json
import re
from collections import Counter
from dataclasses import dataclass, replace
from pathlib import Path

from scripts.claims.declare import OURS
from scripts.claims.ledger import check_user_claims, names_in, paper_claims
from scripts.config.check_config import checked
from scripts.files.read_config import ConfigError, check_size, merge, read
from scripts.plans import registry
from scripts.results import paths
from scripts.results.programs import KINDS

CONFIG = Path(__file__).parents[2] / "config" / "config.yaml"
RESULTS = "results"
"""The folder of the paper's results; each user's file has a folder of its own in it."""
NAME = re.compile(r"(?!.*?(.+?)\1{19}\Z)[A-Za-z0-9_-]{1,100}")
"""Names of users' files. Snakemake takes a word that ends with 20 equal parts for an endless
recursion."""
SECTIONS = {
    "scenes": ("scenes",),
    "atlas": ("atlas", "planes"),
    "planes": ("hopf_curves",),
    "chains": ("chains",),
    "mode_planes": ("chain_modes", "planes"),
    "event_chains": ("event_sizes", "chains"),
    "routes": ("routes", "lines"),
    "cycles": ("cycles", "lines"),
    "basins": ("basins", "places"),
    "families": ("stability", "families"),
    "measured_scenes": ("work_precision", "scenes"),
    "measured_cases": ("work_precision", "cases"),
}
"""Where the configuration has entries with names that a user chooses; the atlas before the planes
of Hopf curves that it draws."""


@dataclass(frozen=True)
class Plan:
    """A run: its configuration, and what it makes."""

    config: dict
    """The configuration; that of a user's file has the user's entries and those they name."""
    results: str
    """The folder of the results."""
    is_users: bool
    """Whether the run is for a user's file."""
    figures: list[str]
    """Figures, in the order of the page."""
    claims: dict[str, dict]
    """Claims by name."""

    def without(self, unmade: list[str]) -> "Plan":
        """The plan without those figures and claims that a run could not make."""
        drawn = [
            name for name in self.figures if f"{self.results}/figures/{name}.svg" not in unmade
        ]
        claims = {} if f"{self.results}/tables/claims.json" in unmade else self.claims
        return replace(self, figures=drawn, claims=claims)

    def targets(self) -> list[str]:
        """All results but what figures and tables need on the way."""
        kinds = ("pdf", "png", "svg")
        drawn = [f"<results>/figures/{name}.{kind}" for name in self.figures for kind in kinds]
        pages = ["<results>/index.html"] + ["<results>/figures.html"] * (not self.is_users)
        return [*drawn, *self._data_of_figures(), *self.tables(), *pages]

    def summary(self) -> str:
        """How many claims have each verdict, and the page to open, if they are there.

        Questions of ours have answers; they are counted by themselves.
        """
        ledger = Path(self.results, "tables", "claims.json")
        page = Path(self.results, "index.html")
        lines = []
        if self.claims and ledger.exists():
            claims = json.loads(ledger.read_text())
            for ours, kind in ((False, "claims"), (True, "questions of ours")):
                these = [claim["verdict"] for claim in claims if (claim["whose"] == OURS) == ours]
                words = ", ".join(f"{n} {verdict}" for verdict, n in Counter(these).most_common())
                lines += [f"{len(these)} {kind}: {words}"] * bool(these)
            lines.append(f"see {ledger.with_suffix('.tsv')}")
        lines += [f"open {page}"] * page.exists()
        return "\n".join(lines)

    def trajectories(self) -> list[str]:
        """Trajectories that figures draw: the page lets a reader zoom into them."""
        kept = "<results>/trajectories/"
        return [path for path in self._data_of_figures() if path.startswith(kept)]

    def _data_of_figures(self) -> list[str]:
        """Results that figures read, each once."""
        read = [path for name in self.figures for path in registry.files_of(name, self.config)]
        return [path for path in dict.fromkeys(read) if path.startswith("<results>/")]

    def tables(self) -> list[str]:
        """Tables of what is in the configuration, by their paths in the folder of results."""
        there = {section for section, path in SECTIONS.items() if _inside(self.config, path)}
        names = [table for table, section in TABLES.items() if section in there]
        names += ["claims"] * bool(self.claims)
        in_si = paths.scenes_with(self.config, "si")
        tables = [f"{name}.tsv" for name in names + ["si"] * bool(in_si)]
        tables += [f"events/{scene}.csv" for scene in in_si]
        return [f"<results>/tables/{table}" for table in tables]


TABLES = {
    "linear-stability": "scenes",
    "attractors": "scenes",
    "hopf-points": "planes",
    "cycle-points": "cycles",
    "basins": "basins",
    "stability": "families",
    "chain-modes": "mode_planes",
    "event-sizes": "event_chains",
    "tolerance-proportionality": "measured_scenes",
}
"""Tables, and the section whose entries they list. Others are made where a figure needs them."""


def read_plan(overlay: dict) -> Plan:
    """The plan of a run.

    `overlay` is what Snakemake was given by --configfile and --config: it changes the paper's own
    configuration, but for `user_file`, a path. Raises ConfigError in words.
    """
    check_size(overlay, "--config or --configfile")
    overlay = copy.deepcopy(overlay)
    user_file = overlay.pop("user_file", None)
    whole = merge(read(CONFIG), overlay)
    if user_file is None:
        config = checked(whole)
        return plan_of_paper(config, checked_folder(whole["pathvars"]["results"]))
    if "pathvars" in overlay:
        raise ConfigError("pathvars: expected none with user_file, which names the folder")
    said = read(user_file)
    if "pathvars" in said:
        raise ConfigError(f"{user_file}: pathvars: expected none; the file names its folder")
    return plan_of_user(merge(whole, said), added(said, whole), f"{RESULTS}/{name_of(user_file)}")


def checked_folder(results: str) -> str:
    """The folder of the results, which lies in none of the project's own."""
    folder, first = CONFIG.parents[1] / results, results.split("/")[0]
    above = filter(Path.exists, folder.parents[: results.count("/")])
    is_new = not folder.exists() and all(map(holds_results_alone, above))
    if first != RESULTS and not is_new and not (folder / "logs").is_dir():
        raise ConfigError(
            f"config pathvars: results = {results!r}: {first} is there, without results; expected "
            f"a new folder, one beside other results, or one in {RESULTS}/"
        )
    return results


def holds_results_alone(folder: Path) -> bool:
    """Whether nothing is in a folder but folders of results, at any depth."""
    if folder.is_symlink() or not folder.is_dir():
        return False
    return all((part / "logs").is_dir() or holds_results_alone(part) for part in folder.iterdir())


def plan_of_paper(config: dict, folder: str) -> Plan:
    """All of the paper."""
    used = {scene: registry.variables_used(config, scene) for scene in config["scenes"]}
    config = set_variables(config, used, least=[])
    return Plan(config, folder, False, registry.FIGURES, paper_claims())


def plan_of_user(whole: dict, names: dict[str, list[str]], folder: str) -> Plan:
    """What a user's file adds or changes, by the names of its entries."""
    config = checked(whole)
    drawn = {scene: {"u", "v"} for scene in config["scenes"]}
    config = set_variables(config, drawn, least=VARIABLES)
    figures = registry.user_figures(config, names)
    claims = check_user_claims(config["claims"], config, {*registry.FIGURES, *figures})
    if not figures and not claims and not any(names.values()):
        raise ConfigError(
            f"{folder}: the file adds no scene, plane, route, atlas, cycles, family or claim"
        )
    return Plan(restrict(config, names, names_in(claims)), folder, True, figures, claims)


def set_variables(config: dict, used: dict[str, set[str]], *, least: list[str]) -> dict:
    """The configuration in which each scene names the variables that it stores.

    By default those that figures use and those of `least`, or all of a scene that is in no figure.
    """
    for name, scene in config["scenes"].items():
        default = [key for key in VARIABLES if key in used[name].union(least)] or VARIABLES
        lacking = sorted(used[name] - set(scene.setdefault("variables", default)))
        if lacking:
            raise ConfigError(
                f"scene '{name}': variables = {scene['variables']}; its figures also use {lacking}"
            )
    return config


VARIABLES = ["theta", "u", "v"]


def name_of(user_file: str) -> str:
    """Name of the folder of a user's results."""
    name = Path(user_file).stem
    if name in KINDS | {"logs", "benchmarks", "docs"} or not NAME.fullmatch(name):
        raise ConfigError(
            f"{user_file}: its results would be in {RESULTS}/{name}/; expected a name of letters,"
            " digits, _ and -, at most 100, without 20 equal parts at the end, and none of"
            f" {', '.join(sorted(KINDS))}"
        )
    return name


def added(said: dict, whole: dict) -> dict[str, list[str]]:
    """Names of what a user's file adds or changes, by section.

    If the file changes shared settings of a section only, all entries of the section.
    """
    names = {section: list(_inside(said, path)) for section, path in SECTIONS.items()}
    named = {path[:-1] for section, path in SECTIONS.items() if names[section]}
    for section, path in SECTIONS.items():
        if len(path) > 1 and path[:-1] not in named and _inside(said, path[:-1]):
            names[section] = list(_inside(whole, path))
    return names


def restrict(config: dict, *groups: dict[str, list[str]]) -> dict:
    """The configuration with the entries of these names alone.

    Scenes whose runs are measured stay. The attractors of all scenes are looked for. Planes of Hopf
    curves in planes of the atlas stay, since the atlas draws them.
    """
    kept = copy.deepcopy(config)
    for section, (first, *rest) in SECTIONS.items():
        names = {name for group in groups for name in group.get(section, [])}
        if section == "scenes":
            names |= {name for group in groups for name in group.get("measured_scenes", [])}
        if section == "planes":
            names |= {Path(path).stem for path in paths.curves_of_atlas(kept)}
        inside = {k: v for k, v in _inside(config, (first, *rest)).items() if k in names}
        if rest:
            kept[first][rest[0]] = inside
        else:
            kept[first] = inside
    # motions are told apart of the paper's chains and scenes alone
    kept["chain_motions"] |= {"chains": [], "scenes": []}
    for scene in kept["scenes"].values():
        scene.setdefault("attractors", {})
    return kept


def _inside(config: dict, path: tuple[str, ...]) -> dict:
    """A section; empty if it is not there."""
    for key in path:
        config = config.get(key) if isinstance(config, dict) else None
    return config if isinstance(config, dict) else {}
