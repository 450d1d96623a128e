# SPDX-License-Identifier: BSD-3-Clause
"""What the documents show: their programs run, and give the values of the study."""

import re
from pathlib import Path

import numpy as np
import pytest

HOUSE = Path(__file__).parents[2]


@pytest.fixture(autouse=True)
def _beside_the_solver(monkeypatch, tmp_path):
    (tmp_path / "fortran").symlink_to(HOUSE / "fortran")
    monkeypatch.chdir(tmp_path)


def program_of(document: str, language: str) -> dict:
    """What is defined when all blocks of a document have run."""
    text = (HOUSE / document).read_text(encoding="utf-8")
    found: dict = {}
    exec("".join(re.findall(rf"^```{language}\n(.*?)^```", text, re.DOTALL | re.MULTILINE)), found)
    return found


def test_scenes_of_the_paper():
    """Values in results/tables of the study; folds and double Hopf points to ten digits."""
    found = program_of("docs/results-in-python.md", "py")
    assert found["motion"]["class"].item() == "cycle"
    np.testing.assert_allclose(found["roots"][0], 0.009369777991 + 0.6196655088j, rtol=1e-9)
    exponents = found["exponents"]
    published = [0, -0.0140454, -0.0397391, -0.0397395]
    np.testing.assert_allclose(exponents.value, published, atol=3 * float(exponents.error.max()))
    cycles = found["cycles"]
    folds = cycles.special_epsilon[cycles.special_kind == "fold"]
    np.testing.assert_allclose(sorted(folds), [0.596725226587, 0.742775734668], rtol=1e-9)
    curves = found["curves"]
    double = curves.special_kind == "double_hopf"
    places = np.column_stack([curves.special_epsilon[double], curves.special_tau[double]])
    expected = [[1.14543742276339, 3.34264689840277], [1.1990768353805, 29.6336701501605]]
    for one in expected:
        assert np.abs(places / one - 1).max(axis=1).min() < 1e-10


def test_the_readme(monkeypatch):
    found = program_of("python/README.md", "python")
    assert found["exponents"].sign.values.tolist() == ["positive", "zero", "negative", "negative"]
    assert found["motion"]["class"].item() == "cycle"
    assert (found["cycles"].special_kind == "period_doubling").any()


def test_coming_from():
    """Exact up to t = 2; y(10) by JiTCDDE 1.8.3 at a tolerance of 1e-10; exact Hopf points."""
    found = program_of("docs/coming-from.md", "python")
    run = found["run"]
    assert float(run.y.sel(t=2)) == pytest.approx(0.5 * np.exp(0.9 + 2.8 - np.exp(0.9)), rel=1e-9)
    assert float(run.y[-1]) == pytest.approx(2.1060614118, rel=1e-8)
    np.testing.assert_allclose(run.event_t[:2], np.log(2) / 0.9 + np.arange(2), rtol=1e-9)
    assert found["exponents"].sign.values.tolist() == ["zero", "negative"]
    curve = found["curve"]
    np.testing.assert_allclose(curve.r * curve.tau, np.pi / 2, rtol=1e-9)
    assert (curve.l1 < 0).all()
    assert (found["roots"].real < 0).all()
