"""Verdicts on slip events, on made-up ones."""

import numpy as np
import pytest
from made_up_results import NO, YES, Results, cycles_to_a_torus, slip_events

from scripts.studies.events.claims import (
    FEWEST,
    aperiodic_events,
    periodic_without_delay,
    relaxation,
)

RANDOM = np.random.default_rng(1).uniform(4.0, 12.0, 1000)
CYCLE = np.full(1000, 8.0)
PERIOD_3 = np.tile([4.0, 8.0, 12.0], 300)
TORUS = 8 + np.sin(2 * np.pi * 0.25 * np.arange(1000) + 1e-9 * np.arange(1000))


def aperiodic(times, of_cycle=CYCLE):
    """The finding on these recurrence times beside those of a cycle."""
    made = {"mine": slip_events(recurrence_time=times)}
    made["cycle"] = slip_events(recurrence_time=of_cycle)
    return aperiodic_events(Results(slip_events=made), scene="mine", periodic="cycle")


@pytest.mark.parametrize(
    ("times", "of_cycle", "verdict"),
    [
        (RANDOM, CYCLE, YES),
        (RANDOM, PERIOD_3, YES),
        (CYCLE, CYCLE, NO),
        (PERIOD_3, CYCLE, NO),
        (TORUS, CYCLE, NO),
        (RANDOM, RANDOM, NO),
        (RANDOM[: FEWEST - 1], CYCLE, NO),
    ],
)
def test_aperiodic_events(times, of_cycle, verdict):
    """Times that vary and repeat are periodic; a few times are no evidence."""
    assert aperiodic(times, of_cycle).verdict == verdict


@pytest.mark.parametrize(
    ("times", "verdict"),
    [(CYCLE, YES), (np.tile([8.0, 8.1], 100), NO), (RANDOM, NO), (CYCLE[: FEWEST - 1], NO)],
)
def test_events_without_delay(times, verdict):
    """Equal in every scene; a doubled period is the beginning of a cascade."""
    made = {"a": slip_events(recurrence_time=CYCLE), "b": slip_events(recurrence_time=times)}
    found = periodic_without_delay(Results(slip_events=made), scenes=["a", "b"])
    assert found.verdict == verdict
    assert ("It is not found here" in found.evidence) == (verdict == YES)


@pytest.mark.parametrize(
    ("tau", "unstable", "verdict"), [(0.0, 0, YES), (0.0, 2, NO), (1.0, 2, YES)]
)
def test_cycles_without_delay(tau, unstable, verdict):
    """One unstable orbit refutes; cycles with delay say nothing."""
    cycles = cycles_to_a_torus("epsilon", tau=tau)
    cycles = cycles.assign(unstable=("orbit", [0, 0, 0, unstable]))
    made = Results(slip_events={"a": slip_events()}, cycles={"line": cycles})
    found = periodic_without_delay(made, scenes=["a"])
    assert found.verdict == verdict
    count = "4" if unstable == 0 else "3"
    words = f"along $epsilon$ from 0.1 to 0.4: {count} of 4 orbits are stable"
    assert (words in found.evidence) == (tau == 0)


@pytest.mark.parametrize(
    ("given", "verdict"),
    [
        ({"peak_velocity": 1e3, "duration": 0.4}, YES),
        ({"peak_velocity": 1e2, "duration": 0.4}, NO),
        ({"peak_velocity": 1e3, "duration": 2.0}, NO),
        ({"peak_velocity": np.array([1e3, 1e3, 2.0]), "duration": 0.4}, YES),
        ({"peak_velocity": np.array([1e3, 2.0, 2.0]), "duration": 0.4}, NO),
        ({"peak_velocity": np.array([])}, NO),
    ],
)
def test_relaxation(given, verdict):
    """The median event must be large and the stick long, in one scene at least."""
    made = Results(slip_events={"small": slip_events(), "mine": slip_events(**given)})
    found = relaxation(made, scenes=["small", "mine"], ratio=1e3, stick=0.9)
    assert found.verdict == verdict
    assert "Scene small ($tau = 7$, $gamma = 0.8$) has 200 events." in found.evidence
    assert "nan" not in found.evidence
