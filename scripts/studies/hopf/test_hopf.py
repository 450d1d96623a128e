"""The hopf program: every point in equation (5) and in closed form; the table, captions, verdicts.

The suite hopf_curves shows that curves are complete and smooth, and which way roots cross; the
suite hopf_unfoldings shows where curves of folds and of tori start.
"""

import numpy as np
import pytest
import xarray as xr
from characteristic_equation import closed_form, residual
from made_up_results import NO, PARTLY, YES, assert_finding, cases, changed, changing, hopf_curve
from matplotlib import pyplot as plt

from scripts.drawing.wording import short
from scripts.drawing.write_captions import render
from scripts.files.tsv import read_table, rows_by
from scripts.models.models import PAPER
from scripts.plans import studies
from scripts.studies.hopf import figure as drawing
from scripts.studies.hopf.table import rows_of
from scripts.tables.roots_of_5 import unstable_roots

PLANES = ["tau_of_epsilon", "xi_of_epsilon"]


@pytest.fixture(params=PLANES)
def plane(request, filled_config) -> dict:
    """Settings of a plane as in the config."""
    return filled_config["hopf_curves"][request.param] | {"cells": 20}


@pytest.fixture
def curves(programs, plane) -> xr.Dataset:
    return programs.made_by("hopf", plane)


def parameters(curves: xr.Dataset) -> list[np.ndarray]:
    """epsilon, tau, xi and gamma of all points."""
    gamma = np.full(curves.sizes["point"], curves.attrs["gamma"])
    return [curves.epsilon.values, curves.tau.values, curves.xi.values, gamma]


def test_every_point_solves_the_characteristic_equation(curves, plane):
    """Equation (5) at i omega, recomputed and as the file says; the closed form; the plane."""
    recomputed = residual(1j * curves.omega.values, *parameters(curves))
    assert recomputed.max() <= 1e-10
    np.testing.assert_allclose(curves.residual, recomputed, rtol=0, atol=1e-14)
    epsilon, angle = closed_form(curves.omega, curves.xi, plane["gamma"])
    np.testing.assert_allclose(curves.epsilon, epsilon, rtol=1e-9, atol=1e-12)
    turns = (curves.omega * curves.tau - angle) / (2 * np.pi)
    np.testing.assert_allclose(turns, curves.branch, rtol=0, atol=1e-9)
    fixed = {"tau": "xi", "xi": "tau"}[plane["ordinate"]]
    np.testing.assert_allclose(curves[fixed], plane[fixed], rtol=1e-13)
    known = {"gamma": plane["gamma"], "ordinate": plane["ordinate"], fixed: plane[fixed]}
    assert curves.attrs.items() >= known.items()


def test_window_without_a_curve_makes_an_empty_file(programs, filled_config):
    """Below epsilon = 0.1 nothing oscillates by itself at small delays."""
    plane = filled_config["hopf_curves"]["tau_of_epsilon"] | {"cells": 20}
    plane |= {"abscissa_window": [0.0, 0.05], "ordinate_window": [0.0, 1.0]}
    curves = programs.made_by("hopf", plane)
    assert curves.sizes["point"] == curves.sizes["special"] == 0
    assert rows_of("empty", curves) == []


def test_map_counts_the_crossings(curves, plane):
    """In every cell: roots at tau = 0 plus crossings of all curves below."""
    for i, epsilon in enumerate(curves.map_abscissa.values):
        for j, ordinate in enumerate(curves.map_ordinate.values):
            place = {**plane, plane["ordinate"]: ordinate}
            expected = unstable_roots(epsilon, place["tau"], place["xi"], plane["gamma"])
            assert curves.map_unstable_roots.values[j, i] == expected


