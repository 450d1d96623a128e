"""Return maps: which event is paired with which time, and what is measured."""

import math

import numpy as np
import pytest
from made_up_results import slip_events

from scripts.studies.return_map import figure as return_map
from scripts.studies.return_map.table import FEWEST, measures_of, rows_of

WAITING = np.random.default_rng(1).uniform(4.0, 12.0, 1000)


def events_of(slip: np.ndarray):
    """Events with a slip whose duration grows with it, and a random time to the next one."""
    made = {"slip": slip, "duration": slip / 2, "recurrence_time": WAITING + slip / 2}
    return slip_events(**made).assign_attrs(scene="chaos")


BEFORE, AFTER = "slip_by_waiting", "waiting_by_slip"


@pytest.mark.parametrize(
    ("slip", "known", "other"), [(np.roll(WAITING, 1), BEFORE, AFTER), (WAITING, AFTER, BEFORE)]
)
def test_both_kinds_of_predictable_events(slip, known, other):
    """Slip equal to the time before, or after it: the other time is within five deviations of 0."""
    measures = {row["map"]: row for row in rows_of(events_of(slip))}
    n = measures[known]["pairs"]
    assert measures[known]["r"] == pytest.approx(1)
    assert measures[known]["dependence"] == pytest.approx((n - 2) / (n + 1))
    assert abs(measures[other]["r"]) < 5 / math.sqrt(n)
    assert abs(measures[other]["dependence"]) < 5 * 0.63 / math.sqrt(n)


def test_dependence_sees_a_curve_without_correlation():
    """Of a symmetric tent."""
    x = np.linspace(1.0, 2.0, 1001)
    measures = measures_of(x, 2.0 - np.abs(x - 1.5))
    assert measures["r"] == pytest.approx(0, abs=1e-12)
    assert measures["dependence"] > 0.99


def test_few_or_equal_events_have_no_correlation():
    """Events of a cycle differ by errors of the solver alone."""
    few, equal = np.arange(1.0, FEWEST), 6.0 + 1e-9 * np.arange(100)
    assert all(math.isnan(measures_of(slip, slip)["r"]) for slip in (few, few[:0], equal))


def test_figure_and_caption_of_a_scene_without_events():
    events = [events_of(WAITING), events_of(WAITING).isel(event=[]).assign_attrs(scene="mine")]
    table = [row for one in events for row in rows_of(one)]
    axes = return_map.draw(events, table, ["a", "b"]).axes[1]
    np.testing.assert_allclose(axes.lines[0].get_xydata(), np.column_stack([WAITING, WAITING]))
    assert axes.texts[0].get_text() == "$r = 1.00$, $D = 1.00$"
    told = return_map.numbers(events, table)
    assert [row[:3] for row in told["cells"][1:]] == [["mine", "0", "events equal or few"]]
    assert told["better"] == 0
