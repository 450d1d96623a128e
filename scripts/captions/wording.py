"""Numbers and lists in sentences."""

import re
from collections.abc import Sequence

COUNTS = ("no", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten")
MOST_LISTED = 8
"""Values in a sentence."""


def short(value: float, digits: int = 3) -> str:
    """A number with `digits` digits, very large and small ones with a power of ten as a formula."""
    text = f"{float(value):.{digits}g}"
    if "e" not in text:
        return text.replace("-", "\N{MINUS SIGN}")
    factor, exponent = text.split("e")
    power = f"10^{{{int(exponent)}}}"
    return f":math:`{power}`" if factor == "1" else rf":math:`{factor} \times {power}`"


def count(number: int, word: str = "", plural: str = "") -> str:
    """A number of things, in words up to ten."""
    said = COUNTS[number] if number < len(COUNTS) else str(number)
    return f"{said} {word if number == 1 else plural or word + 's'}" if word else said


def joined(words: Sequence[str]) -> str:
    """Words with commas between, and "and" before the last."""
    return " and ".join([", ".join(words[:-1]), words[-1]] if len(words) > 1 else words)


def listed(values: Sequence[str]) -> str:
    """Values in a sentence; of many the first and the last."""
    return joined(values) if len(values) <= MOST_LISTED else f"{values[0]}, …, {values[-1]}"


def as_formulas(words: str) -> str:
    """Words of a figure, whose formulas stand between dollars, with formulas of a caption."""
    return re.sub(r"\$([^$]*)\$", r":math:`\1`", words)


def in_order(words: Sequence[str]) -> str:
    """A sentence begins with a capital."""
    return words[:1].upper() + words[1:]


FILTERS = {"short": short, "count": count, "joined": joined, "listed": listed, "capital": in_order}
