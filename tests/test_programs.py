"""What all programs share: bad input is refused in words, and no output is left behind."""

import math
import os
import re
import shutil
import stat
from pathlib import Path

import pytest
import xarray as xr
from conftest import GROUPS

RANGES = {
    "trajectory": {
        "tau": ([(">=", 0)], [-1e-9]),
        "epsilon": ([(">", -1)], [-1.0, -2.0]),
        "xi": ([(">", 0)], [0.0, -1.0]),
        "gamma": ([(">", 0)], [0.0, -1.0]),
        "history%theta": ([], []),
        "history%u": ([], []),
        "history%v": ([(">", 0)], [0.0, -1.0]),
        "t_end": ([(">", 0)], [0.0, -1.0]),
        "t_transient": ([(">=", 0), ("<", 30)], [-1.0, 30.0, 31.0]),
        "sample_interval": ([(">", 0), ("<=", 30)], [0.0, -0.1, 30.1]),
        "tolerance": ([(">=", 1e-13), ("<=", 1e-2)], [0.0, 9.9e-14, 1.01e-2]),
    },
    "spectrum": {
        "overlap": ([(">=", 0), ("<", 1)], [-0.1, 1.0]),
        "peak_floor": ([(">", 0), ("<=", 1)], [0.0, 1.1]),
        "peak_prominence": ([(">=", 1)], [0.9]),
    },
    "hopf": {
        "fixed": ([(">", 0)], [0.0, -1.0]),
        "gamma": ([(">", 0)], [0.0, -1.0]),
        "epsilon_window(1)": ([(">", -1)], [-1.0]),
        "epsilon_window(2)": ([(">", 0)], [0.0, -0.5]),
        "ordinate_window(1)": ([(">=", 0)], [-1e-9]),
        "ordinate_window(2)": ([(">", 0)], [0.0, -1.0]),
    },
    "linear_stability": {
        "tau": ([(">=", 0)], [-0.1]),
        "epsilon": ([(">", -1)], [-1.0]),
        "xi": ([(">", 0)], [0.0]),
        "gamma": ([(">", 0)], [0.0]),
        "root_bound": ([("<=", 0)], [0.1]),
        "tau_most": ([(">", 0)], [0.0]),
        "epsilon_most": ([(">", 0)], [0.0]),
    },
    "velocity_step": {
        "mu0": ([(">=", 0)], [-0.1]),
        "a": ([(">=", 0)], [-0.1]),
        "b": ([(">=", 0)], [-0.1]),
        "dc": ([(">", 0)], [0.0]),
        "v0": ([(">", 0)], [0.0]),
        "b_state": ([(">", 0)], [0.0]),
        "delta_v": ([(">", 0)], [0.0]),
        "slip_before": ([(">", 0)], [0.0]),
        "slip_after": ([(">", 0)], [0.0]),
        "tolerance": ([(">=", 1e-13), ("<=", 1e-2)], [9.9e-14, 1.01e-2]),
    },
}
"""For each number that a program reads: its range, and values out of range."""
NUMBERS = [(program, key) for program, keys in RANGES.items() for key in keys]
OUT_OF_RANGE = [
    (program, key, value, bounds)
    for program, keys in RANGES.items()
    for key, (bounds, values) in keys.items()
    for value in values
]
COUNTS = [
    ("hopf", "cells", 0, 1),
    ("spectrum", "segments", 0, 1),
    ("velocity_step", "samples", 1, 2),
]
WORDS = [
    ("trajectory", "method", "auto explicit"),
    ("spectrum", "window", "hann boxcar"),
    ("hopf", "ordinate", "tau xi"),
]


def put(values: dict, key: str, value) -> None:
    """Set a value by the name that Fortran gives it: key, key%component or key(index)."""
    name, component, index = re.fullmatch(r"(\w+)(?:%(\w+))?(?:\((\d)\))?", key).groups()
    if component:
        values[name][component] = value
    elif index:
        values[name][int(index) - 1] = value
    else:
        values[name] = value


def refusal(programs, run) -> str:
    """The one line with which a program refused, after which nothing may be left."""
    assert run.returncode == 1
    assert run.stdout == ""
    assert programs.left_behind() == []
    (line,) = run.stderr.splitlines()
    assert line.startswith("error: ")
    return line


