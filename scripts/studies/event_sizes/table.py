"""Sizes of events and aftershocks of chains: a row of laws for each chain and definition."""

import math
from pathlib import Path

import numpy as np
import xarray as xr

from scripts.files.inputs import read
from scripts.files.outputs import logged
from scripts.files.tsv import read_table, write_table
from scripts.namelists.laws import law_of
from scripts.namelists.parameters import PARAMETERS
from scripts.studies.event_sizes.laws import (
    CutOff,
    fit_aftershocks,
    fit_definition,
    fit_sizes,
    shuffle_slips,
)
from scripts.studies.event_sizes.names_of_laws import RIVALS, is_usual

OF_SIZES = ("exponent", "error", "least", "events", "goodness", "cutoff_goodness")
OF_AFTERSHOCKS = (
    *("main_shocks", "rate", "first", "first_error", "background", "productivity", "delay"),
    *("exponent", "chance", "over_exponential"),
)


def rows_of_chain(
    chain: str, slips: xr.Dataset, events: list[dict], start: float, thresholds: list[float]
) -> list[dict]:
    """A row for each definition of an event; what cannot be fitted is missing.

    An event is a slip of one block above a threshold, or slips of neighbours that overlap in time.
    Slips that begin before `start` are left out.
    """
    place = {
        "chain": chain,
        **{key: slips.attrs[key] for key in ("blocks", "kappa", "ends", *PARAMETERS)},
        "law": law_of(slips.attrs),
        "time": slips.attrs["t_end"] - start,
    }
    rows = []
    for threshold in thresholds:
        alone = slips.slip.values[(slips.threshold == threshold) & (slips.onset >= start)]
        these = [event for event in events if event["threshold"] == threshold]
        sizes = np.array([event["size"] for event in these])
        for joined, found in (("yes", sizes), ("no", alone)):
            row = {**place, "threshold": threshold, "joined": joined, "slips": alone.size}
            row |= {"events": found.size, "smallest": found.min() if found.size else math.nan}
            row |= {"largest": found.max(initial=0.0)}
            laws = laws_of(these, alone, row) if is_usual(row) else law_of_others(found)
            rows.append(row | laws)
    return rows


def laws_of(events: list[dict], slips: np.ndarray, row: dict) -> dict:
    """The laws that the usual events of a chain follow, and those with shuffled slips."""
    onset, duration, size = (
        np.array([event[key] for event in events]) for key in ("onset", "duration", "size")
    )
    sizes, aftershocks = fit_sizes(size), fit_aftershocks(onset, duration, size, row["time"])
    ratios = {}
    for rival in RIVALS:
        ratio, chance = sizes.ratios[rival] if sizes else (math.nan, math.nan)
        ratios |= {f"{rival}_ratio": ratio, f"{rival}_chance": chance}
    for rival in RIVALS[:-1]:
        ratio, chance = sizes.cutoff_ratios[rival] if sizes else (math.nan, math.nan)
        ratios |= {f"cutoff_over_{rival}_ratio": ratio, f"cutoff_over_{rival}_chance": chance}
    shuffled = None
    if sizes:
        counts = np.array([int(event["slips"]) for event in events])
        shuffled = fit_definition(shuffle_slips(slips, counts))
    return {
        **{f"size_{key}": getattr(sizes, key, math.nan) for key in OF_SIZES},
        **columns_of(sizes.cut_off if sizes else None),
        "shuffled_cutoff": shuffled[2].size if shuffled else math.nan,
        **ratios,
        **{f"aftershock_{key}": getattr(aftershocks, key, math.nan) for key in OF_AFTERSHOCKS},
    }


def law_of_others(sizes: np.ndarray) -> dict:
    """The law with a cut-off that events of another definition follow."""
    least, above, law = fit_definition(sizes) or (math.nan, math.nan, None)
    return {"size_least": least, "size_events": above, **columns_of(law)}


def columns_of(law: CutOff | None) -> dict:
    """A law with a cut-off."""
    names = ("exponent", "size", "low", "high")
    exponent, *ends = (getattr(law, name, math.nan) for name in names)
    columns = ("size_cutoff", "size_cutoff_low", "size_cutoff_high")
    return {"size_cutoff_exponent": exponent, **dict(zip(columns, ends, strict=True))}


if __name__ == "__main__":
    with logged(snakemake.log[0]):
        thresholds = snakemake.params.thresholds
        chains = zip(
            snakemake.input.slips, snakemake.input.events, snakemake.params.t_transient, strict=True
        )
        write_table(
            snakemake.output[0],
            [
                row
                for slips, events, start in chains
                for row in rows_of_chain(
                    Path(slips).stem, read(slips), read_table(events), start, thresholds
                )
            ],
        )
