"""What a run is for: the paper, or what a user's file adds; read from the configuration."""

import copy
import json
import re
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from scripts.claims.declare import OURS
from scripts.claims.ledger import check_user_claims, names_in, paper_claims
from scripts.config.check_config import checked
from scripts.files.read_config import ConfigError, check_size, merge, read
from scripts.models.models import HISTORY, model_of
from scripts.models.networks import find_files
from scripts.plans import studies
from scripts.plans.declare import Figure
from scripts.plans.studies import inside

PROJECT = Path(__file__).parents[2]
RESULTS = "results"
"""The folder of the paper's results; each user's file has a folder of its own in it."""
NAME = re.compile(r"(?!.*?(.+?)\1{19}\Z)[A-Za-z0-9_-]{1,100}")
"""Names of users' files. Snakemake takes a word that ends with 20 equal parts for an endless
recursion."""


@dataclass(frozen=True)
class Plan:
    """A run: its configuration, and what it makes."""

    config: dict
    """The configuration; that of a user's file has the user's entries and those they name."""
    results: str
    """The folder of the results."""
    is_users: bool
    """Whether the run is for a user's file."""
    figures: dict[str, Figure]
    """Figures by name, in the order of the page."""
    claims: dict[str, dict]
    """Claims by name."""

    def without(self, unmade: list[str]) -> "Plan":
        """The plan without those figures and claims that a run could not make."""
        drawn = {
            name: figure
            for name, figure in self.figures.items()
            if f"{self.results}/figures/{name}.svg" not in unmade
        }
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
            for ours, whose in ((False, ""), (True, " of ours")):
                these = [claim["verdict"] for claim in claims if (claim["whose"] == OURS) == ours]
                words = ", ".join(f"{n} {verdict}" for verdict, n in Counter(these).most_common())
                what = ("question" if ours else "claim") + "s" * (len(these) != 1) + whose
                lines += [f"{len(these)} {what}: {words}"] * bool(these)
            lines.append(f"see {ledger.with_suffix('.tsv')}")
        lines += [f"open {page}"] * page.exists()
        return "\n".join(lines)

    def _data_of_figures(self) -> list[str]:
        """Results that figures read, each once."""
        read = [path for one in self.figures.values() for path in one.files_of(self.config)]
        return [path for path in dict.fromkeys(read) if path.startswith("<results>/")]

    def tables(self) -> list[str]:
        """Tables of what is in the configuration; others are made where a figure needs them."""
        values = studies.wildcards(self.config)
        wanted = [
            path
            for _, table in studies.tables()
            if table.wanted and table.wanted(self.config)
            for output in (table.output, *table.more_outputs.values())
            for path in in_full(output, values)
        ]
        return [
            f"<results>/{path}" for path in [*wanted, *["tables/claims.tsv"] * bool(self.claims)]
        ]


def in_full(path: str, values: dict[str, str]) -> list[str]:
    """A path with each of the names that its wildcard stands for, if it has one."""
    names = re.findall(r"{(\w+)}", path)
    if not names:
        return [path]
    return [path.format(**{names[0]: value}) for value in values[names[0]].split("|")]


def read_plan(overlay: dict) -> Plan:
    """The plan of a run.

    `overlay` is what Snakemake was given by --configfile and --config: it changes the paper's own
    configuration, but for `user_file`, a path. Raises ConfigError in words.
    """
    check_size(overlay, "--config or --configfile")
    studies.studies()
    overlay = copy.deepcopy(overlay)
    user_file = overlay.pop("user_file", None)
    whole = merge(studies.merged("config.yaml"), overlay)
    if user_file is None:
        config = checked(whole)
        return plan_of_paper(config, checked_folder(whole["pathvars"]["results"]))
    if "pathvars" in overlay:
        raise ConfigError("pathvars: expected none with user_file, which names the folder")
    said = read(user_file)
    if "pathvars" in said:
        raise ConfigError(f"{user_file}: pathvars: expected none; the file names its folder")
    find_files(said, Path(user_file).parent)
    return plan_of_user(merge(whole, said), added(said, whole), f"{RESULTS}/{name_of(user_file)}")


