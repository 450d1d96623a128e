# SPDX-License-Identifier: BSD-3-Clause
"""delaykit, the package of this project: chains of blocks, exponents and cycles of the block, the
equation of Mackey and Glass, networks of phases. Each process compiles its model."""

import os
import tempfile
from functools import cache
from pathlib import Path

CACHE = tempfile.TemporaryDirectory()
os.environ["DELAYKIT_CACHE"] = CACHE.name

import delaykit  # noqa: E402  after its cache
import numpy as np  # noqa: E402
from serving import BETA, PAST, RATE, N, mackey_glass, phases, serve  # noqa: E402

ROOT = Path(__file__).resolve().parents[2]
PARAMETERS = ("tau", "epsilon", "xi", "gamma")
KINDS = ("fold", "torus", "period_doubling")


def block(parameters: list[float], *parts: str, **more: float) -> delaykit.Model:
    """The block with the paper's law of friction."""
    folder = ROOT / "fortran" / "src" / "model"
    files = ["spring_block.yaml", *parts, "laws/slip_delayed_logarithm.yaml"]
    given = dict(zip(PARAMETERS, parameters, strict=False))
    return delaykit.Model.from_file(*(folder / file for file in files), **given, **more)


def chain(words: list[str], parameters: list[float], t_end: float, interval: float):
    """Blocks; the words are kappa, the ends, and the last time of samples."""
    model = block(parameters, "chain.yaml", kappa=float(words[0]))
    history = dict(zip(model.states, np.reshape(parameters[4:], (-1, 3)).T, strict=True))
    model.blocks, model.ends = (len(parameters) - 4) // 3, words[1]
    model.handle  # noqa: B018  compiled
    times = interval * np.arange(round(float(words[2]) / interval) + 1)

    def run(tolerance: float, wanted: bool):
        end = times[-1] if wanted else t_end
        limits = {"rtol": tolerance, "atol": tolerance, "t_eval": times if wanted else [t_end]}
        states = model.integrate(history, end, **limits).y
        return np.column_stack([limits["t_eval"], states.reshape(-1, states.shape[-1]).T])

    return run


def exponents(words: list[str], parameters: list[float], t_end: float, _):
    """Values and standard errors of a run from each velocity, a row for each."""
    model = block(parameters[:4])

    def values_from(v: float, tolerance: float) -> np.ndarray:
        past = {"theta": 0.0, "u": 0.0, "w": np.log(v)}
        found = model.exponents(past, 4, float(words[0]), t_end, rtol=tolerance)
        return np.concatenate([found["value"], found["error"]])

    return lambda tolerance, _: [values_from(v, tolerance) for v in parameters[4:]]


def cycles(words: list[str], parameters: list[float], *_):
    """Cycles along a parameter from Hopf points: a row of the number of orbits and the largest
    error of their multipliers, then a row for each special point, its kind and place."""
    along = words[0]
    start, end, intervals, degree, _, *place = parameters
    model = block(place)
    model.handle  # noqa: B018  compiled
    shape = {"intervals": int(intervals), "degree": int(degree)}

    def run(*_):
        found = model.cycle(None, along, (start, end), **shape)
        rows = [[0, found["branch"].size, float(found["multiplier_error"].max())]]
        points = zip(found["special_kind"].values, found[f"special_{along}"].values, strict=True)
        return rows + [[1 + KINDS.index(str(kind)), value, 0] for kind, value in points]

    return run


@cache
def equation() -> delaykit.Model:
    """The equation of Mackey and Glass, compiled."""
    text = "beta*y(t - tau)/(1 + y(t - tau)**n) - rate*y"
    model = delaykit.Model({"y": text}, {"beta": BETA, "n": N, "rate": RATE, "tau": 1})
    model.handle  # noqa: B018
    return model


def samples(tau: float, times: np.ndarray, tolerance: float) -> np.ndarray:
    """Solution at times, for one delay."""
    options = {"parameters": {"tau": tau}, "rtol": tolerance, "atol": tolerance}
    return equation().integrate(PAST, times[-1], t_eval=times, **options).y[0]


def spectrum(words: list[str], parameters: list[float], t_end: float, _):
    """The largest exponent of Mackey and Glass, of several that are computed."""
    [tau] = parameters
    model = equation().with_parameters(tau=tau)
    times = {"t_transient": float(words[1]), "t_end": t_end}

    def run(tolerance: float, _):
        found = model.exponents(PAST, int(words[0]), **times, rtol=tolerance)
        return [[tau, found["value"].values.max()]]

    return run


def scan(words: list[str], delays: list[float], t_end: float, _):
    """States at an early time; the run that is timed has maxima of all delays on all cores."""
    model = equation()

    def run(tolerance: float, wanted: bool):
        what, end = ("final", float(words[0])) if wanted else ("maxima", t_end)
        options = {"rtol": tolerance, "atol": tolerance, "history": PAST, "progress": False}
        found = model.scan(what, tau=delays, t_end=end, **options)
        return np.column_stack([delays, found.final.values]) if wanted else found

    return run


def kuramoto(_words: list[str], parameters: list[float], t_end: float, _):
    """Phases at the end, all to all."""
    n = int(parameters[0])
    omega, tau, first = phases(n)
    model = delaykit.Model(
        {"x[i]": "omega[i] + 1/n*sum(j, a[i, j]*sin(x[j](t - tau[i, j]) - x[i]))"},
        {"omega": omega, "tau": tau, "a": 1 - np.eye(n), "n": n},
        size={"i": n},
    )

    def run(tolerance: float, _):
        options = {"rtol": tolerance, "atol": tolerance, "t_eval": [t_end]}
        return list(enumerate(model.integrate({"x": first}, t_end, **options).y[:, 0]))

    return run


if __name__ == "__main__":
    tasks = {task.__name__: task for task in (chain, exponents, cycles, spectrum, kuramoto)}
    serve(delaykit.__version__, tasks | mackey_glass(samples, equation) | {"scan": scan})
