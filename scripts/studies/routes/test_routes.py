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
    assert_finding,
    attractor_row,
    cases,
    changed,
    hopf_curve,
    route_rows,
    stability_row,
    survey_run,
    torus_point,
)

from scripts.drawing.write_captions import render
from scripts.models.models import HISTORY, PAPER
from scripts.page.captions import as_html
from scripts.plans import studies
from scripts.studies.routes import figure, plan
from scripts.tables.attractor_tables import route_rows as route_rows_of
from scripts.tables.motion_rows import UNDECIDED

BREAKDOWN, STRICT = ["cycle", "torus", "chaos"], ["torus", "3-torus", "chaos"]
TWO_LOOPS = ["cycle", "cycle", "torus", "chaos", "chaos"]
CYCLE_TORUS, BEFORE = {"expected": ["cycle", "torus"]}, ["cycle", "fixed point"]


def on_routes(*lines: list[str], points: tuple = (), along: tuple = ("tau", "tau")) -> dict:
    """Results of one or two routes with each class at two neighbouring points."""
    rows = [
        row
        for classes, name, parameter in zip(lines, ("mine", "other"), along, strict=False)
        for row in route_rows(*(c for c in classes for _ in "ab"), name=name, along=parameter)
    ]
    return {"route_points": rows, "cycle_points": list(points)}


def at_points(*runs: str) -> dict:
    """Results of a route whose runs have one point of each class."""
    return {"route_points": [row for run in runs for row in route_rows(*TWO_LOOPS, run=run)]}


def breaking(*lines: list[str]) -> dict:
    """Results of two routes with a torus bifurcation, and of a fine one on which runs lock."""
    made = on_routes(*lines, points=(torus_point(),))
    made["route_points"] += route_rows("torus", "cycle/42", "chaos", name="fine")
    made["route_points"] += route_rows("torus", "cycle/42", "cycle/38", name="fine", run="up")
    return made


def with_hopf(l1: float, *points: dict) -> dict:
    """Results of routes in tau and epsilon with this coefficient, and torus bifurcations."""
    curves = {"a": hopf_curve(), "b": changed(hopf_curve(xi=0.8), l1=l1)}
    lines = on_routes(["cycle", "torus"], ["cycle"], points=points, along=("tau", "epsilon"))
    return {"curves": curves, **lines}


def with_scenes(met: list[str], delays: list[float], line: list[str], *points: dict) -> dict:
    """Results of two scenes with these classes and delays, and of a route."""
    return {
        "attractors": [attractor_row(kind, scene) for kind, scene in zip(met, "ab", strict=True)],
        "linear_stability": [stability_row("a", tau=delays[0]), stability_row("b", tau=delays[1])],
        **on_routes(line, points=points),
    }


def by_spring(*classes: str, **given) -> dict:
    """Results of a plane with any xi and of a route in xi."""
    curves = changed(hopf_curve(), xi=np.linspace(0.1, 1, 12), tau=12.0)
    rows = route_rows(*classes, along="xi")
    return {"curves": {"plane": changed(curves, **given)}, "route_points": rows}


