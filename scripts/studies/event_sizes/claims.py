"""Laws of event sizes side by side, for claims about them."""

import math
from collections.abc import Iterable

from scripts.claims.filters import by
from scripts.studies.event_sizes.names_of_laws import RIVALS, decades_of, definition_of, is_usual

LEVEL = 0.01
"""A law is more likely than another one if chance alone has less than this probability."""
MUCH_MORE_LIKELY = 3.0
"""A law is preferred to one that is not nested in it if its log-likelihood is larger by this."""


def laws_of(rows: list[dict], chains: list[str]) -> list[dict]:
    """Rows of the usual events of chains, with spans in decades and laws that are more likely."""
    return [
        {
            **row,
            "span": math.log10(row["largest"] / row["size_least"]),
            "decades": decades_of(row),
            "better": better_laws(row, RIVALS),
            "better_cut_off": better_laws(row, [f"cutoff_over_{law}" for law in RIVALS[:-1]]),
        }
        for of_chain in by(rows, chain=chains)
        for row in filter(is_usual, of_chain)
    ]


def better_laws(row: dict, rivals: Iterable[str]) -> list[str]:
    """Names of the laws that are more likely."""
    return [
        rival.removeprefix("cutoff_over_").replace("_", " ")
        for rival in rivals
        if row[f"{rival}_ratio"] < 0 and row[f"{rival}_chance"] < LEVEL
    ]


def other_definitions(rows: list[dict], chains: list[str]) -> dict[str, list[dict]]:
    """Rows with a fitted cut-off by other definitions of an event, with the decades they span."""
    others = [row for row in rows if row["chain"] in chains and not is_usual(row)]
    found: dict[str, list[dict]] = {definition_of(row): [] for row in others}
    for row in others:
        if not math.isnan(row["size_cutoff"]):
            found[definition_of(row)].append(row | {"decades": decades_of(row)})
    return found