def checked_folder(results: str) -> str:
    """The folder of the results, which lies in none of the project's own."""
    folder, first = PROJECT / results, results.split("/")[0]
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
    figures = studies.paper_figures()
    config = set_variables(config, figures, least=[])
    return Plan(config, folder, False, figures, paper_claims())


def plan_of_user(whole: dict, names: dict[str, list[str]], folder: str) -> Plan:
    """What a user's file adds or changes, by the names of its entries."""
    config = checked(whole)
    figures = studies.user_figures(config, names)
    config = set_variables(config, figures, least=list(HISTORY))
    claims = check_user_claims(config["claims"], config, {*studies.paper_figures(), *figures})
    if not figures and not claims and not any(names.values()):
        raise ConfigError(
            f"{folder}: the file adds no scene, plane, route, atlas, cycles, family or claim"
        )
    return Plan(restrict(config, names, names_in(claims)), folder, True, figures, claims)


def variables_used(config: dict, scene: str, figures: dict[str, Figure]) -> set[str]:
    """Variables of a scene's trajectory that figures draw, and that its spectrum is computed of."""
    used = set()
    for figure in figures.values():
        files = figure.files_of(config)
        if f"<results>/trajectories/{scene}.nc" in files:
            used |= set(figure.variables)
        if f"<results>/spectra/{scene}.nc" in files:
            used.add("v")
    return used


def set_variables(config: dict, figures: dict[str, Figure], *, least: list[str]) -> dict:
    """The configuration in which each scene names the variables that it stores.

    By default those that figures use and those of `least`, or all of a scene that is in no figure.
    """
    for name, scene in config["scenes"].items():
        used = variables_used(config, name, figures)
        model = model_of(config, scene)
        known = list(model.history)
        if used and not model.is_block:
            used = set(known)
        default = [key for key in known if key in used.union(least)] or known
        lacking = sorted(used - set(scene.setdefault("variables", default)))
        if lacking:
            raise ConfigError(
                f"scene '{name}': variables = {scene['variables']}; its figures also use {lacking}"
            )
    return config


def name_of(user_file: str) -> str:
    """Name of the folder of a user's results."""
    name = Path(user_file).stem
    kinds = studies.kinds_of_results()
    if name in kinds | {"logs", "benchmarks", "docs", "records"} or not NAME.fullmatch(name):
        raise ConfigError(
            f"{user_file}: its results would be in {RESULTS}/{name}/; expected a name of letters,"
            " digits, _ and -, at most 100, without 20 equal parts at the end, and none of"
            f" {', '.join(sorted(kinds))}"
        )
    return name


def added(said: dict, whole: dict) -> dict[str, list[str]]:
    """Names of what a user's file adds or changes, by the wildcards of their sections.

    If the file changes shared settings of a section only, all entries of the section.
    """
    sections = studies.entries()
    names = {kind: list(inside(said, keys)) for kind, keys in sections.items()}
    named = {keys[:-1] for kind, keys in sections.items() if names[kind]}
    for kind, keys in sections.items():
        if len(keys) > 1 and keys[:-1] not in named and inside(said, keys[:-1]):
            names[kind] = list(inside(whole, keys))
    return names


def restrict(config: dict, *groups: dict[str, list[str]]) -> dict:
    """The configuration with the entries of these names alone, and with those that they use."""
    every = studies.studies().values()
    used = [study.uses(with_names_alone(config, study.entries, groups)) for study in every]
    kept = with_names_alone(config, studies.entries(), [*groups, *used])
    for study in every:
        study.of_user(kept)
    return kept


def with_names_alone(
    config: dict, sections: dict[str, tuple[str, ...]], groups: Sequence[dict[str, list[str]]]
) -> dict:
    """The configuration with the entries of these names alone in some sections."""
    kept = copy.deepcopy(config)
    for kind, (*above, last) in sections.items():
        names = {name for group in groups for name in group.get(kind, [])}
        section = inside(kept, tuple(above))
        section[last] = {name: one for name, one in section[last].items() if name in names}
    return kept
