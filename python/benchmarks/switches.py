# SPDX-License-Identifier: BSD-3-Clause
"""Errors of all methods where f saturates: thirty right-hand sides that switch.

    python python/benchmarks/switches.py > measured-switches.tsv
    python python/benchmarks/switches.py picture OLDER.tsv measured-switches.tsv PICTURE.png

In 24 of them z' = f(x) along an oscillation x = -cos(t - delay), delay 0 or 1/2. In six the switch
acts back with delay 1. SciPy's DOP853 integrates them interval by interval in short steps. The
error at the end is in units of the tolerance times the condition: the largest change at the end by
a change of one state, at one of some times, over that change.
"""

import re
import sys
from dataclasses import dataclass
from functools import cached_property

import delaykit as dk
import numpy as np
import sympy
from scipy.integrate import solve_ivp

METHODS = ("bs5", "dop853", "taylor", "radau5", "radau9", "radau13", "auto")
TOLERANCES = tuple(10.0**-n for n in range(3, 11))
DISTURBANCE, TIMES = 1e-6, 21
"""Change of a state for the condition, and the times of changes"""
SHORT = 0.02
"""Longest step of the reference; with a tenth of it, or by quadrature, states at the end differ by
less than 3e-13 times the condition"""


@dataclass
class Problem:
    """A right-hand side that switches; X and Y are x and y a delay before."""

    name: str
    equations: dict[str, str]
    history: dict[str, float]
    t_end: float
    parameters: dict[str, float]

    @cached_property
    def model(self) -> dk.Model:
        late = {
            state: re.sub("[XY]", lambda found: f"{found[0].lower()}(t - delay)", text)
            for state, text in self.equations.items()
        }
        return dk.Model(late, dict.fromkeys(self.parameters, 1))

    def run(self, method: str, tolerance: float, **options) -> np.ndarray:
        """The state at the end of a run."""
        return self.model.integrate(
            self.history, self.t_end, parameters=self.parameters, t_eval=[self.t_end],
            method=method, rtol=tolerance, atol=tolerance, **options,
        ).y[:, -1]  # fmt: skip

    def error(self, method: str, tolerance: float) -> float:
        """The error at the end over tolerance and condition."""
        scale = tolerance * (1 + np.abs(self.exact)) * self.condition
        return float(np.max(np.abs(self.run(method, tolerance) - self.exact) / scale))

    @cached_property
    def exact(self) -> np.ndarray:
        """By SciPy, one delay after another."""
        names = [*self.history, *map(str.upper, self.history), *self.parameters]
        rates = sympy.lambdify(names, [*self.equations.values()])
        delay, state = self.parameters["delay"], [*self.history.values()]
        past = [lambda t: self.history.values()]

        def slope(t, y):
            late = past[-1](t - delay) if delay else y
            return rates(*y, *late, *self.parameters.values())

        for start in np.arange(0, self.t_end, delay or self.t_end):
            done = solve_ivp(
                slope, (start, start + (delay or self.t_end)), state,
                method="DOP853", rtol=1e-13, atol=1e-13, max_step=SHORT, dense_output=True,
            )  # fmt: skip
            state = done.y[:, -1]
            past.append(done.sol)
        return state

    @cached_property
    def condition(self) -> float:
        def change(time: float, state: str) -> float:
            dose = [(time, {state: DISTURBANCE})]
            found = self.run("dop853", 1e-11, max_step=SHORT, doses=dose)
            return np.max(np.abs(found - self.exact))

        times = np.linspace(0, self.t_end, TIMES)[:-1]
        return 1 + max(change(s, state) for s in times for state in self.history) / DISTURBANCE


SWITCHES = {
    "tanh": (
        "1 + tanh(k*(X - at))",
        [(1, 0), (10, 0.5), (50, 0.9), (200, 0), (200, 0.99), (1000, 0.999)],
    ),
    "logistic": ("1/(1 + exp(-k*(X - at)))", [(360, 0.5), (100, 0.9)]),
    "pulse": ("exp(-(k*(X - at))**2)", [(5, 0), (25, 0.9)]),
    "hill": ("(X + at)**k/(1 + (X + at)**k)", [(50, 1.2)]),
    "two": ("tanh(k*(X - at)) + tanh(k*(X + at)/2) + tanh(k*(X - at/2))/3", [(150, 0.9)]),
}
"""f(X), and pairs of k and at for which z' = f(X) is integrated."""
RELAY = {"x": "-x - tanh(k*X)"}
NEURONS = {
    "x": "-x + 1/(1 + exp(60*(Y - 1/2)))",
    "y": "-y + 1/(1 + exp(-40*(X - 2/5)))",
}
KICKED = {"x": "y", "y": "-x + tanh(200*(X - 9/10))/3 - y/10"}
PROBLEMS = [
    *(
        Problem(
            f"{name} k = {k} at {at}" + (", delayed" if delay else ""),
            {"x": "y", "y": "-x", "z": f}, {"x": -1.0, "y": 0.0, "z": 0.0}, 20.0,
            {"k": k, "at": at, "delay": delay},
        )
        for name, (f, cases) in SWITCHES.items()
        for k, at in cases
        for delay in (0.0, 0.5)
    ),
    *(
        Problem(f"relay k = {k} from {x}", RELAY, {"x": x}, 20.0, {"k": k, "delay": 1.0})
        for k, x in ((8, 3.0), (10, 2.0), (100, 2.0))
    ),
    Problem("Hill n = 50", {"x": "2*X/(1 + X**50) - x"}, {"x": 0.5}, 6.0, {"delay": 1.0}),
    Problem("neurons", NEURONS, {"x": 0.9, "y": 0.1}, 12.0, {"delay": 1.0}),
    Problem("oscillator", KICKED, {"x": -1.0, "y": 0.0}, 15.0, {"delay": 1.0}),
]  # fmt: skip


def table() -> None:
    """Print a row for each method and tolerance: the largest error and its problem."""
    print("method\ttolerance\tlargest\tof\tmedian\trefused")
    for method in METHODS:
        for tolerance in TOLERANCES:
            errors = {}
            for problem in PROBLEMS:
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
