"""Captions: reStructuredText to HTML, with formulas that a browser sets by itself."""

import html
import re
from pathlib import Path

from docutils.core import publish_parts

from scripts.files import marked_words

SETTINGS = {
    "math_output": "MathML",
    "input_encoding": "unicode",
    # a caption that cannot be read is an error, not a red box on the page
    "halt_level": 2,
    "report_level": 5,
    "file_insertion_enabled": False,
    "raw_enabled": False,
}
"""How docutils reads a caption."""


def as_html(path: str | Path) -> str:
    """The caption as paragraphs and tables; a table that is too wide is scrolled."""
    parts = publish_parts(Path(path).read_text(), writer="html5", settings_overrides=SETTINGS)
    body = re.sub(
        r"(?s)<table.*?</table>", r'<div class="scroll" tabindex="0">\g<0></div>', parts["body"]
    )
    return marked_words.unbroken(body.strip())


def as_words(markup: str) -> str:
    """The text of some HTML on one line, formulas in plain signs without spaces."""
    closed = re.sub(
        r"(?s)<math.*?</math>", lambda formula: re.sub(r">\s+<", "><", formula[0]), markup
    )
    return " ".join(html.unescape(re.sub(r"<[^>]*>", "", closed)).split())


def first_sentence(markup: str) -> str:
    """What stands for a figure where it is not seen."""
    return re.split(r"(?<=\.) ", as_words(markup))[0]
