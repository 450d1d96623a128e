"""The studies: each is a folder in scripts/studies/ with a plan.py. No list names them."""

import copy
import re
from collections.abc import Iterator
from dataclasses import replace
from functools import cache
from importlib import import_module
from pathlib import Path, PurePath
from types import ModuleType

from scripts.files.read_config import ConfigError, merge, read
from scripts.plans.declare import Figure, Run, Study, Table

PROJECT = Path(__file__).parents[2]
FOLDER = PROJECT / "scripts" / "studies"
METHODS = re.findall(
    r'^ +"(\w+)", "\w+"',
    (PROJECT / "fortran/dde/src/loop/dde_methods.f90").read_text(encoding="utf-8"),
    re.MULTILINE,
)
"""The methods of the solver, in the order of its table, which is read before a program is built."""


@cache
def files_of(name: str) -> list[Path]:
    """The files of this name in the folders of all studies."""
    return sorted(
        plan.with_name(name) for plan in FOLDER.glob("*/plan.py") if plan.with_name(name).exists()
    )


def load_parts(part: str) -> dict[str, ModuleType]:
    """The modules of this name of all studies that have one, by study.

    Results of a script that calls it with a name depend on all these modules
    (scripts/workflow/script_imports.py).
    """
    return {
        path.parent.name: import_module(f"scripts.studies.{path.parent.name}.{part}")
        for path in files_of(f"{part}.py")
    }


@cache
def studies() -> dict[str, Study]:
    """All studies by name; raise ConfigError if one that others read, or a caption, is missing."""
    found = {
        name: replace(module.STUDY, title=module.__doc__.splitlines()[0])
        for name, module in load_parts("plan").items()
    }
    for other in {other for study in found.values() for other in study.reads} - set(found):
        readers = [name for name, study in found.items() if other in study.reads]
        raise ConfigError(
            f"scripts/studies/{other}/ is missing: the plans of {', '.join(readers)} read it"
        )
    for name, study in found.items():
        for figure in (*study.figures, *study.kinds):
            caption = PROJECT / replace(figure, study=name).template
            if not caption.exists():
                place = caption.relative_to(PROJECT)
                raise ConfigError(f"{place} is missing: the caption of the figure {figure.name}")
    return found


def runs() -> list[Run]:
    """The runs of all studies."""
    return [run for study in studies().values() for run in study.runs]


def tables() -> Iterator[tuple[str, Table]]:
    """The tables of all studies, each with the path of its script in scripts/."""
    for name, study in studies().items():
        for table in study.tables:
            is_shared = "/" in table.script
            yield table.script if is_shared else f"studies/{name}/{table.script}", table


@cache
def entries() -> dict[str, tuple[str, ...]]:
    """Keys of all sections with entries that a user names, by the wildcard for their names."""
    return {kind: keys for study in studies().values() for kind, keys in study.entries.items()}


def wildcards(config: dict) -> dict[str, str]:
    """What the wildcards of all studies stand for."""
    names = {kind: list(inside(config, keys)) for kind, keys in entries().items()}
    for study in studies().values():
        for name, values in study.wildcards.items():
            names[name] = [values] if isinstance(values, str) else values(config)
    return {name: "|".join(values) for name, values in names.items()}


@cache
def paper_figures() -> dict[str, Figure]:
    """The figures by name, in the order of the page."""
    found = [placed(one, name) for name, each in studies().items() for one in each.figures]
    return {figure.name: figure for figure in sorted(found, key=lambda figure: figure.place)}


def placed(figure: Figure, study: str) -> Figure:
    """A figure with its study, and a title."""
    return replace(figure, study=study, title=figure.title or studies()[study].title)


def user_figures(config: dict, names: dict[str, list[str]]) -> dict[str, Figure]:
    """Figures of what a file adds, given its names by the wildcards of their sections."""
    kinds = [placed(one, name) for name, each in studies().items() for one in each.kinds]
    wildcard_of = {keys: kind for kind, keys in entries().items()}
    return {
        f"{kind.name}/{entry}": replace(
            kind, name=f"{kind.name}/{entry}", shows=(*kind.shows, entry)
        )
        for kind in sorted(kinds, key=lambda kind: kind.place)
        for entry in names[wildcard_of[kind.shows]]
        if kind.shows_entry(config, entry)
    }


@cache
def data() -> dict[str, Run | Table]:
    """What tests of claims and findings read, by the names that they use."""
    found = {run.data: run for run in runs() if run.data}
    for _, table in tables():
        name = PurePath(table.output).stem.replace("-", "_")
        if table.data or "{" not in table.output:
            found[table.data or name] = table
    return found


@cache
def kinds_of_results() -> set[str]:
    """Folders that hold results."""
    made = {PurePath(run.output).parts[0] for run in runs()}
    return made | {"namelists", "tables", "figures", "page"}


def is_measured(path: str) -> bool:
    """Whether two runs may differ in a result, by its path in the folder of results."""
    return path.startswith(tuple(start for one in studies().values() for start in one.measured))


def inside(config: dict, keys: tuple[str, ...]) -> dict:
    """A section; empty if it is not there."""
    for key in keys:
        config = config.get(key) if isinstance(config, dict) else None
    return config if isinstance(config, dict) else {}


@cache
def values_in(path: Path) -> dict:
    """The values of a file of the project, not to be changed."""
    return read(path)


def merged(name: str) -> dict:
    """The file of this name in config/ with those of all studies."""
    return merge(values_in(PROJECT / "config" / name), *map(values_in, files_of(name)))


@cache
def schema() -> dict:
    """The schema of the configuration: that of config/ with those of all studies."""
    whole = copy.deepcopy(values_in(PROJECT / "config" / "schema.yaml"))
    for path in files_of("schema.yaml"):
        add_rules(whole, values_in(path))
    return with_methods(whole)


def with_methods(part):
    """A part of a schema with the names of the solver's methods in the places of `<methods>`."""
    if isinstance(part, dict):
        return {key: with_methods(value) for key, value in part.items()}
    if isinstance(part, list):
        lists = (METHODS if one == "<methods>" else [with_methods(one)] for one in part)
        return [one for each in lists for one in each]
    return part.replace("<methods>", ", ".join(METHODS)) if isinstance(part, str) else part


def add_rules(whole: dict, part: dict) -> None:
    """Add a part of a schema to another; keys that both require are required."""
    for key, value in part.items():
        if isinstance(value, dict) and key in whole:
            add_rules(whole[key], value)
        elif isinstance(value, list) and key in whole:
            whole[key] = [*whole[key], *value]
        else:
            whole[key] = copy.deepcopy(value)
