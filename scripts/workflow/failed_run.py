"""The page of a run in which jobs failed: what there is, and why the rest is missing."""

import json
import subprocess
import sys
import tempfile
from pathlib import Path


def make_page(workflow, results: str, given: dict) -> None:
    """Make the page by a run of its own, of which Snakemake knows that it lacks something.

    `given` is the configuration as Snakemake got it. A run that was stopped gets no page: some of
    its jobs lack nothing and were not tried.
    """
    failed, unmade = workflow.scheduler.failed, set(workflow.dag.needrun_jobs())
    needed = workflow.dag.dependencies
    stopped = any(job not in failed and unmade.isdisjoint(needed[job]) for job in unmade)
    paths = sorted(str(path) for job in unmade for path in job.output)
    if stopped or f"{results}/index.html" not in paths:
        return
    for path in paths:
        if path.endswith(".html"):
            Path(path).unlink(missing_ok=True)
    reasons = dict(sorted((str(job.output[0]), reason_of(job.log)) for job in failed))
    print(*(f"{path} failed: {reason}" for path, reason in reasons.items()), sep="\n")
    with tempfile.NamedTemporaryFile("w", suffix=".json") as file:
        json.dump({**given, "failed": reasons, "unmade": paths}, file)
        file.flush()
        command = ["snakemake", "page", "--nolock", "--cores", "1", "--configfile", file.name]
        quiet = ["--quiet", "host", "progress", "reason", "rules"]
        subprocess.run([sys.executable, "-m", *command, *quiet], check=False)


def reason_of(logs) -> str:
    """The first line of logs that begins with error, else their last one, without progress."""
    texts = [Path(log).read_text(errors="replace") for log in logs if Path(log).exists()]
    lines = [line.strip() for text in texts for line in text.splitlines() if " %, " not in line]
    errors = [line for line in lines if line.lower().startswith("error")]
    return next(filter(None, [*errors, *reversed(lines)]), "its log is empty")
