# SPDX-License-Identifier: BSD-3-Clause
"""Errors of all methods where f saturates: thirty right-hand sides that switch.

    python python/benchmarks/switches.py > measured-switches.tsv
    python python/benchmarks/switches.py picture OLDER.tsv measured-switches.tsv PICTURE.png

In 24 of them x = -cos(t - lag) is known, lag 0 or 1/2, and z' = f(x) is integrated by quadrature.
In six the switch acts back with delay 1: SciPy's DOP853 integrates them interval by interval in
short steps. The error at the end is in units of the tolerance times the condition: the largest
change at the end by a change of one state, at one of some times, over that change.
"""

import sys
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cached_property

import delaykit as dk
import numpy as np

METHODS = ("bs5", "dop853", "taylor", "radau5", "radau9", "radau13", "auto")
TOLERANCES = tuple(10.0**-n for n in range(3, 11))
T_END, LAGS = 20.0, (0.0, 0.5)
PANELS = 40_000
"""Of the quadrature, with eight Gauss points each: 0.1 of the shortest switch"""
DISTURBANCE, TIMES = 1e-6, 21
"""Change of a state for the condition, and the times of changes"""
SHORT = 0.002
"""Longest step of the reference"""


@dataclass
class Problem:
    """A switching right-hand side, with its state at the end."""

    name: str
    model: dk.Model
    history: dict[str, float]
    t_end: float
    parameters: dict[str, float] = field(default_factory=dict)

    def run(self, method: str, tolerance: float, **options) -> dk.runs.Solution:
        """The run to the end."""
        return self.model.integrate(
            self.history, self.t_end, parameters=self.parameters, t_eval=[self.t_end],
            method=method, rtol=tolerance, atol=tolerance, **options,
        )  # fmt: skip

    def error(self, method: str, tolerance: float) -> float:
        """The error at the end over tolerance and condition."""
        found = self.run(method, tolerance).y[:, -1]
        scale = tolerance * (1 + np.abs(self.exact))
        return float(np.max(np.abs(found - self.exact) / scale)) / self.condition


