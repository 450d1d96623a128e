"""The atlas on a real Slurm of one node: killed jobs, and the same bytes.

Run by ./test slurm; not collected with the other tests.
"""

import contextlib
import re
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import psutil
import pytest
from slurm_cluster import Cluster

from conftest import SMOKE, Project, copy_of_project, rules_in

SHORT_PARTS = (*SMOKE, "tests/slurm/short_parts.yaml")
ATLAS = "results/tables/atlas.tsv"
PARTS = [f"results/attractors/atlas/xi_05/{part:04}.nc" for part in range(1, 5)]
PART = r"results/attractors/atlas/\w+/000[1-4].nc"
PATIENCE = 300.0
GONE = (psutil.NoSuchProcess, psutil.AccessDenied, psutil.ZombieProcess)


class Program(NamedTuple):
    """A program that works in a job."""

    process: psutil.Process
    job: str
    namelist: str


def running_program(folder: Path, besides: str = "") -> Program | None:
    """One that works now in the folder, on another namelist than `besides`."""
    for process in psutil.process_iter():
        with contextlib.suppress(*GONE):
            words, job = process.cmdline(), process.environ().get("SLURM_JOB_ID")
            here = words and job and process.cwd() == str(folder)
            if here and words[0].startswith("build/release/bin/") and words[2] != besides:
                return Program(process, job, words[2])
    return None


@pytest.fixture(scope="module")
def cluster() -> Iterator[Cluster]:
    """Slurm, stopped at the end whatever happens; only kill -9 leaves jobs to end by themselves."""
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    with Cluster() as cluster:
        yield cluster


@pytest.fixture(scope="module")
def built(tmp_path_factory) -> Project:
    """A copy of the project with its program; not to be changed."""
    project = copy_of_project(tmp_path_factory.mktemp("built") / "project")
    run = project.snakemake(*SHORT_PARTS, "--", "build/release/bin/spring_block")
    assert run.returncode == 0, run.stdout
    return project


@contextlib.contextmanager
def started(cluster: Cluster, project: Project, *arguments: str) -> Iterator[subprocess.Popen[str]]:
    """The workflow under way; every job asks for one core, and Slurm lets them wait for theirs."""
    command = [Path(sys.executable).parent / "snakemake", "--profile", "profiles/slurm"]
    asked_soon = ["--slurm-init-seconds-before-status-checks", "10"]
    no_accounting = ["--slurm-status-command", "squeue", "--slurm-no-account"]
    one_core = ["--set-threads", "atlas_runs=1"]
    with subprocess.Popen(
        [*command, *asked_soon, *no_accounting, *one_core, *arguments],
        cwd=project.folder,
        env=cluster.environment,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    ) as process:
        try:
            yield process
        finally:
            process.kill()


def result_of(run: subprocess.Popen[str]) -> tuple[int, str]:
    """Exit status and log, once it has ended by itself."""
    log, _ = run.communicate(timeout=PATIENCE)
    return run.returncode, log


def program_of(run: subprocess.Popen[str], folder: Path, besides: str = "") -> Program:
    """One that works in a job, waited for, on another namelist than `besides`."""
    while not (found := running_program(folder, besides)):
        assert run.poll() is None, result_of(run)[1]
        time.sleep(0.1)
    return found


def times_of_parts(project: Project) -> dict[str, int]:
    """When each file of the atlas was written."""
    files = (project.folder / "results" / "attractors").rglob("*.*")
    return {str(path.relative_to(project.folder)): path.stat().st_mtime_ns for path in files}


def test_killed_jobs_are_redone_and_nothing_else(cluster, built, tmp_path):
    """A job by scancel, a program by kill -9; in the end the results are the local ones."""
    project = built.copy_to(tmp_path / "on slurm")
    with started(cluster, project, *SHORT_PARTS, "--", ATLAS) as run:
        cancelled = program_of(run, project.folder)
        cluster.command("scancel", cancelled.job)
        killed = program_of(run, project.folder, besides=cancelled.namelist)
        killed.process.kill()
        status, log = result_of(run)
    assert status != 0
    namelists = [one.namelist.replace("namelists/", "", 1) for one in (cancelled, killed)]
    victims = {name.replace(".nml", ".nc") for name in namelists}
    made = times_of_parts(project)
    assert len(made) == 3 * len(PARTS) - 2, log
    assert all(re.fullmatch(PART, name) and name not in victims for name in made)

    with started(cluster, project, *SHORT_PARTS, "--", ATLAS) as run:
        status, log = result_of(run)
    assert status == 0, log
    assert len(re.findall(r"^(?:local)?rule atlas_runs:", log, flags=re.MULTILINE)) == 2
    again = times_of_parts(project)
    assert set(again) - set(made) == victims
    assert {name: again[name] for name in made} == made
    assert "attractors_namelist" not in rules_in(log)

    local = built.copy_to(tmp_path / "local")
    here = local.snakemake(*SHORT_PARTS, "--", ATLAS)
    assert here.returncode == 0, here.stdout
    outputs = local.outputs()
    assert ATLAS.removeprefix("results/") in outputs
    assert len(outputs.keys() - built.outputs().keys()) == 1 + 2 * len(again)
    assert project.outputs() == outputs
