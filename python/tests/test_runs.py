# SPDX-License-Identifier: BSD-3-Clause
"""Runs against exact solutions and published values, and what is refused."""

import itertools
import math
import multiprocessing
import os
import pickle
import signal
import subprocess
import sys
import textwrap
import threading
import time
from concurrent.futures import ThreadPoolExecutor

import delaykit as dk
import numpy as np
import pandas
import pytest
import sympy
from scipy.integrate import quad

from conftest import MACKEY_GLASS, NUMBERS

METHODS = ("auto", "bs5", "dop853", "taylor", "radau5", "radau13")


def test_dense_output_and_continuation(sine):
    first = sine.integrate(math.sin, 10, dense_output=True)
    t = np.linspace(0, 10, 201)
    np.testing.assert_allclose(first.sol(t)[0], np.sin(t), atol=3e-8)
    onward = sine.integrate(first, 20, t_eval=[15, 20])
    np.testing.assert_allclose(onward.y[0], np.sin([15, 20]), atol=1e-7)
    loaded = pickle.loads(pickle.dumps(first))
    assert (sine.integrate(loaded, 20, t_eval=[15, 20]).y == onward.y).all()


def dense(model, history, end, **options):
    """A run that can go on."""
    return model.integrate(history, end, dense_output=True, **options)


FIRST = {
    "constants": lambda m: dense(m, 1, 0.3),
    "a function": lambda m: dense(m, lambda t: 1, 0.3, parameters={"tau": 3}),
    "no step": lambda m: dense(m, 1, 0),
    "an event": lambda m: dense(m, 1, 9, events="y = 0.8 falling stop"),
    "two runs": lambda m: dense(m, pickle.loads(pickle.dumps(dense(m, 1, 0.3))), 0.7),
}


@pytest.mark.parametrize("first", FIRST.values(), ids=FIRST)
def test_a_run_goes_on_with_its_history(first):
    """y' = -y(t - 1) after 1: polynomials on each unit of time. From 2 on the delay is 1, or 3."""
    model = dk.Model({"y": "-y(t - tau)"}, {"tau": 1})
    run = dense(model, first(model), 2)
    np.testing.assert_allclose(run.sol([-0.5, 1, 2])[0], [1, 0, -1 / 2], atol=1e-12)
    for tau, expected in ((1, -1 / 6), (3, -3 / 2)):
        onward = model.integrate(run, 3, t_eval=[3], parameters={"tau": tau})
        np.testing.assert_allclose(onward.y[0], expected, atol=1e-12)


def test_a_history_in_an_array(sine):
    times = np.linspace(-2, 0, 400)
    run = sine.integrate((times, np.sin(times)), 10, t_eval=[5, 10], rtol=1e-7, atol=1e-7)
    np.testing.assert_allclose(run.y[0], np.sin([5, 10]), atol=1e-5)


@pytest.mark.parametrize("kind", [tuple, list, lambda pair: pandas.Series(pair[1], pair[0])])
def test_a_history_in_lists_or_a_series(sine, kind):
    history = {"y": kind([[-2, -1, 0], [1, 1, 1]])}
    found, expected = (sine.integrate(one, 3, t_eval=[3]).y for one in (history, 1))
    np.testing.assert_allclose(found, expected, rtol=1e-9)


def test_tolerances_in_an_array(sine):
    assert sine.integrate(1, 1, atol=np.array([1e-7])).options["atol"] == [1e-7]


def test_a_level_at_the_start_or_crossed_by_a_dose_is_no_event():
    run = dk.Model({"y": "-y"}).integrate(1, 2, events=["y = 1", "y = 0.5"], doses=[(1, {"y": 1})])
    assert [len(times) for times in run.t_events] == [1, 1]


def test_a_function_without_delays():
    """It is read at the start alone, which need not be 0."""
    run = dk.Model({"y": "-y"}).integrate(math.cos, 3, t_start=2, t_eval=[3])
    np.testing.assert_allclose(run.y[0], [math.cos(2) * math.exp(-1)], rtol=1e-8)


