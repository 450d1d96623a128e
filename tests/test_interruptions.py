"""Runs that are interrupted or killed: no half-written file, and the next run completes."""

import contextlib
import copy
import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import pytest
from namelist_groups import in_groups

from conftest import SMOKE, Programs, Project, unfinished, wait_for
from scripts.namelists.write_namelist import write_namelist

SNAKEMAKE = Path(sys.executable).parent / "snakemake"
LONG = "results/references/stability/grid_fault.tsv"
"""A result that takes about a second."""
NAMELIST = "results/namelists/trajectories/torus.nml"


@pytest.fixture(autouse=True)
def heed_interrupts() -> Iterator[None]:
    """A job in the background of a shell ignores them, and so would its children."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


@pytest.fixture
def half_long(programs, good_inputs) -> Programs:
    """Programs beside the namelist of a trajectory of about half a second."""
    values = {**good_inputs["trajectory"], "t_end": 2e5}
    programs.write({"scene": values})
    return programs


@pytest.mark.parametrize("how", [signal.SIGINT, signal.SIGKILL])
def test_program_that_is_killed_at_any_moment(half_long, how):
    """There is no output, or the whole older one; the next run makes the same bytes and removes
    what is unfinished of this output alone."""
    others = ["output.1-2.part", "output.nc.1-2.part.nc", "output.nc.nc.1-2.part"]
    for name in others:
        (half_long.folder / name).touch()
    assert half_long.run("trajectory", "input.nml", "output.nc").returncode == 0
    whole = half_long.output.read_bytes()
    for seconds in (0.0, 0.03, 0.1):
        run = half_long.begin("trajectory")
        time.sleep(seconds)
        run.send_signal(how)
        assert run.wait() == -how
        assert half_long.output.read_bytes() == whole
        assert len(set(half_long.left_behind()) - set(others)) == 2
    half_long.output.unlink()
    run = half_long.begin("trajectory")
    run.send_signal(how)
    assert run.wait() == -how
    assert not half_long.output.exists()
    assert half_long.run("trajectory", "input.nml", "output.nc").returncode == 0
    assert half_long.output.read_bytes() == whole
    assert half_long.left_behind() == sorted(["output.nc", *others])


def groups_of(program: str, t_end: float, good_groups: dict) -> dict[str, dict]:
    """Namelist groups of a run of about a second, in which `t_end` makes a difference."""
    groups = copy.deepcopy(good_groups[program])
    if program == "trajectory":
        groups["scene"]["t_end"] = 1000 * t_end
    else:
        groups["cases"]["t_end"] = [t_end, 5.0]
    return groups


@pytest.mark.parametrize(
    ("program", "first_to_end"), [("trajectory", "older"), ("reference", "newer")]
)
def test_last_of_two_runs_wins(programs, good_groups, program, first_to_end):
    """The program of a workflow that was killed may still run: it gives way, in words."""
    for name, t_end in (("older", 150.0), ("newer", 200.0)):
        groups = in_groups(groups_of(program, t_end, good_groups))
        write_namelist(programs.folder / f"{name}.nml", groups)

    def begin(name: str) -> subprocess.Popen[str]:
        # in place: a new file would take the inode that a removed one leaves to the next
        namelist = (programs.folder / f"{name}.nml").read_text()
        (programs.folder / "input.nml").write_text(namelist)
        run = programs.begin(program, stderr=subprocess.PIPE, text=True)
        wait_for(lambda: any(path.stat().st_size for path in unfinished(programs.output)))
        os.kill(run.pid, signal.SIGSTOP)
        return run

    runs = {"older": begin("older"), "newer": begin("newer")}
    said = {}
    for name in ("older", "newer") if first_to_end == "older" else ("newer", "older"):
        os.kill(runs[name].pid, signal.SIGCONT)
        said[name] = runs[name].communicate(timeout=60)[1]
    assert runs["newer"].returncode == 0, said["newer"]
    assert runs["older"].returncode == 1
    given_way = (
        "error: output.nc: another run has started to write this file; only the last one keeps it"
    )
    assert said["older"].splitlines()[-1] == given_way
    assert programs.left_behind() == ["output.nc"]
    whole = programs.output.read_bytes()
    assert programs.run(program, "input.nml", "output.nc").returncode == 0
    assert programs.output.read_bytes() == whole


@pytest.fixture
def workflow(scratch) -> Iterator[subprocess.Popen[bytes]]:
    """A run of the workflow that has begun to make the long result, its program stopped."""
    scratch.use_packages_at_hand()
    (scratch.folder / LONG).unlink()
    run = subprocess.Popen(
        ["./reproduce", LONG, *SMOKE],
        cwd=scratch.folder,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        start_new_session=True,
    )
    wait_for(lambda: bool(unfinished(scratch.folder / LONG)))
    os.kill(program_of(run), signal.SIGSTOP)
    yield run
    with contextlib.suppress(ProcessLookupError):
        os.killpg(run.pid, signal.SIGKILL)
    run.wait()


def processes_of(run: subprocess.Popen[bytes]) -> list[tuple[int, str, str]]:
    command = ["ps", "-ww", "-o", "pid=,comm=,args=", "-g", str(run.pid)]
    listed = subprocess.run(command, capture_output=True, text=True).stdout
    lines = [line.split(maxsplit=2) for line in listed.splitlines()]
    return [(int(number), program, words) for number, program, words in lines]


def program_of(run: subprocess.Popen[bytes]) -> int:
    (process,) = [
        number for number, program, _ in processes_of(run) if program == "spring_block_qu"
    ]
    return process


def test_workflow_resumes(smoke, scratch, workflow):
    """Ctrl-C reaches all processes of a terminal; no other result changes."""
    os.killpg(workflow.pid, signal.SIGINT)
    os.killpg(workflow.pid, signal.SIGCONT)
    assert workflow.wait(timeout=60) != 0
    before, unfinished = smoke.outputs(), LONG.removeprefix("results/") + "."
    present = {k: v for k, v in scratch.outputs().items() if not k.startswith(unfinished)}
    assert present == {name: before[name] for name in before if not LONG.endswith(name)}
    again = scratch.snakemake(LONG, *SMOKE)
    assert again.returncode == 0, again.stdout
    assert scratch.outputs() == before


def test_workflow_resumes_where_snakemake_itself_was_killed(smoke, scratch, workflow):
    """A second run is refused while the first is alive; its locks go once it is killed.

    Its program lives on and does no harm.
    """
    program = program_of(workflow)
    refused = scratch.reproduce(LONG, *SMOKE)
    assert refused.returncode == 1
    assert refused.stdout.startswith("reproduce: another run of the paper is at work here; ")
    os.kill(workflow.pid, signal.SIGKILL)
    workflow.wait()
    again = scratch.reproduce(LONG, *SMOKE)
    assert again.returncode == 0, again.stdout
    assert scratch.outputs() == smoke.outputs()
    os.kill(program, signal.SIGCONT)
    wait_for(lambda: not Path(f"/proc/{program}").exists())
    assert scratch.outputs() == smoke.outputs()


WAIT = "[[ $0 != *run_program.sh ]] || sleep 600"
"""What Bash does before a script: that of a run of the program waits to be killed."""
STALE = "results/spectra/torus.nc"


@contextlib.contextmanager
def about_to_run(project: Project, *arguments: str) -> Iterator[subprocess.Popen[bytes]]:
    """A run of the workflow whose job of the trajectory waits."""
    waiting = project.folder.with_name("waiting.sh")
    waiting.write_text(WAIT)
    with subprocess.Popen(
        [SNAKEMAKE, "--cores", "2", "results/trajectories/torus.nc", *SMOKE, *arguments],
        cwd=project.folder,
        env={**os.environ, "BASH_ENV": str(waiting)},
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        start_new_session=True,
    ) as run:
        try:
            wait_for(lambda: bool(jobs_of(run)))
            yield run
            assert run.wait(timeout=60) != 0
        finally:
            with contextlib.suppress(ProcessLookupError):
                os.killpg(run.pid, signal.SIGKILL)
    assert not (project.folder / NAMELIST).exists()


def jobs_of(run: subprocess.Popen[bytes]) -> list[int]:
    return [number for number, _, words in processes_of(run) if "run_program.sh" in words]


def test_nothing_stale_passes_as_current(smoke, scratch):
    """Values are changed and changed back; the job with the latter does not finish."""
    (scratch.folder / "mine.yaml").write_text("scenes: { torus: { tau: 10.5 } }")
    other = scratch.snakemake(STALE, *SMOKE, "mine.yaml")
    assert other.returncode == 0, other.stdout
    before, changed = smoke.outputs(), scratch.outputs()
    for name in ("trajectories/torus.nc", "spectra/torus.nc"):
        assert changed[name] != before[name]
    with about_to_run(scratch) as run:
        for process in jobs_of(run):
            os.kill(process, signal.SIGKILL)
    again = scratch.snakemake(STALE, *SMOKE)
    assert again.returncode == 0, again.stdout
    assert scratch.outputs() == before


def test_run_with_other_values_loses_no_result(smoke, scratch):
    """It is killed, Snakemake included; the next run without them has all results as before."""
    (scratch.folder / "mine.yaml").write_text("scenes: { torus: { tau: 10.5 } }")
    with about_to_run(scratch, "mine.yaml") as run:
        os.killpg(run.pid, signal.SIGKILL)
    # what no longer exists is made again where it is asked for
    again = scratch.reproduce("results/trajectories/torus.nc", STALE, *SMOKE)
    assert again.returncode == 0, again.stdout
    assert scratch.outputs() == smoke.outputs()
