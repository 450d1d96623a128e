# SPDX-License-Identifier: BSD-3-Clause
"""What a model did before the initial time: as numbers, functions, arrays, or an earlier run."""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from delaykit.errors import ModelError
from delaykit.library import History, address

DEGREE = 12
"""Degree of the polynomials that stand for a function."""
SHARE = 0.1
"""Their error as a share of the tolerance of the run."""
MOST_PIECES = 4096
ROUNDING = 4
"""How far a time may be off, in units of the spacing of times."""


def leja(points: np.ndarray) -> np.ndarray:
    """Points in an order in which Newton's form loses no digits."""
    left, order = list(points), []
    while left:
        far = [math.prod(abs(x - y) for y in order) if order else abs(x - 0.5) for x in left]
        order.append(left.pop(int(np.argmax(far))))
    return np.array(order)


NODES = leja((1 - np.cos(np.pi * (np.arange(DEGREE + 1) + 0.5) / (DEGREE + 1))) / 2)
"""Where a function is read in each piece: Chebyshev points of 0..1 ..."""
TESTS = np.linspace(0.02, 0.98, 2 * DEGREE + 1)
"""... and where the polynomial is compared with it."""


@dataclass
class Pieces:
    """A past in polynomials of all states, and the kinks in it."""

    start: np.ndarray
    """Start of each piece as a pair whose sum it is, shape (pieces, 2)"""
    length: np.ndarray
    valid_for: np.ndarray
    nodes: np.ndarray
    """Newton nodes in units of the length, shape (pieces, degree)"""
    coefficients: np.ndarray
    """Newton coefficients, shape (pieces, states, 1 + degree)"""
    kinks: np.ndarray
    """Times where a derivative jumps, as pairs, shape (kinks, 2)"""
    passages: np.ndarray
    """Delays passed since; -1 where the solution jumps"""
    generation: np.ndarray
    origin: np.ndarray
    """Where they begin, a pair"""
    end: np.ndarray
    """Where they end, a pair"""
    state: np.ndarray
    """The state there, shape (states)"""
    before: np.ndarray | None = None
    """Constant states before the origin; None where nothing is known of them"""

    @classmethod
    def none(cls, t: float, state: np.ndarray, before: np.ndarray | None) -> "Pieces":
        """No piece: all that is known was before t."""
        pair, n = np.array([t, 0.0]), len(state)
        return cls(
            start=np.empty((0, 2)),
            length=np.empty(0),
            valid_for=np.empty(0),
            nodes=np.empty((0, 0)),
            coefficients=np.empty((0, n, 1)),
            kinks=np.empty((0, 2)),
            passages=np.empty(0),
            generation=np.empty(0),
            origin=pair,
            end=pair,
            state=state,
            before=before,
        )

    @property
    def past(self) -> np.ndarray:
        """States before the origin as the library takes them, also where it reads none of them."""
        return self.state if self.before is None else self.before

    @property
    def is_constant(self) -> bool:
        """Whether the states before go on, without a jump."""
        has_none = not len(self.length) and not len(self.passages)
        return has_none and np.array_equal(self.past, self.state)

    def check_reach(self, delays: np.ndarray) -> None:
        """Raise ModelError if a delay reaches beyond what is known."""
        begin, end = self.origin.sum(), self.end.sum()
        for number, delay in enumerate(delays, 1):
            if self.before is None and end - delay < begin - self.slack:
                raise ModelError(
                    f"delay {number} of the model is {delay} at t = {end}, and the history is "
                    f"known from t = {begin} on; expected a delay <= {end - begin}, or a first "
                    "run that begins with constants, or has the longer delay"
                )

    @property
    def slack(self) -> float:
        """By how much rounding may move a time."""
        return ROUNDING * np.spacing(np.abs([self.origin[0], self.end[0]]).max())

    def with_kink(self, passages: int) -> "Pieces":
        """The same with a kink at the end, a jump if `passages` is -1."""
        return replace(
            self,
            kinks=np.vstack([self.kinks, self.end]),
            passages=np.append(self.passages, passages),
            generation=np.append(self.generation, 0),
        )

    def structure(self) -> tuple[History, list]:
        """As the library takes it, and the arrays that must outlive the call."""
        kept = np.arange(1, self.coefficients.shape[1] + 1, dtype=np.int32)
        reals = [self.origin, self.kinks, self.start, self.length, self.valid_for, self.nodes]
        arrays = [np.ascontiguousarray(one, np.float64) for one in [*reals, self.coefficients]]
        arrays += [np.ascontiguousarray(one, np.int32) for one in (self.passages, self.generation)]
        arrays.append(kept)
        sizes = (len(self.passages), len(self.length), self.nodes.shape[1], len(kept))
        return History(*map(address, arrays), *sizes), arrays

    def __call__(self, t: np.ndarray) -> np.ndarray:
        """All states at times, shape (times, states)."""
        t = np.asarray(t, float)
        least = self.origin[0] if self.before is None else -np.inf
        known = (t >= least - self.slack) & (t <= self.end[0] + self.slack)
        if not known.all():
            raise ModelError(f"t = {t[~known][0]}; expected {least} <= t <= {self.end[0]}")
        if not len(self.length):
            return np.where((t < self.end[0])[:, None], self.past, self.state)
        piece = np.clip(np.searchsorted(self.start[:, 0], t, side="right") - 1, 0, None)
        share = (t - self.start[piece, 0] - self.start[piece, 1]) / self.length[piece]
        value = newton_value(self.coefficients[piece], self.nodes[piece], share)
        if self.before is not None:
            value[t < self.origin[0]] = self.before
        return value