def test_a_jump_at_the_start_and_doses():
    """y' = -y(t - 1) with y = 0 before and 1 at 0: polynomials on each unit of time."""
    model = dk.Model({"y": "-y(t - 1)"})
    run = model.integrate(0, 3, initial=1, t_eval=[0, 1, 2, 3])
    np.testing.assert_allclose(run.y[0], [1, 1, 0, -1 / 2], atol=1e-12)
    # a dose at 1/2 adds the same solution, later
    dosed = model.integrate(0, 3, initial=1, doses=[(0.5, {"y": 2})], t_eval=[3])
    np.testing.assert_allclose(dosed.y[0], [-1 / 2 + 2 * (1 - 1.5 + 0.5**2 / 2)], atol=1e-12)
    first = dense(model, 0, 0.5, initial=1)
    onward = model.integrate(first, 3, initial=first.y[0, -1] + 2, t_eval=[3])
    np.testing.assert_allclose(onward.y, dosed.y, atol=1e-12)


def test_events(sine):
    watched = ["y' = 0 falling", dk.Event("y", 0.5, 1), "y' = 0 rising"]
    run = sine.integrate(math.sin, 12, events=watched)
    np.testing.assert_allclose(run.t_events[0], [math.pi / 2, 5 * math.pi / 2], atol=1e-6)
    np.testing.assert_allclose(run.y_events[0][:, 0], [1, 1], atol=1e-7)
    np.testing.assert_allclose(run.t_events[1] % (2 * math.pi), math.pi / 6, atol=1e-6)
    # in the order of time
    found = run.to_dataset()
    np.testing.assert_allclose(found.event_t, np.sort(np.concatenate(run.t_events)))
    assert found.event_number.values.tolist() == [1, 0, 2] * 2
    np.testing.assert_allclose(found.event_y, [0.5, 1, -1] * 2, atol=1e-7)
    ended = sine.integrate(math.sin, 12, events="y = 0.5 rising stop")
    assert ended.status == 1
    np.testing.assert_allclose(ended.t[-1], math.pi / 6, atol=1e-7)


def test_numbers_of_sympy_keep_their_digits():
    """Also where states have the names of its constants."""
    root = sympy.sqrt(2).evalf(40)
    model = dk.Model({"e": sympy.Float(1 / 3) * sympy.E, "pi": sympy.pi * root})
    texts = model.definition["equations"]
    assert texts["e"] == "0.3333333333333333*exp(1)"
    assert texts["pi"] == "1.41421356237309504880168872420969807856966*acos(-1)"
    run = model.integrate({"e": 0, "pi": 0}, 1)
    np.testing.assert_allclose(run.y[:, -1], [math.e / 3, math.pi * 2**0.5], rtol=1e-15)


def test_time_in_other_expressions_and_names_of_any_alphabet():
    """y' = cos(w t)/(1 + t) e**(-0.1 t) by quadrature, alone and in a chain of equal blocks."""
    text = "cos(ω*t)/(1 + t)*e**(-t/10)*log10(10) + 0*η(t - τ)"
    alone = dk.Model({"η": text}, {"ω": 3, "τ": 1})
    chain = dk.Model({"η": f"{text} + second_difference(η)"}, {"ω": 3, "τ": 1}, blocks=3)
    expected = quad(lambda t: math.cos(3 * t) / (1 + t) * math.exp(-t / 10), 0, 5, epsabs=1e-13)
    for model, method in itertools.product((alone, chain), ("taylor", "dop853", "radau9")):
        run = model.integrate(0, 5, rtol=1e-11, atol=1e-13, method=method)
        np.testing.assert_allclose(run.y[0, ..., -1], expected[0], atol=1e-10)


def test_an_exponential_of_a_state():
    """w' = -1: v = exp(w) decays, and falls through 1/2 at ln 2."""
    model = dk.Model({"w": "-1 + 0*w(t - 1)"}, auxiliary={"v": "exp(w)"})
    run = model.run({"v": 1}, 3, events="v = 0.5 stop")
    np.testing.assert_allclose(run.t[-1], math.log(2), atol=1e-9)
    np.testing.assert_allclose(run.v[-1], 0.5, atol=1e-9)


