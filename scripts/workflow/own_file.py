"""A user's configuration file: the folder of its results, and what it adds."""

import re
from pathlib import Path

from scripts.config.read_config import ConfigError

RESULTS = "results"
"""The folder of the paper's results; in it each user's file has a folder of its own."""
TAKEN = {
    *("attractors", "benchmarks", "cycles", "docs", "exponents", "figures", "friction", "hopf"),
    *("linear_stability", "logs", "measurements", "namelists", "page", "references"),
    *("slip_events", "spectra", "tables", "trajectories"),
}
"""Folders of the paper's results."""
NAME = re.compile(r"(?!.*?(.+?)\1{19}\Z).{1,100}")
"""Names of folders of results. Snakemake takes a word that ends with 20 equal parts for an endless
recursion."""
SECTIONS = {
    "scenes": ("scenes",),
    "planes": ("hopf_curves",),
    "routes": ("routes", "lines"),
    "atlas": ("atlas", "planes"),
    "cycles": ("cycles", "lines"),
    "basins": ("basins", "places"),
    "families": ("stability", "families"),
    "dimensions": ("dimensions",),
}
"""Where the configuration has what a file may add, by name."""


def folder_of(files: list[str | Path], entries: list[str]) -> str:
    """The folder of the results of some files, named after them, or of entries KEY=VALUE alone.

    Of neither it is the folder of the paper's results.
    """
    names = [Path(file).stem for file in files] or ["config"] * bool(entries)
    if not names:
        return RESULTS
    name = re.sub(r"[^A-Za-z0-9_-]", "_", "-".join(names))
    if name in TAKEN:
        raise ConfigError(
            f"{files[0]}: its results would be in {RESULTS}/{name}/, where the paper's are; give"
            " the file another name"
        )
    if not NAME.fullmatch(name):
        raise ConfigError(
            f"its results would be in {RESULTS}/{name}/; expected at most 100 letters, and not 20"
            " equal parts at the end; give the file another name"
        )
    return f"{RESULTS}/{name}"


def refuse_active(folder: str) -> None:
    """Raise ConfigError where a folder that another workflow gives means more than a path."""
    if not re.fullmatch(r"[\w./-]+", folder):
        raise ConfigError(
            f"pathvars of the module: results = {folder!r}; expected a path of letters, digits and"
            " _ - . / alone"
        )


def added(overlay: dict, config: dict) -> dict[str, list[str]]:
    """Names of what a file adds or changes, by section.

    A file that changes what all of a section of the configuration share, and names none, changes
    all.
    """
    names = {section: list(_inside(overlay, path)) for section, path in SECTIONS.items()}
    for section, path in SECTIONS.items():
        if not names[section] and _inside(overlay, path[:-1]) and len(path) > 1:
            names[section] = list(_inside(config, path))
    return names


def listed(config: dict, *groups: dict[str, list[str]]) -> dict:
    """The configuration with nothing else in these sections than the names of these groups.

    The attractors of all its scenes are looked for.
    """
    kept = dict(config)
    for section, (first, *rest) in SECTIONS.items():
        inside = _inside(config, (first, *rest))
        names = dict.fromkeys(name for group in groups for name in group.get(section, []))
        chosen = {name: inside[name] for name in names}
        kept[first] = {**config[first], rest[0]: chosen} if rest else chosen
    kept["scenes"] = {name: {"attractors": {}} | own for name, own in kept["scenes"].items()}
    return kept


def _inside(config: dict, path: tuple[str, ...]) -> dict:
    """A section; nothing where it is not there."""
    for key in path:
        config = config.get(key) if isinstance(config, dict) else None
    return config if isinstance(config, dict) else {}
