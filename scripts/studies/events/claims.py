"""Claims about slip events, the times in which the block is faster than the plate."""

from typing import Annotated

import numpy as np

from scripts.claims.claims_results import (
    NOT_REPRODUCED,
    Finding,
    Results,
    decided,
    equations,
    short,
)
from scripts.claims.declare import (
    Scene,
    Scenes,
    claim,
    number,
    question,
    reads,
    says,
    tested_with,
)
from scripts.namelists.parameters import HISTORY, PARAMETERS

FEWEST = 100
"""Events that a statement about their distribution needs."""
LONGEST_REPEAT = 100
"""Largest number of events after which a repetition is looked for."""
PERIODIC = 1e-3
"""Recurrence times repeat if they return to within this share of their mean."""
NOTHING = 1e-5
"""Shares below this are not given as numbers: they are errors of the solver."""

Ratio = Annotated[float, number("largest velocity over least", above=1)]
Share = Annotated[float, number("least share of the time with v < 1", exclusiveMaximum=1)]


@claim(8, "aperiodic_events", "section 4", look_at="events")
@says("Slip events on the strange attractor are aperiodic.")
@tested_with(scene="chaos", periodic="oscillation")
@reads("slip_events")
def aperiodic_events(results: Results, *, scene: Scene, periodic: Scene) -> Finding:
    """Whether recurrence times of events vary without repeating, unlike those of another scene."""
    parts, repeats = [], {}
    for name in (scene, periodic):
        events = results.events_of(name)
        times, slip = (events[key].values for key in ("recurrence_time", "slip"))
        if times.size < FEWEST:
            return few(name, times.size)
        after, repeats[name] = best_repeat(times)
        parts.append(
            f"Scene {name} has {times.size} events. The mean recurrence time is"
            f" {short(times.mean())} $L/v0$, with a coefficient of variation of"
            f" {percent(variation(times))}. The mean slip is {short(slip.mean())} $L$, with a"
            f" coefficient of variation of {percent(variation(slip))}. The sequence of recurrence"
            f" times repeats best after {after} event{'' if after == 1 else 's'}, with differences"
            f" of {percent(repeats[name])} of the mean."
        )
    repeating = f"The recurrence times of scene {scene} repeat."
    return decided(
        repeats[scene] > PERIODIC >= repeats[periodic],
        " ".join(parts),
        repeating if repeats[scene] <= PERIODIC else f"Those of scene {periodic} do not repeat.",
    )


@question(7, "periodic_without_delay", look_at="cycles")
@says(
    "Without delay, does one block with one state variable move periodically, and never"
    " chaotically?"
)
@tested_with(
    scenes=["no_delay", "no_delay_stuck", "no_delay_fast", "no_delay_less", "no_delay_more"]
)
@reads("slip_events", "cycles")
def periodic_without_delay(results: Results, *, scenes: Scenes) -> Finding:
    """Whether the cycles followed at tau = 0 are stable, and all events of each scene are equal."""
    parts, holds = [], True
    for cycles in results.cycles.values():
        if cycles.attrs.get("tau") != 0:
            continue
        along = cycles.attrs["along"]
        values, stable = cycles[along].values, cycles.unstable.values == 0
        holds = holds and bool(stable.all())
        parts.append(
            f"At {equations(cycles.attrs, [key for key in PARAMETERS if key != along])} the cycle"
            f" was followed along ${along}$ from {short(values.min())} to {short(values.max())}:"
            f" {stable.sum()} of {stable.size} orbits are stable, with"
            f" {cycles.sizes['special']} folds, doublings or torus bifurcations. The error of the"
            f" multiplier 1 is at most {short(cycles.multiplier_error.max(), 1)}."
        )
    for scene in scenes:
        events = results.events_of(scene)
        times, place = events.recurrence_time.values, events.attrs
        if times.size < FEWEST:
            return few(scene, times.size)
        spread = float(np.ptp(times) / times.mean())
        holds = holds and spread <= PERIODIC
        history = equations({key: place[f"history_{key}"] for key in HISTORY}, HISTORY)
        parts.append(
            f"At {equations(place, ['tau', 'epsilon'])}, from {history}, {times.size} events come"
            f" after {short(times.mean(), 6)} $L/v0$ each, with $v$ up to"
            f" {short(events.peak_velocity.values.max())}. The longest is longer than the shortest"
            f" by {percent(spread)}."
        )
    return decided(
        holds,
        f"{' '.join(parts)} Erickson, Birnir and Lavallee (2008) report a cascade of period"
        " doublings to chaos without delay, near $epsilon = 11$."
        f"{' It is not found here.' if holds else ''}",
        "Cycles without delay lose their stability, or events do not repeat.",
    )


@claim(12, "block_sticks_and_slips", "section 1, Figure 1", look_at="events")
@says("The block moves along the rough surface in a stick-slip fashion.")
@tested_with(scenes=["oscillation", "chaos"], ratio=1e3, stick=0.9)
@claim(54, "relaxation_oscillator", "sections 1 and 5", look_at="events")
@says("Under some conditions the block sticks and slips like a relaxation oscillator.")
@tested_with(scenes=["oscillation", "chaos", "stick_slip", "no_delay_less"], ratio=1e3, stick=0.9)
@reads("slip_events")
def relaxation(results: Results, *, scenes: Scenes, ratio: Ratio, stick: Share) -> Finding:
    """Whether half of the events of a scene span this ratio of v, and the block mostly sticks."""
    parts, holds = [], False
    for scene in scenes:
        events = results.events_of(scene)
        if events.sizes["event"] == 0:
            parts.append(f"Scene {scene} has no complete event.")
            continue
        spans = events.peak_velocity.values / events.least_velocity.values
        slower = 1 - float(events.duration.sum() / events.recurrence_time.sum())
        middle, large = float(np.median(spans)), float((spans >= ratio).mean())
        holds = holds or (middle >= ratio and slower >= stick)
        parts.append(
            f"Scene {scene} ({equations(events.attrs, ['tau', 'gamma'])}) has {spans.size} events."
            f" $v$ spans a factor of {short(middle, 2)} in the median event, and of at least"
            f" {ratio:g} in {percent(large)} of them. The block is slower than the plate for"
            f" {percent(slower)} of the time."
        )
    return decided(
        holds,
        f"{' '.join(parts)} The test asks for a factor of {ratio:g} in the median event, and for"
        f" {percent(stick)} of the time.",
        "In none of the scenes does the block stick and slip like this.",
    )


def variation(values: np.ndarray) -> float:
    """Coefficient of variation: standard deviation over mean."""
    return float(values.std() / values.mean())


def best_repeat(times: np.ndarray) -> tuple[int, float]:
    """After how many events times repeat best, and the rms of the differences over the mean."""
    after = range(1, min(LONGEST_REPEAT, times.size // 2) + 1)
    left = [np.sqrt(np.mean((times[m:] - times[:-m]) ** 2)) / times.mean() for m in after]
    # the first of those that are equal but for rounding and tolerance
    best = next(m for m, size in zip(after, left, strict=True) if size <= max(min(left), PERIODIC))
    return best, float(left[best - 1])


def percent(share: float) -> str:
    """A share in per cent."""
    if 0 < share < NOTHING:
        return f"less than {100 * NOTHING:g} %"
    return f"{100 * share:.3g} %"


def few(scene: str, events: int) -> Finding:
    """The scene has too few events to show whether they repeat."""
    evidence = f"Scene {scene} has {events} complete events. The test needs {FEWEST}."
    instead = f"Scene {scene} has too few events to show whether they repeat."
    return Finding(NOT_REPRODUCED, evidence, instead)
