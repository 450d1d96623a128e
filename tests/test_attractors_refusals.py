"""The program `attractors`: bad input is refused in words, and nothing is left behind."""

import math

import pytest
from attractors_runs import OBSERVATION, POINTS, good_groups, made, run

from scripts.namelists.write_namelist import write_groups

BAD = [
    *[("t_transient", value, "a finite number > 0") for value in (0.0, -1.0, math.nan, math.inf)],
    *[("t_observed", value, "a finite number > 0") for value in (0.0, -1.0, math.nan)],
    *[("t_turning", value, "a finite number >= 0") for value in (-1.0, math.nan)],
    *[("interval", value, "a finite number > 0") for value in (0.0, math.nan)],
    ("blocks", 1, "a whole number >= 2"),
    ("blocks", 1001, "a whole number <= 1000"),
    ("exponents", 0, "a whole number >= 1"),
    ("exponents", 65, "a whole number <= 64"),
    *[("zero_level", value, "a finite number >= 0") for value in (-1e-9, math.nan)],
    *[("longest_bar", value, "a finite number > 0") for value in (0.0, math.nan)],
    ("doublings", -1, "a whole number >= 0"),
    ("doublings", 11, "a whole number <= 10"),
    *[("sample_interval", value, "a finite number > 0") for value in (0.0, 200.1, math.nan)],
    ("window", "hamming", "one of"),
    ("segments", 0, "a whole number >= 1"),
    *[("overlap", value, "a finite number >= 0.0 < 1.0") for value in (-0.1, 1.0, math.nan)],
    *[("peak_floor", value, "a finite number > 0.0 <= 1.0") for value in (0.0, 1.1, math.nan)],
    *[("peak_prominence", value, "a finite number >= 1") for value in (0.9, math.nan)],
    *[("tolerance", value, "a finite number >= ") for value in (9.9e-14, 1.01e-2, math.nan)],
    ("method", "radau", "one of"),
    ("most_steps", 0, "a whole number >= 1"),
    *[("xi", value, "a finite number > 0") for value in (0.0, -1.0, math.nan)],
    *[("gamma", value, "a finite number > 0") for value in (0.0, -1.0, math.nan)],
    ("epsilon_count", 0, "a whole number >= 1"),
    ("epsilon_count", 100001, "a whole number <= 100000"),
    ("tau_count", 0, "a whole number >= 1"),
    ("tau_count", 100001, "a whole number <= 100000"),
    ("kept", -1, "a whole number >= 0"),
    ("kept", 100001, "a whole number <= 100000"),
]
"""Key, value out of range, words of the range."""


@pytest.fixture
def groups() -> dict[str, dict]:
    """Namelist groups that the program accepts, to change."""
    return good_groups()


def group_of(key: str) -> str:
    """The group that holds a key."""
    return "observation" if key in OBSERVATION else "points"


def refusal(programs, groups: dict[str, dict]) -> str:
    """The one line with which the program refuses; nothing is left behind."""
    done = run(programs, groups)
    assert (done.returncode, done.stdout) == (1, "")
    assert programs.left_behind() == []
    (line,) = done.stderr.splitlines()
    assert line.startswith("error: input.nml: ")
    return line


@pytest.mark.parametrize(("key", "value", "words"), BAD)
def test_value_out_of_range_is_refused(programs, groups, key, value, words):
    """The line names file, key, value and range."""
    groups[group_of(key)][key] = value
    line = refusal(programs, groups)
    if isinstance(value, float) and not math.isfinite(value):
        assert f"{key} = " in line
    else:
        met = line.split(f"{key} = ")[1].split(";")[0].strip("'")
        assert met == value if isinstance(value, str) else float(met) == pytest.approx(value)
    assert "; expected " in line
    assert words in line


@pytest.mark.parametrize("key", ["epsilon", "tau"])
@pytest.mark.parametrize("part", [[0, 1], [2, 1], [1, 4], [4, 4], [-1, 2]])
def test_part_outside_the_grid_is_refused(programs, groups, key, part):
    """The line names the part and the grid."""
    groups["points"] |= {f"{key}_count": 3, f"{key}_part": part}
    words = f"{key}_part = {part[0]}, {part[1]}; expected first and last, 1 <= first <= last <= 3"
    assert words in refusal(programs, groups)


@pytest.mark.parametrize(
    ("key", "window", "words"),
    [
        ("epsilon_window", [-1.0, 0.5], "epsilon_window = -1.0; expected a finite number > -1.0"),
        ("epsilon_window", [0.5, -2.0], "epsilon_window = -2.0; expected a finite number > -1.0"),
        ("epsilon_window", [0.5, math.inf], "epsilon_window = "),
        ("epsilon_window", [0.5], "epsilon_window = NaN; expected a finite number > -1.0"),
        ("tau_window", [-0.1, 5.0], "tau_window = -0.1; expected a finite number >= 0.0"),
        ("tau_window", [5.0, math.nan], "tau_window = NaN; expected a finite number >= 0.0"),
    ],
)
def test_window_out_of_range_is_refused(programs, groups, key, window, words):
    """Either end."""
    groups["points"][key] = window
    assert words in refusal(programs, groups)


