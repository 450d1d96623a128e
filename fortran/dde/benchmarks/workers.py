# SPDX-License-Identifier: BSD-3-Clause
"""Solvers as processes: each integrates one scene on request, and may fail without harm."""

import os
import re
import select
import shutil
import subprocess
import tempfile
import time
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from measuring import BUILD, HERE

START_LIMIT = 120.0
"""Seconds in which a worker must have started, which may include compilation."""


@dataclass(frozen=True)
class Solver:
    """How a solver is called, what it is made from, and kinds of scenes that it is for."""

    command: list[str]
    needs: str = "nothing else"
    kinds: tuple[str, ...] = ("mild", "stiff")
    any_problem: bool = False
    """Whether it has a program for each problem, which is told what the problem gives"""


DESOLVE = ["Rscript", "--vanilla", str(HERE / "desolve_worker.R"), str(BUILD / "block.so")]
OURS = "ours"
SOLVERS = {
    OURS: Solver([str(BUILD / "dde_block"), "auto"], any_problem=True),
    "radar5": Solver([str(BUILD / "radar5_block")], "--hairer FOLDER", ("stiff",), True),
    "retard": Solver([str(BUILD / "retard_block")], "--hairer FOLDER", ("mild",), True),
    "jitcdde": Solver(
        [str(HERE / ".venv" / "bin" / "python"), "-I", str(HERE / "jitcdde_worker.py")],
        "Python packages of requirements.lock",
        ("mild",),
    ),
    "desolve": Solver([*DESOLVE, "1"], "R with deSolve"),
    "desolve_interpol_2": Solver([*DESOLVE, "2"], "R with deSolve"),
}
"""This solver, then others; deSolve by default and with its better interpolation."""


def chosen_solvers(names: list[str]) -> dict[str, Solver]:
    """This solver and others by name; SystemExit if one of them is not there."""
    chosen = {name: SOLVERS[name] for name in dict.fromkeys([OURS, *names])}
    for name, solver in chosen.items():
        if not shutil.which(solver.command[0]):
            raise SystemExit(f"benchmarks: {name} is missing; it needs {solver.needs}")
    return chosen


@dataclass(frozen=True, kw_only=True)
class Scene:
    """Parameters, the constant past, last and sample times; nondimensional.

    The past is theta, u, ln v, of one block after another where there are several.
    """

    tau: float
    epsilon: float
    xi: float
    gamma: float
    past: tuple[float, ...]
    t_end: float
    sample_interval: float

    def line(self) -> str:
        """The scene as its workers read it."""
        values = (self.tau, self.epsilon, self.xi, self.gamma, *self.past)
        return " ".join(f"{value:.17g}" for value in (*values, self.t_end, self.sample_interval))


class SolverError(Exception):
    """Why a solver did not finish, in words."""


class TimeLimitError(SolverError):
    """The solver took too long."""


def peak_memory_of(process: subprocess.Popen) -> float:
    """The most memory that a process has held, in MB; 0 if it has ended."""
    status = Path(f"/proc/{process.pid}/status").read_text()
    found = re.search(r"VmHWM:\s+(\d+) kB", status)
    return int(found[1]) * 1024 / 1e6 if found else 0.0


@dataclass
class Worker:
    """One solver on one scene; its process starts with a request, and again after its end."""

    command: list[str]
    scene: Scene
    version: str = ""
    set_up_seconds: float | None = None
    process: subprocess.Popen | None = None
    unread: bytes = field(default=b"", repr=False)

    def __enter__(self) -> "Worker":
        return self

    def __exit__(self, *_) -> None:
        self.stop()

    def seconds(self, tolerance: float, runs: int, limit: float) -> float:
        """CPU seconds of one integration without samples, as the mean of several."""
        return self._request(f"{tolerance:g} {runs} -", limit)

    def samples(self, tolerance: float, limit: float) -> np.ndarray:
        """Samples of one integration: rows of the time and the state."""
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "samples.tsv"
            self._request(f"{tolerance:g} 0 {path}", limit)
            return np.loadtxt(path, ndmin=2)

    def instructions(self, tolerance: float, runs: int) -> int:
        """Instructions of a process of its own that integrates several times."""
        counting = ["valgrind", "--tool=cachegrind", "--cache-sim=no"]
        run = subprocess.run(
            [*counting, "--cachegrind-out-file=/dev/null", *self.command],
            input=f"{self.scene.line()}\n{tolerance:g} {runs} -\n",
            capture_output=True,
            text=True,
            check=True,
        )
        found = re.search(r"I +refs: +([\d,]+)", run.stderr)
        return int(found[1].replace(",", ""))

    def stop(self) -> None:
        """End the process, if there is one."""
        if self.process:
            self.process.kill()
            self.process.wait()
            self.process.stdin.close()
            self.process.stdout.close()
        self.process = None
        self.unread = b""

    def _request(self, request: str, limit: float) -> float:
        """Seconds in the answer; raise SolverError with the solver's own words."""
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
        self.version, *seconds = self._answer(START_LIMIT).split()
        self.set_up_seconds = float(seconds[0]) if seconds else None

    def _send(self, line: str) -> None:
        try:
            self.process.stdin.write(f"{line}\n".encode())
        except BrokenPipeError:
            raise self._death() from None

    def _answer(self, limit: float) -> str:
        """The next answer; other output of the solver is left out."""
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
        """The error for a process that ended without a request to do so."""
        status = self.process.wait()
        self.stop()
        return SolverError(f"ended by itself with status {status}")
