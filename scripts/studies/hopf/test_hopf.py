"""Special points of Hopf curves in equation (5); the table, captions, verdicts.

The suite hopf_curves shows that curves are those of the closed form, complete and smooth, and which
way roots cross; the suite hopf_points shows where curves of folds and of tori start.
"""

import numpy as np
import pytest
import xarray as xr
from characteristic_equation import residual
from made_up_results import NO, PARTLY, YES, assert_finding, cases, changed, changing, hopf_curve
from matplotlib import pyplot as plt

from scripts.drawing.wording import short
from scripts.drawing.write_captions import render
from scripts.files.tsv import read_table, rows_by
from scripts.plans import studies
from scripts.studies.hopf import figure as drawing
from scripts.studies.hopf.table import rows_of

PLANES = ["tau_of_epsilon", "xi_of_epsilon"]


@pytest.fixture(params=PLANES)
def plane(request, filled_config) -> dict:
    """Settings of a plane as in the config."""
    return filled_config["hopf_curves"][request.param] | {"cells": 20}


@pytest.fixture
def curves(programs, plane) -> xr.Dataset:
    return programs.made_by("hopf", plane)


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


def test_points_without_l1_are_of_no_kind(smoke):
    """As where delays depend on the states: dots, and a sentence."""
    curves = xr.load_dataset(smoke.folder / "results" / "hopf" / "tau_of_epsilon.nc")
    whole = curves.assign(l1=np.nan * curves.l1)
    figure = drawing.draw(whole, {})
    drawn = {line.get_linestyle() for line in figure.axes[0].lines if len(line.get_xdata()) > 1}
    words = [text.get_text() for text in figure.legends[0].get_texts()]
    assert drawn - {"None"} == {":"}
    assert "l1 unknown" in words
    assert "subcritical" not in words
    plt.close(figure)
    text = (studies.FOLDER / "hopf" / "caption.rst").read_text()
    caption = render(text, [], paper=False, **drawing.numbers(whole, {}))
    assert "supercritical at\n0 of" in caption
    assert "this is not known (dotted lines)" in caption


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
