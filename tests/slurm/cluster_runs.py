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
from dataclasses import dataclass
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


@dataclass
class SlurmRun:
    """A run of the workflow through Slurm, under way; a context, at whose end it has ended."""

    folder: Path
    process: subprocess.Popen[str]

    def __enter__(self) -> "SlurmRun":
        return self

    def __exit__(self, *_) -> None:
        self.process.kill()
        self.process.wait()

    def result(self) -> tuple[int, str]:
        """Exit status and log, once it has ended by itself."""
        log, _ = self.process.communicate(timeout=PATIENCE)
        return self.process.returncode, log

    def program(self, besides: str = "") -> Program:
        """One that works in a job, waited for, on another namelist than `besides`."""
        while not (found := running_program(self.folder, besides)):
            assert self.process.poll() is None, self.result()[1]
            time.sleep(0.1)
        return found


def started(cluster: Cluster, project: Project, *arguments: str) -> SlurmRun:
    """Start the workflow; every job asks for one core, and Slurm lets them wait for theirs."""
    command = [Path(sys.executable).parent / "snakemake", "--profile", "profiles/slurm"]
    asked_soon = ["--slurm-init-seconds-before-status-checks", "10"]
    no_accounting = ["--slurm-status-command", "squeue", "--slurm-no-account"]
    one_core = ["--set-threads", "atlas_runs=1"]
    process = subprocess.Popen(
        [*command, *asked_soon, *no_accounting, *one_core, *arguments],
        cwd=project.folder,
        env=cluster.environment,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )
    return SlurmRun(project.folder, process)


def run_on(cluster: Cluster, project: Project, *arguments: str) -> tuple[int, str]:
    with started(cluster, project, *arguments) as run:
        return run.result()


def counted(log: str, rule: str) -> int:
    return len(re.findall(rf"^(?:local)?rule {rule}:", log, flags=re.MULTILINE))


def result_of(namelist: str) -> str:
    return namelist.replace("namelists/", "", 1).replace(".nml", ".nc")


def times_of_parts(project: Project) -> dict[str, int]:
    """When each file of the atlas was written."""
    files = (project.folder / "results" / "attractors").rglob("*.*")
    return {str(path.relative_to(project.folder)): path.stat().st_mtime_ns for path in files}


def test_killed_jobs_are_redone_and_nothing_else(cluster, built, tmp_path):
    """A job by scancel, a program by kill -9; in the end the results are the local ones."""
    project = built.copy_to(tmp_path / "on slurm")
    with started(cluster, project, *SHORT_PARTS, "--", ATLAS) as run:
        cancelled = run.program()
        cluster.command("scancel", cancelled.job)
        killed = run.program(besides=cancelled.namelist)
        killed.process.kill()
        status, log = run.result()
    assert status != 0
    victims = {result_of(namelist) for namelist in (cancelled.namelist, killed.namelist)}
    made = times_of_parts(project)
    assert len(made) == 3 * len(PARTS) - 2, log
    assert all(re.fullmatch(PART, name) and name not in victims for name in made)

    status, log = run_on(cluster, project, *SHORT_PARTS, "--", ATLAS)
    assert status == 0, log
    assert counted(log, "atlas_runs") == 2
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
