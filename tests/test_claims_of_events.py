"""Verdicts on slip events, on made-up ones."""

import numpy as np
import pytest
from made_up_results import results, slip_events

from scripts.claims.claims_of_events import FEWEST, TESTS
from scripts.claims.claims_results import NOT_REPRODUCED, REPRODUCED

RANDOM = np.random.default_rng(1).uniform(4.0, 12.0, 1000)
CYCLE = np.full(1000, 8.0)
PERIOD_3 = np.tile([4.0, 8.0, 12.0], 300)
TORUS = 8 + np.sin(2 * np.pi * 0.25 * np.arange(1000) + 1e-9 * np.arange(1000))


def aperiodic(times, of_cycle=CYCLE):
    """The finding on these recurrence times beside those of a cycle."""
    made = {"mine": slip_events(recurrence_time=times)}
    made["cycle"] = slip_events(recurrence_time=of_cycle)
    return TESTS["aperiodic_events"](results(slip_events=made), scene="mine", periodic="cycle")


@pytest.mark.parametrize(
    ("times", "of_cycle", "verdict"),
    [
        (RANDOM, CYCLE, REPRODUCED),
        (RANDOM, PERIOD_3, REPRODUCED),
        (CYCLE, CYCLE, NOT_REPRODUCED),
        (PERIOD_3, CYCLE, NOT_REPRODUCED),
        (TORUS, CYCLE, NOT_REPRODUCED),
        (RANDOM, RANDOM, NOT_REPRODUCED),
        (RANDOM[: FEWEST - 1], CYCLE, NOT_REPRODUCED),
    ],
)
def test_aperiodic_events(times, of_cycle, verdict):
    """Times that vary and repeat are periodic; a few times are no evidence."""
    assert aperiodic(times, of_cycle).verdict == verdict


def test_variation_in_words():
    """Uniform between 4 and 12: a standard deviation of 8/sqrt(12), over a mean of 8."""
    even = np.linspace(4.0, 12.0, 10001)
    words = aperiodic(np.random.default_rng(2).permutation(even), PERIOD_3).evidence
    assert "has 10001 events. The mean recurrence time is 8 L/v0, with a coefficient" in words
    assert (
        "variation of 28.9 %. The mean slip is 6 L, with a coefficient of variation of 0 %" in words
    )
    assert "repeats best after 3 events, with differences of 0 % of the mean." in words


@pytest.mark.parametrize(
    ("times", "verdict"),
    [
        (CYCLE, REPRODUCED),
        (np.tile([8.0, 8.1], 100), NOT_REPRODUCED),
        (RANDOM, NOT_REPRODUCED),
        (CYCLE[: FEWEST - 1], NOT_REPRODUCED),
    ],
)
def test_equal_events(times, verdict):
    """In every scene; a doubled period is the beginning of a cascade."""
    made = {"a": slip_events(recurrence_time=CYCLE), "b": slip_events(recurrence_time=times)}
    found = TESTS["equal_events"](results(slip_events=made), scenes=["a", "b"])
    assert found.verdict == verdict
    assert ("It is not found here" in found.evidence) == (verdict == REPRODUCED)


@pytest.mark.parametrize(
    ("given", "verdict"),
    [
        ({"peak_velocity": 1e3, "duration": 0.4}, REPRODUCED),
        ({"peak_velocity": 1e2, "duration": 0.4}, NOT_REPRODUCED),
        ({"peak_velocity": 1e3, "duration": 2.0}, NOT_REPRODUCED),
        ({"peak_velocity": np.array([1e3, 1e3, 2.0]), "duration": 0.4}, NOT_REPRODUCED),
        ({"peak_velocity": np.array([])}, NOT_REPRODUCED),
    ],
)
def test_relaxation(given, verdict):
    """Every event must be large and short, in one scene at least."""
    made = results(slip_events={"small": slip_events(), "mine": slip_events(**given)})
    test = TESTS["relaxation"]
    found = test(made, scenes=["small", "mine"], ratio=1e3, stick=0.9)
    assert found.verdict == verdict
    assert "Scene small (tau = 7, gamma = 0.8) has 200 events." in found.evidence
    assert "nan" not in found.evidence
