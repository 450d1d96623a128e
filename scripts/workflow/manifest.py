"""Digests of all results, by which damage is noticed and two people compare their results.

Each folder of results has two lists in the format of sha256sum: results that depend on nothing but
the project, and what was measured on this machine. Paths begin in the folder of the project.
"""

import hashlib
import sys
from pathlib import Path

from scripts.files.outputs import written
from scripts.plans.studies import is_measured, kinds_of_results

LIST, MEASURED_LIST = "manifest.sha256", "measured.sha256"
STAMP = ".run-began"
"""A file that is as old as the run at work, or as the first one that was killed."""


def results_in(folder: str | Path) -> list[str]:
    """Results by their paths in a folder, which may hold other folders of results."""
    found = [path for kind in kinds_of_results() for path in Path(folder, kind).rglob("*")]
    found += Path(folder).glob("*.html")
    names = (path.relative_to(folder).as_posix() for path in found if path.is_file())
    return sorted(name for name in names if not name.endswith(".part"))


def read_digests(folder: str | Path) -> dict[str, str]:
    """Digests by path, of both lists of a folder."""
    lists = [Path(folder, name) for name in (LIST, MEASURED_LIST)]
    lines = [line for path in lists if path.exists() for line in path.read_text().splitlines()]
    return {path: digest for digest, _, path in (line.partition("  ") for line in lines)}


def begin_run(folder: str | Path) -> None:
    """From now on results may change."""
    Path(folder).mkdir(parents=True, exist_ok=True)
    if not Path(folder, STAMP).exists():
        Path(folder, STAMP).touch()


def remove_damaged(folder: str | Path) -> list[str]:
    """Remove results that have changed while no run was at work, so that a run makes them again.

    Results that a killed run has made are good: Snakemake knows which of its jobs did not end.
    """
    damaged = [
        path
        for path, digest in read_digests(folder).items()
        if Path(path).exists() and not _is_of_run(folder, path) and _digest_of(path) != digest
    ]
    for path in damaged:
        Path(path).unlink()
    return damaged


def record_run(folder: str | Path) -> None:
    """Record what the run has made; other results keep their digests, so that no run takes a
    result that was damaged or edited for a good one."""
    known = read_digests(folder)
    digests = {}
    for name in results_in(folder):
        path = f"{folder}/{name}"
        keeps = path in known and not _is_of_run(folder, path)
        digests[path] = known[path] if keeps else _digest_of(path)
    for list_name, measured in ((LIST, False), (MEASURED_LIST, True)):
        kept = [path for path in digests if is_measured(path[len(f"{folder}/") :]) == measured]
        with written(Path(folder, list_name)) as unfinished:
            unfinished.write_text("".join(f"{digests[path]}  {path}\n" for path in sorted(kept)))
    Path(folder, STAMP).unlink(missing_ok=True)


def _is_of_run(folder: str | Path, path: str) -> bool:
    """Whether a result is younger than the beginning of the run at work, or of a killed one."""
    stamp = Path(folder, STAMP)
    return stamp.exists() and Path(path).stat().st_mtime_ns >= stamp.stat().st_mtime_ns


def _digest_of(path: str) -> str:
    with open(path, "rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


if __name__ == "__main__":
    for path in remove_damaged(sys.argv[1]):
        words = "was changed or damaged since a run made it; it is made again"
        print(f"{path}: {words}", file=sys.stderr)
