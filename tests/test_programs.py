"""What all programs share: bad input is refused in words, and no output is left behind.

Ranges of keys are tests of the configuration. Programs refuse what would break the equations.
"""

import os
import re
import shutil
import subprocess
from pathlib import Path

import netCDF4
import pytest
import xarray as xr

from conftest import COMMANDS, ROOT, Programs
from generator.compile import compile_module
from generator.definition import overlaid, read_model
from generator.module import interface_digest, write_module
from scripts.files.read_config import read
from scripts.namelists.laws import BLOCK, PAPER

REFUSED = {
    "trajectory": ("scene", "tau", -1.0, "scene 'torus': tau = -1.0; expected a finite number >= "),
    "spectrum": ("spectrum", "segments", 0, "spectrum: segments = 0; expected a whole number >= 1"),
    "hopf": ("hopf_curves", "gamma", 0.0, "gamma = 0.0; expected a finite number > 0"),
    "cycles": ("cycles", "degree", 2, "degree = 2; expected a whole number >= 3"),
    "linear_stability": ("linear_stability", "xi", -1.0, "xi = -1.0; expected a finite number > 0"),
    "slip_events": ("scene", "xi", -1.0, "scene 'torus': xi = -1.0; expected a finite number > 0"),
    "exponents": ("exponents", "blocks", 1, "exponents%blocks = 1; expected a whole number >= 2"),
    "synchrony": ("synchrony", "count", 1, "synchrony%count = 1; expected a whole number >= 2"),
    "attractors": ("observation", "interval", 0.0, "observation: interval = 0.0; expected a "),
    "measure": ("measure", "repeats", -1, "repeats = -1; expected a whole number >= 0"),
    "reference": ("reference", "most_steps", 0, "most_steps = 0.0; expected a finite number >= "),
}
"""For each program: a group, a key, a value that is refused, and words of the refusal."""

every_program = pytest.mark.parametrize("program", COMMANDS)
each_kind = pytest.mark.parametrize("program", ["spectrum", "reference"])
"""One that reads NetCDF and writes it, and one that writes text."""


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


@every_program
def test_good_input_makes_one_file(programs, good_groups, program):
    """Nothing on the screen; a second run makes the same bytes; every variable has a checksum."""
    run = programs.run_groups(program, good_groups[program])
    assert (run.returncode, run.stdout, run.stderr) == (0, "", "")
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


@pytest.mark.parametrize("program", ["linear_stability", "reference"])
def test_result_is_on_the_disk_before_it_has_its_name(programs, good_groups, program, monkeypatch):
    """And its folder thereafter: a loss of power leaves no empty file under a final name."""
    preloaded = programs.folder.with_name("fsync_order.so")
    source = ROOT / "tests" / "fsync_order.c"
    subprocess.run(["cc", "-shared", "-fPIC", "-o", preloaded, source, "-ldl"], check=True)
    monkeypatch.setenv("LD_PRELOAD", str(preloaded))
    programs.write(good_groups[program])
    run = programs.run(program, "input.nml", programs.output)
    assert run.returncode == 0
    calls = [line.replace(str(programs.folder), "") for line in run.stdout.splitlines()]
    file, named, folder = [re.sub(r"nc\.[0-9-]+\.part", "part", call) for call in calls]
    assert file == "fsync /output.part"
    assert named == "rename /output.part /output.nc"
    assert folder == "fsync "


@pytest.mark.parametrize(
    ("program", "group", "key", "value", "words"),
    [
        ("trajectory", "scene", "sample_interval", 1e-8, "scene 'torus': sample_interval = 1.0E-"),
        ("trajectory", "scene", "t_end", 1e12, "scene 'torus': sample_interval = 0.25; expected "),
        ("exponents", "exponents", "t_end", 1e12, "exponents%interval = "),
        ("measure", "cases", "t_end", [1e12, 1e12], "case 'decay': sample_interval = 0.5; "),
    ],
)
def test_too_many_samples_are_refused(programs, good_groups, program, group, key, value, words):
    """Before the run: their number would overflow, and their file fill the disk."""
    groups = good_groups[program]
    groups[group] = {**groups[group], key: value}
    line = refusal(programs, programs.run_groups(program, groups))
    assert line.startswith(f"error: input.nml: {words}")
    assert "expected a finite number >= " in line


@every_program
def test_bad_input_is_refused(programs, good_groups, program):
    """The line names the file, and group, key and range where they are wrong."""
    group, key, value, words = REFUSED[program]
    groups = good_groups[program]

    def refused(**changes) -> str:
        changed = {**groups, group: {**changes, **groups[group], **changes}}
        return refusal(programs, programs.run_groups(program, changed))

    assert refused(**{key: value}).startswith(f"error: input.nml: {words}")
    line = refused(absent=1.0)
    assert "input.nml: namelist group &settings: " in line
    assert "absent" in line


NO_PARAMETER = f"parameter of the law {PAPER} = 'w'; expected one of 'tau' "


