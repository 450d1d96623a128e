"""Runs that are interrupted or killed: no half-written file, and the next run completes."""

import contextlib
import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import pytest
from conftest import GROUPS, SMOKE, Programs, Project, wait_for
from write_namelist import write_namelist

SNAKEMAKE = Path(sys.executable).parent / "snakemake"
LONG = "results/references/stability/grid_fault.tsv"
"""A result that takes about a second."""


@pytest.fixture(autouse=True)
def heed_interrupts() -> Iterator[None]:
    """A job in the background of a shell ignores them, and so would its children."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


@pytest.fixture
def half_long(programs, good_inputs) -> Programs:
    """Programs beside the namelist of a trajectory of about a second."""
    values = {**good_inputs["trajectory"], "t_end": 4e5}
    write_namelist(programs.folder / "input.nml", GROUPS["trajectory"], values)
    return programs


@pytest.mark.parametrize("how", [signal.SIGINT, signal.SIGKILL])
def test_program_that_is_killed_at_any_moment(half_long, how):
    """There is no output, or the whole older one; the next run makes the same bytes."""
    assert half_long.run("trajectory", "input.nml", "output.nc").returncode == 0
    whole = half_long.output.read_bytes()
    for seconds in (0.0, 0.03, 0.1):
        run = half_long.begin("trajectory")
        time.sleep(seconds)
        run.send_signal(how)
        assert run.wait() == -how
        assert half_long.output.read_bytes() == whole
    half_long.output.unlink()
    run = half_long.begin("trajectory")
    run.send_signal(how)
    assert run.wait() == -how
    assert not half_long.output.exists()
    assert half_long.run("trajectory", "input.nml", "output.nc").returncode == 0
    assert half_long.output.read_bytes() == whole
    assert half_long.left_behind() == ["output.nc"]


def test_last_of_two_runs_wins(half_long):
    """The program of a workflow that was killed may still run: it gives way, in words."""
    first = half_long.begin("trajectory", stderr=subprocess.PIPE, text=True)
    os.kill(first.pid, signal.SIGSTOP)
    second = half_long.begin("trajectory")
    os.kill(first.pid, signal.SIGCONT)
    assert second.wait(timeout=60) == 0
    assert first.communicate(timeout=60)[1].splitlines()[-1] == (
        "error: output.nc: another run began to write it; only the last one does"
    )
    assert first.returncode == 1
    whole = half_long.output.read_bytes()
    assert half_long.run("trajectory", "input.nml", "output.nc").returncode == 0
    assert half_long.output.read_bytes() == whole


@pytest.fixture
def workflow(scratch) -> Iterator[subprocess.Popen[bytes]]:
    """A run of the workflow that has begun to make the long result, its program stopped."""
    (scratch.folder / LONG).unlink()
    run = subprocess.Popen(
        [SNAKEMAKE, "--cores", "2", LONG, *SMOKE],
        cwd=scratch.folder,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        start_new_session=True,
    )
    wait_for(scratch.folder / f"{LONG}.part")
    os.kill(program_of(run), signal.SIGSTOP)
    yield run
    with contextlib.suppress(ProcessLookupError):
        os.killpg(run.pid, signal.SIGKILL)
    run.wait()


def program_of(run: subprocess.Popen[bytes]) -> int:
    """The process that makes the long result."""
    listed = subprocess.run(["ps", "-o", "pid=,comm=", "-g", str(run.pid)], capture_output=True)
    processes = [line.split() for line in listed.stdout.decode().splitlines()]
    (program,) = [int(number) for number, name in processes if name == "reference"]
    return program


def assert_resumes(project: Project, before: dict[str, bytes]) -> None:
    """No other result has changed, and the same command completes with the same bytes."""
    present = project.outputs()
    present.pop(f"{LONG}.part".removeprefix("results/"), None)
    assert present == {name: before[name] for name in before if not LONG.endswith(name)}
    again = project.snakemake(LONG, *SMOKE)
    assert again.returncode == 0, again.stdout
    assert project.outputs() == before


@pytest.mark.parametrize("end", ["Ctrl-C", "program killed"])
def test_workflow_resumes(smoke, scratch, workflow, end):
    """Ctrl-C reaches all processes of a terminal; the kernel kills one where memory is short."""
    if end == "Ctrl-C":
        os.killpg(workflow.pid, signal.SIGINT)
        os.killpg(workflow.pid, signal.SIGCONT)
    else:
        os.kill(program_of(workflow), signal.SIGKILL)
    assert workflow.wait(timeout=60) != 0
    assert_resumes(scratch, smoke.outputs())


def test_workflow_resumes_where_snakemake_itself_was_killed(smoke, scratch, workflow):
    """Its lock held while it was alive, and no longer; its program lives on and does no harm."""
    program = program_of(workflow)
    refused = scratch.snakemake(LONG, *SMOKE)
    assert refused.returncode != 0
    assert "LockException" in refused.stdout
    os.kill(workflow.pid, signal.SIGKILL)
    workflow.wait()
    assert_resumes(scratch, smoke.outputs())
    os.kill(program, signal.SIGCONT)
    end = time.monotonic() + 60
    while Path(f"/proc/{program}").exists() and time.monotonic() < end:
        time.sleep(0.01)
    assert scratch.outputs() == smoke.outputs()
