"""Numbers, lists and parameters in the sentences of captions."""

import math
import re
from collections.abc import Mapping, Sequence

from scripts.drawing import parameters
from scripts.models.records import is_of_block

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


def with_error(value: float, error: float) -> str:
    """A measured value with its standard error; an exact one has none, NaN was not measured."""
    if math.isnan(value):
        return "not measured"
    return short(value) if error == 0 else f"{short(value)} ± {short(error, 2)}"


def count(number: int, word: str = "", plural: str = "") -> str:
    """A number of things, in words up to ten."""
    said = COUNTS[number] if number < len(COUNTS) else str(number)
    return f"{said} {word if number == 1 else plural or word + 's'}" if word else said


def joined(words: Sequence[str]) -> str:
    """Words with commas between, and "and" before the last."""
    return " and ".join([", ".join(words[:-1]), words[-1]] if len(words) > 1 else words)


def shortened(values: Sequence[str]) -> str:
    """Values in a sentence; of many the first and the last."""
    return joined(values) if len(values) <= MOST_LISTED else f"{values[0]}, …, {values[-1]}"


def counted_at(name: str, places: Sequence[str]) -> str:
    """How many things of a name there are, and where."""
    return f"{count(len(places), name)} at {shortened(places)}"


def as_formulas(words: str) -> str:
    """Words of a figure, whose formulas stand between dollars, with formulas of a caption."""
    return re.sub(r"\$([^$]*)\$", r":math:`\1`", words)


def place_in_words(place: Mapping, *left_out: str) -> str:
    """The parameters of a place as formulas of a caption, without some of them."""
    return as_formulas(parameters.in_words(place, *left_out))


def words_of_state(place: Mapping) -> str:
    """What the steady state of the model of a place is called."""
    return "steady sliding" if is_of_block(place) else "the steady state"


def capitalised(words: str) -> str:
    """The beginning of a sentence."""
    return words[:1].upper() + words[1:]


FILTERS = {
    "short": short,
    "count": count,
    "joined": joined,
    "shortened": shortened,
    "capital": capitalised,
}
"""By their names in templates."""
