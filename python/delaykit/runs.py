# SPDX-License-Identifier: BSD-3-Clause
"""Runs: a model integrated from its history."""

import ctypes
import math
from dataclasses import dataclass, field

import numpy as np

from delaykit.arguments import HUGE, Arguments, begin, number_of
from delaykit.errors import ModelError, RunError, check_name
from delaykit.events import Event
from delaykit.history import Pieces
from delaykit.library import LIBRARY, Results, address, call, lines_of

EXTENTS = {"f": "equations", "jacobian": "jacobian", "series": "whole"}
"""What is compiled of a long model, by what a method reads of it."""
METHODS = {name: EXTENTS[reads] for name, reads in lines_of(LIBRARY.dk_methods)}
"""The solver's methods, with what is compiled for them."""
COUNTS = (
    *("status", "steps_accepted", "steps_rejected", "steps_implicit", "evaluations"),
    *("factorisations", "breaking_points", "switches", "kinks_untracked"),
)
"""Names of the numbers in `counts` of the library"""
MOST_SAMPLES = 10**4
"""In a step; more fill the memory"""


@dataclass
class Solution:
    """A run as arrays; the words are those of scipy.integrate.solve_ivp where it has them."""

    model: object
    numbers: np.ndarray
    """Parameters, in the order of the definition"""
    t: np.ndarray
    """Times, shape (times)"""
    y: np.ndarray
    """States, shape (states, times), of a chain (blocks, states, times)"""
    t_events: list[np.ndarray]
    """Times of each event, then of each of the model's own, which change the state"""
    y_events: list[np.ndarray]
    """States at each, before they change, shape (events, states)"""
    status: int
    """0: reached the end; 1: an event ended the run"""
    counts: dict[str, int]
    """Counts of the solver"""
    switches: dict[str, int]
    """How often each term that is not smooth switched"""
    options: dict = field(default_factory=dict)
    pieces: Pieces | None = None
    """Dense output, if it was asked for"""

    def sol(self, t) -> np.ndarray:
        """Dense output at times, shape (states, times); of a run with dense_output=True.

        Before the run it is the history. Raise ModelError where nothing is known.
        """
        if self.pieces is None:
            raise RunError("this run has no dense output; expected one with dense_output=True")
        return self.pieces(np.atleast_1d(t)).T

    def to_dataset(self):
        """The run as an xarray.Dataset."""
        from delaykit.datasets import dataset_of_run

        return dataset_of_run(self)


def integrate(
    model,
    history=None,
    t_end=None,
    *,
    t_start=0.0,
    t_eval=None,
    parameters=None,
    method="auto",
    rtol=1e-9,
    atol=None,
    events=(),
    dense_output=False,
    initial=None,
    breaks=(),
    doses=(),
    first_step=0.0,
    max_step=math.inf,
    max_steps=10**8,
    max_bytes=2e9,
    samples_per_step=4,
) -> Solution:
    """Integrate a model from t_start to t_end.

    history: before t_start, of each state or auxiliary a number or a function of t, as a dict (of
        a model with one state without it); arrays over time as an xarray.Dataset, or a dict of
        pairs (times, values) or pandas Series; or an earlier run with dense output, which goes on.
    initial: the state at t_start where it differs from the history (a jump).
    t_eval: times of the samples, NaN after an event that stops the run; otherwise they follow the
        steps, `samples_per_step` in each.
    rtol, atol: tolerances of a step: numbers, or by state a dict or an array. Without atol it is
        1e-6 rtol, but at least 2e-14, times the largest value of each state so far: units do not
        matter.
    events: texts such as "y = 1 rising" or "y' = 0 falling stop", or Event. A level that the state
        has at t_start, or that a dose crosses, is no event.
    breaks: times at which the equations or the history jump.
    doses: pairs (time, {state: change}).
    max_bytes: most memory of the past; stiff runs with explicit steps fill it, and dense output.

    All times in the model's unit. Raise ModelError before the run for arguments that cannot be,
    RunError with the solver's words where it stops.
    """
    check_name("method", method, METHODS)
    model = model.reduced(METHODS[method])
    own = Arguments(model, parameters)
    t_end = own.number("t_end", t_end)
    rtol = own.tolerance("rtol", rtol)
    atol = None if atol is None else own.tolerance("atol", atol)
    breaks = own.array("breaks", breaks)
    past = begin(own, history, own.number("t_start", t_start), initial, breaks, rtol, atol)
    request, kept = own.request(past, t_end)
    request.method = method.encode()
    request.rtol, request.atol = address(rtol), address(atol)
    request.first_step = own.number("first_step", first_step)
    request.max_step = own.number("max_step", min(max_step, HUGE))
    request.max_steps = int(own.number("max_steps", max_steps))
    request.max_bytes = own.number("max_bytes", max_bytes)
    samples_per_step = own.number("samples_per_step", samples_per_step)
    if not 0 < samples_per_step <= MOST_SAMPLES:
        raise ModelError(
            f"samples_per_step: {samples_per_step}; expected a number > 0 and <= {MOST_SAMPLES}"
        )
    request.share = 1.0 / samples_per_step
    request.keep_all = int(bool(dense_output))
    request.breaks, request.break_count = address(breaks), len(breaks)
    request.time_count = -1
    if t_eval is not None:
        times = own.times(t_eval, past.end[0], t_end)
        request.times, request.time_count = address(times), len(times)
    events = [Event.read(one) for one in ([events] if isinstance(events, str | Event) else events)]
    watched = own.events(events) if events else {}
    for name, array in watched.items():
        setattr(request, f"event_{name}", address(array))
    request.event_count = len(events)
    if dosed := own.doses(doses, past.end[0], t_end):
        changes = np.array(dosed)
        request.doses, request.dose_count = address(changes), len(changes)
    try:
        found = call(LIBRARY.dk_integrate, model.handle, ctypes.byref(request))
    except RunError as problem:
        problem.partial = solution_of(own, problem.partial, events, past.before)
        raise
    solution = solution_of(own, found, events, past.before)
    solution.options = {"method": method, "rtol": rtol.tolist()}
    if atol is not None:
        solution.options["atol"] = atol.tolist()
    del kept
    return solution


