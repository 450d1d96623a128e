"""Standard error while jobs run: lines that stay and, on a terminal, one line that is rewritten."""

import codecs
import os
import threading
from collections.abc import Callable

CLEAR = "\r\x1b[K"
"""Back to the start of the line, which becomes empty."""
GRACE = 0.1
"""Seconds by which a job that Ctrl-C ends may be heard of before Ctrl-C itself."""


class Screen:
    """Takes over standard error, so that the words of jobs do not mix with the rewritten line.

    Jobs inherit the pipe that replaces it. A thread passes on what they write, line by line.
    """

    def __init__(self, heard: Callable[[str], None], interrupted: threading.Event) -> None:
        """`heard` is called with each line that a job, or Snakemake itself, writes.

        These lines are no longer shown once the run is interrupted.
        """
        self.heard = heard
        self.interrupted = interrupted
        self.lock = threading.Lock()
        self.shown = ""
        self.stderr = os.dup(2)
        self.rewrites = os.isatty(2) and os.environ.get("TERM") != "dumb"
        self.pipe, writing = os.pipe()
        os.dup2(writing, 2)
        os.close(writing)
        self.listener = threading.Thread(target=self.listen, daemon=True)
        self.listener.start()

    def listen(self) -> None:
        """Pass on what comes through the pipe, until all who could write have ended."""
        decoder = codecs.getincrementaldecoder("utf-8")(errors="replace")
        rest = ""
        while some := os.read(self.pipe, 65536):
            rest = self.pass_on(rest + decoder.decode(some))
        if rest:
            self.pass_on(f"{rest}\n")

    def pass_on(self, text: str) -> str:
        """Show the lines of others, and let them be heard; return the line that has no end yet."""
        *lines, rest = text.split("\n")
        hidden = self.interrupted.wait(GRACE)
        for line in lines:
            if not hidden:
                self.say(line)
            self.heard(line)
        return rest

    def say(self, line: str) -> None:
        """A line that stays."""
        with self.lock:
            self.write(f"{CLEAR if self.shown else ''}{line}\n{self.shown}")

    def show(self, text: str) -> None:
        """Rewrite the line of progress, where there is a terminal."""
        if not self.rewrites:
            return
        with self.lock:
            self.shown = text[: self.columns() - 1]
            self.write(CLEAR + self.shown)

    def columns(self) -> int:
        """Width of the terminal."""
        try:
            return os.get_terminal_size(self.stderr).columns or 80
        except OSError:
            return 80

    def write(self, text: str) -> None:
        """To the true standard error; one that takes nothing does not stop the work."""
        data = text.encode(errors="replace")
        try:
            while data:
                data = data[os.write(self.stderr, data) :]
        except OSError:
            pass

    def close(self) -> None:
        """Clear the line of progress and give standard error back."""
        os.dup2(self.stderr, 2)
        # a process that a job left behind may hold the pipe open
        self.listener.join(timeout=2)
        self.show("")
        self.shown = ""
