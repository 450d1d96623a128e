# SPDX-License-Identifier: BSD-3-Clause
"""Networks: models with indices beside the same equations written out, and beside other codes."""

import math
import re

import delaykit as dk
import numpy as np
import pytest
import scipy.sparse
from scipy.optimize import brentq
from scipy.special import lambertw

RANDOM = np.random.default_rng(7)
KURAMOTO = {"x[i]": "omega[i] + k*sum(j, a[i, j]*sin(x[j](t - tau[i, j]) - x[i]))"}
RING = {"x[i]": "-x[i] + c*tanh(sum(j, a[i, j]*x[j](t - T)))"}
EVERY = {
    "x[i]": "-x[i] + c*tanh(y[i](t - T[i])) + sum(j, a[i, j]*tanh(x[j](t - d[i, j])))"
    " + b*sum(j, x[j](t - T[j]) - y[j]**2*T[j])",
    "y[i]": "s - y[i] + sum(j, a[i, j]*(x[j](t - T[i])*x[i] - y[j](t - s) + x[i](t - d[i, j])))**2"
    "/4 + b*x[i](t - s)",
}
"""Delayed values of a node, of the other one, of both by the delays of the edge; some delays 0."""


def arrays_of(n: int, share=0.6) -> dict:
    """Parameters of EVERY."""
    a = RANDOM.normal(0, 0.5, (n, n)) * (RANDOM.random((n, n)) < share)
    d = np.round(RANDOM.random((n, n)), 1)
    delays = np.round(2 * RANDOM.random(n), 1)
    delays[0] = d[0, 1] = 0.0
    return {"a": a, "d": d, "T": delays, "b": 0.1, "c": 1.5, "s": 0.7}


def written_out(equations: dict, parameters: dict, n: int) -> dk.Model:
    """A network without indices: an equation for each state of each node."""
    scalars = {key: value for key, value in parameters.items() if np.ndim(value) == 0}

    def place(text: str, i: int, j: int) -> str:
        def named(match):
            name, indices = match[1], [{"i": i, "j": j}[one] for one in match[2].split(", ")]
            if name in parameters:
                return f"({parameters[name][tuple(indices)]!r})"
            return f"{name}{indices[0]}"

        return re.sub(r"(\w+)\[([ij](?:, j)?)\]", named, text)

    def expanded(text: str, i: int) -> str:
        while "sum(j, " in text:
            start = text.index("sum(j, ")
            depth, end = 1, start + 7
            while depth:
                depth += {"(": 1, ")": -1}.get(text[end], 0)
                end += 1
            term = text[start + 7 : end - 1]
            parts = " + ".join(f"({place(term, i, j)})" for j in range(n))
            text = f"{text[:start]}({parts}){text[end:]}"
        return place(text, i, 0)

    texts = {}
    for i in range(n):
        for key, text in equations.items():
            texts[f"{key[0]}{i}"] = expanded(text, i).replace("np.float64", "")
    return dk.Model(texts, scalars)


@pytest.fixture(scope="module")
def every(cache) -> tuple[dk.Model, dict, dk.Model, dict]:
    """EVERY with four nodes and its past, as a network and written out."""
    n, parameters = 4, arrays_of(4)
    past = {"x": RANDOM.random(n), "y": RANDOM.random(n)}
    of_plain = {f"{key}{i}": value[i] for key, value in past.items() for i in range(n)}
    network = dk.Model(EVERY, parameters, size={"i": n})
    return network, past, written_out(EVERY, parameters, n), of_plain


@pytest.fixture(scope="module")
def ring(cache) -> dk.Model:
    """Each node of twelve reads the one before it."""
    a = np.roll(np.eye(12), -1, axis=0)
    return dk.Model(RING, {"c": 2.0, "a": a, "T": 2.0}, size={"i": 12}, name="ring")


