"""Table of builds by several compilers: their unit tests, and whether their trajectories
(fortran/test/bits/trajectory_bits.f90) have the same bits as those of the first.

Usage: compare_builds.py BUILD...
Ends with status 1 unless all tests pass and all bits are the same.
"""

import re
import sys
from collections.abc import Iterable
from dataclasses import astuple, dataclass
from pathlib import Path

import numpy as np

HEADER = ("build", "compiler", "units passed", "suites passed", "same bits", "largest difference")


@dataclass
class Row:
    """A line of the table, as text."""

    build: str
    compiler: str
    units: str
    suites: str
    same: str
    difference: str


def trajectories(lines: Iterable[str]) -> dict[str, np.ndarray]:
    """Bits of each case: time, theta, u and ln v; shape (samples, 4)."""
    cases: dict[str, list[list[int]]] = {}
    for line in lines:
        case, numbers = line.split(":")
        cases.setdefault(case, []).append([int(number, 16) for number in numbers.split()])
    return {case: np.array(rows, dtype=np.uint64) for case, rows in cases.items()}


def read_trajectories(build: Path) -> dict[str, np.ndarray]:
    """Those of a build; none where it has none."""
    path = build / "trajectories.txt"
    return trajectories(path.read_text().splitlines()) if path.is_file() else {}


def difference(ours: dict[str, np.ndarray], theirs: dict[str, np.ndarray]) -> str:
    """The largest difference of a value, relative where values are above 1, and where it is."""
    if {case: rows.shape for case, rows in ours.items()} != {
        case: rows.shape for case, rows in theirs.items()
    }:
        return "not the same cases"
    worst = {}
    for case in (case for case in ours if (ours[case] != theirs[case]).any()):
        a, b = ours[case].view(np.float64), theirs[case].view(np.float64)
        worst[case] = (np.abs(a - b) / np.maximum(1.0, np.abs(a))).max()
    case = max(worst, key=worst.get)
    first = ours[case].view(np.float64)[(ours[case] != theirs[case]).any(axis=1)][0, 0]
    return f"{worst[case]:.1e} ({case}, from t = {first:g})"


def compiler(build: Path) -> str:
    """Name and version, as CMake found them."""
    found = {}
    for path in build.glob("CMakeFiles/*/CMakeFortranCompiler.cmake"):
        found = dict(re.findall(r'set\(CMAKE_Fortran_(\w+) "([^"]*)"\)', path.read_text()))
    return f"{found['COMPILER_ID']} {found['COMPILER_VERSION']}" if found else "none"


def passed(build: Path) -> tuple[str, str, bool]:
    """Units and suites that passed of those that there are, and whether all did."""
    path = build / "log"
    log = path.read_text(errors="replace") if path.is_file() else ""
    units = log.count("[PASSED]"), log.count("[FAILED]")
    found = re.search(r"^\d+% tests passed, (\d+) tests failed out of (\d+)$", log, re.MULTILINE)
    failed, suites = map(int, found.groups()) if found else (0, 0)
    well = units[0] > 0 and units[1] == 0 and suites > 0 and failed == 0
    return f"{units[0]} of {sum(units)}", f"{suites - failed} of {suites}", well


def row_of(build: Path, first: dict[str, np.ndarray]) -> tuple[Row, bool]:
    """A build against the first one's trajectories, and whether all is well."""
    units, suites, all_passed = passed(build)
    theirs = read_trajectories(build)
    same = first.keys() == theirs.keys() and all(
        np.array_equal(first[case], theirs[case]) for case in first
    )
    if not first or not theirs:
        same, words = False, "no trajectories"
    else:
        words = "0" if same else difference(first, theirs)
    row = Row(build.name, compiler(build), units, suites, "yes" if same else "no", words)
    return row, all_passed and same


def main(builds: list[Path]) -> int:
    """Print the table, and where to look for what failed."""
    first = read_trajectories(builds[0])
    rows, well = zip(*(row_of(build, first) for build in builds), strict=True)
    lines = [HEADER, *map(astuple, rows)]
    widths = [max(map(len, column)) for column in zip(*lines, strict=True)]
    for line in lines:
        cells = (cell.ljust(width) for cell, width in zip(line, widths, strict=True))
        print("  ".join(cells).rstrip())
    for build, good in zip(builds, well, strict=True):
        if not good:
            print(
                f"compilers: {build.name} is not as it should be; see {build}/log", file=sys.stderr
            )
    return 0 if all(well) else 1


if __name__ == "__main__":
    sys.exit(main([Path(name) for name in sys.argv[1:]]))
