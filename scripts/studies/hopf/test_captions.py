"""Captions of planes of Hopf curves."""

import numpy as np
import pytest
import xarray as xr
from made_up_results import hopf_curve
from matplotlib import pyplot as plt

from scripts.drawing.wording import short
from scripts.drawing.write_captions import render
from scripts.plans import studies
from scripts.studies.hopf import figure as drawing


def test_plane_without_a_curve_has_a_figure_and_a_caption(smoke):
    """In the window of the file."""
    curves = xr.load_dataset(smoke.folder / "results" / "hopf" / "tau_of_epsilon.nc")
    empty = curves.isel(point=slice(0), special=slice(0))
    figure = drawing.draw(empty, {})
    window = (0.0, pytest.approx(1.5)), (0.0, pytest.approx(20.0))
    assert (figure.axes[0].get_xlim(), figure.axes[0].get_ylim()) == window
    plt.close(figure)
    text = (studies.FOLDER / "hopf" / "caption.rst").read_text()
    caption = render(text, [], paper=False, **drawing.numbers(empty, {}))
    assert caption.startswith("No Hopf curve lies in this plane, at ")
    assert "Lyapunov" not in caption


def test_numbers_of_a_plane():
    """Counts along the curves, the boundary, and special points with their places."""
    curves = hopf_curve()
    curves["l1"][3] = 0.2
    curves["unstable_pairs"][curves.epsilon.values.argmax()] = 1
    curves["crossing"][:4] = -1
    curves["map_unstable_pairs"] = (("map_y", "map_x"), [[0, 0], [0, 1]])
    kinds = ["double_hopf", "hopf_without_delay", "double_hopf"]
    curves["special_kind"] = ("special", np.array(kinds))
    curves["special_epsilon"] = ("special", [1.143, 0.28, 0.336])
    curves["special_tau"] = ("special", [3.343, 0.0, 13.4])
    found = drawing.numbers(curves, {})
    assert (found["stabilising"], found["double"], found["without_delay"]) == (4, 2, [0.28])
    ordered = np.sort(curves.epsilon.values)
    assert found["boundary"] == (short(ordered[0]), short(ordered[-2]))
