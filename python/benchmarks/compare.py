# SPDX-License-Identifier: BSD-3-Clause
"""delaykit, JiTCDDE, ddeint and SciPy with steps by hand, on the equation of Mackey and Glass.

    python python/benchmarks/compare.py --peers ENVIRONMENT/bin/python > table.md

Each task is tried with tighter and tighter tolerances until its error is at most ERROR, each in a
process of its own. The time is that of the loosest tolerance that passes, the least of ROUNDS. A
peer that does not reach the error in PATIENCE seconds stays empty. `--peers` is a Python with
jitcdde and ddeint; the one that runs this has delaykit.
"""

import argparse
import json
import math
import multiprocessing
import os
import subprocess
import sys
import tempfile
import time

import numpy as np

ERROR, TIGHT = 1e-6, 1e-9
PATIENCE = 120
ROUNDS = 3
TOLERANCES = (1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12)
BETA, N, RATE, PAST = 0.2, 10, 0.1, 1.2
TAU_CHAOS, TAU_CYCLE = 17.0, 6.0
T_RUN = 1e4 * TAU_CYCLE
TIMES_OF_RUN = T_RUN - np.linspace(20, 0, 11)
PUBLISHED = 1.186718107117
"""y(200) with tau = 17: fortran/dde/README.md"""
LARGEST, CLOSE = 0.0052, 0.001
"""Published largest exponent with tau = 17, and how near a value over T_EXPONENTS can be"""
T_TRANSIENT, T_EXPONENTS = 1700.0, 20000.0
TAUS = np.linspace(5, 25, 400)
T_SCAN, T_SCAN_CHECK = 2000.0, 50.0
"""Length of the runs of a scan, and when their error is taken: later it is that of chaos"""


# delaykit


def model(tau):
    import delaykit

    return delaykit.Model(
        {"y": "beta*y(t - tau)/(1 + y(t - tau)**n) - rate*y"},
        {"beta": BETA, "n": N, "rate": RATE, "tau": tau},
    )


def delaykit_first(rtol):
    return lambda: model(TAU_CHAOS).integrate(PAST, 200, t_eval=[200], rtol=rtol, atol=rtol).y[0, 0]


def delaykit_run(rtol, method="auto"):
    it = model(TAU_CYCLE)
    it.handle  # noqa: B018  compiled
    return lambda: it.integrate(
        PAST, T_RUN, t_eval=TIMES_OF_RUN, rtol=rtol, atol=rtol, method=method
    ).y[0]


def delaykit_exponents(rtol):
    it = model(TAU_CHAOS)
    it.handle  # noqa: B018  compiled
    return lambda: (
        it.exponents(
            PAST, 4, t_transient=T_TRANSIENT, t_end=T_TRANSIENT + T_EXPONENTS, rtol=rtol
        ).value.values
    )


def delaykit_scan(rtol, workers=None):
    it = model(TAU_CHAOS)
    it.handle  # noqa: B018  compiled
    options = {"tau": TAUS, "history": PAST, "rtol": rtol, "atol": rtol, "progress": False}
    early = it.scan("final", t_end=T_SCAN_CHECK, **options).final.values[:, 0]

    def measured():
        it.scan("maxima", t_end=T_SCAN, workers=workers, **options)
        return early

    return measured


# JiTCDDE


def equation(tau):
    from jitcdde import t, y

    return [BETA * y(0, t - tau) / (1 + y(0, t - tau) ** N) - RATE * y(0)]


def sampled(solver, times, rtol, *parameters):
    """Solution at times, from the constant past."""
    solver.purge_past()
    solver.constant_past([PAST])
    if parameters:
        solver.set_parameters(*parameters)
    solver.set_integration_parameters(rtol=rtol, atol=rtol, min_step=1e-15)
    solver.step_on_discontinuities()
    return np.array([solver.integrate(t)[0] for t in times])


def jitcdde_first(rtol):
    from jitcdde import jitcdde

    return lambda: sampled(jitcdde(equation(TAU_CHAOS), verbose=False), [200.0], rtol)[0]


