"""One block in JiTCDDE: a scene, compiled once and run on request (compare.py)."""

import contextlib
import os
import sys
import time
import warnings
from typing import TextIO

import jitcdde
import numpy as np
from symengine import Symbol, exp


def compiled(tau: float, epsilon: float, xi: float, gamma: float) -> jitcdde.jitcdde:
    """The solver of equation (4) in theta, u and w = ln v, with v as a helper."""
    theta, u, w = (jitcdde.y(i) for i in range(3))
    delayed_w = jitcdde.y(2, jitcdde.t - tau) if tau > 0 else w
    v = Symbol("v")
    equations = [
        -v * (theta + (1 + epsilon) * delayed_w),
        v - 1,
        -(gamma**2) / v * (u + (theta + w) / xi),
    ]
    solver = jitcdde.jitcdde(equations, helpers=[(v, exp(w))], max_delay=tau, verbose=False)
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


def answer(solver, past, times: np.ndarray, tolerance: float, runs: int, path: str) -> str:
    """CPU seconds of one run to the last time; or, for no runs, nothing but samples."""
    seconds = 0.0
    try:
        if runs == 0:
            prepare(solver, past, tolerance)
            np.savetxt(path, np.column_stack([times, sampled(solver, times)]), delimiter="\t")
        for _ in range(runs):
            prepare(solver, past, tolerance)
            start = time.process_time()
            solver.step_on_discontinuities()
            solver.integrate(times[-1])
            seconds += time.process_time() - start
    except jitcdde.UnsuccessfulIntegration as failure:
        return f"0 {str(failure).strip().splitlines()[0]}"
    return f"{seconds / max(runs, 1)} ok"


def serve_scene(out: TextIO) -> None:
    """Answer requests, a line each, about the scene on the first line of standard input."""
    *parameters, t_end, interval = map(float, sys.stdin.readline().split())
    times = interval * np.arange(round(t_end / interval) + 1)
    solver, past = compiled(*parameters[:4]), parameters[4:]
    print(f"answer: {jitcdde.__version__}", file=out, flush=True)
    for line in sys.stdin:
        tolerance, runs, path = line.rstrip("\n").split(" ", 2)
        reply = answer(solver, past, times, float(tolerance), int(runs), path)
        print(f"answer: {reply}", file=out, flush=True)


if __name__ == "__main__":
    warnings.simplefilter("ignore")
    # other output of JiTCDDE must not be taken for an answer
    with os.fdopen(os.dup(1), "w") as answers, contextlib.redirect_stdout(sys.stderr):
        os.dup2(2, 1)
        serve_scene(answers)
