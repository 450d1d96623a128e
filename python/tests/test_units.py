# SPDX-License-Identifier: BSD-3-Clause
"""Units of time (s) and of states (q) change nothing but the unit."""

from functools import cache, partial

import delaykit as dk
import numpy as np
import pytest

CLASSES = ["fixed_point", "cycle", "torus", "three_torus", "chaos", "undecided"]
SINE = dk.Model(
    {"x": "(-x + a*q*sin(x(t - tau)/q) + b*x**2/q)/s"}, {"a": 6, "b": 0, "q": 1, "s": 1, "tau": 1}
)
VAN_DER_POL = dk.Model({"x": "y/s", "y": "((1 - (x/q)**2)*y - x)/s"}, {"q": 1, "s": 1})


def sine(s, q, a=6):
    return SINE.with_parameters(a=a, q=q, s=s, tau=s)


def at_rest(s, q):
    """Without the symmetry, and with more roots."""
    return SINE.with_parameters(a=-2, b=1.5, q=q, s=s, tau=5 * s).resting({"x": q / 8})


def roots(s, q):
    found = at_rest(s, q).roots(-0.5 / s)
    assert found.size == 40
    return s * found


def hopf(s, q):
    curves = at_rest(s, q).hopf(("a", "tau"), ((-3, 0.5), (s / 4, 10 * s)), cells=10)
    kinds = curves.special_kind == "generalised_hopf"
    assert kinds.any()
    numbers = [s * curves.omega, curves.a, curves.tau / s, q**2 * curves.l1, kinds]
    numbers += [curves.special_a, s * curves.special_omega_1, q**4 * curves.special_l2]
    return np.concatenate([*numbers, curves.map_unstable_roots.values.ravel()])


def run(s, q, history=lambda t: 0.5, **options):
    found = sine(s, q).run(
        lambda t: q * history(t / s),
        t_eval=s * np.arange(9),
        t_end=8 * s,
        events="x' = 0",
        **options,
    )
    return [*found.x / q, *found.event_t / s]


def spectrum(s, q):
    found = dk.spectrum(sine(s, q, 4).run(0.5 * q, 100 * s, t_eval=s * np.arange(1000) / 10))
    return [*found.peak_frequency * s, *found.peak_density / s / q**2]


def attractor(s, q, a):
    found = sine(s, q, a).attractor(0.5 * q, near={"x": 0}, t_path=8 * s)
    path = [found.path_time[-1] / s, found.path_x.max() / q] if a == 4 else []
    return [CLASSES.index(found["class"]), *found.lyapunov_exponent[:2] * s, *path]


def without_delay(s, q):
    model, start = VAN_DER_POL.with_parameters(q=q, s=s), {"x": 0.5 * q, "y": 0}
    found = model.attractor(start, near={"x": 0, "y": 0}, exponents=2)
    maxima = model.scan(q=[q], history=start, progress=False).maxima / q
    return [CLASSES.index(found["class"]), *found.lyapunov_exponent[:2] * s, maxima[0, -1]]


def cycles(s, q, start, window):
    model = sine(s, q, sum(window) / 2)
    found = model.cycle(start and start * q, "a", window, near={"x": 0}, most_orbits=40)
    return [*found.a, *found.period / s, *found.x_most / q, *found.multiplier_real[0]]


CALLS = {
    **{m: (partial(run, method=m), 1e-7) for m in ("auto", "bs5", "dop853", "radau9")},
    "a history that is 0 at the start": (partial(run, history=np.sin), 1e-7),
    "spectrum": (spectrum, 1e-6),
    "exponents": (lambda s, q: sine(s, q).exponents(0.5 * q).value * s, 0.1),
    **{f"attractor, a = {a}": (partial(attractor, a=a), 0.1) for a in (0.5, 4, 6)},
    "without delay": (without_delay, 1e-3),
    "roots": (roots, 1e-7),
    "Hopf curves": (hopf, 1e-7),
    "cycles of Hopf points": (partial(cycles, start=None, window=(2, 6)), 1e-7),
    "cycles of a motion": (partial(cycles, start=0.5, window=(-4, -3)), 1e-7),
}
"""What is computed, free of units, and how far other units than powers of two may change it."""
ROUNDED = {"Hopf curves": 1e-12}
"""How far powers of two may: logarithms of omega are in lengths along curves."""
POWERS = [(2.0**-30, 1), (1, 2.0**30), (2.0**30, 2.0**-30)]
OTHERS = [(3600, 1e-4), (1e-3, 1), (1e9, 1e-9)]
expected = cache(lambda name: CALLS[name][0](1, 1))


@pytest.mark.parametrize("name", CALLS)
@pytest.mark.parametrize(("s", "q"), POWERS + OTHERS)
def test_units_change_nothing(name, s, q):
    """Bit for bit where they are powers of two; chaos only within its error."""
    compute, within = CALLS[name]
    if (s, q) in POWERS:
        within = ROUNDED.get(name, 0)
    np.testing.assert_allclose(compute(s, q), expected(name), within, within)
