"""Routes: verdicts and captions on made-up tables, and namelists."""

import math
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from figure_contents import assert_on_page
from made_up_results import (
    NO,
    PARTLY,
    YES,
    Results,
    attractor_row,
    changed,
    hopf_curve,
    of_other_model,
    route_rows,
    stability_row,
    survey_run,
    torus_point,
)

from scripts.drawing.write_captions import render
from scripts.namelists.laws import PAPER
from scripts.namelists.parameters import HISTORY
from scripts.page.captions import as_html
from scripts.plans import studies
from scripts.studies.routes import figure, plan
from scripts.studies.routes.claims import (
    chaos_by_a_and_b,
    delays_in_turn,
    independent_of_spring,
    leads_to,
    quasiperiodic_route,
    route,
    torus_route,
    two_supercritical_hopfs,
)
from scripts.tables.attractor_tables import route_rows as route_rows_of
from scripts.tables.motion_rows import UNDECIDED

CYCLE_TORUS = {"routes": ["mine"], "expected": ["cycle", "torus"]}
BREAKDOWN, STRICT = ["cycle", "torus", "chaos"], ["torus", "3-torus", "chaos"]


def twice(*classes: str, **given) -> list[dict]:
    """Rows of a route with each class at two neighbouring points."""
    return route_rows(*(name for name in classes for _ in range(2)), **given)


@pytest.mark.parametrize(
    ("classes", "verdict"),
    [
        (["fixed point", "cycle", "torus", "chaos"], YES),
        (["cycle", UNDECIDED, "torus", UNDECIDED, "chaos", "cycle"], YES),
        (["cycle", "chaos", "cycle", "torus", "chaos"], YES),
        (["cycle", "torus", "cycle/7", "chaos"], YES),
        (["cycle", "torus", "cycle/1", "chaos"], NO),
        (["cycle/1", "cycle/2", "cycle/4", "chaos"], NO),
        ([UNDECIDED], NO),
    ],
)
def test_route(classes, verdict):
    """Classes follow each other; a cycle of several points behind a torus is locked there."""
    made = Results(routes=twice(*classes))
    assert route(made, routes=["mine"], expected=BREAKDOWN).verdict == verdict


def test_one_point_decides_nothing():
    """Unless another run has the same class there."""
    classes = ["cycle", "cycle", "torus", "chaos", "chaos"]
    rows = route_rows(*classes)
    assert route(Results(routes=rows), **CYCLE_TORUS).verdict == NO
    found = route(Results(routes=rows + route_rows(*classes, run="up")), **CYCLE_TORUS)
    assert found.verdict == YES
    assert "cycle 0.1 to 0.2, torus 0.3; in 2 of 2 runs." in found.evidence


def test_one_route_of_several_is_enough():
    rows = twice("cycle", "torus") + twice("cycle", "chaos", name="other")
    found = route(Results(routes=rows), **(CYCLE_TORUS | {"routes": ["other", "mine"]}))
    assert found.verdict == YES
    assert "in none of 1 runs. Along $tau$" in found.evidence


@pytest.mark.parametrize(
    ("first", "second", "verdict"),
    [
        (("cycle", "chaos"), ("torus", "fixed point", "chaos"), YES),
        (("cycle", "chaos"), ("chaos", "cycle"), PARTLY),
        (("chaos",), ("chaos", "cycle"), NO),
    ],
)
def test_leads_to(first, second, verdict):
    rows = twice(*first) + twice(*second, name="other", along="xi")
    before = ["cycle", "fixed point"]
    found = leads_to(Results(routes=rows), routes=["mine", "other"], before=before, after="chaos")
    assert found.verdict == verdict
    assert ("cycle 0.1 to 0.2, chaos 0.3 to 0.4" in found.evidence) == (first == ("cycle", "chaos"))


@pytest.mark.parametrize(
    ("met", "delays", "along", "points", "verdict"),
    [
        (["cycle", "torus"], [0.1, 7.0], ["chaos"], [], YES),
        (["cycle", "torus"], [7.0, 7.0], ["cycle", "torus"], [torus_point()], PARTLY),
        (["cycle", "cycle"], [0.1, 7.0], ["cycle", "torus"], [torus_point()], PARTLY),
        (["cycle", "cycle"], [0.1, 7.0], ["cycle", "torus"], [], NO),
        (["cycle", "cycle"], [0.1, 7.0], ["cycle"], [torus_point()], NO),
    ],
)
def test_delays_in_turn(met, delays, along, points, verdict):
    """By the scenes and their delays, or by a route with a torus bifurcation."""
    made = Results(
        attractors=[attractor_row(name, scene) for name, scene in zip(met, "ab", strict=True)],
        linear_stability=[
            stability_row(scene, tau=tau) for scene, tau in zip("ab", delays, strict=True)
        ],
        routes=twice(*along),
        cycle_points=points,
    )
    claim = {"scenes": ["a", "b"], "expected": ["cycle", "torus"], "route": "mine"}
    found = delays_in_turn(made, **claim)
    assert found.verdict == verdict
    assert ("These delays grow" in found.evidence) == (delays[0] < delays[1])