SATURATED = {
    "1/(1 + exp(c(t - 1)))": lambda c: float(c < 0),
    "exp(2*c(t - 1))/(1 + exp(c(t - 1)))**2": lambda c: float(c > 0),
    "exp(c(t - 1))/(1 + exp(c(t - 1)))**4": lambda c: 0,
    "sinh(c(t - 1))/cosh(c(t - 1)) + 1/cosh(c(t - 1))**2": lambda c: math.copysign(1, c),
    "c(t - 1)/expm1(c(t - 1)/2)": lambda c: max(0, -c),
    "exp(-c(t - 1)**2)/(3 + exp(c(t - 1)))": lambda c: 0,
}
"""Bounded slopes whose exponentials overflow, and their values far from 0."""


@pytest.mark.parametrize("method", METHODS)
def test_exponentials_overflow_in_bounded_quotients(method):
    slopes = dict(zip("uvwxyz", SATURATED, strict=True))
    model = dk.Model({"c": "1e-9*c", **slopes})
    for c in (360, -360, 800, -800, 1e6, -1e6):
        run = model.integrate({"c": c, **dict.fromkeys(slopes, 0)}, 1, t_eval=[1], method=method)
        np.testing.assert_allclose(run.y[1:, 0], [at(c) for at in SATURATED.values()], 1e-9, 1e-50)


@pytest.mark.parametrize("slope", ["exp(a)", "log(900 - a)"])
def test_what_is_not_finite_is_named(slope):
    model = dk.Model({"a": "second_difference(a)/9**9", "b": slope}, blocks=4, ends="ring")
    with pytest.raises(dk.RunError, match=r"b' of block 3 is NaN at t = 0.0, where b of block 3"):
        model.integrate({"a": [1, 2, 901, 1], "b": 1}, 1)


def test_methods_name_states():
    model = dk.Model({"a": "-a", "b": "log(-a)"})
    with pytest.raises(dk.RunError, match=r"b' is NaN at t = 0.0, where b = 1.0"):
        model.exponents({"a": 1, "b": 1}, 1, 1, 9)


def test_a_ring_of_blocks():
    """A ring has no ends: a pattern moved by one block stays moved by one."""
    ring = dk.Model({"x": "k*second_difference(x) - x(t - 1)"}, {"k": 2}, blocks=5, ends="ring")
    start = np.array([0.0, 1.0, 3.0, 2.0, -1.0])
    run = ring.integrate({"x": start}, 4, t_eval=[0, 4])
    moved = ring.integrate({"x": np.roll(start, 1)}, 4, t_eval=[0, 4])
    np.testing.assert_allclose(run.y[:, 0], start)
    np.testing.assert_allclose(dense(ring, {"x": start}, 1).sol([-1, 0]).T, [start, start])
    np.testing.assert_allclose(np.roll(run.y, 1, axis=0), moved.y, atol=1e-8)


def test_a_dataset(mackey_glass):
    run = mackey_glass.run({"y": 1.2}, 50)
    assert run.t[0] == 0
    assert run.t[-1] == 50
    assert run.attrs["tau"] == 17
    assert run.attrs["steps_accepted"] > 0
    np.testing.assert_allclose(run.y[-1], 1.06095436, rtol=1e-8)


NAMES = {
    "of the code": "y z k i rate dy w_0 d_w w w_delayed_1",
    "of Fortran, in cases": "sum real a A exp_ do end_ if V v",
    "of Python and SymPy": "lambda None is E I S N Q beta zeta",
    "of constants and functions": "e pi ln erf atan2 log10 cot sec N P",
    "of other alphabets": "α β ε µ τ é Ψ_1 ϕ₂ ñ 変",
    "long": " ".join(f"{47 * 'l'}{letter}" for letter in "abcdefghij"),
}
"""Six parameters, three states and exp(state)."""


def ends_of(names: str) -> np.ndarray:
    """Ends of runs by f, by the Jacobian and by series of a model whose parts have these names."""
    p, q, r, s, lag, bound, a, b, w, v = names.split()
    equations = {
        a: f"-{p}*{a} + {q}*{b}(t - {lag})*{r} - {s}/(1 + {a}**2)*{bound}",
        b: f"expm1({w}) + log1p({a}**2) - {b}",
        w: f"-{p}**2/{v}*({a} + {w})",
    }
    model = dk.Model(
        equations, dict.fromkeys([p, q, r, s, lag, bound], 0.7), auxiliary={v: f"exp({w})"}
    )
    history = {a: 0.3, b: -0.4, w: 0.2}
    runs = [model.integrate(history, 2, method=one) for one in ("dop853", "radau9", "taylor")]
    return np.array([run.y[:, -1] for run in runs])


