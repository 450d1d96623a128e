"""The table of return maps: how much one quantity of slip events says about another one."""

import math

import numpy as np
from scipy.stats import chatterjeexi, pearsonr, spearmanr

from scripts.files.inputs import Dataset, read
from scripts.files.outputs import logged
from scripts.files.tsv import write_table
from scripts.models.models import PARAMETERS
from scripts.models.records import law_of

FEWEST = 10
"""Pairs that a correlation needs."""
EQUAL = 1e-5
"""Values that differ by less than this share of their mean are those of a cycle."""


def maps_of(events: Dataset) -> dict[str, tuple[np.ndarray, np.ndarray]]:
    """Pairs (x, y) of successive events by the name of their map.

    The waiting time is from the end of an event to the next onset; the recurrence time, between
    onsets, has the duration of the event itself.
    """
    slip, recurrence = events.slip.values, events.recurrence_time.values
    waiting = recurrence - events.duration.values
    return {
        "slip_by_waiting": (waiting[:-1], slip[1:]),
        "waiting_by_slip": (slip, waiting),
        "recurrence_by_recurrence": (recurrence[:-1], recurrence[1:]),
        "recurrence_by_slip": (slip, recurrence),
    }


def measures_of(x: np.ndarray, y: np.ndarray) -> dict:
    """Correlations, and dependence of y on x; NaN of few pairs and of equal events."""
    measures = {"r": pearsonr, "rank_r": spearmanr, "dependence": chatterjeexi}
    if x.size < FEWEST or min(np.ptp(x) / x.mean(), np.ptp(y) / y.mean()) < EQUAL:
        return {"pairs": x.size, **dict.fromkeys(measures, math.nan)}
    found = {name: float(measure(x, y).statistic) for name, measure in measures.items()}
    return {"pairs": x.size, **found}


def rows_of(events: Dataset) -> list[dict]:
    """A row for each map of a scene."""
    place = {key: events.attrs[key] for key in ("scene", *PARAMETERS)}
    place |= {"law": law_of(events.attrs), "events": events.sizes["event"]}
    return [{**place, "map": name, **measures_of(*xy)} for name, xy in maps_of(events).items()]


if __name__ == "__main__":
    with logged(snakemake.log[0]):
        scenes = [read(path) for path in snakemake.input.slip_events]
        write_table(snakemake.output[0], [row for events in scenes for row in rows_of(events)])
