# SPDX-License-Identifier: BSD-3-Clause
"""Arguments of runs, checked and as the library takes them."""

import ctypes
import math
import re
import sys
from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from delaykit.errors import ModelError, check_name
from delaykit.events import Event
from delaykit.history import ROUNDING, Pieces, fit
from delaykit.library import LIBRARY, Request, address

HUGE = sys.float_info.max
DOSES = "pairs (time, {state: change})"
ENDS = ("free", "ring", "plate")
"""What is beyond the ends of a chain, in the order of the library."""
NODE = re.compile(r"(\w+)\[(\d+)\]")
"""A state of a node of a network."""


def number_of(what: str, value) -> float:
    """A finite real number; raise ModelError for anything else."""
    if isinstance(value, complex | np.complexfloating):
        raise ModelError(f"{what}: {value!r}; expected a real number")
    try:
        number = float(value)
    except (TypeError, ValueError):
        raise ModelError(f"{what}: {value!r}; expected a finite number") from None
    if not math.isfinite(number):
        raise ModelError(f"{what}: {number!r}; expected a finite number")
    return number


def window_of(values, *names: str) -> list[float]:
    """Ends of the window of each parameter in a row; raise ModelError for anything else."""
    pairs = [values] if len(names) == 1 else values
    try:
        ends = [[number_of("window", end) for end in pair] for pair in pairs]
    except TypeError:
        ends = []
    if [len(pair) for pair in ends] != [2] * len(names):
        expected = ", ".join(f"(least, most) of {name}" for name in names)
        raise ModelError(f"window: {values!r}; expected {expected}")
    return [end for pair in ends for end in pair]


