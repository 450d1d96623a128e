"""Digests of all results, by which damage is noticed and two people compare their results.

Each folder of results has two lists in the format of sha256sum: results that depend on nothing but
the project, and what was measured on this machine. Paths begin in the folder of the project.
"""

import hashlib
import os
from collections.abc import Iterable
from pathlib import Path

from scripts.files.outputs import written
from scripts.workflow.own_file import TAKEN

LIST, MEASURED_LIST = "manifest.sha256", "measured.sha256"
MEASURED = ("measurements/", "figures/work_precision", "tables/work-precision.tsv", "times.html")
"""How paths of measured results begin."""
OF_RUNS = {"logs", "benchmarks", "docs"}
"""Folders that hold no results."""


def is_measured(path: str) -> bool:
    """Whether two runs may differ in a result, by its path in the folder of results."""
    return path.startswith(MEASURED)


def results_in(folder: str | Path) -> list[str]:
    """Results by their paths in a folder, which may hold other folders of results."""
    found = [path for kind in TAKEN - OF_RUNS for path in Path(folder, kind).rglob("*")]
    found += Path(folder).glob("*.html")
    names = (path.relative_to(folder).as_posix() for path in found if path.is_file())
    return sorted(name for name in names if not name.endswith(".part"))


def digest_of(path: str | Path) -> str:
    """As sha256sum has it."""
    with open(path, "rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def read(folder: str | Path) -> dict[str, str]:
    """Digests by path, of both lists of a folder."""
    lists = [Path(folder, name) for name in (LIST, MEASURED_LIST)]
    lines = [line for path in lists if path.exists() for line in path.read_text().splitlines()]
    return {path: digest for digest, _, path in (line.partition("  ") for line in lines)}


def write(folder: str | Path, digests: dict[str, str]) -> None:
    """Write both lists of a folder, each if it changes."""
    for name, measured in ((LIST, False), (MEASURED_LIST, True)):
        kept = [
            path for path in digests if is_measured(path.removeprefix(f"{folder}/")) == measured
        ]
        text = "".join(f"{digests[path]}  {path}\n" for path in sorted(kept))
        list_file = Path(folder, name)
        if list_file.exists() and list_file.read_text() == text:
            continue
        with written(list_file) as unfinished:
            unfinished.write_text(text)


def folders_of(paths: Iterable[str]) -> set[Path]:
    """Folders with lists, around these paths."""
    around = {parent for path in paths for parent in Path(path).parents}
    return {folder for folder in around if (folder / LIST).exists()}


def damaged(paths: Iterable[str]) -> list[str]:
    """Those of some results that differ from the lists."""
    paths = set(paths)
    known = {path: digest for folder in folders_of(paths) for path, digest in read(folder).items()}
    there = [path for path in paths & set(known) if Path(path).exists()]
    return sorted(path for path in there if differs(path, known[path]))


def differs(path: str, digest: str) -> bool:
    """Whether a result has another digest, or cannot be read."""
    try:
        return digest_of(path) != digest
    except OSError:
        return True


def forget(made: Iterable[str]) -> None:
    """At the start of a run: no list holds the results that it is to make.

    So those of a run that is killed are recorded by the next one. Damaged ones are removed, so that
    none of them is recorded.
    """
    made = set(made)
    for path in damaged(made):
        Path(path).unlink()
    for folder in folders_of(made):
        write(folder, {path: known for path, known in read(folder).items() if path not in made})


def record(folders: Iterable[str], made: Iterable[str]) -> None:
    """At the end: record what the run has made, and what no list holds. Others keep their digests,
    so that no run takes a result that was damaged or edited for a good one."""
    made = set(made)
    for folder in filter(os.path.isdir, folders):
        known = {path: digest for path, digest in read(folder).items() if path not in made}
        paths = [f"{folder}/{name}" for name in results_in(folder)]
        write(folder, {path: known.get(path) or digest_of(path) for path in paths})
