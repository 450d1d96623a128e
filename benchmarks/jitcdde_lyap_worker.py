"""Exponents of one block by JiTCDDE: growth of its vectors, interval by interval (exponents.py)."""

import contextlib
import json
import os
import sys
import time
import warnings

import jitcdde
from jitcdde_worker import equations_of


def growth_of(request: dict) -> dict:
    """CPU seconds after the transient, and growth and length of each interval."""
    equations, helpers = equations_of(*(request[key] for key in ("tau", "epsilon", "xi", "gamma")))
    solver = jitcdde.jitcdde_lyap(
        equations,
        helpers=helpers,
        n_lyap=request["vectors"],
        max_delay=request["tau"],
        verbose=False,
    )
    solver.compile_C()
    solver.constant_past(request["past"])
    # its own least step of 1e-10 would end it at tight tolerances
    tolerance = request["tolerance"]
    solver.set_integration_parameters(rtol=tolerance, atol=tolerance, min_step=1e-15)
    solver.step_on_discontinuities()
    interval = request["interval"]
    begins = solver.t
    while solver.t < begins + request["t_transient"]:
        solver.integrate(solver.t + interval)
    growth, length = [], []
    end = solver.t + request["t_measured"]
    start = time.process_time()
    while solver.t < end:
        _, exponents, passed = solver.integrate(solver.t + interval)
        growth.append([float(value * passed) for value in exponents])
        length.append(float(passed))
    return {"seconds": time.process_time() - start, "growth": growth, "length": length}


def main() -> None:
    """One request on standard input, one answer on standard output, both JSON."""
    warnings.simplefilter("ignore")
    # what JiTCDDE says while it works must not be taken for the answer
    with os.fdopen(os.dup(1), "w") as out, contextlib.redirect_stdout(sys.stderr):
        os.dup2(2, 1)
        json.dump(growth_of(json.load(sys.stdin)), out)


if __name__ == "__main__":
    main()
