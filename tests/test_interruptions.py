"""Runs that are interrupted or killed: no half-written file, and the next run completes."""

import contextlib
import os
import signal
import subprocess
from collections.abc import Iterator
from pathlib import Path

import xarray as xr

from conftest import SMOKE, Project, unfinished, wait_for

LONG = "results/references/stability/grid_fault.tsv"
"""A result that takes about a second."""


def test_program_that_is_killed_at_any_moment(programs, good_inputs):
    """There is no output, or the whole older one; the next run makes the same bytes and removes
    what is unfinished of it, and of no other file."""
    programs.write({"scene": {**good_inputs["trajectory"], "t_end": 2e5}})
    assert programs.run("trajectory", "input.nml", "output.nc").returncode == 0
    whole = programs.output.read_bytes()
    for is_there in (True, False):
        if not is_there:
            programs.output.unlink()
        run = programs.begin("trajectory")
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


def test_last_of_two_runs_wins(programs, good_inputs):
    """The program of a workflow that was killed may still run: it gives way, in words."""
    runs, said = {}, {}
    for name, t_end in {"older": 1.5e5, "newer": 2e5}.items():
        programs.write({"scene": {**good_inputs["trajectory"], "t_end": t_end}})
        runs[name] = programs.begin("trajectory", stderr=subprocess.PIPE, text=True)
        os.kill(runs[name].pid, signal.SIGSTOP)
    for name in ("older", "newer"):
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
