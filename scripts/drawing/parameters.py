"""Parameters and numbers as figures write them, with true minus signs."""

from scripts.namelists.laws import PAPER, law_of, spoken
from scripts.namelists.parameters import PARAMETERS

SYMBOLS = {
    **{"tau": r"\tau", "epsilon": r"\varepsilon", "xi": r"\xi", "gamma": r"\gamma"},
    **{"theta": r"\theta", "u": "u", "v": "v"},
}
"""Of the block's parameters, and of the values before the start."""
NAMES = {
    "tau": "delay",
    "epsilon": "sensitivity of the velocity relaxation",
    "xi": "spring constant",
    "gamma": "frequency",
    "theta": "friction state before the start",
    "u": "displacement before the start",
    "v": "velocity before the start",
}
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


def in_words(place: dict, *left_out: str) -> str:
    """The parameters of a place as formulas, without some of them, and a law not the paper's."""
    words = [equation(key, place[key]) for key in PARAMETERS if key not in left_out]
    if law_of(place) != PAPER:
        words.append(f"law {spoken(law_of(place))}")
    return ", ".join(words)


def symbol_of(parameter: str) -> str:
    """The symbol of a parameter, of a law's own one its name."""
    name = parameter.replace("_", r"\_")
    return SYMBOLS.get(parameter, rf"\mathrm{{{name}}}")


def equation(parameter: str, value: float) -> str:
    """A parameter with its value."""
    return f"${symbol_of(parameter)} = {number(value)}$"


def axis_of(parameter: str, meaning: str = "") -> str:
    """Name and symbol of a parameter, the delay with its unit; a law's own one has its meaning."""
    unit = " (units of $L/v_0$)" if parameter == "tau" else ""
    meaning = "" if meaning == parameter else meaning
    return f"{NAMES.get(parameter, meaning)} ${symbol_of(parameter)}${unit}".strip()
