"""Logger plugin of Snakemake: one line of progress instead of several lines for each job.

Snakemake's own messages and the words of jobs are in its log file in .snakemake/log/.
"""

import atexit
import contextlib
import logging
import signal
import threading
import time
from types import FrameType

from snakemake_interface_logger_plugins.base import LogHandlerBase
from snakemake_interface_logger_plugins.common import LogEvent

from scripts.console.error_words import in_one_line
from scripts.console.run_progress import Job, RunProgress, counted
from scripts.console.screen import GRACE, Screen

TICK = 0.5
"""Seconds between two times at which a terminal's line is rewritten."""
PAUSE = 30.0
"""Seconds between two lines of progress where there is no terminal."""
NOTHING = "Nothing to be done"
"""Snakemake's first words where all results are up to date."""
OF_FAILURES = (
    "RuleException: CalledProcessError",
    "WorkflowError: At least one job",
    "Exiting because a job",
)
"""First words of errors that only repeat that a job failed."""


def log_file() -> str:
    """Snakemake's own log file of this run, which it opens after its plugins."""
    for handler in logging.getLogger("snakemake.logging").handlers:
        if isinstance(handler, logging.FileHandler):
            return handler.baseFilename
    return ""


class LogHandler(LogHandlerBase):
    """Shows progress, the words of failing jobs and how the run ended."""

    writes_to_stream = True
    writes_to_file = False
    has_filter = True
    has_formatter = True
    needs_rulegraph = False

    def __post_init__(self) -> None:
        """Before the Snakefile is read."""
        self.run = RunProgress()
        self.log = ""
        self.up_to_date = False
        self.closed = threading.Event()
        self.interrupted = threading.Event()
        self.screen = Screen(self.note, self.interrupted)
        signal.signal(signal.SIGINT, self.on_interrupt)
        self.events = {
            LogEvent.RUN_INFO: self.on_run,
            LogEvent.JOB_INFO: self.on_job,
            LogEvent.JOB_FINISHED: self.on_end_of_job,
            LogEvent.JOB_ERROR: self.on_failure,
        }
        self.ticker = threading.Thread(target=self.tick, daemon=True)
        self.ticker.start()
        # a Snakefile that ends the run leaves its handlers open
        atexit.register(self.close)

    def emit(self, record: logging.LogRecord) -> None:
        """Called for each message of Snakemake's, in turn."""
        self.log = self.log or log_file()
        asked = getattr(record, "asked_for", None)
        if asked is not None:
            self.run.ask(asked)
        elif on_event := self.events.get(getattr(record, "event", None)):
            on_event(record)
        elif record.levelno >= logging.WARNING:
            self.on_problem(record)
        elif record.getMessage().startswith(NOTHING):
            self.up_to_date = True

    def on_run(self, record: logging.LogRecord) -> None:
        """Before the first job."""
        self.run.total = record.stats["total"]
        log = self.run.seen(self.log)
        self.screen.say(f"{counted(self.run.total, 'job')}; all messages are in {log}")

    def on_job(self, record: logging.LogRecord) -> None:
        """A job starts."""
        self.run.begin(record.jobid, Job(list(record.output), list(record.log)))

    def on_end_of_job(self, record: logging.LogRecord) -> None:
        """A job is done."""
        for path in self.run.end(record.job_id):
            self.screen.say(f"made {self.run.seen(path)}")

    def on_failure(self, record: logging.LogRecord) -> None:
        """The job's own words come before, through standard error."""
        if self.interrupted.wait(2 * GRACE):
            return
        self.run.fail(record.jobid)
        made = f"{self.run.seen(record.output[0])} " if record.output else ""
        log = f"; log: {self.run.seen(record.log[0])}" if record.log else ""
        self.screen.say(f"failed: {made}(rule {record.rule_name}){log}")

    def on_interrupt(self, number: int, frame: FrameType | None) -> None:
        """Ctrl-C: the jobs that it ends have not failed by themselves; their words tell nothing."""
        self.interrupted.set()
        signal.default_int_handler(number, frame)

    def on_problem(self, record: logging.LogRecord) -> None:
        """A warning as it stands, an error in one line."""
        message = record.getMessage()
        if record.levelno < logging.ERROR:
            self.screen.say(message)
        elif not " ".join(message.split()).startswith(OF_FAILURES):
            self.screen.say(in_one_line(message))

    def note(self, line: str) -> None:
        """Keep the words of jobs in the log file too."""
        # on a full disk the jobs go on
        with contextlib.suppress(OSError), open(self.log, "a", encoding="utf-8") as log:
            log.write(f"{line}\n")

    def tick(self) -> None:
        """Time goes on while no message comes."""
        told = time.monotonic()
        while not self.closed.wait(TICK):
            if not self.run.total:
                continue
            self.screen.show(self.run.line())
            if not self.screen.rewrites and time.monotonic() - told >= PAUSE:
                told = time.monotonic()
                self.screen.say(self.run.sentence())

    def close(self) -> None:
        """At the end of the run, however that ends; Snakemake calls it more than once."""
        if not self.closed.is_set():
            self.closed.set()
            self.ticker.join()
            self.screen.close()
            lines = self.run.last_lines(self.log) if self.run.total else []
            if self.up_to_date:
                lines = ["nothing to do: all results are up to date", *self.run.to_open()]
            for line in lines:
                self.screen.say(line)
        super().close()
