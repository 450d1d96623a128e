"""Words with mathematics between dollars, as plain text and as HTML."""

import html
import re

import pytest

from scripts.files.marked_words import to_html, to_plain


@pytest.mark.parametrize(
    ("words", "expected"),
    [
        ("$gamma^2 xi/(xi + gamma^2)$", "γ2 ξ/(ξ + γ2)"),
        ("0.0174 +- 0.0029 $v0/L$", "0.0174 ±\N{NO-BREAK SPACE}0.0029 v0/L"),
        ("38 % of it", "38\N{NO-BREAK SPACE}% of it"),
        (
            "by -8.3e-07, at $gamma = 1e4$ to 1e+12",
            "by −8.3\N{NO-BREAK SPACE}×\N{NO-BREAK SPACE}10−7, at"
            " γ\N{NO-BREAK SPACE}=\N{NO-BREAK SPACE}104 to 1012",
        ),
        (
            "$d theta/dt = -x ln x <= v(t - tau)$",
            "dθ/dt\N{NO-BREAK SPACE}=\N{NO-BREAK SPACE}−x ln x ≤ v(t − τ)",
        ),
        ("a spring-block at A, $k_c = (B - A)/L$, $Dc$", "a spring-block at A, kc = (B − A)/L, Dc"),
        ("tau_of_epsilon and fixed_point", "τ(ε) and fixed point"),
        ("1e-06 m/s, the paper's, 1 < 2", "10−6 m/s, the paper’s, 1 < 2"),
        ("$1/s^b$ costs $5", "1/sb costs $5"),
    ],
)
def test_words_become_mathematics(words, expected):
    """Greek letters, powers, signs and minus between dollars; elsewhere numbers and names alone."""
    assert html.unescape(re.sub("<[^>]*>", "", to_html(words))) == expected


def test_plain_words_have_no_dollars_around_mathematics():
    assert to_plain("At $gamma^2 = 1e-06$ it costs $5.") == "At gamma^2 = 1e-06 it costs $5."
