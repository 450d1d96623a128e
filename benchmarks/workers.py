"""Solvers as processes: each integrates one scene when asked, and may fail without harm."""

import os
import select
import subprocess
import time
from dataclasses import dataclass, field
from pathlib import Path

from scenes import Scene

HERE = Path(__file__).resolve().parent
BUILD = HERE / "build"
START_LIMIT = 120.0
"""Seconds in which a worker must have started, which may include compilation."""


class SolverError(Exception):
    """Why a solver did not finish, in words."""


class TimeLimitError(SolverError):
    """It took too long."""


def our_command(method: str) -> list[str]:
    """The project's own solver with a method."""
    return [str(BUILD / "our_worker"), method]


def desolve_command(interpolation: int) -> list[str]:
    """deSolve with one of its two interpolations of the past."""
    script, library = str(HERE / "desolve_worker.R"), str(BUILD / "block.so")
    return ["Rscript", "--vanilla", script, library, str(interpolation)]


SOLVERS = {
    "ours": our_command("auto"),
    "jitcdde": [str(HERE / ".venv" / "bin" / "python"), "-I", str(HERE / "jitcdde_worker.py")],
    "desolve": desolve_command(1),
    "desolve_interpol_2": desolve_command(2),
}
"""Commands of the solvers, ours first; deSolve by default and with its better interpolation."""


@dataclass
class Worker:
    """One solver on one scene; started when asked, and again after its end."""

    command: list[str]
    scene: Scene
    version: str = ""
    process: subprocess.Popen | None = None
    unread: bytes = field(default=b"", repr=False)

    def __enter__(self) -> "Worker":
        return self

    def __exit__(self, *_) -> None:
        self.stop()

    def seconds(self, tolerance: float, runs: int, limit: float) -> float:
        """CPU seconds of one integration without samples, as the mean of several."""
        return self._ask(f"{tolerance:g} {runs} -", limit)

    def sample(self, tolerance: float, path: Path, limit: float) -> None:
        """Integrate once and write samples to a file."""
        self._ask(f"{tolerance:g} 0 {path}", limit)

    def stop(self) -> None:
        """End the process, if there is one."""
        if self.process:
            self.process.kill()
            self.process.wait()
            self.process.stdin.close()
            self.process.stdout.close()
        self.process = None
        self.unread = b""

    def _ask(self, request: str, limit: float) -> float:
        """Seconds as answered; raise SolverError with the solver's own words."""
        if self.process is None:
            self._start()
        self._send(request)
        seconds, status = self._answer(limit).split(maxsplit=1)
        if status != "ok":
            raise SolverError(status)
        return float(seconds)

    def _start(self) -> None:
        self.process = subprocess.Popen(
            self.command,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            bufsize=0,
            env={**os.environ, "OMP_NUM_THREADS": "1"},
        )
        self._send(self.scene.line())
        self.version = self._answer(START_LIMIT)

    def _send(self, line: str) -> None:
        try:
            self.process.stdin.write(f"{line}\n".encode())
        except BrokenPipeError:
            raise self._death() from None

    def _answer(self, limit: float) -> str:
        """The next answer; what the solver says besides is left out."""
        last = time.monotonic() + limit
        while True:
            line, found, rest = self.unread.partition(b"\n")
            if found:
                self.unread = rest
                word, _, answer = line.decode(errors="replace").partition(":")
                if word == "answer":
                    return answer.strip()
                continue
            ready, _, _ = select.select([self.process.stdout], [], [], last - time.monotonic())
            if not ready:
                self.stop()
                raise TimeLimitError(f"longer than {limit:g} s")
            piece = self.process.stdout.read(65536)
            if not piece:
                raise self._death()
            self.unread += piece

    def _death(self) -> SolverError:
        """What is known of a process that ended unasked."""
        status = self.process.wait()
        self.stop()
        return SolverError(f"ended by itself with status {status}")
