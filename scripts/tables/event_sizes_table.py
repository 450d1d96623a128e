"""Sizes of events and aftershocks of chains: a row of laws for each chain."""

import math
from pathlib import Path

import numpy as np
import xarray as xr

from scripts.files.inputs import read
from scripts.files.outputs import logged
from scripts.files.tsv import read_table, write_table
from scripts.namelists.laws import law_of
from scripts.namelists.study_cases import PARAMETERS
from scripts.tables.event_laws import fit_aftershocks, fit_sizes
from scripts.tables.names_of_laws import RIVALS

OF_SIZES = ("exponent", "error", "least", "events", "goodness", "cutoff_exponent", "cutoff")
OF_AFTERSHOCKS = (
    *("main_shocks", "rate", "first", "first_error", "background", "productivity", "delay"),
    *("exponent", "chance", "over_exponential"),
)


def laws_row(chain: str, slips: xr.Dataset, events: list[dict], t_transient: float) -> dict:
    """The laws that the events of a chain follow; what cannot be fitted is missing."""
    onset, duration, size = (
        np.array([event[key] for event in events]) for key in ("onset", "duration", "size")
    )
    time = slips.attrs["t_end"] - t_transient
    sizes, aftershocks = fit_sizes(size), fit_aftershocks(onset, duration, size, time)
    ratios = {}
    for rival in RIVALS:
        ratio, chance = sizes.ratios[rival] if sizes else (math.nan, math.nan)
        ratios |= {f"{rival}_ratio": ratio, f"{rival}_chance": chance}
    for rival in RIVALS[:-1]:
        ratio, chance = sizes.cutoff_ratios[rival] if sizes else (math.nan, math.nan)
        ratios |= {f"cutoff_over_{rival}_ratio": ratio, f"cutoff_over_{rival}_chance": chance}
    return {
        "chain": chain,
        **{key: slips.attrs[key] for key in ("blocks", "kappa", "ends", *PARAMETERS)},
        "law": law_of(slips.attrs),
        "time": time,
        "slips": slips.sizes["event"],
        "events": len(events),
        "smallest": size.min(initial=math.inf) if events else math.nan,
        "largest": size.max(initial=0.0) if events else math.nan,
        **{f"size_{key}": getattr(sizes, key, math.nan) for key in OF_SIZES},
        **ratios,
        **{f"aftershock_{key}": getattr(aftershocks, key, math.nan) for key in OF_AFTERSHOCKS},
    }


if __name__ == "__main__":
    with logged(snakemake.log[0]):
        rows = [
            laws_row(Path(slips).stem, read(slips), read_table(events), start)
            for slips, events, start in zip(
                snakemake.input.slips,
                snakemake.input.events,
                snakemake.params.t_transient,
                strict=True,
            )
        ]
        write_table(snakemake.output[0], rows)
