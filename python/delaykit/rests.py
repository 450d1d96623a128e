# SPDX-License-Identifier: BSD-3-Clause
"""Networks at rest: the state, characteristic roots and Hopf points, by sparse matrices.

The roots s make Delta(s) = s I - A_0 - sum of A_k exp(-s lag_k) singular. Those near a shift come
from the Krylov space of the operator that integrates solutions, whose eigenvalues are 1/(s - shift)
(Jarlebring, Meerbergen and Michiels 2010, SIAM J. Sci. Comput. 32, 3278): each of its steps solves
one system with Delta(shift). Each root is then refined by Newton's method.
"""

import ctypes

import numpy as np
import xarray as xr
from scipy.optimize import brentq
from scipy.sparse import csc_matrix, identity
from scipy.sparse.linalg import splu

from delaykit.arguments import Arguments
from delaykit.errors import RunError
from delaykit.history import Pieces
from delaykit.library import LIBRARY, call

MOST_STEPS, MOST_HALVINGS = 100, 30
"""Of Newton's method to the state at rest, the first also to a root"""
AT_REST = 1e-9
"""A state is at rest if its rates are below this share of the largest derivative and state"""
KRYLOV = 60
"""Steps in the Krylov space of a shift"""
MOST_SHIFTS = 400
"""Then there are too many roots: a shift of 100 equations takes 0.2 s"""
CONVERGED = 1e-6
"""Relative residual of an approximate root from which Newton's method starts"""
SURE = 0.9
"""Share of the radius within which the roots of a shift are taken to be all"""
SAME = 1e-8
"""Roots nearer than this, relative to 1 + |s|, are one"""
LAST, FARTHEST = 1e-13, 0.1
"""Newton's method ends with a correction this small, and fails this far from its start, both
relative to 1 + |s|"""


class Linear:
    """A network linearised at a state: matrices by their delays."""

    def __init__(self, own: Arguments, state: np.ndarray):
        request, kept = own.request(Pieces.none(0.0, state, state), 0.0)
        found = call(LIBRARY.dk_linearise, own.model.handle, ctypes.byref(request))
        del kept
        self.n, self.rate = len(state), found.values("rate")
        places = found.values("row").astype(int) - 1, found.values("column").astype(int) - 1
        self.lags, number = np.unique(found.values("lag"), return_inverse=True)
        values = found.values("value")
        self.matrices = [
            csc_matrix((values[one], (places[0][one], places[1][one])), (self.n, self.n))
            for one in (number == k for k in range(len(self.lags)))
        ]

    def sum(self, weights) -> csc_matrix:
        """A sum of the matrices."""
        total = csc_matrix((self.n, self.n))
        for weight, matrix in zip(weights, self.matrices, strict=True):
            total = total + weight * matrix
        return total.tocsc()

    def delta(self, s: complex) -> csc_matrix:
        """Delta(s)."""
        return (s * identity(self.n) - self.sum(np.exp(-s * self.lags))).tocsc()

    def slope(self, s: complex) -> csc_matrix:
        """The derivative of Delta by s."""
        return (identity(self.n) + self.sum(self.lags * np.exp(-s * self.lags))).tocsc()

    def near(self, shift: complex) -> tuple[np.ndarray, np.ndarray, float]:
        """Roots near a shift, their vectors, and a radius within which there are no others."""
        unit = self.lags.max(initial=0.0) or 1.0
        inverse = splu(self.delta(shift))
        weights = [np.exp(-shift * lag) for lag in self.lags]
        steps = KRYLOV
        basis = np.zeros((steps + 1, steps + 1, self.n), complex)
        hessenberg = np.zeros((steps + 1, steps), complex)
        basis[0, 0] = np.random.default_rng(1).normal(size=self.n)
        basis[0] /= np.linalg.norm(basis[0])
        orders = np.arange(1, steps + 2)
        for k in range(steps):
            old, new = basis[k], np.zeros_like(basis[k])
            new[1:] = old[:-1] / orders[:-1, None]
            right = old[0] / unit
            for lag, weight, matrix in zip(self.lags, weights, self.matrices, strict=True):
                if lag > 0:
                    powers = -((-lag / unit) ** orders) / orders
                    right = right + weight * (matrix @ (powers @ old))
            new[0] = -inverse.solve(right)
            for _ in range(2):
                shares = np.einsum("ijk,jk->i", basis[: k + 1].conj(), new)
                new -= np.tensordot(shares, basis[: k + 1], 1)
                hessenberg[: k + 1, k] += shares
            hessenberg[k + 1, k] = size = np.linalg.norm(new)
            if size < 1e-14:
                # nothing is left but rounding: the space is whole
                steps = k + 1
                break
            basis[k + 1] = new / size
        values, vectors = np.linalg.eig(hessenberg[:steps, :steps])
        # roots too far to be told from infinite ones
        keep = np.abs(values) > 1e-12 * np.abs(values).max()
        values, vectors = values[keep], vectors[:, keep]
        residual = np.abs(hessenberg[steps, steps - 1] * vectors[-1])
        good = residual < CONVERGED * np.abs(values)
        away = 1 / (unit * np.abs(values))
        radius = min(away[~good], default=np.inf)
        inside = away < radius
        roots = shift + 1 / (unit * values[inside])
        first = np.tensordot(vectors[:, inside], basis[:steps, 0], ((0,), (0,)))
        return roots, first, radius

    def refined(self, s: complex, vector: np.ndarray | None = None) -> complex | None:
        """The root near an approximate one and near its vector, by inverse iteration."""
        start = s
        if vector is None:
            vector = np.random.default_rng(1).normal(size=self.n) + 0j
            s += 1e-7 * (1 + abs(s))
            vector = splu(self.delta(s)).solve(vector)
        for _ in range(MOST_STEPS):
            try:
                solved = splu(self.delta(s)).solve(self.slope(s) @ vector)
            except RuntimeError:
                # exactly singular
                return s
            step = -np.vdot(vector, vector) / np.vdot(vector, solved)
            s, vector = s + step, solved / np.linalg.norm(solved)
            if not np.isfinite(s) or abs(s - start) > FARTHEST * (1 + abs(start)):
                return None
            if abs(step) <= LAST * (1 + abs(s)):
                return s
        return s if abs(step) <= SAME * (1 + abs(s)) else None