@pytest.mark.parametrize(
    ("histories", "words"),
    [
        ({"theta": [], "u": [], "v": []}, "number of histories = 0; expected"),
        ({"v": []}, "v(1) = NaN; expected a finite number > 0.0"),
        ({"v": [1.1]}, "v(2) = NaN; expected a finite number > 0.0"),
        ({"v": [1.1, 0.0]}, "v(2) = 0.0; expected a finite number > 0.0"),
        ({"v": [1.1, math.inf]}, "v(2) = "),
        ({"u": [0.0]}, "u(2) = NaN; expected a finite number"),
        ({"theta": [0.0, 0.5, 1.0]}, "u(3) = NaN; expected a finite number"),
        ({"theta": [math.inf, 0.0]}, "theta(1) = "),
        ({key: [1.0] * 1001 for key in ("theta", "u", "v")}, "&points"),
    ],
)
def test_histories_that_are_none_are_refused(programs, groups, histories, words):
    """None at all, one without a value, one out of range, more than there is place for."""
    for key, values in histories.items():
        groups["points"][key] = values
        if not values:
            del groups["points"][key]
    assert words in refusal(programs, groups)


def test_more_points_than_fit_are_refused(programs, groups):
    """Not met as lack of memory."""
    groups["points"] |= {"epsilon_count": 1001, "epsilon_part": [1, 1001]}
    groups["points"] |= {"tau_count": 1000, "tau_part": [1, 1000], "v": [1.1], "u": [0.0]}
    groups["points"]["theta"] = [0.0]
    assert "number of points = " in refusal(programs, groups)


@pytest.mark.parametrize("name", ["", 129 * "a"])
def test_name_that_is_none_or_too_long_is_refused(programs, groups, name):
    """It would be cut in the output's attribute."""
    groups["points"]["name"] = name
    assert f"letters of name = {len(name)}; expected" in refusal(programs, groups)


@pytest.mark.parametrize(
    "key", [*OBSERVATION, *(key for key in POINTS if key not in ("theta", "u"))]
)
def test_missing_key_is_refused(programs, groups, key):
    """The program has no defaults."""
    del groups[group_of(key)][key]
    line = refusal(programs, groups)
    assert key in line


@pytest.mark.parametrize("group", ["observation", "points"])
def test_missing_group_is_refused(programs, groups, group):
    """The line names it."""
    del groups[group]
    assert f"no complete namelist group &{group} in it" in refusal(programs, groups)


@pytest.mark.parametrize("group", ["observation", "points"])
@pytest.mark.parametrize(("key", "value"), [("colour", 1.0), ("kept", "much"), ("blocks", "many")])
def test_unknown_key_and_text_for_a_number_are_refused(programs, groups, group, key, value):
    """The line names the group."""
    groups[group][key] = value
    assert f"namelist group &{group}" in refusal(programs, groups)


def test_missing_namelist_and_arguments_are_refused(programs):
    """The line names the file, or says how the program is used."""
    done = programs.run("attractors", "nowhere.nml", "output.nc")
    assert done.returncode == 1
    assert "nowhere.nml" in done.stderr
    for arguments in ([], ["a.nml"], ["a.nml", "b.nc", "c"]):
        done = programs.run("attractors", *arguments)
        assert done.returncode == 1
        assert "attractors NAMELIST OUTPUT" in done.stderr
    assert programs.left_behind() == []


def test_output_that_cannot_be_written_is_an_error(programs, groups):
    """A missing folder or a folder of that name; nothing unfinished is left."""
    groups["points"] |= {"epsilon_part": [2, 2], "tau_part": [1, 1]}
    write_groups(programs.folder / "input.nml", groups)
    done = programs.run("attractors", "input.nml", "nowhere/output.nc")
    assert done.returncode == 1
    assert "nowhere/output.nc" in done.stderr
    assert programs.left_behind() == []
    programs.output.mkdir()
    done = programs.run("attractors", "input.nml", "output.nc")
    assert done.returncode == 1
    assert "output.nc" in done.stderr
    assert programs.left_behind() == ["output.nc"]
    assert list(programs.output.iterdir()) == []


def test_refusal_leaves_an_older_output_alone(programs, groups):
    """A file under the final name is always a whole one."""
    groups["points"] |= {"epsilon_part": [2, 2], "tau_part": [1, 1]}
    made(programs, groups)
    before = programs.output.read_bytes()
    groups["observation"]["blocks"] = 0
    assert run(programs, groups).returncode == 1
    assert programs.output.read_bytes() == before
