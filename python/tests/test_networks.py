# SPDX-License-Identifier: BSD-3-Clause
"""Networks: models with indices beside the same equations written out, and beside other codes."""

import re

import delaykit as dk
import numpy as np
import pytest
import scipy.sparse

RANDOM = np.random.default_rng(7)
KURAMOTO = {"x[i]": "omega[i] + k/n*sum(j, a[i, j]*sin(x[j](t - tau[i, j]) - x[i]))"}
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


@pytest.mark.parametrize("method", ["bs5", "radau5"])
def test_a_network_is_the_same_equations_written_out(method):
    """Also for stiff steps, which read the derivatives."""
    n, parameters = 4, arrays_of(4)
    network = dk.Model(EVERY, parameters, size={"i": n})
    plain = written_out(EVERY, parameters, n)
    past = {"x": RANDOM.random(n), "y": RANDOM.random(n)}
    of_plain = {f"{key}{i}": value[i] for key, value in past.items() for i in range(n)}
    options = {"t_end": 6.0, "t_eval": [1.0, 3.0, 6.0], "rtol": 1e-10, "method": method}
    found = network.integrate(past, **options)
    expected = plain.integrate(of_plain, **options)
    assert found.y == pytest.approx(expected.y, abs=1e-8)
    assert found.counts["steps_accepted"] == expected.counts["steps_accepted"]
