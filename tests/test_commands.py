"""./reproduce and ./test, with stand-ins for the set-up and the tools that they call."""

import fcntl
import os
import re
import subprocess
import tempfile
from pathlib import Path

import pytest

from conftest import copy_of_project, write_script

TOOLS = ["ruff", "snakefmt", "fortitude", "snakemake", "cmake", "ctest", "pytest"]
"""Tools that ./test runs."""


@pytest.fixture
def set_up(tmp_path) -> Path:
    """A copy of the project in which the set-up has nothing to do."""
    folder = copy_of_project(tmp_path / "project").folder
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
        (["mine.yaml", "scenes/a"], "--cores 2 scenes/a --config user_file={here}/mine.yaml"),
    ],
)
def test_reproduce_hands_its_arguments_on(recording, tmp_path, arguments, passed):
    """Two cores unless said otherwise, from any folder, also through a link."""
    (tmp_path / "link").symlink_to(recording / "reproduce")
    for command in (recording / "reproduce", tmp_path / "link"):
        status, calls = calls_of(command, *arguments, cwd=tmp_path)
        assert status == 0
        words = passed.format(here=tmp_path)
        assert calls == [f"snakemake --quiet host reason rules --snakefile Snakefile {words}"]


def test_reproduce_shows_a_dry_run(recording):
    status, calls = calls_of(recording / "reproduce", "--dry-run")
    assert (status, calls) == (0, ["snakemake --snakefile Snakefile --cores 2 --dry-run"])


def test_second_run_of_the_same_file_says_so(recording):
    """Another file is run beside it, and a dry run is none."""
    (recording / ".snakemake").mkdir()
    with open(recording / ".snakemake" / "run of the paper", "a") as run:
        fcntl.flock(run, fcntl.LOCK_EX)
        refused = subprocess.run([recording / "reproduce"], capture_output=True, text=True)
        assert (refused.returncode, refused.stdout) == (1, "")
        (line,) = refused.stderr.splitlines()
        assert line.startswith("reproduce: another run of the paper is at work here; ")
        for words in (["--dry-run"], ["--list-target-rules"], ["mine.yaml"]):
            status, calls = calls_of(recording / "reproduce", *words)
            assert (status, len(calls)) == (0, 1)
    assert len(calls_of(recording / "reproduce")[1]) == 1


def test_locks_of_a_live_run_stay(recording):
    """A run of ./reproduce holds a lock of the operating system."""
    lock = recording / ".snakemake" / "locks" / "0.input.lock"
    lock.parent.mkdir(parents=True)
    lock.touch()
    with open(recording / ".snakemake" / "runs", "a") as runs:
        fcntl.flock(runs, fcntl.LOCK_SH)
        assert calls_of(recording / "reproduce")[0] == 0
        assert lock.exists()
    assert calls_of(recording / "reproduce")[0] == 0
    assert not lock.exists()


@pytest.mark.parametrize(
    ("arguments", "tools", "last"),
    [
        ([], TOOLS, "pytest --numprocesses 2 .*"),
        (["quick"], TOOLS, "pytest .* -m not workflow and not browser and not long"),
        (["lint"], ["ruff", "snakefmt", "fortitude", "snakemake"], "snakemake --lint"),
        (["fortran", "-R", "a"], ["cmake", "ctest"], "ctest .* -R a"),
        (["python", "-k", "a or b"], ["pytest"], "pytest -k a or b"),
        (["long"], ["pytest"], "pytest -m long"),
        (["slurm"], ["pytest"], "pytest tests/slurm/cluster_runs.py"),
    ],
)
def test_test_runs_a_part(recording, tmp_path, arguments, tools, last):
    """Only its tools, from any folder; the quick part sets up neither browser nor formats."""
    if "quick" in arguments:
        write_script(recording / "setup" / "setup.sh", "[[ ! ${1-} ]] || exit 7")
    status, calls = calls_of(recording / "test", *arguments, cwd=tmp_path)
    assert status == 0
    assert {call.split()[0] for call in calls} == set(tools)
    assert re.fullmatch(last, calls[-1])


@pytest.mark.parametrize(
    ("part", "missing"),
    [("compilers", "compilers/*"), ("slurm", "tests/slurm"), ("slurm", "profiles/slurm")],
)
def test_part_whose_packages_are_missing_is_refused(recording, part, missing):
    write_script(recording / "setup" / "setup.sh", f"[[ ${{1-}} != {missing} ]] || exit 7")
    assert calls_of(recording / "test", part) == (7, [])


@pytest.mark.parametrize("tool", ["ruff", "ctest"])
def test_test_stops_at_the_first_failure(recording, tool):
    """With its exit status, whichever tool it is; nothing runs after it."""
    write_script(recording / ".venv" / "bin" / tool, 'echo "${0##*/}" >>"$CALLS"; exit 3')
    status, calls = calls_of(recording / "test")
    assert status != 0
    assert calls[-1] == tool
