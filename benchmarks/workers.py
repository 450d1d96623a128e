"""Solvers as processes, which run a task on request and may fail without harm.

A solver is a worker in solvers/ and a row of SOLVERS. A worker reads a task from the first line of
its standard input, and prints `answer: VERSION SECONDS`, the CPU time of its set-up, which may be
left out. Each further line is a request `TOLERANCE RUNS PATH`. It runs the task so often; if RUNS
is 0, it runs once and writes a table of numbers to PATH. Then it prints `answer: SECONDS ok`, the
CPU time of a run, or `answer: 0 WHY_NOT`. Other output is ignored.
"""

import contextlib
import os
import re
import shutil
import signal
import subprocess
import tempfile
import threading
import time
from dataclasses import dataclass
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
BUILD = HERE / "build"
PYTHON = HERE / ".venv" / "bin" / "python"
START_LIMIT = 120.0
"""Seconds in which a worker must have started, which may include compilation."""


@dataclass(frozen=True)
class Solver:
    """How a solver is called, and what it needs."""

    command: str
    """Words; those in braces are filled in, others may follow"""
    needs: str = "nothing else"
    kinds: tuple[str, ...] = ("mild", "stiff")
    """Cases of `peers` that it is for"""


OURS = "ours"
VENV, HAIRER, R = "packages of requirements.lock", "--hairer FOLDER", "R with deSolve"
SOLVERS = {
    OURS: Solver(f"{BUILD}/dde_{{problem}} {{method}} {{given}}"),
    "radar5": Solver(f"{BUILD}/radar5_{{problem}} {{given}}", HAIRER, ("stiff", "moving")),
    "retard": Solver(f"{BUILD}/retard_{{problem}}", HAIRER, ("mild", "moving")),
    "dense_output": Solver(f"{BUILD}/dense_worker", kinds=()),
    "jitcdde": Solver(f"{PYTHON} -Es {HERE}/solvers/jitcdde_worker.py", VENV, ("mild",)),
    "jitcdde_moving": Solver(
        f"{PYTHON} -Es {HERE}/solvers/jitcdde_worker.py {{problem}}", VENV, ("moving",)
    ),
    "delaykit": Solver(f"{PYTHON} -Es {HERE}/solvers/delaykit_worker.py", VENV, ()),
    "scipy": Solver(f"{PYTHON} -Es {HERE}/solvers/scipy_worker.py", VENV, ()),
    "scipy_dense": Solver(f"{PYTHON} -Es {HERE}/solvers/scipy_worker.py dense", VENV, ()),
    "ddeint": Solver(f"{PYTHON} -Es {HERE}/solvers/ddeint_worker.py", VENV, ()),
    "desolve": Solver(f"Rscript --vanilla {HERE}/solvers/desolve_worker.R {BUILD}/block.so 1", R),
    "desolve_interpol_2": Solver(
        f"Rscript --vanilla {HERE}/solvers/desolve_worker.R {BUILD}/block.so 2", R
    ),
    "biftool": Solver(
        f"octave-cli --quiet {HERE}/solvers/biftool_worker.m", "Octave and --biftool FOLDER", ()
    ),
}
"""This solver, its dense output, then others; deSolve also with its better interpolation."""


def command_of(name: str, *more, **filled: str) -> list[str]:
    """The words that start a worker; SystemExit if it is not there."""
    words = [word.format(**filled) for word in SOLVERS[name].command.split()]
    if not shutil.which(words[0]):
        raise SystemExit(f"benchmarks: {name} is missing; it needs {SOLVERS[name].needs}")
    return [*words, *map(str, more)]


@dataclass(frozen=True)
class Task:
    """What a worker reads first: numbers of the problem, the last time, and that between samples.

    Those of the block are tau, epsilon, xi, gamma, then theta, u and ln v for t <= 0, of one block
    after another where there are several; nondimensional. Other problems say theirs.
    """

    parameters: tuple[float, ...] = ()
    t_end: float = 0.0
    sample_interval: float = 0.0

    def line(self) -> str:
        """The task as its workers read it."""
        values = (*self.parameters, self.t_end, self.sample_interval)
        return " ".join(f"{value:.17g}" for value in values)


class SolverError(Exception):
    """Why a solver did not finish, in words."""


class TimeLimitError(SolverError):
    """The solver took too long."""