@cases(
    (
        *("route", {"routes": ["mine"], "expected": BREAKDOWN}),
        (on_routes(["fixed point", *BREAKDOWN]), YES),
        (on_routes(["cycle", UNDECIDED, "torus", UNDECIDED, "chaos", "cycle"]), YES),
        (on_routes(["cycle", "chaos", *BREAKDOWN]), YES),
        # a cycle of several points behind a torus is locked there
        (on_routes(["cycle", "torus", "cycle/7", "chaos"]), YES),
        (on_routes(["cycle", "torus", "cycle/1", "chaos"]), NO),
        (on_routes(["cycle/1", "cycle/2", "cycle/4", "chaos"]), NO),
        (on_routes([UNDECIDED]), NO),
    ),
    (
        *("route", {"routes": ["mine"], **CYCLE_TORUS}),
        # one point decides nothing, unless another run has the same class there
        (at_points("near"), NO),
        (at_points("near", "up"), YES, "cycle 0.1 to 0.2, torus 0.3; in 2 of 2 runs."),
    ),
    (
        *("route", {"routes": ["mine", "other"], **CYCLE_TORUS}),
        (on_routes(["cycle", "chaos"], ["cycle", "torus"]), YES, "in none of 1 runs. Along $tau$"),
    ),
    (
        *("torus_route", {"routes": ["mine"], "expected": BREAKDOWN}),
        (on_routes(BREAKDOWN, points=[torus_point()]), YES, "unit circle at $tau = 0.25$."),
        (on_routes(BREAKDOWN, points=[torus_point(0.15)]), NO, "unit circle at $tau = 0.15$."),
        (on_routes(BREAKDOWN, points=[torus_point(xi=0.5)]), NO, "No torus bifurcation"),
        (on_routes(BREAKDOWN, points=[torus_point(kind="period_doubling")]), NO),
        (on_routes(BREAKDOWN, points=[torus_point(unstable_before=1.0)]), NO),
    ),
    (
        # torus breakdown and a third frequency, one of them, or neither
        *("quasiperiodic_route", {"routes": ["mine", "other"], "fine": "fine"}),
        (breaking(BREAKDOWN, STRICT), YES, "42 loops in 2 runs at 0.2; chaos in 1 runs, cycle"),
        (breaking(BREAKDOWN, ["torus", "chaos"]), PARTLY),
        (breaking(["cycle", *STRICT], ["chaos"]), PARTLY),
        (breaking(["cycle", "chaos"], ["torus", "3-torus"]), NO),
    ),
    (
        # that of steady sliding and all torus bifurcations of stable cycles on the line
        *("two_supercritical_hopfs", {"routes": ["mine"], "planes": ["a", "b"]}),
        (with_hopf(-0.1, torus_point()), YES),
        (with_hopf(0.1, torus_point()), NO),
        (with_hopf(-0.1, torus_point(criticality="subcritical")), NO),
        (with_hopf(-0.1), NO, "stable cycles: none."),
        (with_hopf(-0.1, torus_point(), torus_point(epsilon=0.4)), YES),
    ),
    (
        # the torus bifurcation is not on the other line
        *("two_supercritical_hopfs", {"routes": ["mine", "other"], "planes": ["a", "b"]}),
        (with_hopf(-0.1, torus_point()), PARTLY),
    ),
    (
        # B alone raises epsilon, A and B in proportion lower xi
        *("chaos_by_a_and_b", {"routes": ["mine", "other"]}),
        (on_routes(["cycle", "chaos"], ["chaos", "cycle"], along=("epsilon", "xi")), YES),
        (on_routes(["cycle", "chaos"], ["cycle", "chaos"], along=("epsilon", "xi")), PARTLY),
        (on_routes(["chaos", "cycle"], ["chaos", "cycle"], along=("epsilon", "xi")), PARTLY),
        (on_routes(["chaos"], ["cycle", "chaos"], along=("epsilon", "xi")), NO),
    ),
    (
        *("leads_to", {"routes": ["mine", "other"], "before": BEFORE, "after": "chaos"}),
        (on_routes(["cycle", "chaos"], ["torus", "fixed point", "chaos"]), YES, "0.2, chaos 0.3"),
        (on_routes(["cycle", "chaos"], ["chaos", "cycle"]), PARTLY, "cycle 0.1 to 0.2, chaos 0.3"),
        (on_routes(["chaos"], ["chaos", "cycle"]), NO, "in none of 1 runs."),
    ),
    (
        # by the scenes and their delays, or by a route with a torus bifurcation
        *("delays_in_turn", {"scenes": ["a", "b"], "route": "mine", **CYCLE_TORUS}),
        (with_scenes(["cycle", "torus"], [0.1, 7.0], ["chaos"]), YES, "These delays grow"),
        (with_scenes(["cycle", "torus"], [7.0, 7.0], ["cycle", "torus"], torus_point()), PARTLY),
        (with_scenes(["cycle", "cycle"], [0.1, 7.0], ["cycle", "torus"], torus_point()), PARTLY),
        (with_scenes(["cycle", "cycle"], [0.1, 7.0], ["cycle", "torus"]), NO),
        (with_scenes(["cycle", "cycle"], [7.0, 0.1], ["cycle"], torus_point()), NO, "do not grow"),
    ),
    (
        # the same epsilon and class at every xi, or one that changes; or no such point at all
        *("independent_of_spring", {"plane": "plane", "route": "mine", "limit": 1e-3}),
        (by_spring(*["chaos"] * 4, epsilon=0.3), YES),
        (by_spring(*["chaos"] * 4), NO),
        (by_spring(*["cycle"] * 2, *["chaos"] * 2, epsilon=0.3), NO),
        (by_spring(*["chaos"] * 4, unstable_roots=2), NO),
    ),
)
def test_verdicts(case):
    assert_finding(*case)


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
    assert groups["histories"] == {"names": [*HISTORY], "values": [history[key] for key in HISTORY]}
    assert groups["observation"].items() >= own_config["spectra"].items()
    assert (points["refinements"], points["kept"]) == (0, routes["observation"]["kept"])


def test_route_along_a_value_of_the_history(own_config):
    """One set of parameters and a history for each value; there are no sweeps."""
    line = {"along": "v", "window": [0.5, 1.5], "count": 3, "tau": 7.0, "epsilon": 0.5}
    own_config["routes"]["lines"]["mine"] = line | {"xi": 0.5, "gamma": 0.8, "law": PAPER}
    groups = plan.groups(own_config, "mine", "slip")
    points, histories = groups["points"], groups["histories"]
    theta, u = (own_config["routes"]["histories"]["slip"][key] for key in ("theta", "u"))
    assert histories["names"] == [*HISTORY]
    assert histories["values"] == [theta, u, 0.5, theta, u, 1.0, theta, u, 1.5]
    assert "axes" not in points
    assert points["sweep"] == "none"
    names = [path.split("/")[-1] for path in plan.runs_of_route(own_config, "mine")]
    assert names == ["near.nc", "slip.nc"]
