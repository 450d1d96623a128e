# SPDX-License-Identifier: BSD-3-Clause
"""Dense output where a component decays within a step, of this solver and of SciPy's methods."""

import itertools
import platform

import numpy as np
import scipy
from measuring import BUILD, describe_machine, measure_command, options_of, write_table
from scipy.integrate import solve_ivp

OURS = ("auto", "bs5", "dop853", "taylor", "radau5", "radau9", "radau13")
THEIRS = ("RK23", "RK45", "DOP853", "Radau", "BDF", "LSODA")
EXPLICIT = ("bs5", "dop853", "taylor", "RK23", "RK45", "DOP853")
"""Their steps are as long as one over the rate, which is at most 1000."""
WITHOUT_DELAY = ("decay", "switch")
"""y' = rate (s - y), y(0) = 1, s = 0, or y(0) = 0 and s = 1 from t = 1 on."""
WITH_DELAY = ("pulse", "returning pulse")
"""Those of this solver's tests."""
PARTS_OF_TABLE = ((OURS, WITHOUT_DELAY), (THEIRS, WITHOUT_DELAY), (OURS, WITH_DELAY))
RATES = 1.01 * 10.0 ** (np.arange(73) / 12)
TOLERANCES = (1e-3, 1e-6, 1e-9, 1e-12)
PARTS = 16
"""Parts of a step between two samples."""
MOST_EVALUATIONS = 500_000
"""A run of SciPy with more has stalled."""


def our_errors(method: str, layer: str, tolerance: float, rates: np.ndarray) -> np.ndarray:
    """Largest errors at the ends of steps and between them: an array (rate, 2)."""
    lines = [f"{method} '{layer}' {tolerance} {rate}\n" for rate in rates]
    _, answer = measure_command([BUILD / "dense_worker"], "".join(lines))
    return np.array([line.split() for line in answer.splitlines()], dtype=float)


def their_errors(method: str, layer: str, tolerance: float, rate: float) -> tuple[float, float]:
    """The same of one run of SciPy; not a number if it failed."""
    first, switch = (1.0, np.inf) if layer == "decay" else (0.0, 1.0)
    calls = itertools.count()

    def slope(t: float, y: np.ndarray) -> np.ndarray:
        if next(calls) == MOST_EVALUATIONS:
            raise TimeoutError
        return rate * ((t >= switch) - y)

    def largest_error(t: np.ndarray, y: np.ndarray) -> float:
        since = np.where(t >= switch, t - switch, t)
        exact = (t >= switch) + (first - (t >= switch)) * np.exp(-rate * since)
        return float(abs(y - exact).max())

    limits = {"rtol": tolerance, "atol": tolerance}
    try:
        run = solve_ivp(slope, (0.0, 3.7), [first], method, dense_output=True, **limits)
    except TimeoutError:
        return np.nan, np.nan
    inside = (run.t[:-1, None] + np.diff(run.t)[:, None] * np.arange(1, PARTS) / PARTS).ravel()
    errors = largest_error(run.t, run.y[0]), largest_error(inside, run.sol(inside)[0])
    return errors if run.success else (np.nan, np.nan)


def worst(errors: np.ndarray, tolerance: float, rates: np.ndarray) -> dict:
    """The run with the largest ratio of the error between the ends of steps to that at the ends,
    or to the tolerance if that is larger."""
    ratio = errors[:, 1] / np.maximum(errors[:, 0], tolerance)
    i = np.nanargmax(ratio)
    numbers = map(float, (ratio[i], rates[i], *errors[i]))
    counts = {"runs": len(rates), "failed": int(np.isnan(ratio).sum())}
    names = ("ratio", "rate", "error_at_steps", "error_between")
    return counts | dict(zip(names, numbers, strict=True))


def row_of(method: str, layer: str, tolerance: float) -> dict:
    """A row of the table."""
    case = {"method": method, "layer": layer, "tolerance": tolerance}
    rates = RATES[RATES < 1e3] if method in EXPLICIT else RATES
    if method in OURS:
        errors = our_errors(*case.values(), rates)
    else:
        errors = np.array([their_errors(*case.values(), rate) for rate in rates])
    solver = "dde" if method in OURS else "SciPy"
    return {"solver": solver, **case, **worst(errors, tolerance, rates)}


def main() -> None:
    """Measure and write the table."""
    options = options_of("run dense").parse_args()
    rows = [
        row_of(method, layer, tolerance)
        for methods, layers in PARTS_OF_TABLE
        for method, layer, tolerance in itertools.product(methods, layers, TOLERANCES)
    ]
    header = [
        *describe_machine(),
        f"Python {platform.python_version()}, SciPy {scipy.__version__}",
        "runs: at 12 rates a decade, from 1 to 1e3 or 1e6; failed: runs that stopped or stalled",
        "ratio: the largest of these runs, of the error between the ends of steps over the error",
        "at the ends or the tolerance, the larger one; of the component with the largest ratio",
        "rate, error_at_steps, error_between: those of the run with this ratio",
    ]
    write_table(options.output / "dense-output.tsv", rows, header)


if __name__ == "__main__":
    main()