@pytest.mark.parametrize("kind", NAMES)
def test_names_are_free(kind):
    """Any name that is not a function's: the model is the same."""
    np.testing.assert_allclose(ends_of(NAMES[kind]), ends_of("p q r s h g u x c d"), rtol=1e-13)


def test_what_was_reached_before_an_error():
    explosion = dk.Model({"y": "y**2"})
    with pytest.raises(dk.RunError, match="stopped at t = ") as failure:
        explosion.run(1, 2)
    assert failure.value.partial.t[-1] == pytest.approx(1, abs=1e-9)


def test_other_processes_and_threads(mackey_glass):
    expected = at_fifty(mackey_glass)
    with ThreadPoolExecutor(4) as pool:
        found = [*pool.map(at_fifty, [mackey_glass] * 4)]
    for way in ("fork", "spawn"):
        with multiprocessing.get_context(way).Pool(1) as pool:
            found.append(pool.apply(pickle.loads(pickle.dumps(at_fifty)), (mackey_glass,)))
    assert all((one == expected).all() for one in found)
    assert len(found) == 6


def at_fifty(model):
    """A value that another process computes."""
    return model.integrate(1.2, 50, t_eval=[50]).y


def test_two_processes_compile_one_model(tmp_path):
    program = f"""
        import delaykit as dk
        model = dk.Model({{"y": "{MACKEY_GLASS}"}}, {NUMBERS}, name="twice")
        print(model.integrate(1.2, 50, t_eval=[50]).y)
    """
    command = [sys.executable, "-c", textwrap.dedent(program)]
    running = [
        subprocess.Popen(
            command,
            stdout=subprocess.PIPE,
            env={"DELAYKIT_CACHE": str(tmp_path), "PATH": "/usr/bin:/bin"},
        )
        for _ in range(2)
    ]
    outputs = {one.communicate()[0] for one in running}
    assert len(outputs) == 1
    assert b"1.0609" in outputs.pop()
    assert len([*tmp_path.glob("*.so")]) == 1


def test_no_compiler(monkeypatch):
    from delaykit import errors, objects

    monkeypatch.setattr(objects, "COMPILER", "no-such-compiler")
    with pytest.raises(errors.CompilerError, match="apt install gfortran"):
        dk.Model({"y": "-y(t - 2)"}).run(1, 1)


@pytest.fixture
def interruptible():
    """Ctrl-C as Python takes it by default, which background jobs of a shell ignore."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


def test_an_interruption_may_be_ignored(mackey_glass, interruptible):
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    assert mackey_glass.handle  # compiled before the clock runs
    threading.Timer(0.1, os.kill, [os.getpid(), signal.SIGINT]).start()
    assert mackey_glass.integrate(1.2, 5e5, t_eval=[5e5]).status == 0


@pytest.mark.parametrize(
    "call",
    [
        lambda model: model.run(1.2, 1e9, t_eval=[1e9]),
        lambda model: model.scan(tau=[17.0] * 4, history=1.2, t_end=1e9, progress=False),
        lambda model: model.hopf(("tau", "beta"), ((1, 99), (0.1, 0.5)), near={"y": 1}, cells=2000),
        lambda model: model.cycle(None, "tau", (1, 20), near={"y": 1}, intervals=1000),
    ],
)
def test_an_interruption_ends_within_a_second(mackey_glass, interruptible, call):
    assert mackey_glass.handle  # compiled before the clock runs
    assert mackey_glass.resting({"y": 1}).path
    timer = threading.Timer(0.5, os.kill, [os.getpid(), signal.SIGINT])
    begun = time.monotonic()
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        call(mackey_glass)
    # a second, and what a busy machine needs; without it the run would last for hours
    assert time.monotonic() - begun < 20
    assert mackey_glass.integrate(1.2, 1, t_eval=[1]).status == 0
