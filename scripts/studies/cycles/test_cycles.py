"""Special points of cycles: the table, verdicts and the figure, mostly from made-up lines."""

import numpy as np
import pytest
from made_up_results import (
    LINES,
    NO,
    PARTLY,
    PLACE,
    YES,
    assert_finding,
    attractor_row,
    cases,
    cycles_to_a_torus,
    finding,
    followed_cycles,
    route_rows,
    stability_row,
    torus_point,
)
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from scripts.drawing.special_points import STYLES
from scripts.models.models import PAPER
from scripts.studies.cycles import figure as cycles
from scripts.studies.cycles.branches import branch_of, cycles_there, smooth_curve
from scripts.studies.cycles.plan import sweeps_on_lines
from scripts.studies.cycles.table import COLUMNS, rows_of, sweeps_over

pytestmark = pytest.mark.usefixtures("styled")


def sweep(*motions: tuple[str, float], run: str = "up", **given) -> list[dict]:
    """Rows of a sweep at 0.2, 0.3 and so on: class, with points in the section behind a /."""
    rows = route_rows(*(met for met, _ in motions), run=run)[::-1]
    return [
        {**row, "tau": round(row["tau"] + 0.1, 1), "largest_maximum": most, **given}
        for row, (_, most) in zip(rows, motions, strict=True)
    ]


ANOTHER_CYCLE = sweep(("cycle/1", 3.0), ("cycle/1", 3.1))


@pytest.mark.parametrize(
    ("rows", "word"),
    [
        (sweep(("cycle/1", 1.2), ("torus", 1.4)), "yes"),
        (ANOTHER_CYCLE + sweep(("cycle/1", 1.2), ("torus", 1.4), run="down"), "yes"),
        (sweep(("cycle/1", 1.2), ("cycle/1", 1.5)), "yes"),
        (sweep(("cycle/1", 1.2), ("cycle/1", 1.25)), "no"),
        (sweep(("cycle/1", 1.3), ("torus", 1.4)), "not simulated"),
        (sweep(("cycle/1", 1.2), ("undecided", 1.4)), "not simulated"),
        (sweep(("cycle/1", 1.2), ("torus", 1.4), xi=0.5), "not simulated"),
        (sweep(("cycle/1", 1.2), ("torus", 1.4), run="near"), "not simulated"),
        ([], "not simulated"),
    ],
)
def test_confirmed_by_a_sweep(rows, word):
    """The sweep follows the stable cycle up to the point, and leaves it beyond."""
    cycles = cycles_to_a_torus()
    (row,) = rows_of("mine", cycles, sweeps_over(cycles, rows))
    assert row["confirmed"] == word


def test_a_point_of_unstable_cycles_is_not_simulated():
    """No simulation stays on them."""
    cycles = cycles_to_a_torus()
    cycles["unstable"] = cycles.unstable + 1
    for side in ("before", "behind"):
        cycles[f"special_unstable_{side}"] = cycles[f"special_unstable_{side}"] + 1
    rows = sweep(("cycle/1", 1.2), ("torus", 1.4))
    (row,) = rows_of("mine", cycles, rows)
    assert row["confirmed"] == "not simulated"


def test_columns_of_a_torus_point():
    """The coefficient, its error and the amplitude are empty where they were not found."""
    cycles = cycles_to_a_torus()
    (row,) = rows_of("mine", cycles, [])
    assert set(row) == set(COLUMNS)
    assert (row["tau"], row["angle"], row["resonance"]) == ("0.25", "0.24", "1:4")
    keys = ("criticality", "coefficient", "coefficient_error", "amplitude")
    assert [row[key] for key in keys] == ["supercritical", "-0.1234568", "3.2e-10", "0.5432"]
    cycles["special_criticality"] = ("special", ["not determined"])
    for key in keys[1:]:
        cycles[f"special_{key}"] = ("special", [float("nan")])
    (row,) = rows_of("mine", cycles, [])
    assert [row[key] for key in keys] == ["not determined", "", "", ""]


def test_a_cusp_lies_beside_the_line():
    """A cusp has parameters and errors, but neither branch nor stability."""
    row = rows_of("mine", cycles_to_a_torus(cusps=1), [])[1]
    place = {"tau": "3.5", "epsilon": "0.5", "xi": "0.8", "gamma": "0.8"}
    assert row == {
        **{"of": "mine", "kind": "cusp", "period": "9", "v_most": "2.5", **place, "law": PAPER},
        **{"confirmed": "not simulated", "multiplier_error": "0.0001", "mesh_error": "1e-10"},
    }


def test_cycles_at_a_value_of_the_parameter():
    """Between the points of a branch; a closed one ends at its first orbit."""
    found = cycles_there(cycles_to_a_torus(), 0.24)
    assert [(cycle.unstable, round(cycle.most, 9)) for cycle in found] == [(0, 1.24)]
    assert found[0].modulus == pytest.approx(0.98)
    closed = followed_cycles()
    closed["multiplier_real"] = (("orbit", "multiplier"), [[0.5]] * 10)
    closed["multiplier_imaginary"] = (("orbit", "multiplier"), [[0.0]] * 10)
    both = [cycle for cycle in cycles_there(closed, 0.65) if cycle.branch == 2]
    assert [round(cycle.most, 9) for cycle in both] == [2.05, 2.55]
    assert [cycle.unstable for cycle in both] == [0, 0]


