# SPDX-License-Identifier: BSD-3-Clause
"""Every method on every kind of model: a right answer or a refusal in words."""

import math
from functools import cache

import delaykit as dk
import numpy as np
import pytest
from scipy.optimize import brentq

KINDS = {
    "driven": ({"y": "-a*y(t - 1) + sin(t)"}, None),
    "decay": ({"y": "-a*y(t - 1)"}, {"y": 0}),
    "growth": ({"y": "a*y(t - 1)/10"}, {"y": 0}),
    "two rests": ({"y": "-y + 2*a*tanh(y(t - 1))"}, {"y": 2}),
    "another rest": ({"y": "-y + 2*a*tanh(y(t - 1))"}, {"y": 0}),
    "no rest": ({"y": "a + sin(y(t - 1))/2"}, None),
    "symmetric": (
        {"y": "-y - 3*a*tanh(z(t - 1))", "z": "-z - 3*a*tanh(y(t - 1))"},
        {"y": 0, "z": 0},
    ),
    "damped, no delay": ({"y": "z", "z": "-y - a*z/10"}, {"y": 0, "z": 0}),
    "cycle, no delay": ({"y": "z", "z": "a*(1 - y**2)*z - y"}, {"y": 0, "z": 0}),
    "a line of rests": ({"y": "z", "z": "-a*z"}, {"y": 0, "z": 0}),
    "a centre": ({"y": "z", "z": "-a*y"}, {"y": 0, "z": 0}),
    "one state, no delay": ({"y": "a*y*(1 - y)"}, {"y": 1}),
    "an end": ({"y": "a*y**2"}, {"y": 0}),
    "eight states": (
        {
            "y": "-y - 2*a*tanh(x1(t - 1/2))",
            **{f"x{i}": f"-x{i} + 2*a*tanh(x{i + 1}(t - 1/2))" for i in range(1, 7)},
            "x7": "-x7 + 2*a*tanh(y(t - 1/2))",
        },
        dict.fromkeys(["y", *(f"x{i}" for i in range(1, 8))], 0),
    ),
    "a relay": ({"y": "-y - a*tanh(100*y(t - 1))"}, {"y": 0}),
    "no delay yet": ({"y": "-a*y(t - tau) - y**3"}, {"y": 0}),
    "not smooth": ({"y": "-a*sign(y(t - 1))"}, None),
    "a long delay": ({"y": "-y - 2*a*tanh(y(t - long))"}, {"y": 0}),
}
"""Equations, and where they are at rest. Parameters are 1, tau is 0."""
HISTORY = 0.5


@cache
def model_of(kind: str) -> tuple[dk.Model, dict]:
    """The model and its history."""
    equations, rest = KINDS[kind]
    numbers = {"a": 1, "b": 1, "tau": 0, "long": 30}
    model = dk.Model(equations, numbers, steady_state=rest and {"near": rest})
    return model, dict.fromkeys(equations, HISTORY)


def exponents(model, history):
    count = 2 if any(model.delays()) or len(model.states) > 1 else 1
    return model.exponents(history, count).value


def attractor(model, history):
    found = model.attractor(history, t_observed=500, doublings=2)
    known = found.lyapunov_exponent.dropna("exponent")
    return [CLASSES.index(found["class"]), *known[:1]]


