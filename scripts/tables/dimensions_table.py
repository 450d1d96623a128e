"""What the nondimensional values are in seconds and metres, by (2), as one table."""

import math

from scripts.files.outputs import logged
from scripts.files.tsv import write_table
from scripts.tables.fault_limit_table import PAPER

DELAY = 7.0
"""That of the paper's chaos."""


def row_of(preset: str, *, length: float, v0: float, k: float, a: float, m: float) -> dict:
    """One set of the quantities of (2) in SI units, times in seconds.

    (2) holds per unit of area: A is in Pa, k in Pa/m and M in kg/m^2.
    """
    unit = length / v0
    return {
        "preset": preset,
        **{"length": length, "v0": v0, "k": k, "a": a, "m": m},
        "time_unit": unit,
        "xi": k * length / a,
        "gamma": math.sqrt(k / m) * unit,
        "delay": DELAY * unit,
        "inertial_period": 2 * math.pi * math.sqrt(m / k),
        "inertial_period_of_paper": 2 * math.pi * unit / PAPER,
    }


if __name__ == "__main__":
    with logged(snakemake.log[0]):
        presets = snakemake.params.presets
        rows = [row_of(name, **quantities) for name, quantities in presets.items()]
        write_table(snakemake.output[0], rows)