@pytest.mark.parametrize(
    ("program", "group", "changes", "words"),
    [
        ("spectrum", "spectrum", {"window": "w"}, "spectrum: window = 'w'; expected one of 'hann'"),
        (
            "hopf",
            "hopf_curves",
            {"ordinate": "w", "tau": 7.0},
            f"parameter of the law {PAPER} = 'w'; ",
        ),
        (
            "hopf",
            "hopf_curves",
            {"ordinate": "epsilon", "tau": 7.0},
            "ordinate = 'epsilon'; expected one of",
        ),
        (
            "cycles",
            "cycles",
            {"along": "w", "epsilon": 0.5},
            f"parameter of the law {PAPER} = 'w'; expected one",
        ),
        ("attractors", "points", {"sweep": "w"}, "points: sweep = 'w'; expected one of 'none'"),
    ],
)
def test_unknown_word_is_refused(programs, good_groups, program, group, changes, words):
    good_groups[program][group] |= changes
    said = refusal(programs, programs.run_groups(program, good_groups[program]))
    assert said.startswith(f"error: input.nml: {words}")


@each_kind
def test_bad_arguments_are_refused(programs, good_groups, program):
    """A missing namelist, too few or too many arguments, and empty paths."""
    programs.write(good_groups[program])
    for arguments, words in (
        (["nowhere.nml", "output.nc"], "nowhere.nml: "),
        ([], f"{program} NAMELIST OUTPUT"),
        (["input.nml"], f"{program} NAMELIST OUTPUT"),
        (["input.nml", "output.nc", "c"], f"{program} NAMELIST OUTPUT"),
        (["input.nml", ""], "error: the output path is empty; expected the path of a file"),
        (["", "output.nc"], "error: the namelist path is empty; expected the path of a file"),
    ):
        assert words in refusal(programs, programs.run(program, *arguments))


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
    run = programs.run("trajectory", "input.nml", "output.nc")
    assert (run.returncode, run.stderr) == (0, "")
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


def test_hint_about_nan_is_given_for_nan_only(programs, good_groups):
    """A key that is missing reads as NaN; -1 is not missing."""
    groups = good_groups["trajectory"]
    groups["scene"]["tau"] = -1.0
    assert "NaN" not in refusal(programs, programs.run_groups("trajectory", groups))
    del groups["scene"]["tau"]
    assert "missing" in refusal(programs, programs.run_groups("trajectory", groups))


@each_kind
def test_output_that_cannot_be_written_is_refused(programs, good_groups, program):
    """In a missing folder, or where a folder, a pipe or a link to a device is; that stays."""
    programs.write(good_groups[program])
    line = refusal(programs, programs.run(program, "input.nml", "nowhere/output.nc"))
    assert line.startswith(
        "error: nowhere/output.nc: cannot write: the folder does not exist; check"
    )
    place = programs.folder / "of each kind.nml"
    make = {
        "folder": Path.mkdir,
        "pipe": os.mkfifo,
        "link": lambda path: path.symlink_to("/dev/null"),
    }
    for name, made in make.items():
        place.mkdir()
        path = place / name
        made(path)
        line = refusal(programs, programs.run(program, "nowhere.nml", path))
        assert line.startswith(
            f"error: {path}: cannot write: a folder, a device or a link is there"
        )
        assert [(left.name, left.is_file()) for left in place.iterdir()] == [(name, False)]
        shutil.rmtree(place)


@each_kind
def test_input_that_is_no_file_is_refused(programs, good_groups, program):
    """A pipe to which no one writes would be waited for, a device read without end."""
    os.mkfifo(programs.folder / "pipe.nml")
    for path in ("pipe.nml", "/dev/zero", "."):
        said = refusal(programs, programs.run(program, path, "output.nc"))
        assert said.startswith(f"error: {path}: cannot be read: a folder, a device or a pipe is ")
        if program == "spectrum":
            good_groups[program][program]["trajectory"] = path
            run = programs.run_groups(program, good_groups[program])
            assert refusal(programs, run) == said


@each_kind
def test_output_that_is_the_input_is_refused(programs, good_groups, program):
    namelist = programs.write(good_groups[program])
    before = namelist.read_bytes()
    other = programs.folder / "another name.nml"
    other.hardlink_to(namelist)
    for path in (namelist, other):
        line = refusal(programs, programs.run(program, "input.nml", path))
        assert line.startswith(f"error: {path}: cannot write: it is the input input.nml; expected")
    assert namelist.read_bytes() == before


def test_spectrum_does_not_replace_its_trajectory(programs, good_groups):
    groups = good_groups["spectrum"]
    trajectory = programs.folder / "trajectory.nml"
    shutil.copy(groups["spectrum"]["trajectory"], trajectory)
    before = trajectory.read_bytes()
    groups["spectrum"]["trajectory"] = "trajectory.nml"
    programs.write(groups)
    line = refusal(programs, programs.run("spectrum", "input.nml", "trajectory.nml"))
    assert "trajectory.nml: cannot write: it is the input trajectory.nml; expected" in line
    assert trajectory.read_bytes() == before


def test_refusal_leaves_an_older_output_alone(programs, good_groups):
    """A file under the final name is always complete."""
    programs.output.write_bytes(b"older")
    good_groups["hopf"]["hopf_curves"]["gamma"] = 0.0
    assert programs.run_groups("hopf", good_groups["hopf"]).returncode == 1
    assert programs.output.read_bytes() == b"older"


