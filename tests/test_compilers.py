"""The table of ./test compilers, from made-up builds."""

import struct
from pathlib import Path

import compare_builds
import pytest


def written_bits(values: list[float]) -> str:
    """Hexadecimal digits of the bits of numbers."""
    return " ".join(struct.pack(">d", value).hex().upper() for value in values)


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
    (build / "log").write_text(tests + "\n" + summary)
    rows = {
        "cycle by explicit": [[0.0, 1.0, 2.0, 0.1], [1.0, 1.0, 2.0, 0.1]],
        "slips by auto": [[0.0, 1.0, 2.0, 0.2], [5.0, 1.0, -40.0, last]],
    }
    lines = [f"{case}: {written_bits(row)}\n" for case in rows for row in rows[case]]
    (build / "trajectories.txt").write_text("".join(lines))
    return build


def lines_of(capsys) -> list[list[str]]:
    """Cells of the table printed, and what was said beside it as the last line."""
    said = capsys.readouterr()
    return [line.split("  ") for line in said.out.splitlines()] + [[said.err]]


def test_same_bits_and_no_failures_are_well(tmp_path, capsys):
    """Status 0, each build with its compiler and counts."""
    builds = [made_build(tmp_path, name) for name in ("one", "two")]
    assert compare_builds.main(builds) == 0
    header, one, two, said = lines_of(capsys)
    assert header[0].strip() == "build"
    cells = [cell.strip() for cell in two if cell.strip()]
    assert cells == ["two", "GNU 12.2.0", "2 of 2", "2 of 2", "yes", "0"]
    assert one[0].strip() == "one"
    assert said == [""]


def test_one_other_bit_is_found(tmp_path, capsys):
    """Where it is and how much, and status 1."""
    other = 0.25 + 2.0**-54
    builds = [made_build(tmp_path, "one"), made_build(tmp_path, "two", last=other)]
    assert compare_builds.main(builds) == 1
    *_, two, said = lines_of(capsys)
    assert [cell.strip() for cell in two if cell.strip()][-2:] == [
        "no",
        "5.6e-17 (slips by auto, from t = 5)",
    ]
    assert said == [f"compilers: two is not as it should be; see {tmp_path}/two/log\n"]


def test_minus_zero_is_not_zero(tmp_path, capsys):
    """Bits are compared, not values."""
    builds = [made_build(tmp_path, "one", last=0.0), made_build(tmp_path, "two", last=-0.0)]
    assert compare_builds.main(builds) == 1
    assert "0.0e+00 (slips by auto, from t = 5)" in capsys.readouterr().out


def test_failed_test_is_told(tmp_path, capsys):
    """Also where the bits are the same."""
    builds = [made_build(tmp_path, "one"), made_build(tmp_path, "two", failed=1)]
    assert compare_builds.main(builds) == 1
    assert "2 of 3" in capsys.readouterr().out


@pytest.mark.parametrize("lost", ["log", "trajectories.txt"])
@pytest.mark.parametrize("which", ["one", "two"])
def test_build_that_failed_is_told(tmp_path, capsys, lost, which):
    """No log of tests or no trajectories, of the first or of another."""
    builds = [made_build(tmp_path, name) for name in ("one", "two")]
    (tmp_path / which / lost).unlink()
    assert compare_builds.main(builds) == 1
    said = capsys.readouterr()
    assert f"{which} is not as it should be" in said.err
    assert ("0 of 0" if lost == "log" else "no trajectories") in said.out


def test_lost_case_is_told(tmp_path, capsys):
    """A trajectory that ended early."""
    builds = [made_build(tmp_path, name) for name in ("one", "two")]
    path = builds[1] / "trajectories.txt"
    path.write_text("".join(path.read_text().splitlines(keepends=True)[:-1]))
    assert compare_builds.main(builds) == 1
    assert "not the same cases" in capsys.readouterr().out
