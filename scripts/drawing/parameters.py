"""Parameters and numbers as figures write them, with true minus signs."""

import math
from collections.abc import Mapping

from scripts.models.models import HISTORY, PAPER, PARAMETERS, block_parameters
from scripts.models.records import is_of_block, law_of, spoken

GREEK = (
    *("alpha", "beta", "gamma", "delta", "epsilon", "zeta", "eta", "theta", "kappa", "lambda"),
    *("mu", "nu", "xi", "pi", "rho", "sigma", "tau", "phi", "chi", "psi", "omega"),
)
"""Letters that are symbols by their names."""
LEAST_PLAIN, LEAST_POWER = 1e-3, 1e4
"""Numbers between these are written plainly, others with a power of ten."""


def number(value: float) -> str:
    """A number with up to six digits, for a formula."""
    if value == 0 or LEAST_PLAIN <= abs(value) < LEAST_POWER:
        return f"{value:g}"
    digits, exponent = f"{value:.5e}".split("e")
    power = f"10^{{{int(exponent)}}}"
    digits = digits.rstrip("0").rstrip(".")
    return power if digits == "1" else rf"{digits} \times {power}"


def true_minus(text: str) -> str:
    """The text with minus signs in the place of hyphens."""
    return text.replace("-", "\N{MINUS SIGN}")


def in_words(place: Mapping, *left_out: str) -> str:
    """The parameters of a place as formulas, without some of them, and a law not the paper's."""
    there = [key for key in PARAMETERS if not math.isnan(place.get(key, math.nan))]
    words = [equation(key, place[key]) for key in there if key not in left_out]
    if law_of(place) != PAPER:
        words.append("law " * is_of_block(place) + spoken(law_of(place)))
    return ", ".join(words)


def symbol_of(parameter: str) -> str:
    """The symbol of a parameter: a letter, or its name."""
    if parameter in GREEK:
        return r"\varepsilon" if parameter == "epsilon" else rf"\{parameter}"
    name = parameter.replace("_", r"\_")
    return name if len(name) == 1 else rf"\mathrm{{{name}}}"


def equation(parameter: str, value: float) -> str:
    """A parameter with its value."""
    return f"${symbol_of(parameter)} = {number(value)}$"


def axis_of(parameter: str, meaning: str = "", place: Mapping | None = None) -> str:
    """Name and symbol of a parameter of the model of a place, by default of the block.

    The delay of the block has its unit.
    """
    of_block = place is None or is_of_block(place)
    known = {**block_parameters(), **HISTORY} if of_block else {}
    unit = " (units of $L/v_0$)" if of_block and parameter == "tau" else ""
    meaning = known.get(parameter, {}).get("meaning", meaning).split(",")[0]
    said = "" if meaning == parameter else meaning
    return f"{said} ${symbol_of(parameter)}${unit}".strip()
