"""Contrast of the colours of the page, by its style sheet."""

import re

import numpy as np
import pytest
from conftest import ROOT

STYLE = (ROOT / "page" / "style.css").read_text()


def colours(number: int) -> dict[str, str]:
    """The colours by name: 0 light, 1 dark, 2 on paper, where light ones go on."""
    blocks = re.findall(r":root \{([^}]*)\}", STYLE)
    found = [dict(re.findall(r"--([\w-]+): (#\w{6});", block)) for block in blocks]
    assert len(found) == 3
    return found[0] | found[number]


def pairs() -> set[tuple[str, str]]:
    """Names of colours of text and of what is behind it, in the rules of the style sheet.

    Text of a rule without a background stands on the page or on a card.
    """
    found = set()
    for _, body in re.findall(r"([^{}]+)\{([^{}]*)\}", STYLE):
        text = re.search(r"(?<![\w-])color: var\(--([\w-]+)\)", body)
        behind = re.search(r"background: var\(--([\w-]+)\)", body)
        if text and text[1] != "figure-text":
            found |= {(text[1], name) for name in ([behind[1]] if behind else ["page", "card"])}
        elif text:
            found.add((text[1], "figure"))
    return found


def luminance(colour: str) -> float:
    """Relative luminance as WCAG 2 defines it."""
    parts = [int(colour[i : i + 2], 16) / 255 for i in (1, 3, 5)]
    linear = [x / 12.92 if x <= 0.04045 else ((x + 0.055) / 1.055) ** 2.4 for x in parts]
    return float(np.dot([0.2126, 0.7152, 0.0722], linear))


def contrast(one: str, other: str) -> float:
    """Ratio of contrast of two colours."""
    low, high = sorted([luminance(one), luminance(other)])
    return (high + 0.05) / (low + 0.05)


@pytest.mark.parametrize("number", [0, 1, 2], ids=["light", "dark", "paper"])
def test_text_can_be_read(number):
    """Contrast of 4.5 or more for each text on what is behind it (WCAG 2, AA)."""
    found = colours(number)
    assert len(pairs()) >= 10
    low = {
        pair: contrast(found[pair[0]], found[pair[1]])
        for pair in pairs()
        if contrast(found[pair[0]], found[pair[1]]) < 4.5
    }
    assert low == {}
