"""The page of a run in which jobs failed: what there is, and why the rest is missing."""

import json
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

from scripts.workflow.check_run import targets_of
from scripts.workflow.manifest import STAMP

VARIABLE = "FAILED_RUN"
"""In the environment of the run that makes the page: a file with reasons by path, and what is
missing."""
SNAKEMAKE = [sys.executable, "-m", "snakemake", "--nolock", "--cores", "1"]


def read_failed_run() -> tuple[dict[str, str], list[str]]:
    """Reasons by path and missing paths of the run whose page is to be made; of others none."""
    path = os.environ.get(VARIABLE)
    return tuple(json.loads(Path(path).read_text())) if path else ({}, [])


def make_page(results: str, given: dict) -> None:
    """Make the page by a run of its own, which knows what the one that failed lacks.

    `given` is the configuration as Snakemake got it. A run that was stopped gets no page: some of
    its jobs lack nothing and were not tried.
    """
    with tempfile.TemporaryDirectory() as folder:
        config, lacks = Path(folder, "given.json"), Path(folder, "lacks.json")
        config.write_text(json.dumps(given))
        command = [*SNAKEMAKE, "--configfile", str(config)]
        jobs = jobs_left([*command, "--dry-run", *targets_of(sys.argv)])
        failed = [job for job in jobs if was_tried(job, Path(results, STAMP))]
        unmade = sorted({path for job in jobs for path in job["output"]})
        stopped = any(job not in failed and not {*unmade} & {*job["input"]} for job in jobs)
        if stopped or f"{results}/index.html" not in unmade:
            return
        for path in unmade:
            if path.endswith(".html"):
                Path(path).unlink(missing_ok=True)
        reasons = dict(sorted((job["output"][0], reason_of(job["log"])) for job in failed))
        print(*(f"{path} failed: {reason}" for path, reason in reasons.items()), sep="\n")
        lacks.write_text(json.dumps([reasons, unmade]))
        quiet = ["--quiet", "host", "progress", "reason", "rules"]
        environment = {**os.environ, VARIABLE: str(lacks)}
        subprocess.run([*command, *quiet, "--", "page"], check=False, env=environment)


def jobs_left(command: list[str]) -> list[dict[str, list[str]]]:
    """Inputs, outputs and logs of the jobs that a dry run lists: those that could not be done."""
    said = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    jobs = re.findall(r"^(?:local)?rule [\w/]+:\n((?:    .*\n)*)", said.stdout, re.MULTILINE)
    kinds = ("input", "output", "log")
    found = [dict(re.findall(r"^    (\w+): (.*)$", job, re.MULTILINE)) for job in jobs]
    return [{kind: job[kind].split(", ") if kind in job else [] for kind in kinds} for job in found]


def was_tried(job: dict[str, list[str]], began: Path) -> bool:
    """Whether a job has a log that is younger than the run."""
    logs = [Path(log) for log in job["log"] if Path(log).exists()]
    return any(log.stat().st_mtime_ns >= began.stat().st_mtime_ns for log in logs)


def reason_of(logs: list[str]) -> str:
    """The first line of logs that begins with error, else their last one, without progress."""
    texts = [Path(log).read_text(errors="replace") for log in logs if Path(log).exists()]
    lines = [line.strip() for text in texts for line in text.splitlines() if " %, " not in line]
    errors = [line for line in lines if line.lower().startswith("error")]
    return next(filter(None, [*errors, *reversed(lines)]), "its log is empty")