class Arguments:
    """Checks arguments for a model with values of its parameters."""

    def __init__(self, model, parameters: Mapping | None = None):
        self.model = model
        self.numbers = model.numbers(parameters)
        self.states = model.states
        self.n = len(self.states) * model.blocks

    number = staticmethod(number_of)

    def array(self, what: str, values) -> np.ndarray:
        """Finite numbers in a row."""
        try:
            array = np.array(values, float)
        except (TypeError, ValueError):
            raise ModelError(f"{what}: {values!r}; expected numbers") from None
        if array.ndim != 1 or not np.isfinite(array).all():
            raise ModelError(f"{what}: {values!r}; expected finite numbers in a row")
        return array

    def times(self, values, start: float, end: float) -> np.ndarray:
        """Ascending times from the start to the end."""
        times = self.array("t_eval", values)
        wrong = [*times[times < start], *times[times > end], *times[1:][np.diff(times) < 0]]
        if wrong:
            raise ModelError(
                f"t_eval: {wrong[0]}; expected ascending times from t_start = {start} to "
                f"t_end = {end}"
            )
        return times

    def tolerance(self, what: str, value) -> np.ndarray:
        """A tolerance for each component of the state vector."""
        if isinstance(value, Mapping):
            for state in value:
                check_name(f"{what} of the state", state, self.states)
            missing = [state for state in self.states if state not in value]
            if missing:
                raise ModelError(f"{what}: no value for {missing[0]}; expected one for each state")
            each = [number_of(f"{what} of {state}", value[state]) for state in self.states]
            return np.tile(each, self.model.blocks)
        if isinstance(value, list | tuple) or getattr(value, "ndim", 0):
            each = self.array(what, value)
            if len(each) != len(self.states):
                expected = f"one for each of {', '.join(self.states)}"
                raise ModelError(f"{what}: {len(each)} numbers; expected {expected}")
            return np.tile(each, self.model.blocks)
        return np.full(self.n, number_of(what, value))

    def component(self, what: str, name: str) -> tuple[int, bool]:
        """Number of a state from 0, and whether the name is that of its exponential."""
        check_name(what, name, [*self.states, *self.model.auxiliary])
        state = self.model.auxiliary.get(name, name)
        return self.states.index(state), state != name

    def node(self, name: str) -> tuple[str, int]:
        """The state of an event and the number of its node, from 0, as in x[3] of a network."""
        found = NODE.fullmatch(name)
        if not found:
            return name, 0
        nodes = self.model.network.nodes if self.model.network else 0
        if int(found[2]) >= nodes:
            raise ModelError(
                f"state of an event: {name}; expected the number of one of {nodes} nodes"
            )
        return found[1], int(found[2])

    def events(self, events: list[Event]) -> dict[str, np.ndarray]:
        """Events as arrays of the library."""
        rows = []
        for one in events:
            state, node = self.node(one.state)
            component, exponential = self.component("state of an event", state)
            component += node * len(self.states)
            level = number_of("level of an event", one.level)
            if exponential and not one.of_slope:
                if level <= 0:
                    raise ModelError(f"level of an event of {one.state}: {level}; expected > 0")
                level = math.log(level)
            if one.direction not in (-1, 0, 1):
                raise ModelError(f"direction: {one.direction!r}; expected -1, 0 or 1")
            rows.append((level, 1 + component, one.direction, one.terminal, one.of_slope))
        names = ("level", "component", "direction", "terminal", "of_slope")
        columns = np.reshape(np.array(rows, float), (-1, 5)).T
        return {
            name: column.astype(np.float64 if name == "level" else np.int32)
            for name, column in zip(names, columns, strict=True)
        }

    def doses(self, doses, start: float, end: float) -> list[np.ndarray]:
        """Changes of the state: each a time and n numbers, in order of time."""
        found = []
        pairs = list(doses.items()) if isinstance(doses, Mapping) else doses
        if not isinstance(pairs, list | tuple):
            raise ModelError(f"doses: {doses!r}; expected {DOSES}")
        for one in pairs:
            if not (
                isinstance(one, list | tuple) and len(one) == 2 and isinstance(one[1], Mapping)
            ):
                raise ModelError(f"doses: {one!r}; expected {DOSES}")
            time, change = one
            time = number_of("time of a dose", time)
            if not start <= time <= end:
                raise ModelError(f"time of a dose: {time}; expected {start} <= t <= {end}")
            for state in change:
                check_name("state of a dose", state, self.states)
            each = [number_of(f"dose of {s}", change.get(s, 0.0)) for s in self.states]
            found.append(np.concatenate([[time], np.tile(each, self.model.blocks)]))
        return sorted(found, key=lambda one: one[0])

    def values(self, what: str, given: Mapping, t: float | None = None) -> np.ndarray:
        """The state vector of values by state or auxiliary: numbers, or functions read at t."""
        found = np.full((self.model.blocks, len(self.states)), np.nan)
        for name, value in given.items():
            component, exponential = self.component(f"{what} of", name)
            if callable(value):
                value = value(t)
            try:
                array = np.broadcast_to(np.asarray(value, float), self.model.blocks)
            except (TypeError, ValueError):
                raise ModelError(
                    f"{what} of {name}: {value!r}; expected a number"
                    + (f" or {self.model.blocks} numbers" if self.model.blocks > 1 else "")
                ) from None
            if exponential and not (array > 0).all():
                raise ModelError(f"{what} of {name}: {value!r}; expected a number > 0")
            found[:, component] = np.log(array) if exponential else array
        for state in self.states:
            named = {state, *(k for k, v in self.model.auxiliary.items() if v == state)}
            if not named & set(given):
                raise ModelError(f"{what} of {state}: no value; expected one for each state")
        if t is None and not np.isfinite(found).all():
            raise ModelError(f"{what}: {dict(given)!r}; expected finite numbers")
        return found.ravel()

    def by_name(self, what: str, given) -> Mapping:
        """Values by state; a model with one state may leave out its name."""
        if isinstance(given, Mapping):
            return given
        if len(self.states) == 1 and given is not None:
            return {self.states[0]: given}
        raise ModelError(
            f"{what}: {given!r}; expected a value for each of {', '.join(self.states)}"
        )

    def over_time(self, given: Mapping, first: float, last: float) -> Mapping:
        """Arrays over time, pairs (times, values), Series or DataArrays, as functions of time.

        first, last: between what times they are read.
        """
        found = {}
        for name, value in given.items():
            pair = value
            if hasattr(value, "dims") and value.dims == ("t",):
                pair = (value.t.values, value.values)
            elif hasattr(value, "to_numpy") and hasattr(value, "index"):
                pair = (value.index, value.to_numpy())
            elif isinstance(value, list) and value and np.iterable(value[0]):
                pair = tuple(value)
            if isinstance(pair, tuple) and len(pair) != 1:
                if len(pair) != 2:
                    raise ModelError(f"history of {name}: expected a pair (times, values)")
                times, values = (self.array(f"history of {name}", one) for one in pair)
                if len(times) < 2 or len(times) != len(values) or (np.diff(times) <= 0).any():
                    raise ModelError(
                        f"history of {name}: {len(times)} times and {len(values)} values; expected "
                        "ascending times, at least two, and a value for each"
                    )
                slack = ROUNDING * np.spacing(np.abs(times).max())
                if times[0] > first + slack or times[-1] < last - slack:
                    raise ModelError(
                        f"history of {name}: known from t = {times[0]} to {times[-1]}; expected "
                        f"from {first} to {last}"
                    )
                # SciPy's import takes a third of a second
                from scipy.interpolate import CubicSpline

                value = CubicSpline(times, values)
            found[str(name)] = value
        return found

    def unit_of_time(self, past: np.ndarray) -> float:
        """The unit of times that are not given, of a model with constant states before."""
        request, _ = self.request(Pieces.none(0.0, past, past), 0.0)
        return LIBRARY.dk_unit_of_time(self.model.handle, ctypes.byref(request))

    def request(self, pieces: Pieces, t_end: float) -> tuple[Request, list]:
        """A request with all that is not an option, and what must live as long as it."""
        request = Request()
        request.parameters, request.past = address(self.numbers), address(pieces.past)
        request.t_start, request.t_start_rest = pieces.end
        request.t_end = t_end
        request.blocks = self.model.blocks
        request.ends = 1 + ENDS.index(self.model.ends)
        kept: list = [pieces]
        if not pieces.is_constant:
            structure, arrays = pieces.structure()
            kept += [structure, arrays]
            request.state, request.history = address(pieces.state), ctypes.addressof(structure)
        return request, kept


def begin(own: Arguments, history, t_start: float, initial, breaks, rtol, atol) -> Pieces:
    """What was before a run: constant states, functions of time, or a run."""
    delays = own.model.delays_of(own.numbers)
    pieces = getattr(history, "pieces", None)
    if pieces is None:
        first = t_start - delays[delays < np.inf].max(initial=0.0)
        given = own.over_time(own.by_name("history", history), first, t_start)
        reads = any(callable(value) for value in given.values())
        if reads and np.inf in delays:
            raise ModelError(
                "history: a function; expected constants, or a model with longest_delay: its "
                "delays have no bound"
            )
        if reads and len(delays) and max(delays) > 0:
            pieces = fit(
                lambda t: own.values("history", given, t),
                t_start - max(delays), t_start, breaks, rtol, 0.0 if atol is None else atol,
            ).with_kink(0)  # fmt: skip
        else:
            # without delays a function is read once
            past = own.values("history", given, t_start if reads else None)
            pieces = Pieces.none(t_start, past, None if reads else past)
    else:
        pieces.check_reach(delays)
    if initial is not None:
        state = own.values("initial", own.by_name("initial", initial))
        pieces = replace(pieces.with_kink(-1), state=state)
    return pieces
