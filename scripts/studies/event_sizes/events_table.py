"""Slip events of a chain: slips of neighbours that overlap in time are one event.

A slip is a time above a threshold; events of each threshold have rows of their own.
"""

import numpy as np
import xarray as xr
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from scripts.files.inputs import read
from scripts.files.outputs import logged
from scripts.files.tsv import write_table

COLUMNS = ["threshold", "onset", "duration", "size", "slips", "blocks", "first_block"]


def event_rows(slips: xr.Dataset, t_transient: float) -> list[dict]:
    """Events in the order of their onsets, from the slips of the blocks above one threshold.

    Two slips belong together if their blocks are neighbours and both slip at one time. The size is
    the slip summed over the blocks. Events that begin before `t_transient`, or are not known to be
    complete at the end, are left out.
    """
    block, onset, end, slip = with_unfinished(slips)
    events, label = connected_components(overlaps(slips, block, onset, end), directed=False)
    first = np.lexsort((onset, label))[np.searchsorted(np.sort(label), np.arange(events))]
    ends = np.zeros(events)
    np.maximum.at(ends, label, end)
    sizes, slips_of = np.bincount(label, slip, events), np.bincount(label, minlength=events)
    blocks_of = np.bincount(np.unique(np.stack((label, block)), axis=1)[0], minlength=events)
    whole = onset[first] >= t_transient
    whole[label[slips.sizes["event"] :]] = False
    kept = np.flatnonzero(whole)
    return [
        {
            "onset": float(onset[first[event]]),
            "duration": float(ends[event] - onset[first[event]]),
            "size": float(sizes[event]),
            "slips": int(slips_of[event]),
            "blocks": int(blocks_of[event]),
            "first_block": int(block[first[event]]) + 1,
        }
        for event in kept[np.argsort(onset[first[kept]], kind="stable")]
    ]


def with_unfinished(slips: xr.Dataset) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Block (from 0), onset, end and slip of all slips, then of the last one of each block.

    The last one begins at the onset after the last complete slip. It is taken to last as long as
    the longest slip, at most to the end of the run. A block without a complete slip has none.
    """
    block = slips.number_of_block.values - 1
    onset, t_end = slips.onset.values, slips.attrs["t_end"]
    last = np.full(slips.attrs["blocks"], -np.inf)
    np.maximum.at(last, block, onset + slips.recurrence_time.values)
    last[last < 0] = t_end
    ends = np.minimum(last + slips.duration.values.max(initial=0.0), t_end)
    return (
        np.append(block, np.arange(last.size)),
        np.append(onset, last),
        np.append(onset + slips.duration.values, ends),
        np.append(slips.slip.values, np.zeros(last.size)),
    )


def overlaps(slips: xr.Dataset, block: np.ndarray, onset: np.ndarray, end: np.ndarray) -> coo_array:
    """Which slips of neighbours overlap in time, shape (slips, slips)."""
    order = np.argsort(onset, kind="stable")
    blocks = slips.attrs["blocks"]
    rows = [order[block[order] == number] for number in range(blocks)]
    pairs = [(number, number + 1) for number in range(blocks - 1)]
    pairs += [(blocks - 1, 0)] * (slips.attrs["ends"] == "ring")
    left, right = [], []
    for one, other in pairs:
        # slips of a block follow one another: those that overlap with a slip stand together
        first = np.searchsorted(end[rows[other]], onset[rows[one]], "right")
        beyond = np.searchsorted(onset[rows[other]], end[rows[one]], "left")
        for slip, begin, stop in zip(rows[one], first, beyond, strict=True):
            left += [slip] * max(0, stop - begin)
            right += rows[other][begin:stop].tolist()
    return coo_array((np.ones(len(left), bool), (left, right)), shape=(block.size, block.size))


if __name__ == "__main__":
    with logged(snakemake.log[0]):
        slips = read(snakemake.input.slips)
        rows = [
            {"threshold": threshold, **row}
            for threshold in dict.fromkeys(slips.threshold.values.tolist())
            for row in event_rows(
                slips.isel(event=slips.threshold.values == threshold), snakemake.params.t_transient
            )
        ]
        write_table(snakemake.output[0], rows, COLUMNS)
