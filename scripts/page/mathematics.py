"""Mathematics on the page: formulas in LaTeX, and plain words such as `gamma^2` or `1e-06`."""

import re

from docutils.utils.math import latex2mathml
from markupsafe import Markup, escape

GREEK = {
    "theta": "θ",
    "epsilon": "ε",
    "gamma": "γ",
    "lambda": "λ",
    "mu": "μ",
    "omega": "ω",
    "tau": "τ",
    "xi": "ξ",
}
RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
"""Signs of an exponent where there is no markup."""
SIGNS = {"+-": "±", "<=": "≤", ">=": "≥", "->": "→", "'": "’"}
NAME = "|".join(GREEK)
WORDS = re.compile(
    rf"""
    (?P<unit>\bm/s\b)
    | (?P<power>(?P<minus>-?)(?P<mantissa>\d+(?:\.\d+)?)e(?P<exponent>[+-]?\d+))
    | (?P<rate>\bd\s?(?P<of>{NAME}|[uv])/dt\b)
    | (?P<plane>\b(?P<ordinate>{NAME})_of_(?P<abscissa>{NAME})\b)
    | (?P<identifier>\b[a-z0-9]+(?:_[a-z0-9]+)+\b)
    | (?P<symbol>\b(?:{NAME}|mu0|v0|f[12]|l[12]|Dc|(?<!['’])[bkstuvxBL]
        |(?<=[/(-])A|(?<=-\ )A|A(?=\ ln)|(?<=smaller\ )A|(?<=which\ )A)\b)
    | \^(?P<raised>\w+)
    | (?P<sign>\+-|<=|>=|->|')
    | (?P<below>(?<![\w)])-(?=[\w.])|(?<=\ )-(?=\ ))
    """,
    re.VERBOSE,
)
"""What is set as mathematics in words."""


def of_latex(formula: str, *, block: bool = False) -> Markup:
    """A formula as MathML, on a line of its own or within a line."""
    return Markup(latex2mathml.tex2mathml(" ".join(formula.split()), as_block=block))


def of_words(words: str) -> Markup:
    """Words as HTML: names of variables, powers and signs become mathematics."""
    parts, end = [], 0
    for found in WORDS.finditer(words):
        parts += [escape(words[end : found.start()]), Markup(_html(found))]
        end = found.end()
    html = unbroken("".join([*parts, escape(words[end:])]))
    return Markup(re.sub(r"(?<=[>]) = (?=[\d−])", "\N{NO-BREAK SPACE}=\N{NO-BREAK SPACE}", html))


def unbroken(html: str) -> str:
    """HTML with no end of a line before a percent sign or after a plus-minus sign."""
    return re.sub(r"(?<=\d)\s(?=%)|(?<=±)\s(?=\S)", "\N{NO-BREAK SPACE}", html)


def in_signs(numbers: str) -> str:
    """Numbers with powers of ten and minus signs as in print, where there is no markup."""
    powers = re.sub(
        r"(\d[\d.]*)e([+-]\d+)",
        lambda found: _power(found[1], str(int(found[2])).translate(RAISED)),
        numbers,
    )
    return powers.replace("-", "−")


def _power(mantissa: str, exponent: str) -> str:
    """A number with a power of ten; its exponent is written already."""
    return f"10{exponent}" if mantissa == "1" else f"{mantissa} × 10{exponent}"


def _html(found: re.Match) -> str:
    """What was found, as HTML."""
    if found["unit"]:
        return found["unit"]
    if found["power"]:
        minus = "−" if found["minus"] else ""
        mantissa = "" if found["mantissa"] == "1" else f"{found['mantissa']} × "
        exponent = str(int(found["exponent"])).replace("-", "−")
        return f"{minus}{mantissa}10<sup>{exponent}</sup>"
    if found["rate"]:
        return f"d{_symbol(found['of'])}/d<var>t</var>"
    if found["plane"]:
        return f"{_symbol(found['ordinate'])}({_symbol(found['abscissa'])})"
    if found["identifier"]:
        return " ".join(
            _symbol(word) if word in GREEK else word for word in found["identifier"].split("_")
        )
    if found["symbol"]:
        return _symbol(found["symbol"])
    if found["raised"]:
        raised = found["raised"]
        return f"<sup>{raised if raised.isdigit() else f'<var>{raised}</var>'}</sup>"
    return SIGNS[found["sign"]] if found["sign"] else "−"


def _symbol(name: str) -> str:
    """A variable, with its index."""
    letter, index = re.fullmatch(r"([A-Za-z]+?)(\d*|(?<=D)c)", name).groups()
    below = f"<sub>{index}</sub>" if index else ""
    return f"<var>{GREEK.get(letter, letter)}</var>{below}"
