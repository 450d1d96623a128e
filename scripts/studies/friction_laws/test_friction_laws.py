"""Other laws of friction: the finding, from a made-up table."""

import pytest

from scripts.studies.friction_laws.finding import describe


@pytest.mark.parametrize("holds", [True, False])
def test_finding_follows_the_table(holds):
    """The title says the opposite if the results do."""
    plane = {"gamma": 0.8, "xi": 0.5, "of": "plane", "place": "a", "period": 1.0}
    laws = {
        "slip_delayed_logarithm": "chaos",
        "ageing_delayed_velocity": "cycle" if holds else "chaos",
    }
    rows = [{**plane, "law": law, "class": kind} for law, kind in laws.items()]
    found = describe({"friction_laws": rows})
    assert "points a plane and from one history, whether" in found["title"]
    assert ("not on the law of friction" in found["title"]) is holds
    assert f"points if the delay stands in the logarithm, and {1 - holds} if" in found["words"]
