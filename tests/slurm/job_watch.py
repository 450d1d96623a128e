"""The programs that work in the jobs of a cluster."""

import contextlib
from pathlib import Path
from typing import NamedTuple

import psutil

GONE = (psutil.NoSuchProcess, psutil.AccessDenied, psutil.ZombieProcess)


def processes_in(folder: Path) -> dict[psutil.Process, str]:
    """Processes of jobs that work in the folder, each with its job's number."""
    found = {}
    for process in psutil.process_iter():
        with contextlib.suppress(*GONE):
            if process.cwd() == str(folder) and (job := process.environ().get("SLURM_JOB_ID")):
                found[process] = job
    return found


class Program(NamedTuple):
    process: psutil.Process
    job: str
    namelist: str


def running_program(folder: Path, besides: str = "") -> Program | None:
    """One that works now in the folder, on another namelist than `besides`."""
    for process, job in processes_in(folder).items():
        with contextlib.suppress(*GONE):
            words = process.cmdline()
            if words and words[0].startswith("build/release/bin/") and words[1] != besides:
                return Program(process, job, words[1])
    return None