def assert_names_place(line: str, program: str) -> None:
    """A refusal names the file, and the scene where there is one."""
    assert "input.nml" in line
    assert program != "trajectory" or "scene 'torus'" in line


@pytest.mark.parametrize("program", GROUPS)
def test_good_input_makes_one_file(programs, good_inputs, program):
    """Nothing on the screen, one file in the folder."""
    programs.made_by(program, good_inputs[program])
    assert programs.left_behind() == ["output.nc"]


@pytest.mark.parametrize("program", GROUPS)
def test_paths_may_hold_spaces(programs, good_inputs, program):
    """Namelist and output in a folder of such a name."""
    programs.made_by(program, good_inputs[program])
    run = programs.run(program, programs.folder / "input.nml", programs.folder / "once more.nc")
    assert run.returncode == 0
    assert programs.left_behind() == ["once more.nc", "output.nc"]


@pytest.mark.parametrize(("program", "key", "value", "bounds"), OUT_OF_RANGE)
def test_value_out_of_range_is_refused(programs, good_inputs, program, key, value, bounds):
    """The line names file, scene, key, value and range."""
    put(good_inputs[program], key, value)
    line = refusal(programs, programs.run_with(program, good_inputs[program]))
    assert_names_place(line, program)
    met, expected = re.search(
        rf"{re.escape(key)}\S* (?:\(\w+\) )?= (\S+); expected (.*)", line
    ).groups()
    assert float(met) == pytest.approx(value, rel=1e-6)
    named = [(sign, float(bound)) for sign, bound in re.findall(r"([<>]=?) (\S+)", expected)]
    assert named == bounds


def test_hint_about_nan_is_given_for_nan_only(programs, good_inputs):
    """A key that is missing reads as NaN; -1 is not missing."""
    good_inputs["trajectory"]["tau"] = -1.0
    assert "NaN" not in refusal(
        programs, programs.run_with("trajectory", good_inputs["trajectory"])
    )
    del good_inputs["trajectory"]["tau"]
    assert "missing" in refusal(
        programs, programs.run_with("trajectory", good_inputs["trajectory"])
    )


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf])
@pytest.mark.parametrize(("program", "key"), NUMBERS)
def test_number_that_is_not_finite_is_refused(programs, good_inputs, program, key, value):
    """The line names file, scene, key and value."""
    put(good_inputs[program], key, value)
    line = refusal(programs, programs.run_with(program, good_inputs[program]))
    assert_names_place(line, program)
    met = re.search(rf"{re.escape(key)}\S* (?:\(\w+\) )?= (\S+); expected a finite number", line)[1]
    assert float(met) == pytest.approx(value, nan_ok=True)


@pytest.mark.parametrize(("program", "key", "value", "least"), COUNTS)
def test_count_out_of_range_is_refused(programs, good_inputs, program, key, value, least):
    """The line names file, key, value and range."""
    good_inputs[program][key] = value
    line = refusal(programs, programs.run_with(program, good_inputs[program]))
    assert f"input.nml: {key} = {value}; expected a whole number >= {least}" in line


@pytest.mark.parametrize("ending", ["", "x"])
@pytest.mark.parametrize(("program", "key", "choices"), WORDS)
def test_unknown_word_is_refused(programs, good_inputs, program, key, choices, ending):
    """Another word, and the longest right word with a letter too many."""
    value = max(choices.split(), key=len) + ending if ending else "other"
    good_inputs[program][key] = value
    line = refusal(programs, programs.run_with(program, good_inputs[program]))
    assert_names_place(line, program)
    assert f"{key} = '{value}'; expected one of " in line
    assert all(f"'{choice}'" in line for choice in choices.split())


@pytest.mark.parametrize("variables", [["w"], ["thetas"], ["", "v"], ["u", "v", "w"], ["V"]])
def test_unknown_variable_is_refused(programs, good_inputs, variables):
    """The line names file, scene, key and the three names."""
    good_inputs["trajectory"]["variables"] = variables
    line = refusal(programs, programs.run_with("trajectory", good_inputs["trajectory"]))
    assert_names_place(line, "trajectory")
    assert "variables = '" in line
    assert all(f"'{name}'" in line for name in ("theta", "u", "v"))


