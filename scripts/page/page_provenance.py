"""Where results come from: programs, compiler, works to cite, and seconds of each kind."""

from collections import Counter
from importlib import metadata
from pathlib import Path

from scripts.files.inputs import read
from scripts.files.read_config import read as read_yaml
from scripts.files.tsv import read_table

PACKAGES = [
    *("snakemake", "ruamel.yaml", "jsonschema", "f90nml", "numpy", "xarray", "netCDF4"),
    *("matplotlib", "jinja2", "MarkupSafe", "docutils"),
]
"""Python packages that results or the page go through."""


def packages() -> dict[str, str]:
    """Version of each package."""
    return {name: metadata.version(name) for name in PACKAGES}


def programs(files: list[str]) -> list[dict]:
    """Versions and compilers that the files say they were made with."""
    made = Counter()
    for path in files:
        attributes = read(path).attrs
        made[attributes["program_version"], attributes["compiler"]] += 1
    return [
        {"version": version, "compiler": compiler, "files": count}
        for (version, compiler), count in sorted(made.items())
    ]


def citation(path: str | Path) -> dict:
    """How to cite this work and the paper, by CITATION.cff."""
    given = read_yaml(path)
    return {
        "licence": given["license"],
        "works": [reference(given), *(reference(one) for one in given.get("references", []))],
    }


def reference(given: dict) -> str:
    """One work in a line: authors, year, title, and where it is found."""
    year = given.get("year") or str(given.get("date-released", ""))[:4]
    dated = f" ({year})" if year else ""
    journal = f"{given['journal']} {given.get('volume', '')}".strip() if "journal" in given else ""
    version = f"Version {given['version']}" if "version" in given else ""
    doi = f"doi:{given['doi']}" if "doi" in given else ""
    address = f"<{given['url']}>" if "url" in given else ""
    rest = [part for part in (given["title"], journal, version, doi, address) if part]
    return f"{', '.join(map(author, given['authors']))}{dated}. {'. '.join(rest)}."


def author(given: dict) -> str:
    """A person or a group by name."""
    if "name" in given:
        return given["name"]
    return f"{given['family-names']}, {given['given-names']}"


def seconds(folder: Path) -> list[dict]:
    """Jobs, seconds and memory of each kind of results, by the benchmark files in a folder."""
    runs_of = {}
    for path in sorted(folder.rglob("*.tsv")):
        kind = path.relative_to(folder).parts[0]
        runs_of.setdefault(kind, []).extend(read_table(path))
    return [
        {
            "kind": kind,
            "jobs": len(runs),
            "seconds": sum(run["s"] for run in runs),
            "longest": max(run["s"] for run in runs),
            "memory": max(filter(is_known, (run["max_rss"] for run in runs)), default=None),
        }
        for kind, runs in runs_of.items()
    ]


def is_known(memory: float | str) -> bool:
    """Whether a run lasted long enough for its memory to be seen."""
    return isinstance(memory, float) and memory >= 0
