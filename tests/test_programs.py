"""What all programs share: bad input is refused in words, and no output is left behind.

Ranges of keys are tests of the configuration. Programs refuse what would break the equations.
"""

import copy
import os
import re
import shutil
import subprocess

import netCDF4
import pytest
import xarray as xr
from namelist_groups import in_groups

from conftest import COMMANDS, Programs
from generator.module import interface_digest
from scripts.models.models import PAPER

NUMBER = "expected a finite number >"
WHOLE = "expected a whole number >="
NO_WORD = f"parameter of the model {PAPER} = 'w'; expected one of 'tau' "
REFUSED = [
    # a number out of range, of each command
    ("trajectory", "scene", {"tau": -1.0}, f"scene 'torus': tau = -1.0; {NUMBER}= "),
    ("spectrum", "spectrum", {"segments": 0}, f"spectrum: segments = 0; {WHOLE} 1"),
    ("hopf", "hopf_curves", {"gamma": 0.0}, f"gamma = 0.0; {NUMBER} 0"),
    ("cycles", "cycles", {"degree": 2}, "degree = 2; expected a whole number >= 3"),
    ("attractors", "points", {"refinements": -1}, f"points: refinements = -1; {WHOLE} 0"),
    ("attractors", "observation", {"t_path": 1e300}, "observation: sample_interval = "),
    ("reference", "cases", {"t_end": [-1.0, -1.0]}, f"case 'decay': t_end = -1.0; {NUMBER}= 0"),
    ("linear_stability", "linear_stability", {"xi": -1.0}, f"xi = -1.0; {NUMBER} 0"),
    ("slip_events", "scene", {"xi": -1.0}, f"scene 'torus': xi = -1.0; {NUMBER} 0"),
    ("exponents", "exponents", {"batches": 1}, f"exponents%batches = 1; {WHOLE} 2"),
    ("synchrony", "synchrony", {"count": 1}, f"synchrony%count = 1; {WHOLE} 2"),
    ("synchrony", "scene", {"kappa": None}, "the equations of the model have no second_difference"),
    ("measure", "measure", {"repeats": -1}, f"repeats = -1; {WHOLE} 0"),
    # more samples than can be counted: their file would fill the disk
    ("trajectory", "scene", {"t_end": 1e12}, f"scene 'torus': sample_interval = 0.25; {NUMBER}= "),
    ("exponents", "exponents", {"t_end": 1e12}, "exponents%interval = "),
    ("measure", "cases", {"t_end": [1e12, 1e12]}, "case 'decay': sample_interval = 0.5; "),
    # a word that is unknown
    ("spectrum", "spectrum", {"window": "w"}, "spectrum: window = 'w'; expected one of 'hann'"),
    ("hopf", "hopf_curves", {"ordinate": "w", "tau": 7.0}, NO_WORD),
    ("hopf", "hopf_curves", {"ordinate": "epsilon", "tau": 7.0}, "along = 'epsilon' twice; exp"),
    ("attractors", "points", {"sweep": "w"}, "points: sweep = 'w'; expected one of 'none'"),
    # a key that is unknown or missing, a law that is no name of one
    ("trajectory", "scene", {"tau": None}, "scene 'torus': tau is missing; expected a "),
    ("trajectory", "scene", {"absent": 1.0}, "namelist group &settings: Cannot match namelist"),
    ("trajectory", "scene", {"law": "../models/slip_cut_off"}, "scene 'torus': model = '../m"),
]
"""Commands, a group of their namelist, values that are refused, and words of the refusal."""


def refusal(programs: Programs, run) -> str:
    """The one line with which a program refused, after which nothing may be left."""
    assert run.returncode == 1
    assert run.stdout == ""
    assert programs.left_behind() == []
    (line,) = run.stderr.splitlines()
    assert line.startswith("error: ")
    return line


def flip_a_bit(content: bytes) -> bytes:
    """The content with another bit among the values of v, the last variable."""
    place = len(content) * 4 // 5
    return content[:place] + bytes([content[place] ^ 1]) + content[place + 1 :]


@pytest.mark.parametrize("program", COMMANDS)
def test_good_input_makes_one_file(programs, good_groups, program):
    """Nothing on the screen; a second run makes the same bytes; every variable has a checksum."""
    programs.check_silent(programs.run_groups(program, good_groups[program]))
    assert programs.left_behind() == ["output.nc"]
    if program != "reference":
        with netCDF4.Dataset(programs.output) as file:
            assert all(one.filters()["fletcher32"] for one in file.variables.values())
    run = programs.run(program, programs.folder / "input.nml", programs.folder / "once more.nc")
    assert run.returncode == 0
    assert programs.left_behind() == ["once more.nc", "output.nc"]
    # the times that `measure` writes differ
    if program != "measure":
        again = (programs.folder / "once more.nc").read_bytes()
        assert again == programs.output.read_bytes()


