"""Exponents: the program against known roots, its refusals, the config, table and figure.

The suites lyapunov_spectrum and tangent_runs show long intervals and other methods.
"""

import numpy as np
import pytest
import xarray as xr
from conftest import of_trajectory
from figure_contents import assert_on_page, title_of, words_in
from matplotlib import pyplot as plt

from scripts.drawing.style import STYLE
from scripts.figures import exponents
from scripts.files.tsv import read_table
from scripts.tables import exponents_table

SCENES = ["oscillation", "torus", "chaos", "true_torus"]


@pytest.fixture
def groups(filled_config) -> dict[str, dict]:
    """Namelist groups that the program accepts, to change: the fixed point without delay."""
    scene = {"name": "fixed_point", **of_trajectory(filled_config, "fixed_point")}
    settings = {**filled_config["exponents"], "t_turning": 100.0, "interval": 0.5}
    return {
        "scene": scene | {"t_transient": 200.0, "t_end": 300.0},
        "exponents": {"count": 3, "t_end": 500.0, **settings},
    }


def test_exponents_of_a_fixed_point_are_its_roots(programs, groups):
    """Real parts of the roots of (5) without delay, at each tolerance."""
    made = programs.made_of("exponents", groups)
    ratio = 0.8**2 / 0.8
    roots = np.roots([1, 1 + ratio, 0.8**2 + ratio - 1.3 * ratio, 0.8**2])
    known = np.sort(roots.real)[::-1]
    assert made.tolerance.values.tolist() == [1e-9, 1e-7, 1e-5, 1e-9]
    assert made.longest_step.fillna(0).values.tolist() == [0, 0, 0, 0.1]
    assert 0.09 < made.mean_step[3] <= 0.1 < made.mean_step[0]
    # what is left of the way to the fixed point, and the turning of the pair
    np.testing.assert_allclose(made.value, np.tile(known, (4, 1)), atol=1e-3)
    np.testing.assert_allclose(made.value[0].sum(), -(1 + ratio), atol=1e-4)
    # in the second half it is close enough that volumes shrink as at rest
    at_rest = made.block_value.isel(block=slice(10, 20))
    np.testing.assert_allclose(at_rest.sum("exponent"), -(1 + ratio), atol=1e-4)
    assert made.dimension.values.tolist() == [0, 0, 0, 0]
    assert made.t[-1] == pytest.approx(500)
    assert made.attrs["zero_exponents"] == 0


def test_table_holds_all_exponents_of_all_scenes(smoke):
    """The exponents of each tolerance are in descending order, as in the files."""
    rows = read_table(smoke.folder / "results/tables/exponents.tsv")
    for scene in SCENES:
        made = xr.load_dataset(smoke.folder / f"results/exponents/{scene}.nc")
        own = [row for row in rows if row["scene"] == scene]
        values = np.array([row["exponent"] for row in own]).reshape(4, 6)
        np.testing.assert_allclose(values, made.value, rtol=1e-5)
        bounds = np.maximum(made.attrs["zero_level"], 3 * made.error)
        np.testing.assert_allclose(made.sign_bound, bounds, rtol=1e-12)
        assert (np.diff(values) <= 0).all()
        assert [row["i"] for row in own] == 4 * [1, 2, 3, 4, 5, 6]
        signs = [row["sign"] for row in own[:6]]
        assert signs.count("zero") == made.attrs["zero_exponents"]


def test_rows_hold_the_values_of_their_run(programs, groups):
    """Each column that of its name, at each tolerance."""
    made = programs.made_of("exponents", groups)
    rows = exponents_table.rows_of(made)
    assert len(rows) == made.value.size
    for n, row in enumerate(rows):
        at, i = made.isel(run=n // 3), n % 3
        assert (row["scene"], row["i"]) == ("fixed_point", i + 1)
        assert (row["exponent"], row["error"]) == (at.value[i], at.error[i])
        assert row["sign"] == ("negative" if at.value[i] < -at.sign_bound[i] else "zero")
        assert (row["dimension"], row["dimension_error"]) == (at.dimension, at.dimension_error)
        assert row["t"] == made.attrs["t_end"] - made.attrs["t_begin"]
        assert (row["tolerance"], row["mean_step"]) == (at.tolerance, at.mean_step)
    assert exponents_table.sign(0.02, 0.01) == "positive"


def test_figure_shows_time_tolerance_and_resolution(smoke):
    """A row a scene, with its verdict; all is on the page."""
    results = smoke.folder / "results"
    runs = [xr.load_dataset(results / f"exponents/{scene}.nc") for scene in SCENES]
    with plt.style.context(STYLE):
        figure = exponents.draw(runs, read_table(results / "tables/exponents.tsv"))
    assert len(figure.axes) == 12
    for scene, axes in zip(SCENES, figure.axes[::3], strict=True):
        assert f"scene {scene.replace('_', ' ')}: " in title_of(axes)
        assert len([line for line in axes.lines if len(line.get_xdata()) > 10]) == 6
    assert "time averaged over" in words_in(figure)
    assert_on_page(figure)
    plt.close(figure)
