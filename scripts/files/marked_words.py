"""Words with mathematics between dollars, as plain text and as HTML.

Between dollars stand plain letters: `$gamma^2 xi/(xi + gamma^2)$`, `$v0 = 1e-06$`. Numbers and
names of entries such as `tau_of_epsilon` need no dollars.
"""

import re

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
SIGNS = {"+-": "±", "<=": "≤", ">=": "≥", "->": "→", "-": "−", "'": "’"}
MARKED = re.compile(r"\$([^$]+)\$")
NUMBER = r"(?P<mantissa>\d+(?:\.\d+)?)e(?P<exponent>[+-]?\d+)"
LETTERS = "|".join(GREEK)
FORMULA = re.compile(
    rf"{NUMBER}|(?P<upright>ln\b|log\b|d(?=[tuv]\b))|(?P<differential>d (?=(?:{LETTERS})\b))"
    rf"|(?P<letter>{LETTERS}|[A-Za-z])_?(?P<index>\d+|c\b|)|\^(?P<raised>\w+)"
    r"|(?P<sign>\+-|<=|>=|->|-)"
)
PROSE = re.compile(
    rf"{NUMBER}|(?P<entry>\b[a-z0-9]+(?:_[a-z0-9]+)+\b)|(?P<sign>\+-|'|(?<![\w)])-(?=\d))"
)


def to_plain(words: str) -> str:
    """Words without the dollars around mathematics."""
    return MARKED.sub(r"\1", words)


def to_html(words: str) -> Markup:
    """Words as HTML with variables, powers and signs as in print."""
    parts = MARKED.split(words)
    html = [_replaced(part, FORMULA if i % 2 else PROSE) for i, part in enumerate(parts)]
    # no line ends after an equals sign in a formula
    html[1::2] = [re.sub(" = (?=[\\d−])", "\u00a0=\u00a0", formula) for formula in html[1::2]]
    return Markup(unbroken("".join(html)))


def unbroken(html: str) -> str:
    """HTML with no end of a line before a percent sign or after a plus-minus sign."""
    return re.sub(r"(?<=\d)\s(?=%)|(?<=±)\s(?=\S)", "\N{NO-BREAK SPACE}", html)


def _replaced(words: str, pattern: re.Pattern) -> str:
    """Words as HTML with what the pattern finds replaced."""
    parts, end = [], 0
    for found in pattern.finditer(words):
        parts += [escape(words[end : found.start()]), _html(found.groupdict())]
        end = found.end()
    return "".join([*parts, escape(words[end:])])


def _html(found: dict[str, str | None]) -> str:
    """HTML of one part of a formula, or of a number, name or sign among words."""
    if found["mantissa"]:
        factor = "" if found["mantissa"] == "1" else f"{found['mantissa']}\u00a0×\u00a0"
        return f"{factor}10<sup>{str(int(found['exponent'])).replace('-', '−')}</sup>"
    if found["sign"]:
        return SIGNS[found["sign"]]
    if found.get("entry"):
        words = [_variable(word) if word in GREEK else word for word in found["entry"].split("_")]
        is_curve = len(words) == 3 and words[1] == "of"
        return f"{words[0]}({words[2]})" if is_curve else " ".join(words)
    if found["letter"]:
        below = f"<sub>{found['index']}</sub>" if found["index"] else ""
        return _variable(found["letter"]) + below
    if found["raised"]:
        raised = found["raised"]
        return f"<sup>{raised if raised.isdigit() else _variable(raised)}</sup>"
    return found["upright"] or "d"


def _variable(name: str) -> str:
    """HTML of a variable."""
    return f"<var>{GREEK.get(name, name)}</var>"
