"""Other laws of friction: the finding and verdicts, from a made-up table."""

import pytest
from made_up_results import NO, YES, assert_finding, cases

from scripts.studies.friction_laws.finding import describe


def of_laws(logarithm: str, velocity: str, **given) -> dict:
    """Results of a plane with one point under a law with each place of the delay."""
    plane = {"gamma": 0.8, "xi": 0.5, "of": "plane", "place": "a", "period": 1.0, **given}
    laws = {"slip_delayed_logarithm": logarithm, "ageing_delayed_velocity": velocity}
    return {"friction_laws": [{**plane, "law": law, "class": kind} for law, kind in laws.items()]}


def of_planes(*planes: dict) -> dict:
    return {"friction_laws": [row for plane in planes for row in plane["friction_laws"]]}


@cases(
    (
        *("place_of_delay_decides", {"gamma": 0.8}),
        (
            of_laws("chaos", "cycle"),
            YES,
            "0 (ageing delayed velocity), 1 (slip delayed logarithm).",
        ),
        *((of_laws("chaos", "chaos"), NO), (of_laws("cycle", "cycle"), NO)),
        (of_laws("chaos", "cycle", gamma=1e4), NO),
        (of_planes(of_laws("chaos", "cycle"), of_laws("cycle", "cycle", xi=0.8)), NO),
        (of_laws("chaos", "cycle", of="scene"), NO, "Scene a: chaos (slip delayed logarithm), cyc"),
    ),
)
def test_verdicts(case):
    assert_finding(*case)


@pytest.mark.parametrize("holds", [True, False])
def test_finding_follows_the_table(holds):
    """The title says the opposite if the results do."""
    found = describe(of_laws("chaos", "cycle" if holds else "chaos"))
    assert "points a plane and from one history, whether" in found["title"]
    assert ("not on the law of friction" in found["title"]) is holds
    assert f"points if the delay stands in the logarithm, and {1 - holds} if" in found["words"]
