# SPDX-License-Identifier: BSD-3-Clause
"""JiTCDDE: a block or a chain, the equation of Mackey and Glass, networks of phases, and delays
that depend on t or y (workers.py, package.py)."""

import sys
from functools import cache, partial

import jitcdde
import numpy as np
from serving import PAST, mackey_glass, phases, serve, slope
from symengine import Symbol, exp, log, sin

TAU = Symbol("tau")


def neighbours(j: int, blocks: int, ends: str) -> list[int | None]:
    """Blocks beside block j; None is the plate."""
    beside = [j - 1, j + 1]
    if ends == "ring":
        return [i % blocks for i in beside]
    inside = [i if 0 <= i < blocks else None for i in beside]
    return inside if ends == "plate" else [i for i in inside if i is not None]


def solver_of_chain(
    blocks: int, parameters: list[float], kappa: float, ends: str
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


def begin(solver: jitcdde.jitcdde, past: list[float], tolerance: float) -> None:
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


def chain(words: list[str], parameters: list[float], t_end: float, interval: float):
    """Blocks; the words are kappa, the ends, and the last time of samples."""
    past = parameters[4:]
    blocks = len(past) // 3
    kappa, ends, t_sampled = words or (0.0, "free", t_end)
    times = interval * np.arange(round(float(t_sampled) / interval) + 1)
    # JiTCDDE sorts helpers by as many calls within each other
    sys.setrecursionlimit(100 * (100 + blocks))
    solver = solver_of_chain(blocks, parameters[:4], float(kappa), ends)

    def run(tolerance: float, wanted: bool):
        begin(solver, past, tolerance)
        if wanted:
            return np.column_stack([times, sampled(solver, times)])
        solver.step_on_discontinuities()
        return solver.integrate(t_end)

    return run


@cache
def scaled_solver() -> jitcdde.jitcdde:
    """Mackey and Glass in units of the delay: steps on discontinuities take no delay that is a
    parameter."""
    late = jitcdde.y(0, jitcdde.t - 1)
    equation = [TAU * slope(jitcdde.y(0), late)]
    solver = jitcdde.jitcdde(equation, control_pars=[TAU], verbose=False)
    solver.compile_C()
    return solver


def samples(tau: float, times: np.ndarray, tolerance: float) -> np.ndarray:
    """Solution at times, for one delay."""
    solver = scaled_solver()
    begin(solver, [PAST], tolerance)
    solver.set_parameters(tau)
    return sampled(solver, times / tau)[:, 0]


def spectrum(words: list[str], parameters: list[float], t_end: float, _):
    """The largest average of local exponents after a transient, of several that are computed."""
    [tau] = parameters
    count, t_transient = int(words[0]), float(words[1])
    equation = [slope(jitcdde.y(0), jitcdde.y(0, jitcdde.t - tau))]
    solver = jitcdde.jitcdde_lyap(equation, n_lyap=count, verbose=False)
    solver.compile_C()

    def run(tolerance: float, _):
        begin(solver, [PAST], tolerance)
        solver.step_on_discontinuities()
        times = np.arange(t_transient, t_end, 20.0)
        found = np.array([np.append(*solver.integrate(t)[1:]) for t in times])[1:]
        averages = np.average(found[:, :count], axis=0, weights=found[:, count])
        return [[tau, averages.max()]]

    return run


def kuramoto(_words: list[str], parameters: list[float], t_end: float, _):
    """Phases at the end, all to all."""
    n = int(parameters[0])
    omega, tau, first = phases(n)

    def slopes():
        for i in range(n):
            pulls = (
                sin(jitcdde.y(j, jitcdde.t - tau[i, j]) - jitcdde.y(i)) for j in range(n) if j != i
            )
            yield omega[i] + sum(pulls) / n

    solver = jitcdde.jitcdde(slopes, n=n, max_delay=tau.max(), verbose=False)
    solver.compile_C(simplify=False, do_cse=False, chunk_size=150)

    def run(tolerance: float, _):
        begin(solver, first, tolerance)
        return list(enumerate(sampled(solver, np.array([t_end]))[0]))

    return run


Y, T = jitcdde.y(0), jitcdde.t
MOVING = {
    "paul": Y * jitcdde.y(0, log(Y) - 1) / (T + 1),
    "pantograph": 0.7 * jitcdde.y(0, T / 2) - Y,
}
"""Equations of moving_peers.f90; it keeps no tolerance for each state, which Waltman's need."""


def moving(name: str, _words, _parameters, t_end: float, interval: float):
    """One of them, whose past is 1; steps on discontinuities are for constant delays."""
    solver = jitcdde.jitcdde([MOVING[name]], max_delay=t_end + 1, verbose=False)
    solver.compile_C()
    times = interval * np.arange(1, round(t_end / interval) + 1)

    def run(tolerance: float, wanted: bool):
        begin(solver, [1.0], tolerance)
        solver.adjust_diff()
        if not wanted:
            return solver.integrate(t_end)
        return [(0.0, 1.0), *((t, *solver.integrate(t)) for t in times)]

    return run


if __name__ == "__main__":
    tasks = {
        "chain": chain,
        "spectrum": spectrum,
        "kuramoto": kuramoto,
        **mackey_glass(samples, scaled_solver),
    }
    tasks |= {name: partial(moving, name) for name in MOVING}
    serve(jitcdde.__version__, tasks)
