"""The tables of work against precision, and of how errors follow tolerances."""

import numpy as np

from scripts.files.outputs import logged
from scripts.files.tsv import rows_by, write_table
from scripts.tables.accuracy import Reference, errors_of, largest, read_runs_with_references

FIXED = {"error_quarter": 0.25, "error_half": 0.5, "error_end": 1.0}
"""Columns of errors at fixed times, as shares of t_end."""
USEFUL = (1e-12, 1e-2)
"""Errors between which their slope is measured: beyond, rounding or the attractor limits them."""


def row_of(run: dict, reference: Reference) -> dict:
    """One run."""
    errors = errors_of(run, reference)
    last = errors.size - 1
    return {
        "scene": run["case"],
        "solver": run["method"],
        "tolerance": run["setting"],
        "status": run["status"],
        "t_end": run["t_end"],
        **{name: float(errors[round(share * last)]) for name, share in FIXED.items()},
        "error_max": largest(errors) if run["status"] == "ok" else np.nan,
        "steps": run["steps_accepted"],
        "rejections": run["steps_rejected"],
        **{
            name: run[name]
            for name in ("evaluations", "factorisations", "switches", "seconds", "reason")
        },
    }


def proportionality(rows: list[dict]) -> list[dict]:
    """Slope of log error over log tolerance for each scene and solver, and its number of points."""
    found = []
    for (scene, solver), runs in rows_by(rows, "scene", "solver").items():
        useful = [run for run in runs if USEFUL[0] <= run["error_max"] <= USEFUL[1]]
        slope = ratio = np.nan
        if len(useful) > 2:
            tolerances, errors = (
                np.array([run[key] for run in useful]) for key in ("tolerance", "error_max")
            )
            slope = float(np.polyfit(np.log10(tolerances), np.log10(errors), 1)[0])
            if not solver.startswith("rk4"):
                ratio = float(np.exp(np.median(np.log(errors / tolerances))))
        row = {"scene": scene, "solver": solver, "slope": slope}
        found.append({**row, "median_error_per_tolerance": ratio, "points": len(useful)})
    return found


if __name__ == "__main__":
    with logged(snakemake.log[0]):
        runs = read_runs_with_references(snakemake.input.measurements, snakemake.input.references)
        table = [row_of(*run) for run in runs]
        write_table(snakemake.output.table, table)
        write_table(snakemake.output.proportionality, proportionality(table))