@pytest.mark.parametrize("method", ["bs5", "radau5", "auto"])
def test_equations_written_out(every, method):
    """A network moves as the same equations without indices; so do stiff steps, which read the
    derivatives."""
    network, past, plain, of_plain = every
    options = {"t_end": 6.0, "t_eval": [1.0, 3.0, 6.0], "rtol": 1e-10, "method": method}
    found = network.integrate(past, **options)
    expected = plain.integrate(of_plain, **options)
    assert found.y == pytest.approx(expected.y, abs=1e-9)
    assert found.counts["steps_rejected"] <= expected.counts["steps_rejected"] + 3


def test_exponents_and_roots_of_equations_written_out(every):
    """At rest exponents are real parts of roots."""
    network, past, plain, of_plain = every
    options = {"count": 3, "t_transient": 50.0, "t_end": 200.0}
    found = network.exponents(past, **options)
    expected = plain.exponents(of_plain, **options)
    assert found.value.values == pytest.approx(expected.value.values, abs=1e-3)
    assert found.history_x.dims == ("node",)
    roots = network.roots(-0.7, near={"x": 0.5, "y": 0.5})
    assert found.value.values == pytest.approx(roots[:3].real, abs=1e-3)


def test_runge_kutta_with_steps_that_divide_the_delays(cache):
    """Thirty phases, all to all: the classical method of order 4 with Hermite's cubics between."""
    n, h, steps = 30, 1 / 128, 640
    omega, places = RANDOM.normal(1, 0.2, n), RANDOM.integers(20, 128, (n, n))
    a, start = RANDOM.random((n, n)) / n, RANDOM.uniform(0, 6, n)
    x, slopes = np.tile(start, (128 + steps + 1, 1)), np.zeros((128 + steps + 1, n))
    columns = np.arange(n)

    def delayed(k, half):
        at = k - places
        if not half:
            return x[at, columns]
        ends = x[at, columns] + x[at + 1, columns]
        bend = slopes[at, columns] - slopes[at + 1, columns]
        # the slope jumps at the start
        return ends / 2 + h / 8 * np.where(at < 128, 0.0, bend)

    def f(y, past):
        return omega + (a * np.sin(past - y[:, None])).sum(axis=1)

    for k in range(128, 128 + steps):
        begin, middle, end = delayed(k, False), delayed(k, True), delayed(k + 1, False)
        slopes[k] = k1 = f(x[k], begin)
        k2 = f(x[k] + h / 2 * k1, middle)
        k3 = f(x[k] + h / 2 * k2, middle)
        k4 = f(x[k] + h * k3, end)
        x[k + 1] = x[k] + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
        slopes[k + 1] = f(x[k + 1], end)
    parameters = {"omega": omega, "a": a, "tau": places * h, "k": 1.0}
    model = dk.Model(KURAMOTO, parameters, size={"i": n}, name="phases")
    found = model.integrate({"x": start}, steps * h, t_eval=[steps * h], rtol=1e-9)
    assert found.y[:, 0] == pytest.approx(x[-1], abs=1e-7)


def test_uncoupled_nodes_have_the_exponents_of_one(cache):
    """Two equations of Hutchinson that end at rest, with r = 1 and 1.3."""
    text = "r*x*(1 - x(t - 1))"
    one = dk.Model({"x": text}, {"r": 1.0}, name="one")
    two = text.replace("r", "r[i]").replace("x", "x[i]")
    both = dk.Model({"x[i]": two}, {"r": [1.0, 1.3]}, size={"i": 2}, name="two")
    options = {"t_transient": 100.0, "t_end": 600.0}
    expected = [
        one.exponents({"x": 0.5}, 2, parameters={"r": r}, **options).value.values
        for r in (1.0, 1.3)
    ]
    found = both.exponents({"x": 0.5}, 4, **options).value.values
    assert found == pytest.approx(np.sort(np.ravel(expected))[::-1], abs=2e-3)


