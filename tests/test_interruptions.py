"""Runs that are interrupted or killed: no half-written file, and the next run completes."""

import contextlib
import os
import signal
import subprocess
import time
from collections.abc import Iterator
from pathlib import Path

import pytest
import xarray as xr

from conftest import SMOKE, Project, unfinished, wait_for

LONG = "results/references/stability/grid_fault.tsv"
"""A result that takes about a second."""


@pytest.fixture(autouse=True)
def heed_interrupts() -> Iterator[None]:
    """A job in the background of a shell ignores them, and so would its children."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


def test_program_that_is_killed_at_any_moment(programs, good_inputs):
    """There is no output, or the whole older one; the next run makes the same bytes and removes
    what is unfinished of it, and of no other file."""
    programs.write({"scene": {**good_inputs["trajectory"], "t_end": 2e5}})
    assert programs.run("trajectory", "input.nml", "output.nc").returncode == 0
    whole = programs.output.read_bytes()
    for seconds, is_there in ((0.0, True), (0.03, True), (0.1, True), (0.0, False)):
        if not is_there:
            programs.output.unlink()
        run = programs.begin("trajectory")
        time.sleep(seconds)
        run.kill()
        assert run.wait() != 0
        assert len(programs.left_behind()) == is_there + 1
        assert not is_there or programs.output.read_bytes() == whole
    assert programs.run("trajectory", "input.nml", "output.nc").returncode == 0
    assert programs.output.read_bytes() == whole
    assert programs.left_behind() == ["output.nc"]
    for name in ("[a].nc.1.part", "a.nc.1.part"):
        (programs.folder / name).touch()
    assert programs.run("trajectory", "input.nml", "[a].nc").returncode == 0
    assert programs.left_behind() == ["[a].nc", "a.nc.1.part", "output.nc"]


@pytest.mark.parametrize("first_to_end", ["older", "newer"])
def test_last_of_two_runs_wins(programs, good_inputs, first_to_end):
    """The program of a workflow that was killed may still run: it gives way, in words."""
    runs, said = {}, {}
    for name, t_end in {"older": 1.5e5, "newer": 2e5}.items():
        programs.write({"scene": {**good_inputs["trajectory"], "t_end": t_end}})
        runs[name] = programs.begin("trajectory", stderr=subprocess.PIPE, text=True)
        os.kill(runs[name].pid, signal.SIGSTOP)
    for name in sorted(runs, reverse=first_to_end == "older"):
        os.kill(runs[name].pid, signal.SIGCONT)
        said[name] = runs[name].communicate(timeout=60)[1]
    assert runs["newer"].returncode == 0, said["newer"]
    assert runs["older"].returncode == 1
    words = "error: output.nc: cannot write: another run has started to write this file; only the"
    assert said["older"].splitlines()[-1].startswith(words)
    assert programs.left_behind() == ["output.nc"]
    assert xr.load_dataset(programs.output).attrs["t_end"] == 2e5


@contextlib.contextmanager
def begun(project: Project, target: str, *settings: str) -> Iterator[tuple[subprocess.Popen, int]]:
    """A run of ./reproduce, and its program, which has begun to write a target and is stopped."""
    project.use_packages_at_hand()
    command = ["./reproduce", target, *SMOKE, *settings]
    silent = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
    run = subprocess.Popen(command, cwd=project.folder, start_new_session=True, **silent)
    try:
        wait_for(lambda: bool(unfinished(project.folder / target)))
        listed = ["ps", "-o", "pid=,comm=", "-g", str(run.pid)]
        lines = subprocess.run(listed, capture_output=True, text=True).stdout.splitlines()
        (program,) = [int(line.split()[0]) for line in lines if "spring_block" in line]
        os.kill(program, signal.SIGSTOP)
        yield run, program
    finally:
        with contextlib.suppress(ProcessLookupError):
            os.killpg(run.pid, signal.SIGKILL)
        run.wait()


def test_workflow_resumes_and_nothing_stale_passes_as_current(scratch):
    """Values are changed and changed back; the run with the latter meets a Ctrl-C, which reaches
    all processes of a terminal. No other result changes. What was made of a result that is missing
    is made again with it."""
    target, made_of_it = "trajectories/torus.nc", "spectra/torus.nc"
    (scratch.folder / "long.yaml").write_text("scenes: { torus: { t_end: 5.0e+4 } }")
    (scratch.folder / "mine.yaml").write_text("scenes: { torus: { tau: 10.5 } }")
    made = []
    for settings in (["long.yaml"], ["long.yaml", "mine.yaml"]):
        run = scratch.snakemake(f"results/{made_of_it}", *SMOKE, *settings)
        assert run.returncode == 0, run.stdout
        made.append(scratch.outputs())
    before, changed = made
    assert {name for name in before if before[name] != changed[name]} >= {target, made_of_it}
    with begun(scratch, f"results/{target}", "long.yaml") as (run, _):
        os.killpg(run.pid, signal.SIGINT)
        os.killpg(run.pid, signal.SIGCONT)
        assert run.wait(timeout=60) != 0
    of_the_job = {target, "namelists/trajectories/torus.nml"}
    after = scratch.outputs()
    assert target not in after
    for name in changed.keys() - of_the_job:
        assert after[name] == changed[name], name
    run = scratch.snakemake(f"results/{made_of_it}", *SMOKE, "long.yaml")
    assert run.returncode == 0, run.stdout
    assert scratch.outputs() == before


def test_workflow_resumes_where_snakemake_itself_was_killed(smoke, scratch):
    """Its locks go with the next run, which has all results as before. A program with other values
    lives on and does no harm. Its result has no record, so that it is stale without .snakemake."""
    (scratch.folder / "mine.yaml").write_text(
        "stability: { families: { grid_fault: { t_end: 30.0 } } }"
    )
    with begun(scratch, LONG, "mine.yaml") as (run, program):
        run.kill()
        run.wait()
        assert not (scratch.folder / f"{LONG.replace('/', '/records/', 1)}.json").exists()
        again = scratch.reproduce(LONG, *SMOKE)
        assert again.returncode == 0, again.stdout
        assert scratch.outputs() == smoke.outputs()
        os.kill(program, signal.SIGCONT)
        wait_for(lambda: not Path(f"/proc/{program}").exists())
        assert scratch.outputs() == smoke.outputs()