CLASSES = ["undecided", "fixed_point", "cycle", "torus", "three_torus", "chaos"]
METHODS = {
    "run": lambda model, history: model.run(history, 5, t_eval=[5]).y,
    "exponents": exponents,
    "attractor": attractor,
    "roots": lambda model, _: model.roots(-0.7).real,
    "hopf": lambda model, _: model.hopf(("a", "b"), ((0.5, 1), (0.5, 1)), cells=2).omega,
    "cycle": lambda model, history: (
        model.cycle(history, "a", (0.9, 1.1), most_orbits=3, t_transient=50).period
    ),
    "section": lambda model, history: model.section(history, 20, "y = 0.25").t,
    "spectrum": lambda model, history: (
        dk.spectrum(model.run(history, 100, t_eval=np.arange(0, 100, 0.5))).peak_frequency
    ),
    "scan": lambda model, history: (
        model.scan("final", a=[1, 1.1], history=history, progress=False, t_end=5).final
    ),
}
W, V = -0.31813150520476413, 0.0912765271608622
"""Re W(-1) and W(1/10) (DLMF 4.13)."""
Y = brentq(lambda y: 2 * math.tanh(y) - y, 1, 3)
R = brentq(lambda s: s + 1 - 2 / math.cosh(Y) ** 2 * math.exp(-s), -1, 0)
"""The other rest of y = 2 tanh y, and its rightmost root."""
END = "a singularity?"
ROUGH = ("exponents", "attractor")
KNOWN = {
    ("driven", "exponents"): [W, W],
    ("driven", "attractor"): "the model has t in its equations; expected one without",
    ("decay", "exponents"): [W, W],
    ("decay", "attractor"): [1, W],
    ("decay", "roots"): [W, W],
    ("growth", "exponents"): [V],
    ("growth", "attractor"): [0],
    ("growth", "roots"): [V],
    ("two rests", "exponents"): [R],
    ("two rests", "attractor"): [1, R],
    ("two rests", "roots"): [R],
    ("another rest", "exponents"): [R],
    ("another rest", "attractor"): [1, R],
    ("no rest", "exponents"): [0],
    ("no rest", "attractor"): [2, 0],
    ("no rest", "roots"): "near: None; expected a guess",
    ("damped, no delay", "exponents"): [-0.05, -0.05],
    ("damped, no delay", "attractor"): [1, -0.05],
    ("damped, no delay", "roots"): [-0.05, -0.05],
    ("cycle, no delay", "exponents"): [0],
    ("cycle, no delay", "attractor"): [2, 0],
    ("cycle, no delay", "cycle"): [6.6632868593231301],
    ("a line of rests", "exponents"): [0, -1],
    ("a line of rests", "attractor"): [1, 0],
    ("a line of rests", "roots"): [0],
    ("a centre", "exponents"): [0, 0],
    ("a centre", "roots"): [0, 0],
    ("one state, no delay", "run"): [1 / (1 + math.exp(-5))],
    ("one state, no delay", "exponents"): [-1],
    ("one state, no delay", "attractor"): [1, -1],
    **{("an end", m): END for m in ("run", "exponents", "attractor", "section", "spectrum")},
    ("a relay", "attractor"): [2, 0],
    ("not smooth", "run"): [-0.5],
    **{("not smooth", m): "the model is not smooth at sign(y(t - 1))" for m in ROUGH},
    ("no delay yet", "exponents"): [-1],
    ("no delay yet", "attractor"): [1, -1],
    ("a long delay", "attractor"): [2, 0],
}
"""Closed forms, published numbers (the period of van der Pol's cycle), classes, refusals."""


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("method", METHODS)
def test_every_method_on_every_kind(kind, method):
    """Where nothing is known: numbers, or words that do not speak of what is inside."""
    model, history = model_of(kind)
    try:
        found = METHODS[method](model, history)
    except dk.DelaykitError as refused:
        found = str(refused)
    known = KNOWN.get((kind, method), [])
    if isinstance(found, str):
        assert isinstance(known, str) or not known, found
        assert (known or "expected") in found
        assert "NaN" not in found
    else:
        found = np.ravel(found)
        assert np.isfinite(found).all() or method == "scan"
        np.testing.assert_allclose(found[: len(known)], known, rtol=2e-3, atol=1e-5)


def test_exponents_need_a_motion_and_time():
    model, history = model_of("decay")
    with pytest.raises(dk.RunError, match=r"t_end = 50.0; expected a finite number > 100.0"):
        model.exponents(history, t_end=50)
    with pytest.raises(dk.RunError, match=r"the history is a state at rest, .*; expected another"):
        model_of("two rests")[0].exponents({"y": 0})
    # the motion itself falls to 0 of the computer
    np.testing.assert_allclose(model.exponents(history, 2, t_end=5000).value, W, rtol=1e-3)


def test_delays_from_0_to_1e4():
    """Known before a delay is over; short delays are as good as none."""
    model = dk.Model({"y": "-y + tanh(y(t - tau))"}, {"tau": 0})

    def end(tau):
        return model.integrate(2, 0.9, parameters={"tau": tau}, t_eval=[0.9]).y

    known = 2 * math.exp(-0.9) + math.tanh(2) * (1 - math.exp(-0.9))
    np.testing.assert_allclose([end(1), end(1e4)], known, rtol=1e-8)
    np.testing.assert_allclose(end(1e-9), end(0), rtol=1e-8)


def test_robertson_with_a_delay_is_unstable():
    """docs/verification.md: the slow solution is left from t = 6.04 on, if steps resolve it."""
    model = dk.Model(
        {
            "a": "-0.04*a + 1e4*b(t - tau)*c",
            "b": "0.04*a - 1e4*b(t - tau)*c - 3e7*b**2",
            "c": "3e7*b**2",
        },
        {"tau": 1e-2},
    )
    options = {"method": "dop853", "rtol": 1e-9, "atol": 1e-15}
    with pytest.raises(dk.RunError, match=r"stopped at t = 7\.9.*a singularity\?"):
        model.integrate({"a": 1, "b": 0, "c": 0}, 100, **options)


def test_a_network_compiles_what_a_method_needs(tmp_path, monkeypatch):
    """Twelve oscillators, each coupled to all: the object of a run has no series."""
    monkeypatch.setenv("DELAYKIT_CACHE", str(tmp_path))
    others = [[j for j in range(12) if j != i] for i in range(12)]
    equations = {
        f"x{i}": "1 + k*(" + " + ".join(f"sin(x{j}(t - tau{i}) - x{i})" for j in others[i]) + ")"
        for i in range(12)
    }
    numbers = {"k": 0.1, **{f"tau{i}": 1 + i / 100 for i in range(12)}}
    model = dk.Model(equations, numbers)
    history = {f"x{i}": i / 10 for i in range(12)}
    ends = [
        model.integrate(history, 5, t_eval=[5], method=method).y for method in ("auto", "radau9")
    ]
    np.testing.assert_allclose(*ends, rtol=1e-7)
    assert abs(model.exponents(history, 2, t_transient=20, t_end=60).value).min() < 1e-3
    assert len([*tmp_path.glob("*.so")]) == 2
