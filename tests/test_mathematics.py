"""Mathematics on the page: words and numbers as in print."""

import html
import re

import pytest

from scripts.page import mathematics


def text_of(markup: str) -> str:
    """The text of some HTML."""
    return html.unescape(re.sub(r"<[^>]*>", "", markup))


@pytest.mark.parametrize(
    ("words", "expected"),
    [
        ("gamma^2 xi/(xi + gamma^2)", "γ2 ξ/(ξ + γ2)"),
        ("0.0174 +- 0.0029 v0/L", "0.0174 ±\N{NO-BREAK SPACE}0.0029 v0/L"),
        ("38 % of it", "38\N{NO-BREAK SPACE}% of it"),
        (
            "by -8.3e-07, at 1e4 to 1e+12",
            "by −8.3\N{NO-BREAK SPACE}×\N{NO-BREAK SPACE}10−7, at 104 to 1012",
        ),
        ("d theta/dt = -x ln x <= 1", "dθ/dt\N{NO-BREAK SPACE}=\N{NO-BREAK SPACE}−x ln x ≤ 1"),
        (
            "(B - A)/A of a spring-block at A larger mu0",
            "(B − A)/A of a spring-block at A larger μ0",
        ),
        ("tau_of_epsilon and fixed_point", "τ(ε) and fixed point"),
        ("1e-06 m/s, the paper's, 1 < 2", "10−6 m/s, the paper’s, 1 < 2"),
        ("1/s^b", "1/sb"),
    ],
)
def test_words_become_mathematics(words, expected):
    """Greek letters, powers, signs and minus; the article `a` and hyphens stay."""
    assert text_of(mathematics.of_words(words)) == expected


def test_powers_and_indices_are_raised_and_lowered():
    """As elements, so that they are read as such."""
    assert mathematics.of_words("gamma^2 < v0") == (
        "<var>γ</var><sup>2</sup> &lt; <var>v</var><sub>0</sub>"
    )


def test_numbers_of_views_have_signs_of_print():
    """A factor of 1 is left out; digits without an exponent stay."""
    said = mathematics.in_signs("1e+08, -1.1e-05, 21 and 0.1")
    assert said == "10⁸, −1.1 × 10⁻⁵, 21 and 0.1"