def rest_of(own: Arguments, near) -> np.ndarray:
    """The state at rest near a guess, by Newton's method with steps that shorten the residual."""
    state = own.values("near", own.by_name("near", near))
    here = Linear(own, state)
    for _ in range(MOST_STEPS):
        try:
            step = splu(here.sum(np.ones(len(here.lags)))).solve(-here.rate)
        except RuntimeError:
            # singular: at a branch point a guess may be at rest
            break
        for _ in range(MOST_HALVINGS):
            there = Linear(own, state + step)
            if np.linalg.norm(there.rate) < np.linalg.norm(here.rate):
                break
            step = step / 2
        else:
            break
        state, here = state + step, there
    size = AT_REST * max([1.0, *(abs(matrix).max() for matrix in here.matrices)])
    if not np.abs(here.rate).max() < size * max(1.0, np.abs(state).max()):
        raise RunError(
            f"no state at rest near {near!r}: the largest rate is {np.abs(here.rate).max():g}; "
            "expected a nearer guess"
        )
    return state


def roots_of(linear: Linear, bound: float) -> np.ndarray:
    """All roots with a real part above a bound, each once, the rightmost first.

    Boxes of the plane are split until each lies in the disc of a shift whose roots are all known.
    """
    sizes = np.array([abs(matrix).sum(axis=1).max() for matrix in linear.matrices])

    def reach(right: float) -> float:
        return float(sizes @ np.exp(-np.minimum(right * linear.lags, 700)))

    found: list[complex] = []
    farthest = reach(bound)
    boxes = [(bound, max(farthest, bound), 0.0, farthest)]
    shifts = 0
    while boxes:
        left, right, low, high = boxes.pop()
        nearest = np.hypot(max(left, 0.0, -right), low)
        if nearest > reach(left):
            continue
        centre = complex((left + right) / 2, (low + high) / 2)
        shifts += 1
        if shifts > MOST_SHIFTS:
            raise RunError(f"roots: more than {MOST_SHIFTS} shifts; expected a bound nearer to 0")
        try:
            near, vectors, radius = linear.near(centre)
        except RuntimeError:
            near, vectors, radius = linear.near(centre * (1 + 1e-6) + 1e-6)
            radius -= 2e-6 * (1 + abs(centre))
        for start, vector in zip(near, vectors, strict=True):
            if start.real < bound - FARTHEST * (1 + abs(start)):
                continue
            s = linear.refined(start, vector)
            if s is None or s.real <= bound:
                continue
            s = complex(s.real, abs(s.imag) if abs(s.imag) > SAME * (1 + abs(s)) else 0.0)
            if all(abs(s - one) > SAME * (1 + abs(s)) for one in found):
                found.append(s)
        if np.hypot(right - left, high - low) / 2 > SURE * radius:
            middle, half = centre.real, centre.imag
            for ends in ((left, middle), (middle, right)):
                boxes += [(*ends, low, half), (*ends, half, high)]
    pairs = [one for s in found for one in ((s, s.conjugate()) if s.imag else (s,))]
    return np.array(sorted(pairs, key=lambda s: (-s.real, -s.imag)), complex)