def test_roots_of_a_ring(ring):
    """About 0 each mode of the ring has the roots -1 + W(c T exp(T) u)/T, with u**12 = 1."""
    modes = np.exp(2j * np.pi * np.arange(12) / 12)
    exact = [
        s
        for k in range(-30, 31)
        for s in -1 + lambertw(2.0 * 2.0 * np.exp(2.0) * modes, k) / 2.0
        if s.real > -0.4
    ]
    found = ring.roots(-0.4, near={"x": 0})
    assert len(found) == len(exact) > 30
    assert max(np.abs(found - s).min() for s in exact) < 1e-11


def test_hopf_points_of_a_ring(ring):
    """Mode m crosses at c = sqrt(1 + w**2), where atan(w) + T w = 2 pi m/12."""
    found = ring.hopf("c", (0.5, 1.45), near={"x": 0}, cells=4)
    exact = [
        brentq(lambda w, m=m: math.atan(w) + 2 * w - math.pi * m / 6, 0, 9) for m in (1, 2, 3, 4, 5)
    ]
    assert found.omega.values == pytest.approx(exact, abs=1e-10)
    assert found.c.values == pytest.approx(np.sqrt(1 + np.square(exact)), abs=1e-10)
    assert (found.roots_before < found.roots_behind).all()


def test_what_does_not_grow_with_nodes(ring):
    """One object for any number of nodes; a zero of a matrix is no delay, sparse or dense."""
    size = 1000
    a = scipy.sparse.coo_array((np.ones(size), (np.arange(size), np.arange(-1, size - 1) % size)))
    large = dk.Model(RING, {"c": 2.0, "a": a, "T": 2.0}, size={"i": size}, name="ring")
    assert large.path == ring.path
    phases = {"omega": 1.0, "k": 1.0, "a": a, "tau": a}
    assert len(dk.Model(KURAMOTO, phases, size={"i": size}, name="phases").delays()) == size
    past = {"x": np.tile(np.linspace(0, 1, 10), 100)}
    dense = large.with_parameters(a=a.toarray())
    found = [one.integrate(past, 3.0, t_eval=[3.0]).y for one in (large, dense)]
    assert (found[0] == found[1]).all()
    assert found[0][-1] == found[0][9]


def test_networks_without_edges_and_of_one_node(cache):
    """And one that is driven, within a sum, too: it has no exponent 0."""
    alone = dk.Model(RING, {"c": 2.0, "a": 0.0, "T": 2.0}, size={"i": 3}, name="ring")
    assert alone.run({"x": 1.0}, 1.0).x.values[:, -1] == pytest.approx([math.exp(-1)] * 3)
    one = dk.Model({"x[i]": "sum(j, cos(t) - x[j])"}, size={"i": 1}, name="one")
    run = one.integrate({"x": 0.5}, 2.0)
    assert run.y[0, -1] == pytest.approx((math.cos(2) + math.sin(2)) / 2, abs=1e-8)
    found = one.exponents({"x": 0.5}, 1, t_transient=10.0, t_end=50.0)
    assert found.value.values == pytest.approx([-1.0], abs=1e-6)


def test_definitions_have_indices(ring):
    """A named part of a sum is read with its index."""
    parts = {"read": "a[i, j]*x[j](t - T)", "fed": "tanh(sum(j, read))"}
    values = {**ring.parameters, **ring.arrays}
    same = dk.Model({"x[i]": "-x[i] + c*fed"}, values, size={"i": 12}, definitions=parts)
    past = {"x": np.arange(12) / 12}
    found = [one.integrate(past, 3.0, t_eval=[3.0]).y for one in (ring, same)]
    assert (found[0] == found[1]).all()


def test_results_are_over_nodes(ring):
    """States over node and time, events of a node by its number from 0, names in messages."""
    past = {"x": np.arange(12) / 12}
    run = ring.integrate(past, 1.0, events=["x[3] = 0.4", "x = 0.1"])
    data = run.to_dataset()
    assert data.x.dims == ("node", "t")
    assert data.x.values[3, 0] == 0.25
    assert run.y_events[0][0, 3] == pytest.approx(0.4)
    assert run.y_events[1][0, 0] == pytest.approx(0.1)
    broken = dk.Model({"x[i]": "log(x[i]) - 2"}, size={"i": 2}, name="broken")
    with pytest.raises(dk.RunError, match=r"x\[1\]'"):
        broken.integrate({"x": [9.0, -1.0]}, 1.0)