@dataclass
class Worker:
    """One solver and one task; its process starts with a request, and again after its end."""

    command: list[str]
    task: Task = Task()
    fresh: bool = False
    """Whether each request has a process of its own, whose start and set-up count"""
    version: str = ""
    set_up_seconds: float = 0.0
    clock: float = 0.0
    """Seconds of the wall clock of the last request"""
    held: int = 0
    """Memory at the start in kB"""
    process: subprocess.Popen | None = None

    def __enter__(self) -> "Worker":
        return self

    def __exit__(self, *_) -> None:
        self.stop()

    def seconds(self, tolerance: float, runs: int, limit: float) -> float:
        """CPU seconds of one run without numbers, as the mean of several."""
        return self._request(f"{tolerance:g} {runs} -", limit)

    def numbers(self, tolerance: float, limit: float) -> tuple[np.ndarray, float]:
        """The table that one run writes, and its CPU seconds.

        Of a task with an interval between samples, rows are the time and the state.
        """
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "numbers.tsv"
            seconds = self._request(f"{tolerance:g} 0 {path}", limit)
            return np.loadtxt(path, ndmin=2), seconds

    def instructions(self, tolerance: float) -> float:
        """Instructions of one run: the first ones of a process prepare what later ones use."""
        few, more = (self._instructions_of(tolerance, runs) for runs in (2, 4))
        return (more - few) / 2

    def memory(self) -> float:
        """The most memory in MB that the process has held above that of its start."""
        return (self._status("VmHWM") - self.held) * 1024 / 1e6

    def stop(self) -> None:
        """End the process and those that it has started, if there is one."""
        if self.process:
            with contextlib.suppress(ProcessLookupError):
                os.killpg(self.process.pid, signal.SIGKILL)
            self.process.wait()
            self.process.stdout.close()
            with contextlib.suppress(BrokenPipeError):
                self.process.stdin.close()
        self.process = None

    def _instructions_of(self, tolerance: float, runs: int) -> int:
        counting = ["valgrind", "--tool=cachegrind", "--cache-sim=no"]
        run = subprocess.run(
            [*counting, "--cachegrind-out-file=/dev/null", *self.command],
            input=f"{self.task.line()}\n{tolerance:g} {runs} -\n",
            capture_output=True,
            text=True,
            check=True,
        )
        found = re.search(r"I +refs: +([\d,]+)", run.stderr)
        return int(found[1].replace(",", ""))

    def _status(self, what: str) -> int:
        status = Path(f"/proc/{self.process.pid}/status").read_text()
        return int(re.search(rf"{what}:\s+(\d+) kB", status)[1])

    def _request(self, request: str, limit: float) -> float:
        """Seconds in the answer; raise SolverError with the solver's own words."""
        before, set_up = time.monotonic(), 0.0
        if self.fresh:
            self.stop()
        if self.process is None:
            self._start()
            set_up = self.set_up_seconds if self.fresh else 0.0
        seconds, status = self._answer(request, limit).split(maxsplit=1)
        self.clock = time.monotonic() - before
        if status != "ok":
            raise SolverError(status)
        return set_up + float(seconds)

    def _start(self) -> None:
        self.process = subprocess.Popen(
            self.command,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            text=True,
            errors="replace",
            start_new_session=True,
            # where JiTCDDE compiles no other project may lie
            cwd=tempfile.gettempdir(),
            env={**os.environ, "OMP_NUM_THREADS": "1"},
        )
        self.version, *seconds = self._answer(self.task.line(), START_LIMIT).split()
        self.set_up_seconds = float(seconds[0]) if seconds else 0.0
        # the peak counts from here
        Path(f"/proc/{self.process.pid}/clear_refs").write_text("5")
        self.held = self._status("VmRSS")

    def _answer(self, line: str, limit: float) -> str:
        """The answer to a line; other output of the solver is left out."""
        timer = threading.Timer(limit, os.killpg, (self.process.pid, signal.SIGKILL))
        timer.start()
        with contextlib.suppress(BrokenPipeError):
            print(line, file=self.process.stdin, flush=True)
        for said in self.process.stdout:
            word, _, answer = said.partition(":")
            if word == "answer":
                timer.cancel()
                return answer.strip()
        too_long = timer.finished.is_set()
        timer.cancel()
        status = self.process.wait()
        self.stop()
        if too_long:
            raise TimeLimitError(f"longer than {limit:g} s")
        raise SolverError(f"ended by itself with status {status}")