def roots_of_network(model, bound: float, near, parameters) -> np.ndarray:
    """The roots of a network at rest near a guess."""
    own = Arguments(model, parameters)
    return roots_of(Linear(own, rest_of(own, near)), bound)


def hopf_of_network(model, along, window, near, parameters, cells) -> xr.Dataset:
    """Values of a parameter at which a pair of roots of a network crosses the imaginary axis.

    Roots with a real part above 0 are sought at the ends of all cells, and followed through them.
    """
    state, before, points = near, None, []
    for value in np.linspace(*window, cells + 1):
        own = Arguments(model, {**(parameters or {}), along: value})
        state = rest_of(own, state)
        here = (value, state, roots_of(Linear(own, state), 0.0))
        state = {name: state[k :: len(own.states)] for k, name in enumerate(own.states)}
        if before:
            for known, other in ((before, here), (here, before)):
                for root in known[2][known[2].imag > 0]:
                    found = crossing(model, along, parameters, known, other[0], root)
                    counts = (len(before[2]), len(here[2]))
                    if found and all(
                        abs(found[0] - one[0]) > SAME * (1 + abs(one[0]))
                        or abs(found[1] - one[1]) > SAME * (1 + abs(one[1]))
                        for one in points
                    ):
                        points.append((*found, *counts))
        before = here
    points.sort()
    columns = zip(*points, strict=True) if points else ((), (), (), ())
    value, omega, below, above = map(np.array, columns)
    about = ("its frequency", "unstable roots at the start of its cell", "and at its end")
    return xr.Dataset({
        along: ("point", value, {"long_name": f"{along} at which a pair crosses the axis"}),
        "omega": ("point", omega, {"long_name": about[0]}),
        "roots_before": ("point", below, {"long_name": about[1]}),
        "roots_behind": ("point", above, {"long_name": about[2]}),
    })  # fmt: skip


def crossing(model, along, parameters, known, end, root) -> tuple[float, float] | None:
    """Where a root with a real part above 0 passes the axis before an end, and its frequency."""
    start, state, _ = known
    guess = {name: state[k :: len(model.states)] for k, name in enumerate(model.states)}
    path = {start: root}

    def root_at(value: float) -> complex | None:
        nearest = min(path, key=lambda one: abs(one - value))
        own = Arguments(model, {**(parameters or {}), along: value})
        found = Linear(own, rest_of(own, guess)).refined(path[nearest])
        if found is not None:
            path[value] = found
        return found

    def follow(to: float, halvings: int = 8) -> bool:
        nearest = min(path, key=lambda one: abs(one - to))
        if root_at(to) is not None:
            return True
        return (
            halvings > 0 and follow((nearest + to) / 2, halvings - 1) and follow(to, halvings - 1)
        )

    if not follow(end) or path[end].real > 0:
        return None
    value = brentq(lambda one: root_at(one).real, start, end, xtol=1e-14 * (1 + abs(start)))
    return float(value), abs(root_at(value).imag)
