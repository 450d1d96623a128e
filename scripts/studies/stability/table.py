"""The table of stability: each case by each method, beside its reference."""

import numpy as np

from scripts.files.outputs import logged
from scripts.files.tsv import write_table
from scripts.models.models import PARAMETERS
from scripts.tables.accuracy import (
    Reference,
    distances,
    errors_of,
    largest,
    read_references,
    read_runs,
)

WORDS = {
    "quadruple": "same source in quadruple precision",
    "stationary": "exact stationary state, at t_end only",
    "none": "none: a limit cycle over many periods",
}
"""What errors are measured against, in words."""
SMALL = 1e-3
"""An error that a figure does not show."""
WITHIN_EXPECTED = 100
"""Largest error that is expected, over tolerance times amplification."""


def row_of(family: str, kind: str, run: dict, reference: Reference | None) -> dict:
    """One run of a family; `kind` is that of the family's references, a key of WORDS."""
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
        "law": run["law"],
        **{name: run[name] for name in run if name in PARAMETERS or name.startswith("history_")},
        **{name: run[name] for name in ("t_end", "method")},
        "tolerance": run["setting"],
        "status": run["status"],
        "t_reached": run["t_reached"],
        "steps": run["steps_accepted"],
        "rejections": run["steps_rejected"],
        **{name: run[name] for name in ("evaluations", "switches", "least", "most")},
        "error": error,
        "reference": WORDS[kind],
        "reference_status": status,
        "reference_uncertainty": uncertainty,
        "amplification": amplification,
        "error_expected": run["setting"] * amplification,
        "reason": run["reason"],
    }


def is_within_expected(row: dict) -> bool:
    """Whether the error of a run is within what its tolerance lets expect."""
    return row["error"] <= WITHIN_EXPECTED * row["error_expected"]


if __name__ == "__main__":
    with logged(snakemake.log[0]):
        references = read_references(snakemake.input.references)
        kinds = snakemake.params.references
        measured = zip(kinds, snakemake.input.measurements, strict=True)
        table = [
            row_of(family, kinds[family], run, references.get(run["case"]))
            for family, path in measured
            for run in read_runs(path)
        ]
        write_table(snakemake.output[0], table)