def test_repeated_variable_is_refused(programs, good_inputs):
    """As the config check does."""
    good_inputs["trajectory"]["variables"] = ["v", "v"]
    line = refusal(programs, programs.run_with("trajectory", good_inputs["trajectory"]))
    assert_names_place(line, "trajectory")
    assert "variables" in line


def test_name_too_long_is_refused(programs, good_inputs):
    """It would be cut in the output's attribute."""
    good_inputs["trajectory"]["name"] = 65 * "a"
    line = refusal(programs, programs.run_with("trajectory", good_inputs["trajectory"]))
    assert "name" in line


@pytest.mark.parametrize(
    ("program", "key"),
    [
        *((program, key) for program, key in NUMBERS if not set(key) & set("%()")),
        *((program, key) for program, key, *_ in [*COUNTS, *WORDS]),
        ("trajectory", "history"),
        ("trajectory", "variables"),
        ("hopf", "epsilon_window"),
        ("hopf", "ordinate_window"),
        ("spectrum", "trajectory"),
    ],
)
def test_missing_key_is_refused(programs, good_inputs, program, key):
    """A program has no defaults."""
    del good_inputs[program][key]
    line = refusal(programs, programs.run_with(program, good_inputs[program]))
    assert "input.nml" in line
    assert key in line


@pytest.mark.parametrize("program", GROUPS)
def test_unknown_key_is_refused(programs, good_inputs, program):
    """The line names file, group and key."""
    run = programs.run_with(program, {**good_inputs[program], "colour": 1.0})
    line = refusal(programs, run)
    assert "input.nml" in line
    assert f"&{GROUPS[program]}" in line
    assert "colour" in line


@pytest.mark.parametrize("program", GROUPS)
@pytest.mark.parametrize("text", ["", "garbage\n", "&other a = 1 /\n", "\0\1\2\xff", "&{group}\n"])
def test_file_without_the_group_is_refused(programs, program, text):
    """The line names file and group."""
    namelist = programs.folder / "input.nml"
    namelist.write_text(text.format(group=GROUPS[program]), encoding="latin-1")
    line = refusal(programs, programs.run(program, namelist.name, programs.output.name))
    assert "input.nml" in line
    assert f"&{GROUPS[program]}" in line


@pytest.mark.parametrize(
    ("program", "key"),
    [
        ("trajectory", "tau"),
        ("spectrum", "segments"),
        ("hopf", "fixed"),
        ("velocity_step", "samples"),
    ],
)
def test_text_for_a_number_is_refused(programs, good_inputs, program, key):
    """The line names file and group."""
    good_inputs[program][key] = "much"
    line = refusal(programs, programs.run_with(program, good_inputs[program]))
    assert "input.nml" in line
    assert f"&{GROUPS[program]}" in line


@pytest.mark.parametrize("program", GROUPS)
def test_missing_namelist_is_refused(programs, program):
    """The line names the file."""
    assert "nowhere.nml" in refusal(programs, programs.run(program, "nowhere.nml", "output.nc"))


@pytest.mark.parametrize("program", GROUPS)
@pytest.mark.parametrize("arguments", [[], ["a.nml"], ["a.nml", "b.nc", "c"]])
def test_other_than_two_arguments_are_refused(programs, program, arguments):
    """The line says how the program is used."""
    line = refusal(programs, programs.run(program, *arguments))
    assert f"{program} NAMELIST OUTPUT" in line


@pytest.mark.parametrize("program", GROUPS)
def test_output_in_a_missing_folder_is_refused(programs, good_inputs, program):
    """The line names the output."""
    programs.made_by(program, good_inputs[program])
    programs.output.unlink()
    line = refusal(programs, programs.run(program, "input.nml", "nowhere/output.nc"))
    assert line.startswith("error: nowhere/output.nc: cannot write: there is no such folder; see")


@pytest.mark.parametrize("program", GROUPS)
def test_output_that_is_no_file_is_refused(programs, program):
    """A folder, a device, a pipe or a link, before anything is read; it stays, nothing is left."""
    place = programs.folder / "of each kind.nml"
    for name in ("folder", "pipe", "link", "device"):
        place.mkdir()
        path = place / name
        if name == "folder":
            path.mkdir()
        elif name == "pipe":
            os.mkfifo(path)
        elif name == "link":
            path.symlink_to("/dev/null")
        else:
            path = Path("/dev/null")
        line = refusal(programs, programs.run(program, "nowhere.nml", path))
        assert line.startswith(
            f"error: {path}: cannot write: a folder, a device or a link is there"
        )
        assert stat.S_IFMT(path.lstat().st_mode) != stat.S_IFREG
        assert [left.name for left in place.iterdir()] == [name][: name != "device"]
        shutil.rmtree(place)


