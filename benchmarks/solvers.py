"""Solvers as processes: each integrates one scene on request, and may fail without harm."""

import math
import os
import re
import select
import subprocess
import time
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from measuring import BUILD, HERE, ROOT, configuration

from scripts.files.tsv import read_table
from scripts.studies.work_precision.plan import case_of, measured_study
from scripts.tables.accuracy import Reference, distances, read_references

HORIZONS = ROOT / "results" / "tables" / "trusted-horizons.tsv"
START_LIMIT = 120.0
"""Seconds in which a worker must have started, which may include compilation."""
OURS_BINARY = str(BUILD / "our_worker")
DESOLVE = ["Rscript", "--vanilla", str(HERE / "desolve_worker.R"), str(BUILD / "block.so")]
SOLVERS = {
    "ours": [OURS_BINARY, "auto"],
    "jitcdde": [str(HERE / ".venv" / "bin" / "python"), "-I", str(HERE / "jitcdde_worker.py")],
    "desolve": [*DESOLVE, "1"],
    "desolve_interpol_2": [*DESOLVE, "2"],
}
"""Commands of the solvers, ours first; deSolve by default and with its better interpolation."""


@dataclass(frozen=True, kw_only=True)
class Scene:
    """Parameters, the constant past in theta, u, ln v, last and sample times; nondimensional."""

    name: str
    tau: float
    epsilon: float
    xi: float
    gamma: float
    past: tuple[float, float, float]
    t_end: float
    sample_interval: float

    def line(self) -> str:
        """The scene as its workers read it."""
        values = (self.tau, self.epsilon, self.xi, self.gamma, *self.past)
        return " ".join(f"{value:.17g}" for value in (*values, self.t_end, self.sample_interval))


def read_study() -> dict:
    """The study of work against precision of the project's configuration."""
    return measured_study(configuration())


def read_horizons() -> dict[str, float]:
    """Times up to which each scene can be trusted."""
    return {row["scene"]: row["horizon"] for row in read_table(HORIZONS)}


def reference_path(name: str) -> Path:
    """Where the workflow puts a scene's reference."""
    return ROOT / "results" / "references" / "trust" / f"{name}.tsv"


def read_reference(name: str) -> Reference:
    """The solution of a scene in quadruple precision."""
    return read_references([reference_path(name)])[name]


def scene_of(study: dict, horizons: dict[str, float], name: str) -> Scene:
    """A scene of the study, up to its horizon."""
    case = case_of(name, study["cases"][name])
    return Scene(
        name=name,
        **{key: float(case[key]) for key in ("tau", "epsilon", "xi", "gamma")},
        past=(float(case["theta"]), float(case["u"]), math.log(case["v"])),
        t_end=horizons[name],
        sample_interval=case["sample_interval"],
    )


def error_max(samples: np.ndarray, scene: Scene, reference: Reference) -> float:
    """Largest error over all samples, rows of t, theta, u, ln v; NaN where one is missing."""
    count = round(scene.t_end / scene.sample_interval) + 1
    times = reference.time[:count]
    if samples.shape != (count, 4) or not np.allclose(samples[:, 0], times, rtol=0, atol=1e-6):
        return math.nan
    return float(np.max(distances(samples[:, 1:].T, reference.state[:, :count])))


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
    process: subprocess.Popen | None = None
    unread: bytes = field(default=b"", repr=False)

    def __enter__(self) -> "Worker":
        return self

    def __exit__(self, *_) -> None:
        self.stop()

    def seconds(self, tolerance: float, runs: int, limit: float) -> float:
        """CPU seconds of one integration without samples, as the mean of several."""
        return self._request(f"{tolerance:g} {runs} -", limit)

    def sample(self, tolerance: float, path: Path, limit: float) -> None:
        """Integrate once and write samples to a file."""
        self._request(f"{tolerance:g} 0 {path}", limit)

    def peak_memory(self) -> float:
        """The most memory that the process has held, in MB."""
        return peak_memory_of(self.process)

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
        self.version = self._answer(START_LIMIT)

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
