"""Mathematics on the page: formulas in LaTeX, numbers without markup."""

import re

from docutils.utils.math import latex2mathml
from markupsafe import Markup

RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
"""Signs of an exponent where there is no markup."""


def render(formula: str, *, block: bool = False) -> Markup:
    """A formula as MathML, on a line of its own or within a line."""
    return Markup(latex2mathml.tex2mathml(" ".join(formula.split()), as_block=block))


def in_signs(numbers: str) -> str:
    """Numbers with powers of ten and minus signs as in print, where there is no markup."""

    def power(found: re.Match) -> str:
        factor = "" if found[1] == "1" else f"{found[1]} × "
        return f"{factor}10{str(int(found[2])).translate(RAISED)}"

    return re.sub(r"(\d[\d.]*)e([+-]\d+)", power, numbers).replace("-", "−")