@pytest.mark.parametrize(
    ("point", "verdict"),
    [
        (torus_point(), YES),
        (torus_point(0.15), NO),
        (torus_point(xi=0.5), NO),
        (torus_point(kind="period_doubling"), NO),
        (torus_point(unstable_before=1.0), NO),
    ],
)
def test_torus_route(point, verdict):
    """Cycle, torus and chaos in turn, and a torus bifurcation between cycle and torus."""
    made = Results(routes=twice(*BREAKDOWN), cycle_points=[point])
    found = torus_route(made, routes=["mine"], expected=BREAKDOWN)
    assert found.verdict == verdict
    known = f"multipliers of a stable cycle leaves the unit circle at $tau = {point['tau']}$."
    there = point["kind"] == "torus" and point["xi"] == 0.8 and not point["unstable_before"]
    assert (known in found.evidence) == there


@pytest.mark.parametrize(
    ("first", "second", "verdict"),
    [
        (BREAKDOWN, STRICT, YES),
        (BREAKDOWN, ["torus", "chaos"], PARTLY),
        (["cycle", *STRICT], ["chaos"], PARTLY),
        (["cycle", "chaos"], ["torus", "3-torus"], NO),
    ],
)
def test_quasiperiodic_route(first, second, verdict):
    """Torus breakdown and a third frequency, one of them, or neither."""
    rows = twice(*first) + twice(*second, name="other")
    rows += route_rows("torus", "cycle/42", "chaos", name="fine")
    rows += route_rows("torus", "cycle/42", "cycle/38", name="fine", run="up")
    made = Results(routes=rows, cycle_points=[torus_point()])
    found = quasiperiodic_route(made, routes=["mine", "other"], fine="fine")
    assert found.verdict == verdict
    locked = "cycle with 42 loops in 2 runs at 0.2; chaos in 1 runs, cycle with 38 loops in 1 runs"
    assert locked in found.evidence


@pytest.mark.parametrize(
    ("l1", "points", "verdict"),
    [
        (-0.1, [torus_point()], YES),
        (0.1, [torus_point()], NO),
        (-0.1, [torus_point(criticality="subcritical")], NO),
        (-0.1, [], NO),
        (-0.1, [torus_point(), torus_point(epsilon=0.4)], YES),
    ],
)
def test_two_supercritical_hopfs(l1, points, verdict):
    """That of steady sliding and all torus bifurcations of stable cycles on the line."""
    curves = {"a": hopf_curve(), "b": changed(hopf_curve(xi=0.8), l1=l1)}
    made = Results(curves=curves, routes=twice("cycle", "torus"), cycle_points=points)
    found = two_supercritical_hopfs(made, routes=["mine"], planes=["a", "b"])
    assert found.verdict == verdict


@pytest.mark.parametrize(
    ("in_epsilon", "in_xi", "verdict"),
    [
        (["cycle", "chaos"], ["chaos", "cycle"], YES),
        (["cycle", "chaos"], ["cycle", "chaos"], PARTLY),
        (["chaos", "cycle"], ["chaos", "cycle"], PARTLY),
        (["chaos"], ["cycle", "chaos"], NO),
    ],
)
def test_chaos_by_a_and_b(in_epsilon, in_xi, verdict):
    """B alone raises epsilon, A and B in proportion lower xi."""
    rows = twice(*in_epsilon, name="one", along="epsilon") + twice(*in_xi, name="two", along="xi")
    assert chaos_by_a_and_b(Results(routes=rows), routes=["one", "two"]).verdict == verdict


@pytest.mark.parametrize(
    ("given", "classes", "verdict"),
    [
        ({"epsilon": 0.3}, ["chaos"] * 4, YES),
        ({}, ["chaos"] * 4, NO),
        ({"epsilon": 0.3}, ["cycle"] * 2 + ["chaos"] * 2, NO),
        ({"unstable_roots": 2}, ["chaos"] * 4, NO),
    ],
)
def test_independent_of_spring(given, classes, verdict):
    """The same epsilon and class at every xi, or one that changes; or no such point at all."""
    curves = changed(hopf_curve(), xi=np.linspace(0.1, 1, 12), tau=12.0)
    made = Results(
        curves={"plane": changed(curves, **given)}, routes=route_rows(*classes, along="xi")
    )
    found = independent_of_spring(made, plane="plane", route="mine", limit=1e-3)
    assert found.verdict == verdict


def words_of_caption(rows: list[dict], run: xr.Dataset) -> str:
    """The caption of a user's route, whose runs say the same of their model."""
    text = (studies.FOLDER / "routes" / "caption.rst").read_text()
    numbers = figure.numbers([rows], [run])
    return " ".join(render(text, None, paper=False, **numbers).split())


