"""Scripts of a shell for users and developers, with stand-ins for the tools that they call."""

import fcntl
import os
import re
import shutil
import subprocess
import tempfile
from pathlib import Path

import pytest

from conftest import ROOT, write_script

TOOLS = ["ruff", "snakefmt", "fortitude", "snakemake", "cmake", "ctest", "pytest"]
"""Tools that ./test runs."""
PARTS = ["quick", "lint", "fortran", "python", "long", "compilers", "slurm"]


@pytest.fixture
def recording(tmp_path) -> Path:
    """The two scripts in a folder in which the set-up has nothing to do, and tools only write down
    how they were called."""
    folder = tmp_path / "project"
    shutil.copytree(ROOT / "tools/compilers", folder / "tools/compilers")
    for script in ("reproduce", "test"):
        shutil.copy(ROOT / script, folder)
    write_script(folder / "tools/setup/setup.sh", "exit 0")
    for tool in [*TOOLS, "python"]:
        write_script(folder / ".venv" / "bin" / tool, 'echo "${0##*/} $*" >>"$CALLS"')
    package = folder / "python"
    (package / "tests").mkdir(parents=True)
    archive = "mkdir -p build/package; tar -czf build/package/delaykit.tar.gz test"
    write_script(package / ".venv" / "bin" / "python", archive)
    write_script(package / ".venv" / "bin" / "pytest", 'echo "${0##*/} $*" >>"$CALLS"')
    return folder


def calls_of(*command: str | Path, **options) -> tuple[int, list[str]]:
    """Exit status of a command and the calls of tools that it made."""
    with tempfile.NamedTemporaryFile("r") as calls:
        environment = {**os.environ, "CALLS": calls.name}
        run = subprocess.run(command, env=environment, capture_output=True, **options)
        return run.returncode, calls.read().splitlines()


def test_reproduce_hands_its_arguments_on(recording, tmp_path):
    """Two cores unless said otherwise, from any folder, also through a link; a dry run is shown."""
    (tmp_path / "link").symlink_to(recording / "reproduce")
    quiet = "--quiet host reason rules "
    for command, arguments, passed in (
        ("project/reproduce", [], f"{quiet}--snakefile Snakefile --cores 2"),
        ("link", ["figure_5"], f"{quiet}--snakefile Snakefile --cores 2 figure_5"),
        ("link", ["-c1", "a b"], f"{quiet}--snakefile Snakefile -c1 a b"),
        (
            "link",
            ["mine.yaml", "a", "--cores", "4"],
            f"{quiet}--snakefile Snakefile a --cores 4 --config user_file={tmp_path}/mine.yaml",
        ),
        ("link", ["--dry-run"], "--snakefile Snakefile --cores 2 --dry-run"),
    ):
        called = calls_of(tmp_path / command, *arguments, cwd=tmp_path)
        assert called == (0, [f"snakemake {passed}"])


def test_second_run_of_the_same_file_says_so(recording):
    """Another file is run beside it, and a dry run is none. Locks of Snakemake stay until no run of
    ./reproduce is left, each of which holds a lock of the operating system."""
    lock = recording / ".snakemake" / "locks" / "0.input.lock"
    lock.parent.mkdir(parents=True)
    lock.touch()
    with (
        open(recording / ".snakemake" / "run of the paper", "a") as run,
        open(recording / ".snakemake" / "runs", "a") as runs,
    ):
        fcntl.flock(run, fcntl.LOCK_EX)
        fcntl.flock(runs, fcntl.LOCK_SH)
        refused = subprocess.run([recording / "reproduce"], capture_output=True, text=True)
        assert (refused.returncode, refused.stdout) == (1, "")
        (line,) = refused.stderr.splitlines()
        assert line.startswith("reproduce: another run of the paper is at work here; ")
        for words in (["--dry-run"], ["--list-target-rules"], ["mine.yaml"]):
            status, calls = calls_of(recording / "reproduce", *words)
            assert (status, len(calls)) == (0, 1)
        assert lock.exists()
    assert calls_of(recording / "reproduce")[0] == 0
    assert not lock.exists()


def test_help_and_wrong_words(tmp_path):
    """From any folder; ./test names its parts."""
    run = subprocess.run(
        [ROOT / "reproduce", "--help"], cwd=tmp_path, capture_output=True, text=True
    )
    assert run.returncode == 0
    assert "./reproduce [FILE.yaml] [TARGET...]" in run.stdout
    run = subprocess.run([ROOT / "test", "nonsense"], capture_output=True, text=True)
    assert (run.returncode, run.stdout) == (2, "")
    assert all(part in run.stderr for part in ["'nonsense'", *PARTS])


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
        write_script(recording / "tools/setup/setup.sh", "[[ ! ${1-} || $1 = python ]] || exit 7")
    status, calls = calls_of(recording / "test", *arguments, cwd=tmp_path)
    assert status == 0
    assert {call.split()[0] for call in calls} == set(tools)
    assert re.fullmatch(last, calls[-1])


def test_test_stops_at_the_first_failure(recording):
    """With its exit status, be it a tool or the set-up of a part; nothing runs after it."""
    for part, missing in (
        ("compilers", "tools/compilers/*"),
        ("slurm", "tests/slurm"),
        ("slurm", "profiles/slurm"),
    ):
        write_script(recording / "tools/setup/setup.sh", f"[[ ${{1-}} != {missing} ]] || exit 7")
        assert calls_of(recording / "test", part) == (7, [])
    for tool in ("ctest", "ruff"):
        write_script(recording / ".venv" / "bin" / tool, 'echo "${0##*/}" >>"$CALLS"; exit 3')
        status, calls = calls_of(recording / "test")
        assert status == 3
        assert calls[-1] == tool


CMAKE = """[[ $1 == --build ]] || exit 0
mkdir -p $2/bin
echo "echo cycle: $(<bits-$(basename $2))" >$2/bin/trajectory_bits
chmod +x $2/bin/trajectory_bits"""


@pytest.mark.parametrize(
    ("second", "failing", "said"),
    [
        ("3F", "none", "all tests pass, same bits"),
        ("40", "none", "other bits: build/gfortran-11/trajectories.txt build/gfortran-12"),
        ("3F", "gfortran-12", "failed; see build/gfortran-12/log"),
        # the others are compared without it
        ("3F", "gfortran-11", "all tests pass, same bits"),
    ],
)
def test_builds_that_differ_or_fail_are_named(tmp_path, second, failing, said):
    """With status 1; all builds are tried."""
    (tmp_path / "tools/compilers").mkdir(parents=True)
    shutil.copy(ROOT / "tools/compilers/run", tmp_path / "tools/compilers")
    (tmp_path / "apt-packages.txt").write_text("gfortran-11\ngfortran-12\n")
    for name, bits in {"gfortran-11": "3F", "gfortran-12": second, "sanitize": "3F"}.items():
        (tmp_path / f"bits-{name}").write_text(bits)
    write_script(tmp_path / "bin" / "cmake", CMAKE)
    write_script(tmp_path / "bin" / "ctest", f"[[ $2 != build/{failing} ]]")
    run = subprocess.run(
        ["tools/compilers/run", "."],
        cwd=tmp_path,
        env={**os.environ, "PATH": f"{tmp_path}/bin:{os.environ['PATH']}"},
        capture_output=True,
        text=True,
    )
    lines = run.stdout.splitlines()
    assert [line.split(": ")[1] for line in lines] == ["gfortran-11", "gfortran-12", "sanitize"]
    assert said in lines[1]
    assert run.returncode == (not all("same bits" in line for line in lines))