@pytest.mark.parametrize(("program", "group", "changes", "words"), REFUSED)
def test_bad_value_is_refused(programs, good_groups, program, group, changes, words):
    """Before the run. The line names the file, group, key and range."""
    groups = good_groups[program]
    changed = {**groups[group], **changes}
    groups[group] = {key: value for key, value in changed.items() if value is not None}
    line = refusal(programs, programs.run_groups(program, groups))
    assert line.startswith(f"error: input.nml: {words}")
    assert "NaN" not in line


def test_run_that_stops_leaves_an_older_file(programs, good_groups):
    """From where the first step is impossible."""
    good_groups["trajectory"]["scene"]["history"]["v"] = 1e-300
    programs.write(good_groups["trajectory"])
    (programs.folder / "older.nml").write_bytes(b"older")
    run = programs.run("trajectory", "input.nml", "older.nml")
    words = r"stopped at t = \S+ of 30\.0+ after \d+ steps .* w' is NaN .* where w = -690\."
    assert re.search(words, refusal(programs, run))
    assert (programs.folder / "older.nml").read_bytes() == b"older"


def test_bad_arguments_are_refused(programs, good_groups):
    """A missing namelist, too few or too many arguments, empty paths, an unknown command, and an
    output in a missing folder or where a folder or a link to a device is; that stays."""
    programs.write(good_groups["spectrum"])
    (programs.folder / "link.nml").symlink_to("/dev/null")
    (programs.folder / "folder.nml").mkdir()
    for arguments, words in (
        (["spectrum", "nowhere.nml", "output.nc"], "nowhere.nml: "),
        (["spectrum"], "spectrum NAMELIST OUTPUT"),
        (["spectrum", "input.nml"], "spectrum NAMELIST OUTPUT"),
        (["spectrum", "input.nml", "output.nc", "c"], "spectrum NAMELIST OUTPUT"),
        (["spectrum", "input.nml", ""], "error: the output path is empty; expected the path of a"),
        (["spectrum", "", "output.nc"], "error: the namelist path is empty; expected the path of "),
        (["spectrum", "nowhere.nml", "nowhere/a.nc"], "error: nowhere/a.nc: cannot write: No suc"),
        (["spectrum", "nowhere.nml", "link.nml"], "link.nml: cannot write: a folder, a device or"),
        (["spectrum", "nowhere.nml", "folder.nml"], "folder.nml: cannot write: a folder, a device"),
        (["hop", "input.nml", "output.nc"], "error: the command 'hop'; expected one of: trajec"),
    ):
        assert words in refusal(programs, programs.run(*arguments))
    assert (programs.folder / "link.nml").is_symlink()


@pytest.mark.parametrize("text", ["", "garbage\n", "&other a = 1 /\n", "\0\1\2\xff", "&settings\n"])
def test_file_without_the_group_is_refused(programs, text):
    (programs.folder / "input.nml").write_text(text, encoding="latin-1")
    line = refusal(programs, programs.run("trajectory", "input.nml", "output.nc"))
    assert "input.nml" in line
    assert "&settings" in line


def test_signs_in_comments_and_strings_are_no_keys(programs, good_groups):
    """Nor groups; a file may hold other groups with the same keys."""
    scene = good_groups["trajectory"]["scene"]
    scene["name"] = "a = b, tau = / '' ! &other tau = 1"
    namelist = programs.write({"scene": scene})
    text = namelist.read_text()
    comment = "! it's scene%t_end = 1 / &settings scene%t_end = 1\n"
    other = "&other\nscene%t_end = 1.0\n/\n"
    namelist.write_text(comment + other + text.replace("&settings\n", f"&settings {comment}"))
    programs.check_silent(programs.run("trajectory", "input.nml", "output.nc"))
    assert xr.load_dataset(programs.output).attrs["tau"] == scene["tau"]


def test_memory_that_cannot_be_had_is_an_error(programs, good_groups):
    """The past of a stiff run in short steps outgrows a process of at most 150 MB."""
    good_groups["trajectory"]["scene"] |= {"gamma": 1e4, "method": "explicit"}
    programs.write(good_groups["trajectory"])
    program = [*programs.command("trajectory"), "input.nml", "output.nc"]
    limited = ["prlimit", "--as=150000000", *program]
    run = subprocess.run(limited, cwd=programs.folder, capture_output=True, text=True, timeout=60)
    said = refusal(programs, run)
    assert re.search(r"stopped at t = .* after \d+ steps .*: no memory for another .* bytes", said)