def jitcdde_run(rtol):
    from jitcdde import jitcdde

    solver = jitcdde(equation(TAU_CYCLE), verbose=False)
    solver.compile_C()
    return lambda: sampled(solver, TIMES_OF_RUN, rtol)


def jitcdde_exponents(rtol):
    from jitcdde import jitcdde_lyap

    solver = jitcdde_lyap(equation(TAU_CHAOS), n_lyap=4, verbose=False)
    solver.compile_C()

    def measured():
        solver.constant_past([PAST])
        solver.set_integration_parameters(rtol=rtol, atol=rtol)
        solver.step_on_discontinuities()
        times = T_TRANSIENT + np.arange(0, T_EXPONENTS, 20.0)
        found = np.array([np.append(*solver.integrate(t)[1:]) for t in times])
        return np.average(found[1:, :4], axis=0, weights=found[1:, 4])

    return measured


def jitcdde_scan(rtol):
    from jitcdde import jitcdde
    from symengine import Symbol

    # with time in units of the delay: steps on discontinuities take no delay that is a parameter
    tau = Symbol("tau")
    scaled = [tau * slope for slope in equation(1.0)]
    solver = jitcdde(scaled, control_pars=[tau], verbose=False)
    solver.compile_C()
    early = np.array([sampled(solver, [T_SCAN_CHECK / tau], rtol, tau)[0] for tau in TAUS])

    def measured():
        # maxima of samples: the cheapest that can be asked of it
        times = np.arange(T_SCAN / 2, T_SCAN, 1.0)
        with multiprocessing.get_context("fork").Pool() as pool:
            pool.starmap(jitcdde_forked, [(times / tau, rtol, tau) for tau in TAUS], 5)
        return early

    global FORKED
    FORKED = solver
    return measured


def jitcdde_forked(times, rtol, tau):
    return sampled(FORKED, times, rtol, tau)


# ddeint: its error follows the square of the distance of samples, between which it reads lines


def ddeint_samples(tau, t_end, rtol):
    from ddeint import ddeint

    times = np.linspace(0, t_end, 1 + math.ceil(t_end / (4 * math.sqrt(rtol))))

    def slope(past, t):
        late = past(t - tau)
        return BETA * late / (1 + late**N) - RATE * past(t)

    return times, np.ravel(ddeint(slope, lambda t: PAST, times))


def ddeint_first(rtol):
    return lambda: ddeint_samples(TAU_CHAOS, 200.0, rtol)[1][-1]


def ddeint_run(rtol):
    return lambda: np.interp(TIMES_OF_RUN, *ddeint_samples(TAU_CYCLE, T_RUN, rtol))


# SciPy: one call of solve_ivp for each delay, with the one before as its past


def steps_by_hand(tau, times, rtol):
    from scipy.integrate import solve_ivp

    found = np.empty(len(times))
    past, state, begin = (lambda t: [PAST]), [PAST], 0.0
    while begin < times[-1]:
        end = min(begin + tau, times[-1])

        def slope(t, y, past=past):
            late = past(t - tau)[0]
            return [BETA * late / (1 + late**N) - RATE * y[0]]

        run = solve_ivp(
            slope, (begin, end), state, method="DOP853", rtol=rtol, atol=rtol, dense_output=True
        )
        here = (times > begin) & (times <= end)
        if here.any():
            found[here] = run.sol(times[here])[0]
        past, state, begin = run.sol, run.y[:, -1], end
    return found


def scipy_first(rtol):
    return lambda: steps_by_hand(TAU_CHAOS, np.array([200.0]), rtol)[0]


def scipy_run(rtol):
    return lambda: steps_by_hand(TAU_CYCLE, TIMES_OF_RUN, rtol)


def scipy_scan(rtol):
    early = [steps_by_hand(tau, np.array([T_SCAN_CHECK]), rtol)[0] for tau in TAUS]
    jobs = [(tau, np.arange(T_SCAN / 2, T_SCAN, 1.0), rtol) for tau in TAUS]

    def measured():
        with multiprocessing.get_context("fork").Pool() as pool:
            pool.starmap(steps_by_hand, jobs, chunksize=5)
        return early

    return measured


