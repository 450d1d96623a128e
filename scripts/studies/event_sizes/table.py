"""Sizes of events and aftershocks of chains: a row of laws for each chain and definition."""

import math
from pathlib import Path

import numpy as np
import xarray as xr

from scripts.files.inputs import read
from scripts.files.outputs import logged
from scripts.files.tsv import read_table, write_table
from scripts.models.models import PARAMETERS
from scripts.models.records import law_of
from scripts.studies.event_sizes.laws import (
    fit_aftershocks,
    fit_definition,
    fit_sizes,
    shuffle_slips,
)
from scripts.studies.event_sizes.names_of_laws import RIVALS, is_usual

OF_LAWS = [
    *("size_exponent", "size_error", "size_least", "size_events", "size_goodness"),
    *("size_cutoff_goodness", "size_cutoff_exponent", "size_cutoff", "size_cutoff_low"),
    *("size_cutoff_high", "size_at_end", "shuffled_cutoff"),
    *(f"{law}_{key}" for law in RIVALS for key in ("ratio", "chance")),
    *(f"cutoff_over_{law}_{key}" for law in RIVALS[:-1] for key in ("ratio", "chance")),
    *("aftershock_main_shocks", "aftershock_rate", "aftershock_first", "aftershock_first_error"),
    *("aftershock_background", "aftershock_productivity", "aftershock_delay"),
    *("aftershock_exponent", "aftershock_at_end", "aftershock_chance"),
    "aftershock_over_exponential",
]
"""Columns that are missing where there are too few events. A value at an end of the range that was
tried is no estimate: it is missing, and `size_at_end` or `aftershock_at_end` names it."""


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
            usual = is_usual(row)
            laws = laws_of(these, alone, row["time"]) if usual else fit_definition(found)
            rows.append(row | dict.fromkeys(OF_LAWS, math.nan) | laws)
    return rows


def laws_of(events: list[dict], slips: np.ndarray, time: float) -> dict[str, float]:
    """The laws that the usual events of a chain follow, and the cut-off of shuffled slips."""
    laws = fit_sizes(np.array([event["size"] for event in events]))
    if laws:
        counts = np.array([int(event["slips"]) for event in events])
        shuffled = fit_definition(shuffle_slips(slips, counts))
        laws["shuffled_cutoff"] = shuffled.get("size_cutoff", math.nan)
    return laws | fit_aftershocks(events, time)


if __name__ == "__main__":
    with logged(snakemake.log[0]):
        thresholds = snakemake.params.thresholds
        chains = zip(
            snakemake.input.slips, snakemake.input.events, snakemake.params.t_transient, strict=True
        )
        rows = [
            rows_of_chain(Path(slips).stem, read(slips), read_table(events), start, thresholds)
            for slips, events, start in chains
        ]
        write_table(snakemake.output[0], [row for of_chain in rows for row in of_chain])
