"""./reproduce and ./test, with stand-ins for the set-up and the tools that they call."""

import os
import subprocess
import sys
import tempfile
from pathlib import Path

import pytest
from conftest import copy_of_project, rules_in, write_script

TOOLS = ["ruff", "snakefmt", "fortitude", "snakemake", "cmake", "ctest", "pytest"]
"""Tools that ./test runs."""


@pytest.fixture
def set_up(tmp_path) -> Path:
    """A copy of the project in which the set-up has nothing to do."""
    folder = copy_of_project(tmp_path / "a project").folder
    write_script(folder / "setup" / "setup.sh", "exit 0")
    return folder


@pytest.fixture
def recording(set_up) -> Path:
    """The same with tools that only write down how they were called."""
    for tool in [*TOOLS, "python"]:
        write_script(set_up / ".venv" / "bin" / tool, 'echo "${0##*/} $*" >>"$CALLS"')
    return set_up


def calls_of(*command: str | Path, **options) -> tuple[int, list[str]]:
    """Exit status of a command and the calls of tools that it made."""
    with tempfile.NamedTemporaryFile("r") as calls:
        environment = {**os.environ, "CALLS": calls.name}
        run = subprocess.run(command, env=environment, capture_output=True, **options)
        return run.returncode, calls.read().splitlines()


@pytest.mark.parametrize(
    ("arguments", "passed"),
    [
        ([], "--cores 2"),
        (["figure_5"], "--cores 2 figure_5"),
        (["figure_5", "--cores", "4"], "figure_5 --cores 4"),
        (["-c1", "a b"], "-c1 a b"),
        (["--jobs=3"], "--jobs=3"),
        (["--dry-run", "--configfile=mine.yaml"], "--cores 2 --dry-run --configfile=mine.yaml"),
    ],
)
def test_reproduce_hands_its_arguments_on(recording, tmp_path, arguments, passed):
    """Two cores unless said otherwise, from any folder."""
    status, calls = calls_of(recording / "reproduce", *arguments, cwd=tmp_path)
    assert status == 0
    command = f"python {recording}/scripts/console/reproduce.py"
    assert calls == [
        f"{command} --snakefile {recording}/Snakefile --directory {recording} {passed}"
    ]


def test_reproduce_works_through_a_link(recording, tmp_path):
    """The project is where the script lies, not where the link does."""
    (tmp_path / "link").symlink_to(recording / "reproduce")
    status, calls = calls_of(tmp_path / "link", cwd=tmp_path)
    assert status == 0
    assert f"--directory {recording} " in calls[0]


def test_reproduce_takes_files_from_the_current_folder(set_up, tmp_path):
    """A scene file beside the user, results in the project."""
    write_script(set_up / ".venv" / "bin" / "python", f"exec '{sys.executable}' \"$@\"")
    (tmp_path / "mine.yaml").write_text(
        "scenes: { mine: { tau: 1.0, epsilon: 0.5, xi: 1.0, gamma: 1.0, t_end: 9.0 } }"
    )
    target = ["--dry-run", "results/mine/trajectories/mine.nc", "--configfile", "mine.yaml"]
    run = subprocess.run(
        [set_up / "reproduce", *target], cwd=tmp_path, capture_output=True, text=True
    )
    assert run.returncode == 0, run.stderr
    assert rules_in(run.stdout) == {"build", "scene_namelist", "trajectory"}


def test_reproduce_ignores_settings_of_python(set_up):
    """With PYTHONSAFEPATH Python does not look for modules beside a script."""
    write_script(set_up / ".venv" / "bin" / "python", f"exec '{sys.executable}' \"$@\"")
    run = subprocess.run(
        [set_up / "reproduce", "results/namelists/velocity_step.nml"],
        env={**os.environ, "PYTHONSAFEPATH": "1"},
        capture_output=True,
        text=True,
    )
    assert run.returncode == 0, run.stderr
    assert (set_up / "results" / "namelists" / "velocity_step.nml").exists()


def test_test_runs_everything(recording, tmp_path):
    """Lint, Fortran and Python, from any folder."""
    status, calls = calls_of(recording / "test", cwd=tmp_path)
    assert status == 0
    assert {call.split()[0] for call in calls} == set(TOOLS)
    assert calls[-1] == "pytest --numprocesses 2"


def test_quick_test_needs_no_browser_and_no_workflow(recording):
    """Lint, Fortran, and what is left of Python."""
    write_script(recording / "setup" / "setup.sh", "[[ ! ${1-} ]] || exit 7")
    status, calls = calls_of(recording / "test", "quick")
    assert status == 0
    assert {call.split()[0] for call in calls} == set(TOOLS)
    assert calls[-1] == "pytest --numprocesses 2 -m not workflow and not browser and not long"


@pytest.mark.parametrize(
    ("part", "tools"),
    [
        ("lint", {"ruff", "snakefmt", "fortitude", "snakemake"}),
        ("fortran", {"cmake", "ctest"}),
        ("python", {"pytest"}),
        ("long", {"pytest"}),
    ],
)
def test_test_runs_one_part(recording, part, tools):
    """Only its tools."""
    status, calls = calls_of(recording / "test", part)
    assert status == 0
    assert {call.split()[0] for call in calls} == tools


def test_other_compilers_are_refused_where_packages_are_missing(recording):
    """The set-up's own words and status, and nothing is built."""
    write_script(recording / "setup" / "setup.sh", "[[ ${1-} != compilers/* ]] || exit 7")
    status, calls = calls_of(recording / "test", "compilers")
    assert (status, calls) == (7, [])


@pytest.mark.parametrize("missing", ["tests/slurm", "profiles/slurm"])
def test_slurm_is_refused_where_packages_are_missing(recording, missing):
    """The set-up's own words and status, and no daemon is started."""
    write_script(recording / "setup" / "setup.sh", f"[[ ${{1-}} != {missing} ]] || exit 7")
    status, calls = calls_of(recording / "test", "slurm")
    assert (status, calls) == (7, [])


def test_slurm_runs_its_own_tests(recording):
    """And no others."""
    status, calls = calls_of(recording / "test", "slurm")
    assert (status, calls) == (0, ["pytest tests/slurm/cluster_runs.py"])


def test_test_hands_arguments_to_pytest(recording):
    """And keeps their words apart."""
    status, calls = calls_of(recording / "test", "python", "-k", "a or b")
    assert (status, calls) == (0, ["pytest -k a or b"])


@pytest.mark.parametrize("tool", TOOLS)
def test_test_stops_at_the_first_failure(recording, tool):
    """With its exit status, whichever tool it is; nothing runs after it."""
    write_script(recording / ".venv" / "bin" / tool, 'echo "${0##*/}" >>"$CALLS"; exit 3')
    status, calls = calls_of(recording / "test")
    assert status != 0
    assert calls[-1] == tool
