"""What a run of the workflow has done, does now and ends with, in words."""

import json
import os
import re
import time
from collections import Counter
from dataclasses import dataclass
from pathlib import Path

BAR = 20
"""Characters of the bar."""
PAGE, VERDICTS, PRINTED = "index.html", "claims.json", ".pdf"
"""Names of results that are of use to a reader once they are there."""
STEPS, PER_CENT = re.compile(rb"\[(\d+)/(\d+)\]"), re.compile(rb"(\d+) %,")
"""Progress in the log of a build, and in that of a program."""


def seconds_in_words(seconds: float) -> str:
    """Like `2 min 5 s`."""
    minutes, rest = divmod(round(seconds), 60)
    return f"{minutes} min {rest} s" if minutes else f"{rest} s"


def how_far(logs: list[str]) -> str:
    """Per cent done of a job by the last line of its log, where that has any."""
    try:
        with open(logs[0], "rb") as log:
            log.seek(max(0, log.seek(0, os.SEEK_END) - 400))
            last = log.read().rstrip().rpartition(b"\n")[2]
    except (IndexError, OSError):
        return ""
    if steps := STEPS.search(last):
        return f" {100 * int(steps[1]) // int(steps[2])} %"
    found = PER_CENT.search(last)
    return f" {int(found[1])} %" if found else ""


@dataclass(frozen=True)
class Job:
    """The files of a job that is at work."""

    outputs: list[str]
    logs: list[str]

    def __str__(self) -> str:
        """What it makes, and how far it is."""
        return f"{self.outputs[0].removeprefix('results/')}{how_far(self.logs)}"


def counted(number: int, name: str) -> str:
    """Like `1 job` and `2 jobs`."""
    return f"{number} {name}" if number == 1 else f"{number} {name}s"


class RunProgress:
    """Counts of jobs, and which are at work."""

    def __init__(self) -> None:
        """Begins in the user's folder; the jobs run in the project's."""
        self.folder = Path.cwd()
        self.began = time.monotonic()
        self.total = 0
        self.done = 0
        self.failed = 0
        self.at_work: dict[int, Job] = {}
        self.asked: list[str] = []

    @property
    def elapsed(self) -> str:
        """Time since the beginning."""
        return seconds_in_words(time.monotonic() - self.began)

    def seen(self, path: str) -> str:
        """A path from the user's folder."""
        return os.path.relpath(path, self.folder)

    def ask(self, paths: list[str]) -> None:
        """All files that the run is to make or keep."""
        self.asked = [os.path.abspath(path) for path in paths]

    def begin(self, number: int, job: Job) -> None:
        """A job starts."""
        self.at_work[number] = job

    def end(self, number: int) -> list[str]:
        """A job is done; return those of its files that a reader may open."""
        self.done += 1
        job = self.at_work.pop(number, None)
        return [path for path in job.outputs if path.endswith(PRINTED)] if job else []

    def fail(self, number: int) -> None:
        """A job has failed."""
        self.failed += 1
        self.at_work.pop(number, None)

    def line(self) -> str:
        """Progress and what is made now, for a terminal."""
        full = BAR * self.done // self.total
        bar = "=" * full + " " * (BAR - full)
        return f"[{bar}] {self.sentence()}"

    def sentence(self) -> str:
        """Progress without the bar."""
        # the tick reads while messages change it
        names = ", ".join(str(job) for job in list(self.at_work.values()) if job.outputs)
        so_far = f"{self.done} of {counted(self.total, 'job')}, {self.elapsed}"
        return f"{so_far}: {names}" if names else so_far

    def last_lines(self, log: str) -> list[str]:
        """What a run that began ends with."""
        if self.failed:
            jobs = counted(self.failed, "job")
            return [f"{jobs} failed after {self.elapsed}; all messages are in {self.seen(log)}"]
        if self.done < self.total:
            done = f"{self.done} of {counted(self.total, 'job')} done"
            remedy = "run the same command again to continue"
            return [f"stopped after {self.elapsed}, {done}; {remedy}"]
        return [*self.verdicts(), f"done in {self.elapsed}", *self.to_open()]

    def verdicts(self) -> list[str]:
        """How many claims have each verdict."""
        lines = []
        for path in self.named(VERDICTS):
            claims = json.loads(Path(path).read_text(encoding="utf-8"))
            verdicts = Counter(claim["verdict"] for claim in claims).most_common()
            words = ", ".join(f"{number} {verdict}" for verdict, number in verdicts)
            table = self.seen(str(Path(path).with_suffix(".tsv")))
            lines.append(f"{counted(len(claims), 'claim')}: {words}; see {table}")
        return lines

    def to_open(self) -> list[str]:
        """The page, where it was asked for."""
        return [f"open {self.seen(path)}" for path in self.named(PAGE)]

    def named(self, name: str) -> list[str]:
        """Results of this name among those that were asked for."""
        return [path for path in self.asked if Path(path).name == name and Path(path).exists()]