def section(model, history, t_end, event, *, t_transient=0.0, **options):
    """The points at which a run passes a level: an xarray.Dataset over `passage`.

    Time, the time since the passage before, and the states there. event: such as "y = 1 rising" or
    "y' = 0 falling". t_transient: passages before it are left out. options: those of `integrate`.
    """
    from delaykit.datasets import dataset_of_passages

    run = integrate(model, history, t_end, events=[event], t_eval=(), **options)
    return dataset_of_passages(run, number_of("t_transient", t_transient))


def solution_of(own: Arguments, found: Results, events: list[Event], before) -> Solution:
    """The arrays of results of the library."""
    model, t = own.model, found.values("t")
    y = found.values("y").reshape(len(t), own.n).T
    counts = dict(zip(COUNTS, found.values("counts").astype(int).tolist(), strict=False))
    numbers = range(1, 1 + len(events) + model.own_events)
    which = found.values("event_which", np.int32)
    times = found.values("event_time")
    states = found.values("event_y").reshape(len(times), own.n)
    return Solution(
        model=model,
        numbers=own.numbers,
        t=t,
        y=y,
        t_events=[times[which == i] for i in numbers],
        y_events=[states[which == i] for i in numbers],
        status=counts.pop("status", -1),
        counts=counts,
        switches=switches_of(found) if counts.pop("switches", 0) else {},
        pieces=pieces_of(own, found, before),
    )


def switches_of(found: Results) -> dict[str, int]:
    """How often each term that is not smooth switched."""
    return {
        words[4]: int(words[5])
        for words in found.description()
        if words[::2][:2] == ["attribute", "switched"]
    }


def pieces_of(own: Arguments, found: Results, before: np.ndarray | None) -> Pieces | None:
    """The dense output of results, if they have one, after constant states."""
    if not len(found.values("dense_end")):
        return None
    length = found.values("dense_length")
    steps, degree = len(length), len(found.values("dense_nodes")) // max(1, len(length))
    return Pieces(
        start=found.values("dense_start").reshape(steps, 2),
        length=length,
        valid_for=found.values("dense_valid_for"),
        nodes=found.values("dense_nodes").reshape(steps, degree),
        coefficients=found.values("dense_coefficients").reshape(steps, own.n, 1 + degree),
        kinks=found.values("dense_kink_time").reshape(-1, 2),
        passages=found.values("dense_passages", np.int32),
        generation=found.values("dense_generation", np.int32),
        origin=found.values("dense_origin"),
        end=found.values("dense_end"),
        state=found.values("dense_state"),
        before=before,
    )