@pytest.mark.parametrize(
    ("equations", "parameters", "size", "words"),
    [
        ({"x[i]": "-x"}, {}, 2, r"'x'; expected x\[i\]"),
        ({"x[i]": "-x[j]"}, {}, 2, r"'x\[j\]'; expected the index i"),
        ({"x[i]": "sum(i, x[i])"}, {}, 2, "a new index"),
        ({"x[i]": "sum(j, sum(k, x[k]))"}, {}, 2, "no sum within it"),
        ({"x[i]": "sum(j, a[j, i]*x[j])"}, {"a": 1.0}, 2, r"a\[i, INDEX OF A SUM\]"),
        ({"x[i]": "p[i] + p"}, {"p": 1.0}, 2, "same number of indices"),
        ({"x[i]": "q[i]"}, {}, 2, "expected one of x"),
        ({"x[i]": "x[i](t - x[i])"}, {}, 2, "delay >= 0 of parameters"),
        ({"x[i]": "abs(x[i])"}, {}, 2, "smooth ones in a network"),
        ({"x[i]": "1", "y": "2"}, {}, 2, "one index of all states"),
        ({"x[i]": "p[i]"}, {"p": [1.0, 2.0, 3.0]}, 2, r"shape \(3,\); expected .*\(2,\)"),
        ({"x[i]": "p[i]"}, {"p": [1.0, math.inf]}, 2, "expected finite numbers"),
        ({"x[i]": "p[i]"}, {"p": None}, 2, "parameter p: no value"),
        ({"x[i]": "p[i]"}, {"p": {"default": [1, -1], "above": 0}}, 2, "p: -1; expected p, .* > 0"),
        ({"x[i]": "x[i](t - p[i])"}, {"p": [1, -1]}, 2, "delay 2 of the model"),
        ({"x[i]": "1"}, {}, None, "number of nodes"),
        ({"x[i]": "1"}, {}, 0, "whole number >= 1"),
        ({"x": "1"}, {}, 2, "expected none without an index"),
        ({"x[i]": "sum(j, sqrt(x[j]**2))"}, {}, 2, r"abs\(a\) for sqrt"),
        ({"x[i]": "sum(j, sin(x[j] - x[i]))"}, {}, 46341, "46341 nodes, all to all"),
    ],
)
def test_refusals(cache, equations, parameters, size, words):
    """What is wrong with a network is named."""

    def run():
        nodes = None if size is None else {"i": size}
        dk.Model(equations, parameters, size=nodes).integrate({"x": 1.0}, 1.0)

    with pytest.raises((dk.ModelError, dk.RunError), match=words):
        run()


def test_methods_that_networks_have_not(ring):
    """They are refused by a word of the definition, and a node that there is not by its number."""
    with pytest.raises(dk.ModelError, match=r"steady_state.*none of a network"):
        ring.cycle(None, "c", (1, 2), near={"x": 0})
    with pytest.raises(dk.ModelError, match=r"x\[12\].*12 nodes"):
        ring.integrate({"x": 0}, 1.0, events="x[12] = 1")
    with pytest.raises(dk.ModelError, match=r"expected with_parameters\(a=...\)"):
        ring.integrate({"x": 0}, 1.0, parameters={"a": 1.0})
    with pytest.raises(dk.ModelError, match="expected none in a network"):
        dk.Model({"x[i]": "1"}, size={"i": 2}, blocks=3)
    with pytest.raises(dk.RunError, match="no state at rest"):
        dk.Model({"x[i]": "1 + x[i]**2"}, size={"i": 2}).roots(near={"x": 0})
