"""Names of the laws of event sizes and of the definitions of an event, and cut-offs in words."""

import math

CUT_OFF = "truncated_power_law"
RIVALS = ("exponential", "lognormal", CUT_OFF)
"""Laws that a power law is compared with: the last is one with an exponential cut-off."""


def is_usual(row: dict) -> bool:
    """Whether a row is about the usual events: slips with v > 1 that overlap are one event."""
    return row["threshold"] == 1 and row["joined"] == "yes"


def definition_of(row: dict) -> str:
    """What an event is in a row, in words."""
    slips = "slips joined" if row["joined"] == "yes" else "slips of one block"
    return f"v > {row['threshold']:g}, {slips}"


def cut_off_in_words(row: dict) -> str:
    """The cut-off with the ends of its interval."""
    if math.isnan(row["size_cutoff"]):
        return "too few events"
    middle, low, high = (f"{row[f'size_cutoff{end}']:.2g}" for end in ("", "_low", "_high"))
    return f"{middle} ({low} to {high})"
