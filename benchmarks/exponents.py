"""How often the error bars of Lyapunov exponents hold."""

import tempfile
from pathlib import Path

import numpy as np
import xarray as xr
from measuring import describe_machine, measure_command, options_of, write_table
from project import PROGRAM, TABLES, configuration

from scripts.config.check_config import checked
from scripts.requests.write_namelist import write_namelist
from scripts.studies.exponents.plan import groups

ERROR_BARS = 3.0
"""Standard errors within which the true value is expected."""
COMMON = {"gamma": 0.8, "tolerance": 1e-8, "t_transient": 5000.0}
MOTIONS = {
    "cycle": {"tau": 10.0, "epsilon": 0.35, "xi": 0.8},
    "torus with slow beats": {"tau": 7.0, "epsilon": 0.40, "xi": 0.5},
    "torus": {"tau": 12.5, "epsilon": 0.5, "xi": 0.8},
    "weak chaos": {"tau": 7.0, "epsilon": 0.42, "xi": 0.5},
    "strong chaos": {"tau": 7.0, "epsilon": 0.7, "xi": 0.5},
}
"""Motions whose error bars are tested. At tau = 7, epsilon = 0.43 the motion is in turn nearly
quasiperiodic and chaotic, for times of the order of 1e5: runs of 1e4 miss one."""
T_LONG, T_SHORT = 400000.0, 10000.0
"""Time of the run that gives the true values, and of each shorter run."""
VELOCITIES = np.linspace(1.05, 1.5, 40).tolist()
"""Velocities for t <= 0 of the shorter runs."""
EXPONENTS = 4


def measure(motion: str, v: float, length: float) -> np.ndarray:
    """Exponents but that of the flow, and their errors, of a run from v up to its transient."""
    config = configuration()
    t_end = COMMON["t_transient"] + length
    settings = {"count": EXPONENTS, "t_end": t_end, "checks": False}
    scene = {**COMMON, **MOTIONS[motion], "history": {"v": v}, "t_end": t_end}
    config["scenes"]["motion"] = {**scene, "exponents": settings}
    with tempfile.TemporaryDirectory() as folder:
        namelist, output = Path(folder) / "motion.nml", Path(folder) / "motion.nc"
        write_namelist(namelist, groups(checked(config), "motion"))
        measure_command([PROGRAM, "exponents", namelist, output])
        found = xr.load_dataset(output).isel(run=0)
    both = np.stack([found["value"], found["error"]])
    return np.delete(both, np.argmin(both[1]), axis=1)


def coverage_rows(motion: str) -> list[dict]:
    """How often the true exponents lie within the error bars of shorter runs."""
    true = measure(motion, 1.1, T_LONG)[0]
    runs = np.array([measure(motion, v, T_SHORT) for v in VELOCITIES])
    away, error = runs[:, 0] - true, runs[:, 1]
    return [
        {
            "motion": motion,
            "length": T_SHORT,
            "runs": len(runs),
            "exponent": 1 + i,
            "value": float(value),
            "rms": float(np.sqrt(np.mean(away[:, i] ** 2))),
            "error": float(np.sqrt(np.mean(error[:, i] ** 2))),
            "within": float(np.mean(abs(away[:, i]) <= ERROR_BARS * error[:, i])),
        }
        for i, value in enumerate(true)
    ]


def main() -> None:
    """Measure and write the tables."""
    options = options_of("benchmarks/run exponents", TABLES).parse_args()
    meaning = "within: share of runs whose value is at most three of their errors from `value`"
    rows = [row for motion in MOTIONS for row in coverage_rows(motion)]
    write_table(options.output / "exponent-coverage.tsv", rows, [*describe_machine()[:2], meaning])


if __name__ == "__main__":
    main()
