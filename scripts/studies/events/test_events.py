"""Slip events: the program against a trajectory, the figure, and verdicts on made-up events."""

import numpy as np
from made_up_results import NO, YES, assert_finding, cases, cycles_to_a_torus, slip_events
from scipy.integrate import solve_ivp

from scripts.studies.events import figure as events
from scripts.studies.events.claims import FEWEST


def stuck_cycle(epsilon: float, xi: float, gamma: float) -> tuple[float, float]:
    """Recurrence time and least velocity without delay, by scipy and, where v < e^-20, by hand.

    There theta' vanishes, u' = -1, and the inertial term of (3) is below v: ln v = -theta - xi u.
    """
    slow = np.exp(-20.0)

    def rates(_: float, state: np.ndarray) -> list[float]:
        theta, u, v = state
        friction = theta + np.log(max(v, 1e-12))
        steady = theta + (1 + epsilon) * np.log(max(v, 1e-12))
        return [-v * steady, v - 1, -(gamma**2) * (u + friction / xi)]

    def stops(_: float, state: np.ndarray) -> float:
        return state[2] - slow

    def slips(_: float, state: np.ndarray) -> float:
        return state[2] - 1

    stops.terminal, stops.direction, slips.direction = True, -1, 1
    time, state, onsets, least = 0.0, [0.0, 0.0, 1.1], [], 0.0
    for _ in range(4):
        run = solve_ivp(
            rates, (time, np.inf), state, "Radau", rtol=1e-9, atol=1e-10, events=[stops, slips]
        )
        onsets += list(run.t_events[1])
        theta, u, _ = run.y_events[0][0]
        log_v = -theta - xi * u
        stuck = (-20.0 - log_v) / xi
        time, state, least = run.t_events[0][0] + stuck, [theta, u - stuck, slow], np.exp(log_v)
    return float(onsets[-1] - onsets[-2]), float(least)


def test_stuck_block_is_that_of_another_solver(programs, good_inputs):
    """Where v falls to 1e-43 between events, the recurrence time is right to 1e-8."""
    parameters = {"epsilon": 11.0, "xi": 0.5, "gamma": 0.8}
    ends = {"tau": 0.0, "t_end": 4000.0, "t_transient": 2000.0, "tolerance": 1e-9}
    found = programs.made_by("slip_events", {**good_inputs["slip_events"], **parameters, **ends})
    recurrence_time, least_velocity = stuck_cycle(**parameters)
    assert found.sizes["event"] > 3
    np.testing.assert_allclose(found.recurrence_time, recurrence_time, rtol=1e-8)
    np.testing.assert_allclose(found.least_velocity, least_velocity, rtol=1e-5)


def test_share_of_larger_events_is_drawn():
    """All events have at least the smallest slip, one in four at least the largest of four."""
    made = slip_events(slip=np.array([4.0, 1.0, 2.0, 8.0])).assign_attrs(scene="chaos")
    figure = events.draw([made], ["a"])
    (line,) = figure.axes[2].lines
    drawn = dict(zip(line.get_xdata()[1:], line.get_ydata()[1:], strict=True))
    assert drawn == {1.0: 1.0, 2.0: 0.75, 4.0: 0.5, 8.0: 0.25}


RANDOM = np.random.default_rng(1).uniform(4.0, 12.0, 1000)
CYCLE = np.full(1000, 8.0)
PERIOD_3 = np.tile([4.0, 8.0, 12.0], 300)
TORUS = 8 + np.sin(2 * np.pi * 0.25 * np.arange(1000) + 1e-9 * np.arange(1000))


def of_scenes(cycles=(), **values: dict) -> dict:
    """Results of scenes with these values of events, and of cycles along lines."""
    made = {name: slip_events(**own).assign_attrs(scene=name) for name, own in values.items()}
    return {"slip_events": made, "cycles": dict(enumerate(cycles))}


def beside(times, of_cycle=CYCLE) -> dict:
    """Results of a scene with these recurrence times beside a cycle."""
    return of_scenes(mine={"recurrence_time": times}, cycle={"recurrence_time": of_cycle})


def cycles_at(tau: float, unstable: int) -> dict:
    """Results of a scene with equal events, and of cycles of which the last may be unstable."""
    cycles = cycles_to_a_torus("epsilon", tau=tau)
    return of_scenes([cycles.assign(unstable=("orbit", [0, 0, 0, unstable]))], mine={}, cycle={})


def large(*peaks: float, duration: float = 0.4) -> dict:
    """Results of a scene with these peaks of v beside one whose block does not stick."""
    values = {"peak_velocity": np.array(peaks)} | ({"duration": duration} if peaks else {})
    return of_scenes(small={}, mine=values)


@cases(
    (
        # times that vary and repeat are periodic; a few times are no evidence
        *("aperiodic_events", {"scene": "mine", "periodic": "cycle"}),
        (beside(RANDOM), YES),
        (beside(RANDOM, PERIOD_3), YES, "after 3 events, with"),
        (beside(CYCLE), NO, "after 1 event, with"),
        *((beside(PERIOD_3), NO), (beside(TORUS), NO), (beside(RANDOM, RANDOM), NO)),
        (beside(RANDOM[: FEWEST - 1]), NO, "Scene mine has 99 complete events."),
    ),
    (
        # equal in every scene; a doubled period is the beginning of a cascade
        *("periodic_without_delay", {"scenes": ["cycle", "mine"]}),
        (beside(CYCLE), YES, "It is not found here"),
        (beside(np.tile([8.0, 8.1], 100)), NO),
        *((beside(RANDOM), NO), (beside(CYCLE[: FEWEST - 1]), NO)),
        # one unstable orbit refutes; cycles with delay say nothing
        (cycles_at(0.0, 0), YES, "along $epsilon$ from 0.1 to 0.4: 4 of 4 orbits are stable"),
        (cycles_at(0.0, 2), NO, "along $epsilon$ from 0.1 to 0.4: 3 of 4 orbits are stable"),
        (cycles_at(1.0, 2), YES),
    ),
    (
        # the median event must be large and the stick long, in one scene at least
        *("relaxation", {"scenes": ["small", "mine"], "ratio": 1e3, "stick": 0.9}),
        (large(1e3), YES, "Scene small ($tau = 7$, $gamma = 0.8$) has 200 events."),
        *((large(1e2), NO), (large(1e3, duration=2.0), NO)),
        *((large(1e3, 1e3, 2.0), YES), (large(1e3, 2.0, 2.0), NO)),
        (large(), NO, "Scene mine has no complete event."),
    ),
)
def test_verdicts(case):
    assert_finding(*case)
