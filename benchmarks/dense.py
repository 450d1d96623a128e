"""Dense output where a component decays within a step, of this solver and of SciPy's methods."""

import itertools

import numpy as np
from measuring import options_of, report, write_table
from workers import Task, Worker, command_of

OURS = ("auto", "bs5", "dop853", "taylor", "radau5", "radau9", "radau13")
THEIRS = ("RK23", "RK45", "DOP853", "Radau", "BDF", "LSODA")
EXPLICIT = ("bs5", "dop853", "taylor", "RK23", "RK45", "DOP853")
"""Their steps are as long as one over the rate, which is at most 1000."""
WITHOUT_DELAY = ("decay", "switch")
"""y' = rate (s - y), y(0) = 1, s = 0, or y(0) = 0 and s = 1 from t = 1 on."""
WITH_DELAY = ("pulse", "returning")
"""Those of this solver's tests."""
PARTS = (
    ("dde", "dense_output", OURS, WITHOUT_DELAY),
    ("SciPy", "scipy_dense", THEIRS, WITHOUT_DELAY),
    ("dde", "dense_output", OURS, WITH_DELAY),
)
RATES = 1.01 * 10.0 ** (np.arange(73) / 12)
TOLERANCES = (1e-3, 1e-6, 1e-9, 1e-12)
T_END = 3.7


def errors_of(solver: str, method: str, layer: str, rates: np.ndarray, limit: float) -> np.ndarray:
    """Largest errors at the ends of steps and between them, an array (tolerance, rate, 2); not a
    number where a run failed."""
    with Worker(command_of(solver, method, layer), Task(tuple(rates), T_END)) as worker:
        return np.array([worker.numbers(tolerance, limit)[0] for tolerance in TOLERANCES])


def worst(errors: np.ndarray, tolerance: float, rates: np.ndarray) -> dict:
    """The run with the largest ratio of the error between the ends of steps to that at the ends,
    or to the tolerance if that is larger."""
    ratio = errors[:, 1] / np.maximum(errors[:, 0], tolerance)
    i = np.nanargmax(ratio)
    numbers = map(float, (ratio[i], rates[i], *errors[i]))
    counts = {"runs": len(rates), "failed": int(np.isnan(ratio).sum())}
    names = ("ratio", "rate", "error_at_steps", "error_between")
    return counts | dict(zip(names, numbers, strict=True))


def main() -> None:
    """Measure and write."""
    parser = options_of("dense", time_limit=600.0)
    parser.add_argument("--methods", nargs="+", choices=OURS + THEIRS, default=OURS + THEIRS)
    options = parser.parse_args()
    rows = []
    for shown, solver, methods, layers in PARTS:
        for method, layer in itertools.product(methods, layers):
            if method not in options.methods:
                continue
            report(f"{method}, {layer}")
            rates = RATES[RATES < 1e3] if method in EXPLICIT else RATES
            errors = errors_of(solver, method, layer, rates, options.time_limit)
            case = {"solver": shown, "method": method, "layer": layer}
            rows += [
                {**case, "tolerance": tolerance, **worst(one, tolerance, rates)}
                for tolerance, one in zip(TOLERANCES, errors, strict=True)
            ]
    meanings = [
        "runs: at 12 rates a decade, from 1 to 1e3 or 1e6; failed: runs that stopped or stalled",
        "ratio: the largest of these runs, of the error between the ends of steps over the error",
        "at the ends or the tolerance, the larger one; of the component with the largest ratio",
        "rate, error_at_steps, error_between: those of the run with this ratio",
    ]
    write_table(options.output / "dense.tsv", rows, meanings)
