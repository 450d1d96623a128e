"""A chain of blocks in JiTCDDE, compiled once and run on request (chains.py)."""

import contextlib
import json
import os
import sys
import warnings
from typing import TextIO

import jitcdde
import numpy as np
from jitcdde_worker import answer
from symengine import Symbol, exp


def neighbours(j: int, blocks: int, ends: str) -> list[int | None]:
    """Blocks beside block j; None is the plate."""
    beside = [j - 1, j + 1]
    if ends == "ring":
        return [i % blocks for i in beside]
    inside = [i if 0 <= i < blocks else None for i in beside]
    return inside if ends == "plate" else [i for i in inside if i is not None]


def compiled(chain: dict) -> jitcdde.jitcdde:
    """The solver of the chain in theta, u and w = ln v of one block after another."""
    keys = ("blocks", "tau", "epsilon", "xi", "gamma", "kappa")
    blocks, tau, epsilon, xi, gamma, kappa = (chain[key] for key in keys)
    equations, helpers = [], []
    for j in range(blocks):
        theta, u, w = (jitcdde.y(3 * j + i) for i in range(3))
        beside = neighbours(j, blocks, chain["ends"])
        others = sum(jitcdde.y(3 * i + 1) for i in beside if i is not None)
        v = Symbol(f"v{j}")
        helpers.append((v, exp(w)))
        equations += [
            -v * (theta + (1 + epsilon) * jitcdde.y(3 * j + 2, jitcdde.t - tau)),
            v - 1,
            -(gamma**2) / v * (u + kappa * (len(beside) * u - others) + (theta + w) / xi),
        ]
    solver = jitcdde.jitcdde(equations, helpers=helpers, max_delay=tau, verbose=False)
    solver.compile_C()
    return solver


def serve_chain(out: TextIO) -> None:
    """Answer requests, a line each, about the chain on the first line of standard input."""
    chain = json.loads(sys.stdin.readline())
    # JiTCDDE sorts helpers by as many calls within each other
    sys.setrecursionlimit(100 * (100 + chain["blocks"]))
    before = sum(os.times()[:4])
    solver = compiled(chain)
    seconds = sum(os.times()[:4]) - before
    count = round(chain["t_sampled"] / chain["sample_interval"])
    times = chain["sample_interval"] * np.arange(count + 1)
    print(f"answer: {jitcdde.__version__} {seconds}", file=out, flush=True)
    for line in sys.stdin:
        tolerance, runs, path = line.rstrip("\n").split(" ", 2)
        wanted = times if runs == "0" else np.array([chain["t_end"]])
        reply = answer(solver, chain["past"], wanted, float(tolerance), int(runs), path)
        print(f"answer: {reply}", file=out, flush=True)


if __name__ == "__main__":
    warnings.simplefilter("ignore")
    # other output of JiTCDDE must not be taken for an answer
    with os.fdopen(os.dup(1), "w") as answers, contextlib.redirect_stdout(sys.stderr):
        os.dup2(2, 1)
        serve_chain(answers)
