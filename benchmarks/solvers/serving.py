# SPDX-License-Identifier: BSD-3-Clause
"""What the workers in Python share: requests and answers (workers.py), the equation of Mackey
and Glass (1977), and phases with delays, on which packages are compared (package.py)."""

import contextlib
import multiprocessing
import os
import sys
import time
import warnings
from collections.abc import Callable

import numpy as np

BETA, N, RATE, PAST = 0.2, 10, 0.1, 1.2


def slope(y, late):
    """y' of y and of y a delay before."""
    return BETA * late / (1 + late**N) - RATE * y


def mackey_glass(samples: Callable, prepare: Callable = lambda: None) -> dict[str, Callable]:
    """Tasks of what is prepared, and then has samples of a delay at times with a tolerance."""

    def run(_words, parameters: list[float], *_) -> Callable:
        """One delay: samples at times."""
        prepare()
        tau, *times = parameters
        return lambda tolerance, _: np.column_stack(
            [times, samples(tau, np.array(times), tolerance)]
        )

    def scan(words: list[str], delays: list[float], t_end: float, _) -> Callable:
        """Many delays on all cores: states at an early time. The run that is timed has samples a
        unit of time apart in its second half: the cheapest from which maxima can be had."""
        prepare()

        def scanned(tolerance: float, wanted: bool) -> np.ndarray:
            times = np.array([float(words[0])]) if wanted else np.arange(t_end / 2, t_end, 1.0)
            with multiprocessing.get_context("fork").Pool() as pool:
                found = pool.starmap(samples, [(tau, times, tolerance) for tau in delays], 5)
            return np.column_stack([delays, found])

        return scanned

    return {"run": run, "scan": scan}


def phases(n: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Frequencies, delays and first phases of n phases, each pulled by all others (Kuramoto)."""
    random = np.random.default_rng(1)
    return random.normal(1, 0.1, n), random.uniform(0.5, 1.5, (n, n)), random.uniform(0, 6, n)


def cpu_seconds() -> float:
    """CPU time of this process and of those that it waited for."""
    return time.process_time() + sum(os.times()[2:4])


def serve(version: str, tasks: dict[str, Callable]) -> None:
    """Answer requests about one task; its name is on the command line, or it is the first.

    A task takes the other words of the command line, parameters, the last time and that between
    samples. It returns what runs it: a function of the tolerance and whether numbers are wanted,
    which returns their rows.
    """
    warnings.simplefilter("ignore")
    name, *words = sys.argv[1:] or [*tasks][:1]
    # other output must not be taken for an answer
    with os.fdopen(os.dup(1), "w") as answers, contextlib.redirect_stdout(sys.stderr):
        os.dup2(2, 1)
        *parameters, t_end, interval = map(float, sys.stdin.readline().split())
        run_once = tasks[name](words, parameters, t_end, interval)
        print(f"answer: {version} {cpu_seconds()}", file=answers, flush=True)
        for line in sys.stdin:
            tolerance, runs, path = line.rstrip("\n").split(" ", 2)
            before, wanted, count = cpu_seconds(), runs == "0", max(int(runs), 1)
            try:
                for _ in range(count):
                    rows = run_once(float(tolerance), wanted)
                if wanted:
                    np.savetxt(path, rows, delimiter="\t")
                answer = f"{(cpu_seconds() - before) / count} ok"
            except Exception as failure:
                reason = [*str(failure).strip().splitlines(), type(failure).__name__][0]
                answer = f"0 {reason}"
            print(f"answer: {answer}", file=answers, flush=True)