@dataclass
class Driven(Problem):
    """z' = f(x) along x = -cos(t - lag)."""

    rate: Callable = np.tanh

    def integral(self, panels: int, disturbed: Callable = np.zeros_like) -> float:
        """z at the end, where x is disturbed."""
        places, weights = np.polynomial.legendre.leggauss(8)
        width = self.t_end / panels
        t = width * (np.arange(panels)[:, None] + 0.5 + 0.5 * places)
        t = t - self.parameters["lag"]
        # before the start x is constant
        x = -np.cos(np.maximum(t, 0)) + disturbed(t)
        return float((self.rate(x) * weights).sum() * width / 2)

    @cached_property
    def exact(self) -> np.ndarray:
        t = self.t_end
        return np.array([-np.cos(t), np.sin(t), self.integral(PANELS)])

    @cached_property
    def condition(self) -> float:
        def change(start: float, wave: Callable) -> float:
            def disturbed(t):
                return DISTURBANCE * np.where(t >= start, wave(t - start), 0)

            return abs(self.integral(PANELS // 8, disturbed) - self.integral(PANELS // 8))

        starts = np.linspace(0, self.t_end, TIMES)
        return 1 + max(change(s, wave) for s in starts for wave in (np.cos, np.sin)) / DISTURBANCE


@dataclass
class Feedback(Problem):
    """A switch that acts back after delay 1."""

    rates: Callable = np.tanh
    """f(y, y(t - 1))"""

    @cached_property
    def exact(self) -> np.ndarray:
        from scipy.integrate import solve_ivp

        state = np.array(list(self.history.values()))
        before = lambda t, constant=state: constant  # noqa: E731
        for start in range(int(self.t_end)):
            done = solve_ivp(
                lambda t, y, before=before: self.rates(y, before(t - 1)), (start, start + 1), state,
                method="DOP853", rtol=1e-13, atol=1e-13, max_step=SHORT, dense_output=True,
            )  # fmt: skip
            state, before = done.y[:, -1], done.sol
        return state

    @cached_property
    def condition(self) -> float:
        def change(time: float, state: str) -> float:
            dose = [(time, {state: DISTURBANCE})]
            found = self.run("dop853", 1e-11, max_step=10 * SHORT, doses=dose).y[:, -1]
            return np.max(np.abs(found - self.exact))

        times = np.linspace(0, self.t_end, TIMES)[1:-1]
        return 1 + max(change(s, state) for s in times for state in self.history) / DISTURBANCE


def driven() -> list[Driven]:
    """Twelve right-hand sides, each with and without delay."""
    oscillator = {"x": "y", "y": "-x"}
    texts = {
        "tanh": "1 + tanh(k*(X - at))",
        "logistic": "1/(1 + exp(-k*(X - at)))",
        "pulse": "exp(-(k*(X - at))**2)",
        "hill": "(X + at)**k/(1 + (X + at)**k)",
        "two": "tanh(k*(X - at)) + tanh(k*(X + at)/2) + tanh(k*(X - at/2))/3",
    }
    rates = {
        "tanh": lambda x, k, at: 1 + np.tanh(k * (x - at)),
        "logistic": lambda x, k, at: (1 + np.tanh(k * (x - at) / 2)) / 2,
        "pulse": lambda x, k, at: np.exp(-((k * (x - at)) ** 2)),
        "hill": lambda x, k, at: (1 + np.tanh(k * np.log(x + at) / 2)) / 2,
        "two": lambda x, k, at: (
            np.tanh(k * (x - at)) + np.tanh(k * (x + at) / 2) + np.tanh(k * (x - at / 2)) / 3
        ),
    }
    models = {
        name: dk.Model(
            oscillator | {"z": text.replace("X", "x(t - lag)")}, {"k": 1, "at": 0, "lag": 0}
        )
        for name, text in texts.items()
    }
    cases = {
        "tanh": ((1, 0), (10, 0.5), (50, 0.9), (200, 0), (200, 0.99), (1000, 0.999)),
        "logistic": ((360, 0.5), (100, 0.9)),
        "pulse": ((5, 0), (25, 0.9)),
        "hill": ((50, 1.2),),
        "two": ((150, 0.9),),
    }
    return [
        Driven(
            f"{name} k = {k} at {at}" + (", delayed" if lag else ""),
            models[name], {"x": -1.0, "y": 0.0, "z": 0.0}, T_END, {"k": k, "at": at, "lag": lag},
            lambda x, name=name, k=k, at=at: rates[name](x, k, at),
        )
        for name, pairs in cases.items()
        for k, at in pairs
        for lag in LAGS
    ]  # fmt: skip


def feedback() -> list[Feedback]:
    """Six right-hand sides: relays, neurons, production with a steep Hill function."""

    def of(name, equations, history, t_end, rates):
        return Feedback(name, dk.Model(equations), history, t_end, {}, rates)

    def relay(k, start):
        return of(
            f"relay k = {k} from {start}", {"x": f"-x - tanh({k}*x(t - 1))"}, {"x": start}, 20.0,
            lambda y, z: -y - np.tanh(k * z),
        )  # fmt: skip

    return [
        relay(8, 3.0),
        relay(10, 2.0),
        relay(100, 2.0),
        of(
            "Hill n = 50", {"x": "2*x(t - 1)/(1 + x(t - 1)**50) - x"}, {"x": 0.5}, 6.0,
            lambda y, z: 2 * z / (1 + z**50) - y,
        ),
        of(
            "neurons", {
                "x": "-x + 1/(1 + exp(60*(y(t - 1) - 1/2)))",
                "y": "-y + 1/(1 + exp(-40*(x(t - 1) - 2/5)))",
            }, {"x": 0.9, "y": 0.1}, 12.0,
            lambda y, z: -y + 1 / (1 + np.exp([60 * (z[1] - 0.5), -40 * (z[0] - 0.4)])),
        ),
        of(
            "oscillator", {"x": "y", "y": "-x + tanh(200*(x(t - 1) - 9/10))/3 - y/10"},
            {"x": -1.0, "y": 0.0}, 15.0,
            lambda y, z: np.array([y[1], -y[0] + np.tanh(200 * (z[0] - 0.9)) / 3 - y[1] / 10]),
        ),
    ]  # fmt: skip


def table() -> None:
    """Print a row for each method and tolerance: the largest error and its problem."""
    problems = [*driven(), *feedback()]
    print("method\ttolerance\tlargest\tof\tmedian\trefused")
    for method in METHODS:
        for tolerance in TOLERANCES:
            errors = {}
            for problem in problems:
                try:
                    errors[problem.name] = problem.error(method, tolerance)
                except dk.RunError:
                    errors[problem.name] = np.nan
            values = np.array([*errors.values()])
            worst = [*errors][np.nanargmax(values)]
            largest, median = np.nanmax(values), np.nanmedian(values)
            refused = np.isnan(values).sum()
            print(f"{method}\t{tolerance:.0e}\t{largest:.2g}\t{worst}\t{median:.2g}\t{refused}")


def picture(before: str, now: str, path: str) -> None:
    """Draw the largest errors of two tables."""
    from matplotlib import pyplot as plt

    figure, panels = plt.subplots(1, 2, figsize=(6.7, 3.0), sharey=True, layout="constrained")
    for axes, title, source in zip(panels, ("before", "now"), (before, now), strict=True):
        with open(source, encoding="utf-8") as file:
            rows = [line.split("\t") for line in file][1:]
        for method, marker in zip(METHODS, "ovs^<>D", strict=True):
            mine = np.array([row[1:3] for row in rows if row[0] == method], float)
            axes.plot(*mine.T, marker=marker, markersize=3, linewidth=0.8, label=method)
        axes.axhline(30, color="black", linewidth=0.8, linestyle="--")
        axes.set(xscale="log", yscale="log", title=title, xlabel="tolerance")
        axes.invert_xaxis()
    panels[0].set_ylabel("largest error / (tolerance × condition)")
    panels[1].legend(fontsize=7, ncols=2)
    figure.savefig(path, dpi=150)


if __name__ == "__main__":
    picture(*sys.argv[2:]) if sys.argv[1:2] == ["picture"] else table()
