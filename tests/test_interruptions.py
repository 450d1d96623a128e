"""Runs that are interrupted or killed: no half-written file, and the next run completes."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from conftest import GROUPS, SMOKE, Programs
from write_namelist import write_namelist

SNAKEMAKE = Path(sys.executable).parent / "snakemake"
LONG = "results/references/trust/torus.tsv"
"""A result that takes some seconds."""


def wait_for(path: Path) -> None:
    """Return when a file is there."""
    end = time.monotonic() + 60
    while not path.exists():
        assert time.monotonic() < end
        time.sleep(0.01)


@pytest.fixture
def half_long(programs, good_inputs) -> Programs:
    """Programs beside the namelist of a trajectory of about a second."""
    values = {**good_inputs["trajectory"], "t_end": 2e5}
    write_namelist(programs.folder / "input.nml", GROUPS["trajectory"], values)
    return programs


def begun(programs: Programs) -> subprocess.Popen[bytes]:
    """A program that has begun to write."""
    run = subprocess.Popen(
        [programs.binaries / "trajectory", "input.nml", "output.nc"],
        cwd=programs.folder,
        stderr=subprocess.DEVNULL,
    )
    wait_for(programs.folder / "output.nc.part")
    return run


@pytest.mark.parametrize("how", [signal.SIGINT, signal.SIGKILL])
def test_program_that_is_killed_at_any_moment(half_long, how):
    """There is no output, or the whole older one; the next run makes the same bytes."""
    assert half_long.run("trajectory", "input.nml", "output.nc").returncode == 0
    whole = half_long.output.read_bytes()
    for older in (False, True):
        for seconds in (0.0, 0.05, 0.3):
            if not older:
                half_long.output.unlink(missing_ok=True)
            run = begun(half_long)
            time.sleep(seconds)
            run.send_signal(how)
            assert run.wait() == -how
            assert half_long.output.exists() is older
            assert not older or half_long.output.read_bytes() == whole
        assert half_long.run("trajectory", "input.nml", "output.nc").returncode == 0
        assert half_long.output.read_bytes() == whole
        assert half_long.left_behind() == ["output.nc"]


def test_last_of_two_runs_wins(half_long):
    """The program of a workflow that was killed may still run: it gives way, in words."""
    first = subprocess.Popen(
        [half_long.binaries / "trajectory", "input.nml", "output.nc"],
        cwd=half_long.folder,
        stderr=subprocess.PIPE,
        text=True,
    )
    wait_for(half_long.folder / "output.nc.part")
    os.kill(first.pid, signal.SIGSTOP)
    second = begun(half_long)
    os.kill(first.pid, signal.SIGCONT)
    assert second.wait(timeout=60) == 0
    assert first.communicate(timeout=60)[1].splitlines()[-1] == (
        "error: output.nc: another run began to write it; only the last one does"
    )
    assert first.returncode == 1
    whole = half_long.output.read_bytes()
    assert half_long.run("trajectory", "input.nml", "output.nc").returncode == 0
    assert half_long.output.read_bytes() == whole


def interrupt(run: subprocess.Popen[bytes]) -> None:
    """Ctrl-C: all processes of a terminal get the signal."""
    os.killpg(run.pid, signal.SIGINT)


def kill_program(run: subprocess.Popen[bytes]) -> None:
    """As the kernel does where memory is short."""
    listed = subprocess.run(["ps", "-o", "pid=,comm=", "-g", str(run.pid)], capture_output=True)
    (program,) = [
        int(line.split()[0]) for line in listed.stdout.splitlines() if line.endswith(b"reference")
    ]
    os.kill(program, signal.SIGKILL)


def kill_snakemake(run: subprocess.Popen[bytes]) -> None:
    """Its programs live on, and it leaves its lock."""
    os.kill(run.pid, signal.SIGKILL)


@pytest.mark.parametrize("end", [interrupt, kill_program, kill_snakemake])
def test_workflow_resumes(scratch, end):
    """No other result has changed, and the same command completes with the same bytes."""
    before = scratch.outputs()
    (scratch.folder / LONG).unlink()
    command = ["--cores", "2", LONG, *SMOKE]
    run = subprocess.Popen(
        [SNAKEMAKE, *command],
        cwd=scratch.folder,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        start_new_session=True,
    )
    wait_for(scratch.folder / f"{LONG}.part")
    if end is kill_snakemake:
        refused = scratch.snakemake(LONG, *SMOKE)
        assert refused.returncode != 0
        assert "LockException" in refused.stdout
    end(run)
    assert run.wait(timeout=60) != 0
    present = scratch.outputs()
    present.pop(LONG.removeprefix("results/") + ".part", None)
    assert present == {name: before[name] for name in present}
    assert LONG.removeprefix("results/") not in present
    again = scratch.snakemake(LONG, *SMOKE)
    assert again.returncode == 0, again.stdout
    assert scratch.outputs() == before
