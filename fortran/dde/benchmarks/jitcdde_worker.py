# SPDX-License-Identifier: BSD-3-Clause
"""One block or a chain of them in JiTCDDE: a scene, compiled once and run on request (workers.py).

Arguments for a chain: what its blocks feel of each other, its ends, and the last time of samples.
"""

import contextlib
import os
import sys
import time
import warnings
from typing import TextIO

import jitcdde
import numpy as np
from symengine import Symbol, exp


def neighbours(j: int, blocks: int, ends: str) -> list[int | None]:
    """Blocks beside block j; None is the plate."""
    beside = [j - 1, j + 1]
    if ends == "ring":
        return [i % blocks for i in beside]
    inside = [i if 0 <= i < blocks else None for i in beside]
    return inside if ends == "plate" else [i for i in inside if i is not None]


def compiled(
    blocks: int,
    parameters: tuple[float, float, float, float],
    kappa: float = 0.0,
    ends: str = "free",
) -> jitcdde.jitcdde:
    """The solver of the blocks in theta, u and w = ln v of one after another, with v as helpers."""
    tau, epsilon, xi, gamma = parameters
    equations, helpers = [], []
    for j in range(blocks):
        theta, u, w = (jitcdde.y(3 * j + i) for i in range(3))
        delayed_w = jitcdde.y(3 * j + 2, jitcdde.t - tau) if tau > 0 else w
        beside = neighbours(j, blocks, ends)
        others = sum(jitcdde.y(3 * i + 1) for i in beside if i is not None)
        v = Symbol(f"v{j}")
        helpers.append((v, exp(w)))
        equations += [
            -v * (theta + (1 + epsilon) * delayed_w),
            v - 1,
            -(gamma**2) / v * (u + kappa * (len(beside) * u - others) + (theta + w) / xi),
        ]
    solver = jitcdde.jitcdde(equations, helpers=helpers, max_delay=tau, verbose=False)
    solver.compile_C()
    return solver


def prepare(solver: jitcdde.jitcdde, past: list[float], tolerance: float) -> None:
    """A fresh start from the constant past."""
    solver.purge_past()
    solver.constant_past(past)
    # the default least step of 1e-10 would end it at the tightest tolerances
    solver.set_integration_parameters(rtol=tolerance, atol=tolerance, min_step=1e-15)


def sampled(solver: jitcdde.jitcdde, times: np.ndarray) -> np.ndarray:
    """State at the given times, from the start on."""
    solver.step_on_discontinuities()
    begun, begun_until = solver.get_state(), solver.t
    return np.array(
        [begun.get_state(t) if t <= begun_until else solver.integrate(t) for t in times]
    )


def serve_scene(out: TextIO) -> None:
    """Answer requests, a line each, about the scene on the first line of standard input."""
    *scene, t_end, interval = map(float, sys.stdin.readline().split())
    past = scene[4:]
    blocks = len(past) // 3
    kappa, ends, t_sampled = sys.argv[1:] or (0.0, "free", t_end)
    times = interval * np.arange(round(float(t_sampled) / interval) + 1)
    # JiTCDDE sorts helpers by as many calls within each other
    sys.setrecursionlimit(100 * (100 + blocks))
    before = sum(os.times()[:4])
    solver = compiled(blocks, scene[:4], float(kappa), ends)
    print(f"answer: {jitcdde.__version__} {sum(os.times()[:4]) - before}", file=out, flush=True)

    def answer(tolerance: float, runs: int, path: str) -> str:
        """CPU seconds of one run; or, for no runs, nothing but samples."""
        seconds = 0.0
        try:
            if runs == 0:
                prepare(solver, past, tolerance)
                np.savetxt(path, np.column_stack([times, sampled(solver, times)]), delimiter="\t")
            for _ in range(runs):
                prepare(solver, past, tolerance)
                start = time.process_time()
                solver.step_on_discontinuities()
                solver.integrate(t_end)
                seconds += time.process_time() - start
        except jitcdde.UnsuccessfulIntegration as failure:
            return f"0 {str(failure).strip().splitlines()[0]}"
        return f"{seconds / max(runs, 1)} ok"

    for line in sys.stdin:
        tolerance, runs, path = line.rstrip("\n").split(" ", 2)
        print(f"answer: {answer(float(tolerance), int(runs), path)}", file=out, flush=True)


if __name__ == "__main__":
    warnings.simplefilter("ignore")
    # other output of JiTCDDE must not be taken for an answer
    with os.fdopen(os.dup(1), "w") as answers, contextlib.redirect_stdout(sys.stderr):
        os.dup2(2, 1)
        serve_scene(answers)