def at_scene(met: str, tau: float, **given) -> dict:
    """Results of a scene with this class and delay, of a line through it and a torus point."""
    return {
        "attractors": [attractor_row(met)],
        "linear_stability": [stability_row(**{**PLACE, "tau": tau})],
        "cycles": {"mine": cycles_to_a_torus()},
        "cycle_points": [torus_point()],
        **given,
    }


@cases(
    (
        # a run that ends on a torus, where no cycle is stable: the special point parts the orbits
        *("torus_of_scene", {"scene": "mine"}),
        *((at_scene("torus", 0.35), YES), (at_scene("torus", 0.24), PARTLY)),
        *((at_scene("cycle", 0.15), NO), (at_scene("chaos", 0.35), NO)),
    ),
    (
        *("second_hopf", {"scene": "mine"}),
        (at_scene("torus", 0.35), YES),
        (at_scene("torus", 0.15), NO, "scene: at $tau = 0.25$ along $tau$ ($epsilon = 0.5$"),
        (at_scene("chaos", 0.35), NO),
        (at_scene("torus", 0.35, cycle_points=[]), NO, "scene: none along $tau$"),
        (at_scene("torus", 0.35, cycle_points=[torus_point(kind="fold")]), NO),
        (at_scene("torus", 0.35, cycle_points=[torus_point(unstable_before=2.0)]), NO),
        (at_scene("torus", 0.35, cycles={"mine": cycles_to_a_torus(xi=0.5)}), NO, "scene: none."),
    ),
)
def test_verdicts(case):
    assert_finding(*case)


def test_where_a_second_hopf_bifurcation_is_instead():
    found = finding("second_hopf", at_scene("torus", 0.15), scene="mine")
    assert found.instead == "With all other parameters the same it occurs at $tau = 0.25$."


STABLE, ONE, TWO, MANY = (style["color"] for style in cycles.LINES)


@pytest.fixture
def cycles_drawn() -> Figure:
    return cycles.draw([followed_cycles("tau"), followed_cycles("epsilon")], [], [[], []], {})


def labelled(axes: Axes, label: str) -> list[Line2D]:
    return [line for line in axes.lines if line.get_label() == label]


def test_branches_change_their_line_at_special_points(cycles_drawn):
    """Each part ends at the point where its number of unstable multipliers changes."""
    # the line is smooth: every eighth of its points is an orbit
    parts = [
        (line.get_color(), [tuple(point) for point in line.get_xydata()[::8].round(12)])
        for line in cycles_drawn.axes[0].lines
        if line.get_label() in {style["label"] for style in cycles.LINES}
    ]
    assert parts == [
        (TWO, [(0.1, 1.1), (0.3, 1.5), (0.4, 2.0), (0.45, 2.2)]),
        (MANY, [(0.45, 2.2), (0.4, 2.5), (0.35, 2.8), (0.3, 3.0)]),
        (ONE, [(0.3, 3.0), (0.2, 3.5)]),
        (STABLE, [(0.6, 2.0), (0.7, 2.1)]),
        (ONE, [(0.7, 2.1), (0.8, 2.0), (0.8, 2.5), (0.7, 2.6)]),
        (STABLE, [(0.7, 2.6), (0.6, 2.5), (0.6, 2.0)]),
    ]


def test_a_change_without_a_point_is_drawn_between_orbits():
    """A point that the search did not find moves no other point."""
    found = followed_cycles().isel(special=[0])
    x, y, unstable = branch_of(found, 1)
    assert x.tolist() == [0.1, 0.3, 0.4, 0.45, 0.4, 0.35, 0.2]
    assert y.tolist() == [1.1, 1.5, 2.0, 2.2, 2.5, 2.8, 3.5]
    assert unstable.tolist() == [2, 2, 2, 3, 3, 3]


def test_lines_between_few_orbits_are_smooth():
    """Nine points of a circle, one of them twice: their chords are 4.3 % off it."""
    turns = np.sort([*np.linspace(0.0, 0.75, 9), 0.375]) * 2.0 * np.pi
    x, y = smooth_curve(np.cos(turns), np.sin(turns), 8)
    np.testing.assert_allclose(np.hypot(x, y), 1.0, rtol=0.0, atol=0.009)
    np.testing.assert_allclose([x[::8], y[::8]], [np.cos(turns), np.sin(turns)], atol=1e-14)


def test_special_points_have_markers_by_kind(cycles_drawn):
    expected = {
        "fold": ("fold", [[0.45, 2.2]]),
        "torus bifurcation": ("torus", [[0.3, 3.0]]),
        "period doubling": ("period_doubling", [[0.7, 2.1], [0.7, 2.6]]),
    }
    for axes in cycles_drawn.axes:
        for label, (kind, places) in expected.items():
            (points,) = labelled(axes, label)
            assert points.get_marker() == STYLES[kind][0]
            assert points.get_xydata().tolist() == places
        (hopf,) = labelled(axes, "Hopf point")
        assert hopf.get_xydata().tolist() == [[0.1, 1.0]]


def test_sweeps_on_lines_are_found_by_their_parameters(own_config):
    """Those of routes with the same law, parameter and fixed values."""
    config = own_config
    config["cycles"]["lines"] = LINES
    config["routes"]["lines"]["part"] = {**LINES["mine"], "window": [5.8, 6.1]}
    folder = "<results>/attractors/routes"
    mine, *others, across, in_xi = sweeps_on_lines(config)
    assert mine == [f"{folder}/chaos_in_tau/up.nc", f"{folder}/chaos_in_tau/down.nc"]
    assert across == [f"{folder}/chaos_in_epsilon/up.nc", f"{folder}/chaos_in_epsilon/down.nc"]
    assert [*others, in_xi] == [[]] * 4