@pytest.mark.parametrize("program", GROUPS)
def test_output_that_is_the_input_is_refused(programs, good_inputs, program):
    """By its own name or another; the namelist stays."""
    programs.made_by(program, good_inputs[program])
    programs.output.unlink()
    namelist = programs.folder / "input.nml"
    before = namelist.read_bytes()
    other = programs.folder / "another name.nml"
    other.hardlink_to(namelist)
    for path in (namelist, other):
        line = refusal(programs, programs.run(program, "input.nml", path))
        assert line.startswith(f"error: {path}: cannot write: it is the input input.nml; expected")
    assert namelist.read_bytes() == before


def test_spectrum_does_not_replace_its_trajectory(programs, good_inputs):
    """Which the namelist names."""
    trajectory = programs.folder / "trajectory.nml"
    shutil.copy(good_inputs["spectrum"]["trajectory"], trajectory)
    before = trajectory.read_bytes()
    good_inputs["spectrum"]["trajectory"] = "trajectory.nml"
    programs.made_by("spectrum", good_inputs["spectrum"])
    programs.output.unlink()
    line = refusal(programs, programs.run("spectrum", "input.nml", "trajectory.nml"))
    assert "trajectory.nml: cannot write: it is the input trajectory.nml; expected" in line
    assert trajectory.read_bytes() == before


@pytest.mark.parametrize("program", GROUPS)
def test_refusal_leaves_an_older_output_alone(programs, good_inputs, program):
    """A file under the final name is always a whole one."""
    programs.made_by(program, good_inputs[program])
    before = programs.output.read_bytes()
    assert programs.run_with(program, {**good_inputs[program], "colour": 1.0}).returncode == 1
    assert programs.output.read_bytes() == before


def test_integration_that_fails_says_where(programs, good_inputs):
    """A velocity of 1e-300 makes the first step impossible."""
    good_inputs["trajectory"]["history"]["v"] = 1e-300
    line = refusal(programs, programs.run_with("trajectory", good_inputs["trajectory"]))
    assert re.search(r"stopped at t = \S+ of 30\.0+ after \d+ steps", line)


def test_spectrum_of_a_missing_trajectory_is_refused(programs, good_inputs):
    """The line names the trajectory."""
    good_inputs["spectrum"]["trajectory"] = "nowhere.nc"
    line = refusal(programs, programs.run_with("spectrum", good_inputs["spectrum"]))
    assert "nowhere.nc: cannot be opened" in line


def test_spectrum_of_a_truncated_trajectory_is_refused(programs, good_inputs):
    """The line names the trajectory."""
    whole = good_inputs["spectrum"]["trajectory"]
    with open(whole, "rb") as source, open(programs.folder / "half.nml", "wb") as target:
        target.write(source.read(os.path.getsize(whole) // 2))
    good_inputs["spectrum"]["trajectory"] = "half.nml"
    line = refusal(programs, programs.run_with("spectrum", good_inputs["spectrum"]))
    assert "half.nml: cannot be opened (remove it to have it made anew): NetCDF: " in line


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (lambda data: data.drop_vars("v"), "holds no variable 'v'"),
        (lambda data: data.drop_attrs(), "attribute 'scene'"),
        (lambda data: data.where(data.time > 250), "v"),
        (lambda data: data.isel(time=slice(2010)), "samples"),
    ],
    ids=["without v", "without attributes", "with NaN", "too short"],
)
def test_spectrum_of_an_unfit_trajectory_is_refused(programs, good_inputs, change, words):
    """The line names the trajectory and what is wrong with it."""
    trajectory = xr.load_dataset(good_inputs["spectrum"]["trajectory"])
    change(trajectory).to_netcdf(programs.folder / "unfit.nml")
    good_inputs["spectrum"]["trajectory"] = "unfit.nml"
    line = refusal(programs, programs.run_with("spectrum", good_inputs["spectrum"]))
    assert "unfit.nml" in line
    assert words in line