def test_special_points_solve_the_characteristic_equation(curves):
    """At one frequency or two, to rounding; a row has the coefficients and curves of its kind."""
    rows = rows_of("plane", curves)
    assert {"double_hopf", "generalised_hopf"} <= {row["kind"] for row in rows}
    for row in rows:
        place = [float(row[key]) for key in ("epsilon", "tau", "xi", "gamma")]
        omegas = [float(row[key]) for key in ("omega_1", "omega_2") if key in row]
        assert max(residual(1j * omega, *place) for omega in omegas) < 1e-10
        assert (row["l1_1"] == "0") is (row["kind"] == "generalised_hopf")
        of_two_pairs = {"g2100", "theta", "omega_2", "angle_1", "start_epsilon_2"}
        assert of_two_pairs & set(row) == (of_two_pairs if row["kind"] == "double_hopf" else set())
        if row["kind"] == "double_hopf":
            g = {key: float(row[f"g{key}"]) for key in ("2100", "1011", "1110", "0021")}
            assert float(row["theta"]) == pytest.approx(g["1011"] / g["0021"], rel=1e-4)
            assert float(row["delta"]) == pytest.approx(g["1110"] / g["2100"], rel=1e-4)
            for i, ratio in ((1, omegas[1] / omegas[0]), (2, omegas[0] / omegas[1])):
                angle = np.cos(float(row[f"angle_{i}"]))
                assert angle == pytest.approx(np.cos(2 * np.pi * ratio))
        elif row["kind"] == "generalised_hopf":
            assert float(row["l2"]) != 0
            assert (row["unfolding"], row["torus_1"]) == ("", "")


@pytest.mark.parametrize("along", ["gamma", "c"])
def test_any_parameter_is_an_ordinate(programs, along):
    """Points and counts; the law with a cut-off is here the paper's at (1 + c) xi."""
    window = {"gamma": [0.4, 2.0], "c": [0.0, 3.0]}[along]
    law = {"gamma": PAPER, "c": "slip_cut_off"}[along]
    fixed = {"tau": 7.0, "xi": 0.5, "gamma": 0.8, "law": law}
    fixed.pop(along, None)
    plane = {"ordinate": along, "abscissa_window": [0.0, 1.2], "ordinate_window": window}
    curves = programs.made_by("hopf", {**plane, **fixed, "cells": 16})
    assert (curves.attrs["ordinate"], along in curves.attrs) == (along, False)
    varied = curves[along].values
    assert varied.size > 50
    xi, gamma = (0.5, varied) if along == "gamma" else (0.5 * (1 + varied), 0.8)
    assert residual(1j * curves.omega.values, curves.epsilon.values, 7.0, xi, gamma).max() < 1e-10
    for i, epsilon in enumerate(curves.map_abscissa.values):
        for j, y in enumerate(curves.map_ordinate.values):
            place = (0.5, y) if along == "gamma" else (0.5 * (1 + y), 0.8)
            counted = unstable_roots(epsilon, 7.0, *place)
            assert curves.map_unstable_roots.values[j, i] == counted
            # a pair becomes unstable at each curve
            pieces = [curves.isel(point=curves.piece.values == k) for k in set(curves.piece.values)]
            here = [one for one in pieces if one[along].min() <= y <= one[along].max()]
            assert counted == 2 * sum(
                np.interp(y, one[along], one.epsilon) < epsilon for one in here
            )


def test_table_of_the_workflow(smoke):
    rows = read_table(smoke.folder / "results" / "tables" / "hopf-points.tsv")
    deaths = [f"amplitude_death_{end}" for end in ("begin", "end")]
    by_kind = rows_by(rows, "kind")
    assert by_kind.keys() == {*deaths, "double_hopf", "generalised_hopf", "hopf_without_delay"}
    begin, end = (row["tau"] for kind in deaths for row in by_kind[kind] if row["of"] == "torus")
    assert begin < end


FIRST = np.arange(12) < 3
"""Three of the points of a curve."""


MIXED = np.where(FIRST, 0.1, -0.1)
LOST, REGAINED = "2 (0 -> 2)", "1 (2 -> 0); 5 (0 -> 2)"
WITHOUT_DELAY = {"of": "plane", "kind": "hopf_without_delay", "xi": 0.5, "gamma": 0.8}
WITHOUT_DELAY |= {"l1_1": -0.05, "epsilon": 0.64 * 0.5 / 1.14}
SUPERCRITICAL = {"planes": ["plane"], "expected": ["supercritical"]}