def test_integration_that_fails_says_where(programs, good_groups):
    """A velocity of 1e-300 makes the first step impossible."""
    good_groups["trajectory"]["scene"]["history"]["v"] = 1e-300
    line = refusal(programs, programs.run_groups("trajectory", good_groups["trajectory"]))
    assert re.search(r"stopped at t = \S+ of 30\.0+ after \d+ steps", line)


@pytest.mark.parametrize(
    ("damage", "words"),
    [
        (lambda content: None, "bad.nml: cannot be opened"),
        (lambda content: content[: len(content) // 2], "(remove it; the next run makes it again)"),
        (flip_a_bit, "cannot be read (remove the file;"),
    ],
    ids=["missing", "truncated", "one bit"],
)
def test_spectrum_of_a_damaged_trajectory_is_refused(programs, good_groups, damage, words):
    groups = good_groups["spectrum"]
    content = damage(Path(groups["spectrum"]["trajectory"]).read_bytes())
    if content:
        (programs.folder / "bad.nml").write_bytes(content)
    groups["spectrum"]["trajectory"] = "bad.nml"
    line = refusal(programs, programs.run_groups("spectrum", groups))
    assert line.startswith("error: bad.nml: ")
    assert words in line


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (lambda data: data.drop_vars("v"), "holds no variable 'v'"),
        (lambda data: data.drop_attrs(), "attribute 'scene'"),
        (lambda data: data.where(data.t > 250), "v"),
        (lambda data: data.isel(t=slice(2010)), "samples"),
    ],
    ids=["without v", "without attributes", "with NaN", "too short"],
)
def test_spectrum_of_an_unfit_trajectory_is_refused(programs, good_groups, change, words):
    """The line names the trajectory and what is wrong with it."""
    trajectory = xr.load_dataset(good_groups["spectrum"]["spectrum"]["trajectory"])
    change(trajectory).to_netcdf(programs.folder / "unfit.nml")
    good_groups["spectrum"]["spectrum"]["trajectory"] = "unfit.nml"
    line = refusal(programs, programs.run_groups("spectrum", good_groups["spectrum"]))
    assert "unfit.nml" in line
    assert words in line


def test_help_lists_commands_and_keys(programs):
    """The keys are those of the types that the command reads."""
    program, _ = programs.command("hopf")
    listed = subprocess.run([program, "--help"], capture_output=True, text=True, check=True).stdout
    assert set(COMMANDS) - {"reference"} <= set(listed.split())
    keys = programs.run("hopf", "--help")
    assert (keys.returncode, keys.stderr) == (0, "")
    assert "hopf_curves%parameters%gamma= must be given" in keys.stdout
    assert programs.left_behind() == []


def test_unknown_command_is_refused(programs):
    line = refusal(programs, programs.run("hop", "input.nml", "output.nc"))
    assert line.startswith("error: the command 'hop'; expected one of: trajectory, spectrum, ")


def other_interface(content: bytes) -> bytes:
    """A model that was compiled for another interface."""
    digest = interface_digest().encode()
    assert content.count(digest) == 1
    return content.replace(digest, digest[::-1])


@pytest.mark.parametrize(
    ("damage", "words"),
    [
        (None, "tau = -1.0; expected a finite number >= 0"),
        (lambda content: None, "law = 'slip_delayed_logarithm'; expected one of"),
        (lambda content: content[:1000], "/slip_delayed_logarithm.so: cannot be opened: "),
        (lambda content: b"", "/slip_delayed_logarithm.so: cannot be opened: "),
        (other_interface, "/slip_delayed_logarithm.so: is no model for this program; compile it "),
    ],
    ids=["there", "missing", "truncated", "empty", "older"],
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


def test_delay_that_is_negative_is_refused(programs, good_groups, monkeypatch):
    """One whose sign depends on the parameters; others are refused in the definition."""
    ahead = {"name": "ahead", "definitions": {"evolution": "-v*(theta + w(t - (tau - 10)))"}}
    models = programs.folder.with_name("models")
    compile_module(write_module(read_model(overlaid(read(BLOCK), ahead))), models / "ahead.so")
    monkeypatch.setenv("MODELS", str(models))
    scene = good_groups["trajectory"]["scene"] | {"law": "ahead", "tau": 7.0}
    line = refusal(programs, programs.run_groups("trajectory", {"scene": scene}))
    assert "law ahead: delay 1 = -3.0; expected a finite number >= 0" in line
    scene["tau"] = 12.0
    assert programs.run_groups("trajectory", {"scene": scene}).returncode == 0


@pytest.mark.parametrize("law", ["../models/slip_cut_off", "chain_slip_cut_off", "slip cut off"])
def test_law_that_is_no_name_of_one_is_refused(programs, good_groups, law):
    good_groups["trajectory"]["scene"]["law"] = law
    line = refusal(programs, programs.run_groups("trajectory", good_groups["trajectory"]))
    assert f"law = '{law}'; expected one of '" in line
