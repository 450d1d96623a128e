"""Scenes that are given in SI: their units of time, parameters and periods, as one table."""

import math

from scripts.config.si import in_si, parameters_of, units_of
from scripts.files.outputs import logged
from scripts.files.tsv import write_table
from scripts.tables.ranges_of_gamma import PAPER


def row_of(name: str, scene: dict) -> dict:
    """A scene by the quantities of (2); k_c = (b - a) sigma/D_c, so k_c/k = epsilon/xi."""
    values = in_si(scene["si"])
    unit, parameters = units_of(values)["s"], parameters_of(values)
    return {
        "scene": name,
        "time_unit_s": unit,
        "tau_s": scene["tau"] * unit,
        **parameters,
        "k_c_over_k": parameters["epsilon"] / parameters["xi"],
        "inertial_period_s": 2 * math.pi * math.sqrt(values["M"] / values["k"]),
        "inertial_period_of_paper_s": 2 * math.pi * unit / PAPER,
    }


if __name__ == "__main__":
    with logged(snakemake.log[0]):
        write_table(snakemake.output[0], [row_of(*one) for one in snakemake.params.scenes.items()])
