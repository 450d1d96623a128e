# SPDX-License-Identifier: BSD-3-Clause
"""What is refused, each in words: what was met, and what is expected."""

import math

import delaykit as dk
import numpy as np
import pytest

NEAR = {"near": {"y": 1}}
PLANE = ("tau", "n"), ((0.1, 5), (1, 9))


def after(model, t_end):
    """A run that can go on."""
    return model.integrate(lambda t: 1.2, t_end, dense_output=True)


def past(model, begin, end):
    """A run from an array over these times."""
    times = np.linspace(begin, end, 9)
    return model.run((times, 0 * times), 2)


REFUSED = {
    # histories
    "finite": lambda m: m.run(math.nan, 1),
    "expected finite numbers": lambda m: m.run({"y": math.inf}, 1),
    r"1j; expected a number": lambda m: m.run(1j, 1),
    "no value; expected one for each": lambda m: m.run({}, 1),
    r"\[1, 2\]; expected a number": lambda m: m.run({"y": [1, 2]}, 1),
    "expected a value for each of y": lambda m: m.run(None, 1),
    "history is not finite between": lambda m: m.run(lambda t: math.nan, 1),
    "cannot be fitted": lambda m: m.run(lambda t: math.floor(9 * t), 1),
    "history of 'z'; expected one of y": lambda m: m.run({"z": 1}, 1),
    r"from t = -0.5 to 0.0; expected from -17": lambda m: past(m, -0.5, 0),
    r"to -1.0; expected from -17.0 to 0": lambda m: past(m, -20, -1),
    r"known from t = -17.0 on; expected a delay <= 18": lambda m: m.run(
        after(m, 1), 2, parameters={"tau": 19}
    ),
    r"to 0.5; expected from -16.5 to 0.5": lambda m: m.run(m.run(1, 0.5), 2, t_start=0.5),
    # parameters and options
    "did you mean 'tau'": lambda m: m.with_parameters(tua=1),
    "'long'; expected a finite number": lambda m: m.with_parameters(tau="long"),
    "did you mean 'radau5'": lambda m: m.run(1, 1, method="radua5"),
    "delay 1 of the model = -1": lambda m: m.run(1, 1, parameters={"tau": -1}),
    "STATE = NUMBER": lambda m: m.run(1, 1, events="y > 1"),
    "expected ascending times from t_start": lambda m: m.run(1, 1, t_eval=[1, 0]),
    r"-1.0; expected ascending times": lambda m: m.run(1, 1, t_eval=[-1]),
    "0.4; expected ascending times": lambda m: m.run(1, 0.3, t_eval=[0.1, 0.4]),
    "t = 2.0; expected -inf <= t <= 1": lambda m: m.integrate(1.2, 1, dense_output=True).sol([2]),
    "dense_output: True; expected with integrate": lambda m: m.run(1, 3, dense_output=True),
    "time of a dose": lambda m: m.run(1, 1, doses=[(2, {"y": 1})]),
    r"doses: \(0.3, 1.0\); expected pairs \(t": lambda m: m.run(1, 3, doses=[(0.3, 1.0)]),
    r"doses: 5; expected pairs \(time, \{st": lambda m: m.run(1, 3, doses=5),
    "atol: 2 numbers; expected one": lambda m: m.run(1, 1, atol=[1, 1]),
    "rtol of the state 'z'": lambda m: m.run(1, 1, rtol={"y": 1, "z": 1}),
    "samples_per_step: 0": lambda m: m.run(1, 9, samples_per_step=0),
    # models
    "equation of y": lambda _: dk.Model({"y": "y(t -"}).run(1, 1),
    "expected one of exp": lambda _: dk.Model({"y": "eval(y)"}).run(1, 1),
    "did you mean 'steady_state'": lambda _: dk.Model({"y": "y"}, steady={}),
    "parameter a: no value": lambda _: dk.Model({"y": "a*y"}, {"a": None}).run(1, 1),
    "> 0": lambda _: dk.Model({"y": "a*y"}, {"a": {"above": 0}}).with_parameters(a=0),
    "a value for each of x, y": lambda _: dk.Model({"x": "y", "y": "-x"}).run([1.0, 2.0], 1),
    # methods
    "parameter tau: no values; expected one": lambda m: m.scan(tau=[]),
    "option 'taw'; expected one of .*; did you mean 'tau'": lambda m: m.scan(taw=[1]),
    r"window: .*expected \(least, m": lambda m: m.hopf(("tau", "n"), (0, 5, 0, 3), **NEAR),
    r"window: 5; expected \(least, most\) of tau": lambda m: m.cycle(1, "tau", 5, **NEAR),
    "along: .*; expected two names": lambda m: m.hopf(("tau",), ((0, 5),), **NEAR),
    r"near: 0; expected \{state: guess\}": lambda m: m.roots(near=0),
    "near: None; expected a guess, or a": lambda m: m.roots(),
    r"t_end = 50.0; expected a finite number > 1": lambda m: m.exponents(1.2, t_end=50),
    r"sample_interval = 0": lambda m: m.attractor(1.2, sample_interval=0, **NEAR),
    # numbers that no memory holds, by which Fortran would end the interpreter
    **{
        rf"{key}(:| =) 1000000000.*; expected ": lambda m, key=key, call=call: call(m, {key: 10**9})
        for call, keys in (
            (lambda m, given: m.run(1, 9, **given), ["samples_per_step"]),
            (lambda m, given: m.exponents(1, **given), ["count", "batches"]),
            (lambda m, given: m.attractor(1, **NEAR, **given), ["kept", "exponents"]),
            (lambda m, given: m.hopf(*PLANE, **NEAR, **given), ["cells"]),
            (
                lambda m, given: m.cycle(1, "tau", (0.1, 2), **NEAR, **given),
                ["degree", "intervals", "most_orbits"],
            ),
        )
        for key in keys
    },
}
"""Calls by words of their refusal."""


@pytest.mark.parametrize("words", REFUSED)
def test_refused(mackey_glass, words):
    with pytest.raises(dk.DelaykitError, match=words):
        REFUSED[words](mackey_glass)


def test_a_measure_that_fails_is_a_reason(mackey_glass):
    found = mackey_glass.scan(lambda model: 1 / 0, tau=[1.0], progress=False)
    assert found.reason.item() == "division by zero"


def test_a_history_that_raises(mackey_glass):
    with pytest.raises(ZeroDivisionError):
        mackey_glass.run(lambda t: 1 / 0, 1)
