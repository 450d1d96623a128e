"""Up to when a run at the least tolerance can be trusted, for each scene."""

import numpy as np

from scripts.files.outputs import logged
from scripts.files.tsv import write_table
from scripts.tables.accuracy import Reference, errors_of, largest, read_runs_with_references


def horizon(run: dict, reference: Reference, trusted_error: float) -> int:
    """Index of the last sample up to which the error stays within `trusted_error`."""
    beyond = ~(np.maximum(errors_of(run, reference), reference.uncertainty) <= trusted_error)
    return int(np.argmax(beyond)) - 1 if beyond.any() else beyond.size - 1


def row_of(run: dict, reference: Reference, trusted_error: float) -> dict:
    """One scene."""
    last = horizon(run, reference, trusted_error)
    if last < 1:
        raise ValueError(f"scene '{run['case']}': no sample within the trusted error")
    until = slice(0, last + 1)
    return {
        "scene": run["case"],
        "t_end": run["t_end"],
        "trusted_error": trusted_error,
        "tolerance": run["setting"],
        "horizon": float(run["time"][last]),
        "error": largest(errors_of(run, reference)[until]),
        "reference_uncertainty": largest(reference.uncertainty[until]),
        "amplification": largest(reference.amplification[until]),
    }


if __name__ == "__main__":
    with logged(snakemake.log[0]):
        runs = read_runs_with_references(snakemake.input.measurements, snakemake.input.references)
        trusted_error = snakemake.params.trusted_error
        write_table(snakemake.output[0], [row_of(*run, trusted_error) for run in runs])
