"""Names of the laws of event sizes and of the definitions of an event, and cut-offs in words."""

import math

CUT_OFF = "truncated_power_law"
RIVALS = ("exponential", "lognormal", CUT_OFF)
"""Laws that a power law is compared with: the last is one with an exponential cut-off."""
PLAUSIBLE = 0.1
"""A law is plausible if at least this share of its samples is farther from it than the data."""


def is_usual(row: dict) -> bool:
    """Whether a row is about the usual events: slips with v > 1 that overlap are one event."""
    return row["threshold"] == 1 and row["joined"] == "yes"


def definition_of(row: dict) -> str:
    """What an event is in a row, in words."""
    slips = "slips joined" if row["joined"] == "yes" else "slips of one block"
    return f"v > {row['threshold']:g}, {slips}"


def decades_of(row: dict) -> float:
    """Decades from the lower cut-off to the upper one or to the largest event, if it is smaller."""
    return math.log10(max(1.0, min(row["size_cutoff"], row["largest"]) / row["size_least"]))


def exponent_in_words(exponent: float, digits: int) -> str:
    """An exponent; it is missing where it is no estimate."""
    if math.isnan(exponent):
        return "not estimated (at an end of a range)"
    return f"{exponent:.{digits}g}"


def cut_off_in_words(row: dict) -> str:
    """The cut-off with the ends of its interval."""
    if math.isnan(row["size_cutoff"]):
        return "too few events"
    middle, low, high = (f"{row[f'size_cutoff{end}']:.2g}" for end in ("", "_low", "_high"))
    return f"{middle} ({low} to {high})"
