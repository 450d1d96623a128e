"""Exponents of scenes, for claims about their attractors."""

import math

ERRORS = 3
"""Standard errors beyond which an exponent is not zero."""


def exponents_of(row: dict, long_run: list[dict]) -> list[tuple[float, float]]:
    """The largest three exponents, four of a 3-torus, with their errors, as far as measured.

    They are those of the scene's long run if it has one, else those of the row.
    """
    # the other runs of a scene check tolerance and step size
    own = [one for one in long_run if one["mean_step"] == long_run[0]["mean_step"]]
    number = 4 if row["class"] == "3-torus" else 3
    of_row = [(row[f"exponent_{i}"], row[f"error_{i}"]) for i in range(1, number + 1)]
    pairs = [(one["exponent"], one["error"]) for one in own] or of_row
    return [pair for pair in pairs[:number] if not math.isnan(pair[0])]


def is_positive(row: dict) -> bool:
    """Whether the largest exponent of a row is measured, and positive beyond its error."""
    return row["exponent_1"] > ERRORS * row["error_1"]
