# SPDX-License-Identifier: BSD-3-Clause
"""Published models give their published numbers, and the notebook runs."""

import json
import runpy
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from matplotlib import pyplot

FOLDER = Path(__file__).resolve().parents[1]
FILES = sorted(FOLDER.glob("gallery/*.py"))


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_published_numbers(path):
    names = runpy.run_path(str(path))
    numbers = names["numbers"]()
    assert list(numbers) == list(names["PUBLISHED"])
    for name, (value, within) in names["PUBLISHED"].items():
        assert float(numbers[name]) == pytest.approx(value, rel=0, abs=within), name
    assert len(path.read_text().splitlines()) <= 41


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_a_picture(path):
    runpy.run_path(str(path))["plot"]()
    drawn = pyplot.gca()
    assert drawn.lines or drawn.collections


def test_a_file_runs_by_itself():
    command = [sys.executable, str(FOLDER / "gallery/wille_baker.py")]
    output = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    assert "y1(5): 19.175; published: 19.175 within 1e-07" in output


def test_the_notebook():
    cells = json.loads((FOLDER / "ten_minutes.ipynb").read_text())["cells"]
    names, drawn = {}, 0
    for cell in cells:
        if cell["cell_type"] == "code":
            assert not cell["outputs"]
            figure = pyplot.figure()
            exec("".join(cell["source"]), names)
            drawn += any(axes.lines or axes.collections for axes in figure.axes)
    assert drawn == 5
    assert names["exponents"].sign[0] == "positive"
    assert names["hopf"].l1.size > 0
    assert "period_doubling" in names["cycles"].special_kind
    assert np.isfinite(names["scan"].maxima[:, 0]).all()