def on_curve(**values) -> dict:
    return {"curves": {"plane": changed(hopf_curve(), **values)}}


def with_points(**values) -> dict:
    """Results of two scenes, and of a Hopf point without delay but for these values."""
    return {**changing(LOST, REGAINED), "hopf_points": [WITHOUT_DELAY | values]}


def with_spreads(with_tau: float, with_xi: float, roots: int = 0) -> dict:
    """Results of two planes in which epsilon varies by so much."""
    curves = {
        name: changed(
            hopf_curve(), epsilon=np.linspace(0.3, 0.3 + spread, 12), unstable_roots=roots
        )
        for name, spread in (("a", with_tau), ("b", with_xi))
    }
    return {"curves": curves}


@cases(
    (
        # stable without delay and unstable at some delay, in one scene at least
        *("hopf_by_delay", {"scenes": ["a", "b"]}),
        (changing(LOST, REGAINED), YES, "at $tau = 2$."),
        (changing(np.nan, REGAINED), NO, "No pair crosses the axis in a ($epsilon"),
        (changing(REGAINED, REGAINED), NO, "unstable without delay in a ($epsilon"),
    ),
    (
        # a point without delay refutes "only by", in its own plane; "merely by" needs a scene
        *("hopf_only_by_delay", {"plane": "plane", "scenes": ["a", "b"]}),
        (with_points(), PARTLY, "Read as 'merely by a delay' it holds."),
        (with_points(of="other"), YES),
        (with_points(kind="double_hopf"), YES),
    ),
    ("hopf_only_by_delay", {"plane": "plane", "scenes": ["b"]}, (with_points(), NO)),
    (
        # all of the kind, none, or some of another, where stability changes
        *("kinds_of_hopf", SUPERCRITICAL),
        (on_curve(l1=-0.1), YES),
        (on_curve(l1=0.1), NO),
        (on_curve(l1=MIXED), PARTLY),
        # a bifurcation beside other unstable roots is counted, not judged
        (on_curve(l1=MIXED, unstable_roots=np.where(FIRST, 2, 0)), YES),
        (on_curve(l1=-0.1, unstable_roots=2), NO),
    ),
    (
        *("kinds_of_hopf", {"planes": ["plane"], "expected": ["subcritical", "supercritical"]}),
        (on_curve(l1=MIXED), YES),
    ),
    (
        *("pairs_gained_and_lost", {"plane": "plane"}),
        (on_curve(crossing=np.where(FIRST, 1, -1)), YES),
        *((on_curve(crossing=1), NO), (on_curve(crossing=-1), NO)),
    ),
    (
        # on xi it must, on the delay it must not; without changes of stability on nothing
        *("hopf_depends_on", {"at_fixed_xi": "a", "at_fixed_tau": "b", "limit": 1e-3}),
        *((with_spreads(0.1, 0.1), PARTLY), (with_spreads(0.0, 0.1), YES)),
        *((with_spreads(0.1, 0.0), NO), (with_spreads(0.1, 0.1, 2), NO)),
    ),
)
def test_verdicts(case):
    assert_finding(*case)


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
    curves["unstable_roots"][curves.epsilon.values.argmax()] = 2
    curves["crossing"][:4] = -1
    curves["map_unstable_roots"] = (("map_y", "map_x"), [[0, 0], [0, 2]])
    kinds = ["double_hopf", "hopf_without_delay", "double_hopf"]
    curves["special_kind"] = ("special", np.array(kinds))
    curves["special_epsilon"] = ("special", [1.143, 0.28, 0.336])
    curves["special_tau"] = ("special", [3.343, 0.0, 13.4])
    found = drawing.numbers(curves, {})
    assert (found["stabilising"], found["double"], found["without_delay"]) == (4, 2, [0.28])
    ordered = np.sort(curves.epsilon.values)
    assert found["boundary"] == (short(ordered[0]), short(ordered[-2]))
