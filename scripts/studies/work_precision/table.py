"""The tables of work against precision, and of how errors follow tolerances."""

import numpy as np

from scripts.files.outputs import logged
from scripts.files.tsv import write_table
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
    points: dict[tuple[str, str], list] = {(row["scene"], row["solver"]): [] for row in rows}
    for row in rows:
        if USEFUL[0] <= row["error_max"] <= USEFUL[1]:
            points[row["scene"], row["solver"]].append((row["tolerance"], row["error_max"]))
    found = []
    for (scene, solver), useful in points.items():
        slope = ratio = np.nan
        if len(useful) > 2:
            tolerances, errors = np.transpose(useful)
            slope = float(np.polyfit(np.log10(tolerances), np.log10(errors), 1)[0])
            ratio = float(np.exp(np.median(np.log(errors / tolerances))))
        found.append(
            {
                "scene": scene,
                "solver": solver,
                "slope": slope,
                "median_error_per_tolerance": ratio if not solver.startswith("rk4") else np.nan,
                "points": len(useful),
            }
        )
    return found


if __name__ == "__main__":
    with logged(snakemake.log[0]):
        runs = read_runs_with_references(snakemake.input.measurements, snakemake.input.references)
        table = [row_of(*run) for run in runs]
        write_table(snakemake.output.table, table)
        write_table(snakemake.output.proportionality, proportionality(table))