def test_caption_of_a_route():
    """Where classes first appear, runs that agree, and where motions coexist."""
    kept = {"smallest_maximum": 2.0, "largest_maximum": 3.0, "problem": math.nan}
    kept |= {"exponent_1": 0.02, "error_1": 0.001}
    rows = [
        row | kept
        for run, last in (("near", "chaos"), ("slip", "torus"), ("up", "chaos"))
        for row in route_rows("cycle/1", "torus", "cycle/2", "undecided", last, run=run)
    ]
    # a cycle of another size
    rows[7] |= {"smallest_maximum": 4.0, "largest_maximum": 5.0}
    words = words_of_caption(rows, survey_run(["cycle"]))
    assert "15 points. In runs near and up each class first appears at this value" in words
    assert "maxima of v on the attractor." in words
    assert "motions at 2 of 5 values of :math:`\\tau`: 0.3 and 0.5." in words


def test_letters_of_routes_are_no_numbers_of_a_list(tmp_path):
    """The table of the paper's routes: a letter in brackets begins a list in reStructuredText."""
    run = survey_run(["cycle", "chaos"], epsilon=[0.1, 0.2], period=[1, 0])
    given = figure.numbers([route_rows_of(Path("mine/own.nc"), run)], [run])
    text = (studies.FOLDER / "routes" / "caption.rst").read_text()
    path = tmp_path / "routes.rst"
    path.write_text(render(text, None, paper=True, **given))
    assert "<p>(a)</p>" in as_html(path)


def test_caption_of_a_route_of_a_model_that_is_not_the_block():
    run = of_other_model(survey_run(["cycle", "chaos"], epsilon=[0.1, 0.2], period=[1, 0]))
    run.attrs["axes"] = "beta"
    rows = route_rows_of(Path("mine/own.nc"), run)
    words = words_of_caption(rows, run)
    place = r":math:`\tau = 1`, model mackey glass (n = 10)"
    assert words.startswith(rf"Route along :math:`\beta` at {place}: 2 points.")
    assert "maxima of y on the attractor." in words


@pytest.mark.usefixtures("styled")
def test_runs_of_many_routes_differ_and_are_on_a_page():
    """Six runs have six colours. Both sweeps have a line through their largest maxima."""
    names = ["near", "slip", "fast", "slow", "up", "down"]
    kept = {"exponent_1": 0.02, "error_1": 0.001, "problem": ""}
    rows = [row | kept for run in names for row in route_rows("cycle/1", "torus", run=run)]
    run = survey_run(["cycle", "torus"], tau=[0.1, 0.2])
    run["maximum"] = (("point", "number"), [[1.0, 2.0], [3.0, 2.0]])
    run.attrs["signal"] = "v"
    drawn = figure.draw([rows] * 7, [run] * 42, {})
    handles = drawn.legends[0].legend_handles[: len(names)]
    assert [handle.get_label() for handle in handles] == names
    assert len({handle.get_color() for handle in handles}) == len(names)
    lines = [line for line in drawn.axes[0].lines if line.get_linestyle() != "None"]
    assert [line.get_linestyle() for line in lines] == ["-", "--"]
    assert [list(line.get_ydata()) for line in lines] == [[2.0, 3.0]] * 2
    assert_on_page(drawn)


@pytest.mark.parametrize(("run", "sweep"), [("near", "none"), ("slip", "none"), ("up", "up")])
def test_runs_of_a_route_go_along_its_parameter(own_config, run, sweep):
    """Three values are fixed; sweeps start from the first history."""
    routes = own_config["routes"]
    groups = plan.groups(own_config, "chaos_in_epsilon", run)
    points, line = groups["points"], routes["lines"]["chaos_in_epsilon"]
    assert points["sweep"] == sweep
    count = line["count"]
    axis = {"along": "epsilon", "window": line["window"], "count": count, "part": [1, count]}
    assert points["axes"] == [axis]
    model = {"name": PAPER, "parameters": ["tau", "xi", "gamma"], "values": [7.0, 0.5, 0.8]}
    assert points["model"] == model
    history = routes["histories"].get(run, routes["histories"]["near"])
    assert groups["histories"] == {"names": HISTORY, "values": [history[key] for key in HISTORY]}
    assert groups["observation"].items() >= own_config["spectra"].items()
    assert (points["refinements"], points["kept"]) == (0, routes["observation"]["kept"])


def test_route_along_a_value_of_the_history(own_config):
    """One set of parameters and a history for each value; there are no sweeps."""
    line = {"along": "v", "window": [0.5, 1.5], "count": 3, "tau": 7.0, "epsilon": 0.5}
    own_config["routes"]["lines"]["mine"] = line | {"xi": 0.5, "gamma": 0.8, "law": PAPER}
    groups = plan.groups(own_config, "mine", "slip")
    points, histories = groups["points"], groups["histories"]
    theta, u = (own_config["routes"]["histories"]["slip"][key] for key in ("theta", "u"))
    assert histories["names"] == HISTORY
    assert histories["values"] == [theta, u, 0.5, theta, u, 1.0, theta, u, 1.5]
    assert "axes" not in points
    assert points["sweep"] == "none"
    names = [path.split("/")[-1] for path in plan.runs_of_route(own_config, "mine")]
    assert names == ["near.nc", "slip.nc"]
