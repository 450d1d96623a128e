"""Namelists of routes."""

import pytest

from scripts.namelists.laws import PAPER
from scripts.namelists.parameters import HISTORY
from scripts.studies.routes import plan


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