# the table


def cpu_seconds():
    """Seconds of CPU of this process and of those that it waited for."""
    return time.process_time() + sum(os.times()[2:4])


def work(peer, task, rtol, begun):
    """One task of a peer, and its time: from the start of the process where it is the first."""
    measured = globals()[f"{peer}_{task}"](rtol)
    before = 0.0
    if task != "first":
        begun, before = time.time(), cpu_seconds()
    found = measured()
    spent = [time.time() - begun, cpu_seconds() - before]
    print(json.dumps([*spent, np.ravel(found).tolist()]))


def attempt(python, peer, task, rtol):
    """Seconds of clock and of CPU, and numbers, from a new process with an empty cache."""
    with tempfile.TemporaryDirectory() as cache:
        environment = {**os.environ, "DELAYKIT_CACHE": cache, "OMP_NUM_THREADS": "1"}
        command = [python, "-W", "ignore", __file__, "--work", peer, task, str(rtol)]
        done = subprocess.run(
            [*command, str(time.time())], capture_output=True, text=True, check=False,
            timeout=PATIENCE, env=environment, cwd=cache,
        )  # fmt: skip
    if done.returncode:
        sys.exit(f"{peer} {task} {rtol:g}: {done.stderr}")
    return json.loads(done.stdout.splitlines()[-1])


def seconds_of(python, peer, task, expected, error):
    """Time and error of the loosest tolerance whose error is small enough; empty if none is."""
    if f"{peer}_{task}" not in globals():
        return ""
    for rtol in TOLERANCES:
        try:
            clock, cpu, found = attempt(python, peer, task, rtol)
            reached = float(np.abs(np.array(found[: len(expected)]) - expected).max())
            print(
                f"{peer} {task} {rtol:g}: {clock:.3g} s, {cpu:.3g} s of CPU, error {reached:.1g}",
                file=sys.stderr,
            )
            if reached <= error:
                more = [attempt(python, peer, task, rtol) for _ in range(ROUNDS - 1)]
                clock = min([clock, *(one[0] for one in more)])
                cpu = min([cpu, *(one[1] for one in more)])
                return f"{clock:.3g} s, CPU {cpu:.3g} s (error {reached:.0e})"
        except subprocess.TimeoutExpired:
            print(f"{peer} {task} {rtol:g}: more than {PATIENCE} s", file=sys.stderr)
            return ""
    return ""


def main():
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--peers", default=sys.executable)
    parser.add_argument("--only", help="one task", default="")
    parser.add_argument("--work", nargs=4, help=argparse.SUPPRESS)
    own = parser.parse_args()
    if own.work:
        peer, task, rtol, begun = own.work
        work(peer, task, float(rtol), float(begun))
        return
    reference = delaykit_run(1e-13, "taylor")()
    other = delaykit_run(1e-13, "radau13")()
    print(f"references differ by {np.abs(reference - other).max():.1e}", file=sys.stderr)
    early = delaykit_scan(1e-13, 1)
    early = early.__closure__[[*early.__code__.co_freevars].index("early")].cell_contents
    tasks = (
        ("first", "first line to first number, y(200)", [PUBLISHED], ERROR),
        ("run", "1e4 delays, a cycle", reference, ERROR),
        ("run", "the same, error 1e-9", reference, TIGHT),
        ("exponents", "4 exponents over 2e4 units", [LARGEST], CLOSE),
        ("scan", f"scan of 400 values, {os.cpu_count()} cores", early, ERROR),
    )
    peers = ("delaykit", "jitcdde", "ddeint", "scipy")
    print(f"| | {' | '.join(peers)} |\n|---|{'---|' * len(peers)}")
    for task, words, expected, error in tasks:
        if own.only in ("", task):
            pythons = [sys.executable, *[own.peers] * (len(peers) - 1)]
            row = [
                seconds_of(python, peer, task, expected, error)
                for python, peer in zip(pythons, peers, strict=True)
            ]
            print(f"| {words} | {' | '.join(row)} |", flush=True)


if __name__ == "__main__":
    main()