def test_output_that_is_the_input_is_refused(programs, good_groups):
    """The namelist, also by another name of the same file, and the trajectory of a spectrum."""
    groups = good_groups["spectrum"]
    shutil.copy(groups["spectrum"]["trajectory"], programs.folder / "trajectory.nml")
    groups["spectrum"]["trajectory"] = "trajectory.nml"
    namelist = programs.write(groups)
    (programs.folder / "another name.nml").hardlink_to(namelist)
    before = {path: path.read_bytes() for path in programs.folder.iterdir()}
    for path, read_there in (
        ("input.nml", "input.nml"),
        ("another name.nml", "input.nml"),
        ("trajectory.nml", "trajectory.nml"),
    ):
        line = refusal(programs, programs.run("spectrum", "input.nml", path))
        assert line.startswith(f"error: {path}: cannot write: it is the input {read_there}; ")
    assert {path: path.read_bytes() for path in programs.folder.iterdir()} == before


def damaged(damage):
    """Changes the bytes of a trajectory."""
    return lambda path: path.write_bytes(damage(path.read_bytes()))


def unfit(change):
    """Changes the data of a trajectory."""
    return lambda path: change(xr.load_dataset(path)).to_netcdf(path)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (os.remove, "bad.nml: cannot be opened"),
        (damaged(lambda content: content[: len(content) // 2]), "(remove it; the next run makes "),
        (damaged(flip_a_bit), "cannot be read (remove the file;"),
        (unfit(lambda data: data.drop_vars("v")), "holds no variable 'v'"),
        (unfit(lambda data: data.drop_attrs()), "attribute 'scene'"),
        (unfit(lambda data: data.where(data.t > 250)), "v"),
        (unfit(lambda data: data.isel(t=slice(2010))), "samples"),
    ],
)
def test_spectrum_of_a_bad_trajectory_is_refused(programs, good_groups, change, words):
    """The line names the trajectory and what is wrong with it."""
    shutil.copy(good_groups["spectrum"]["spectrum"]["trajectory"], programs.folder / "bad.nml")
    change(programs.folder / "bad.nml")
    good_groups["spectrum"]["spectrum"]["trajectory"] = "bad.nml"
    line = refusal(programs, programs.run_groups("spectrum", good_groups["spectrum"]))
    assert line.startswith("error: bad.nml: ")
    assert words in line


@pytest.mark.parametrize("program", COMMANDS)
def test_key_that_must_be_given_is_missed(programs, good_groups, program):
    """Each that the help lists, where the namelist leaves it out."""
    binary, _ = programs.command(program)
    said = subprocess.run([binary, "--help"], capture_output=True, text=True, check=True).stdout
    assert program in said.split()
    listed = programs.run(program, "--help").stdout
    keys = re.findall(r"^ ([\w%()]+)= must be given$", listed, re.MULTILINE)
    assert keys
    for key in keys:
        groups = in_groups(copy.deepcopy(good_groups[program]))
        *path, last = key.replace("(1)", "%0").split("%")
        section = groups
        for step in path:
            section = section[int(step) if step.isdecimal() else step]
        del section[last]
        line = refusal(programs, programs.run_groups(program, groups))
        assert re.search(rf"\b{last} (= NaN|is missing); expected ", line), line


def other_interface(content: bytes) -> bytes:
    """A model that was compiled for another interface."""
    digest = interface_digest().encode()
    assert content.count(digest) == 1
    return content.replace(digest, digest[::-1])


@pytest.mark.parametrize(
    ("damage", "words"),
    [
        (None, "tau = -1.0; expected a finite number >= 0"),
        (lambda content: None, "model = 'slip_delayed_logarithm'; expected one of"),
        (lambda content: content[:1000], "/slip_delayed_logarithm.so: cannot be opened: "),
        (other_interface, "/slip_delayed_logarithm.so: is no model for this program; compile it "),
    ],
    ids=["there", "missing", "truncated", "older"],
)
def test_model_that_cannot_be_opened_is_refused(programs, good_groups, monkeypatch, damage, words):
    """One in words, no crash; models of double precision are none for quadruple precision."""
    name = "slip_delayed_logarithm.so"
    content = (programs.binaries.parent / "models" / name).read_bytes()
    models = programs.folder.with_name("models")
    models.mkdir()
    if (content := damage(content) if damage else content) is not None:
        (models / name).write_bytes(content)
    monkeypatch.setenv("MODELS", str(models))
    good_groups["trajectory"]["scene"]["tau"] = -1.0
    assert words in refusal(programs, programs.run_groups("trajectory", good_groups["trajectory"]))
    if damage is None:
        run = programs.run_groups("reference", good_groups["reference"])
        assert "is no model for this program" in refusal(programs, run)
