"""The table of ./test compilers, from made-up builds."""

import struct
from pathlib import Path

import compare_builds
import pytest


def made_build(folder: Path, name: str, last: float = 0.25, failed: int = 0) -> Path:
    """A build with two cases of two samples; `last` is the last value of the second."""
    build = folder / name
    found = build / "CMakeFiles" / "3.25.1" / "CMakeFortranCompiler.cmake"
    found.parent.mkdir(parents=True)
    found.write_text(
        'set(CMAKE_Fortran_COMPILER_ID "GNU")\nset(CMAKE_Fortran_COMPILER_VERSION "12.2.0")\n'
    )
    tests = "1: a [PASSED]\n1: b [PASSED]\n" + "2: c [FAILED]\n" * failed
    summary = f"{100 - 50 * failed}% tests passed, {failed} tests failed out of 2\n"
    (build / "log").write_text(f"{tests}\n{summary}")
    rows = {
        "cycle by explicit": [[0.0, 1.0, 2.0, 0.1], [1.0, 1.0, 2.0, 0.1]],
        "slips by auto": [[0.0, 1.0, 2.0, 0.2], [5.0, 1.0, -40.0, last]],
    }
    lines = [
        f"{case}: {' '.join(struct.pack('>d', value).hex().upper() for value in row)}\n"
        for case in rows
        for row in rows[case]
    ]
    (build / "trajectories.txt").write_text("".join(lines))
    return build


def test_same_bits_and_no_failures_are_well(tmp_path, capsys):
    """Status 0, each build with its compiler and counts."""
    assert compare_builds.main([made_build(tmp_path, name) for name in ("one", "two")]) == 0
    said = capsys.readouterr()
    cells = [cell.strip() for cell in said.out.splitlines()[2].split("  ") if cell.strip()]
    assert cells == ["two", "GNU 12.2.0", "2 of 2", "2 of 2", "yes", "0"]
    assert said.err == ""


@pytest.mark.parametrize(
    ("first", "second", "failed", "shown"),
    [
        # one other bit, with its place and size
        (0.25, 0.25 + 2.0**-54, 0, "no         5.6e-17 (slips by auto, from t = 5)"),
        # bits are compared, not values
        (0.0, -0.0, 0, "0.0e+00 (slips by auto, from t = 5)"),
        # a failed test, also where the bits are the same
        (0.25, 0.25, 1, "2 of 3"),
    ],
)
def test_build_that_differs_or_fails_is_shown(tmp_path, capsys, first, second, failed, shown):
    """With status 1 and the place of its log."""
    builds = [made_build(tmp_path, "one", first), made_build(tmp_path, "two", second, failed)]
    assert compare_builds.main(builds) == 1
    said = capsys.readouterr()
    assert shown in said.out
    assert said.err == f"compilers: two is not as it should be; see {tmp_path}/two/log\n"


@pytest.mark.parametrize("lost", ["log", "trajectories.txt"])
@pytest.mark.parametrize("which", ["one", "two"])
def test_build_without_its_files_is_shown(tmp_path, capsys, lost, which):
    """No log of tests or no trajectories, of the first or of another."""
    builds = [made_build(tmp_path, name) for name in ("one", "two")]
    (tmp_path / which / lost).unlink()
    assert compare_builds.main(builds) == 1
    said = capsys.readouterr()
    assert f"{which} is not as it should be" in said.err
    assert ("0 of 0" if lost == "log" else "no trajectories") in said.out


def test_lost_case_is_shown(tmp_path, capsys):
    """A trajectory that ended early."""
    builds = [made_build(tmp_path, name) for name in ("one", "two")]
    path = builds[1] / "trajectories.txt"
    path.write_text("".join(path.read_text().splitlines(keepends=True)[:-1]))
    assert compare_builds.main(builds) == 1
    assert "not the same cases" in capsys.readouterr().out
