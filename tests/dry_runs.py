"""The jobs that a dry run lists, and which of them a rule or a file needs."""

import re
from dataclasses import dataclass


@dataclass(frozen=True)
class Job:
    """A job with the files that it reads and those that it makes."""

    rule: str
    given: frozenset[str]
    made: frozenset[str]


def jobs_in(log: str) -> list[Job]:
    """The jobs in the log of a run or a dry run."""
    listed = r"^(?:local)?rule ([\w/]+):\n(?:    input: (.*)\n)?(?:    output: (.*)\n)?"
    return [
        Job(rule, *(frozenset(files.split(", ")) - {""} for files in (given, made)))
        for rule, given, made in re.findall(listed, log, flags=re.MULTILINE)
    ]


def needed_for(target: str, jobs: list[Job]) -> set[Job]:
    """The jobs of a rule, or the one that makes a file, and all jobs that these need."""
    makers = {path: job for job in jobs for path in job.made}
    waiting = [job for job in jobs if target in {job.rule, *job.made}]
    needed: set[Job] = set()
    while waiting:
        job = waiting.pop()
        needed.add(job)
        found = {makers[path] for path in job.given if path in makers}
        waiting += found - needed
    return needed


def data_of_jobs(jobs: set[Job]) -> set[str]:
    """Programs and data files that they make, each by folder and name."""
    made = {path for job in jobs for path in job.made}
    data = re.compile(r"\.nc$|\.so$|/bin/\w+$")
    return {"/".join(path.split("/")[-2:]) for path in made if data.search(path)}