def fit(
    function: Callable[[float], np.ndarray],
    begin: float,
    end: float,
    breaks,
    rtol: np.ndarray,
    atol: np.ndarray | float,
) -> Pieces:
    """The pieces of a function of time on [begin, end], within a tenth of the tolerance.

    function: of a time, shape (states). Raise ModelError where it is not finite or too rough.
    """
    edges = sorted({begin, end, *(t for t in breaks if begin < t < end)})
    todo = [*pairwise(edges)][::-1]
    done, size = [], 0.0
    while todo:
        left, right = todo.pop()
        values = np.array([function(left + (right - left) * x) for x in NODES])
        coefficients = newton(values)
        read = np.array([function(left + (right - left) * x) for x in TESTS])
        fitted = newton_value(coefficients[None], NODES[None, :DEGREE], TESTS)
        if not np.isfinite(values).all() or not np.isfinite(read).all():
            raise ModelError(f"the history is not finite between t = {left} and {right}")
        size = np.maximum(size, np.abs(read).max(axis=0))
        if (np.abs(read - fitted) <= SHARE * (atol + rtol * size)).all():
            done.append((left, right, coefficients))
        elif len(done) + len(todo) >= MOST_PIECES or (left + right) / 2 in (left, right):
            raise ModelError(
                f"the history cannot be fitted to the tolerance near t = {left}; expected a "
                "smooth function, with its jumps and kinks in `breaks`"
            )
        else:
            middle = (left + right) / 2
            todo += [(middle, right), (left, middle)]
    start = np.array([[left, 0.0] for left, _, _ in done])
    length = np.array([right - left for left, right, _ in done])
    inner = np.array(edges[1:-1])
    return Pieces(
        start=start,
        length=length,
        valid_for=length,
        nodes=np.tile(NODES[:DEGREE], (len(done), 1)),
        coefficients=np.array([coefficients for _, _, coefficients in done]),
        kinks=np.column_stack([inner, np.zeros_like(inner)]),
        passages=np.full(len(inner), -1),
        generation=np.zeros(len(inner)),
        origin=np.array([begin, 0.0]),
        end=np.array([end, 0.0]),
        state=np.asarray(function(end), float),
    )


def newton(values: np.ndarray) -> np.ndarray:
    """Newton coefficients of values at NODES, shape (states, 1 + degree)."""
    table = values.T.astype(float)
    for k in range(1, len(NODES)):
        table[:, k:] = (table[:, k:] - table[:, k - 1 : -1]) / (NODES[k:] - NODES[:-k])
    return table


def newton_value(coefficients: np.ndarray, nodes: np.ndarray, x: np.ndarray) -> np.ndarray:
    """Polynomials at a place each, or one at all places, shape (places, states)."""
    value = coefficients[..., -1]
    for k in range(nodes.shape[1] - 1, -1, -1):
        value = coefficients[..., k] + (x - nodes[:, k])[:, None] * value
    return value
