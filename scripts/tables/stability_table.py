"""The table of stability: each case by each method, beside its reference."""

import numpy as np

from scripts.files.outputs import logged
from scripts.files.tsv import write_table
from scripts.tables.accuracy import (
    Reference,
    distances,
    errors_of,
    largest,
    read_references,
    read_runs,
)

PARAMETERS = ["tau", "epsilon", "xi", "gamma", "history_theta", "history_u", "history_v", "t_end"]
WORDS = {
    "quadruple": "same source in quadruple precision",
    "stationary": "exact stationary state, at t_end only",
    "none": "none: a limit cycle over many periods",
}
"""What errors are measured against, in words."""


def rows_of(family: str, kind: str, runs: list[dict], references: dict) -> list[dict]:
    """Rows of a family; `kind` is that of its reference."""
    return [row_of(family, kind, run, references.get(run["case"])) for run in runs]


def row_of(family: str, kind: str, run: dict, reference: Reference | None) -> dict:
    """One run."""
    error = uncertainty = amplification = np.nan
    status = ""
    if kind == "quadruple":
        errors = errors_of(run, reference)
        compared = np.isfinite(errors)
        error = largest(errors)
        uncertainty = largest(np.where(compared, reference.uncertainty, np.nan))
        amplification = largest(np.where(compared, reference.amplification, np.nan))
        status = reference.status
    elif kind == "stationary":
        error = float(distances(run["state"][:, -1:], np.zeros((3, 1)))[0])
        status = "exact"
    return {
        "case": run["case"],
        "family": family,
        **{name: run[name] for name in PARAMETERS},
        "method": run["method"],
        "tolerance": run["setting"],
        "status": run["status"],
        "t_reached": run["t_reached"],
        "steps": run["steps_accepted"],
        "rejections": run["steps_rejected"],
        "evaluations": run["evaluations"],
        "switches": run["switches"],
        "least_ln_v": run["least_ln_v"],
        "most_ln_v": run["most_ln_v"],
        "error": error,
        "reference": WORDS[kind],
        "reference_status": status,
        "reference_uncertainty": uncertainty,
        "amplification": amplification,
        "error_expected": run["setting"] * amplification,
        "reason": run["reason"],
    }


if __name__ == "__main__":
    with logged(snakemake.log[0]):
        references = {}
        for path in snakemake.input.references:
            references |= read_references(path)
        kinds = snakemake.params.references
        measured = zip(kinds, snakemake.input.measurements, strict=True)
        table = [
            row
            for family, path in measured
            for row in rows_of(family, kinds[family], read_runs(path), references)
        ]
        write_table(snakemake.output[0], table)
