"""Friction after steps of the imposed velocity (Figure 8), by (1.1) and (1.2), SI units."""

import numpy as np

from scripts.files.outputs import logged
from scripts.files.tsv import as_digits, write_table


def friction_of(law: dict, v, theta):
    """(1.1): mu = mu0 - A ln(v0/v + 1) + B ln(theta/b + 1); v in m/s, theta and b in s."""
    direct, evolution = np.log(law["v0"] / v + 1), np.log(theta / law["b_state"] + 1)
    return law["mu0"] - law["a"] * direct + law["b"] * evolution


def state_after(law: dict, v: float, t, theta: float):
    """(1.2), theta' = 1 - v theta/Dc, at constant v in m/s: the state t seconds after theta."""
    return law["dc"] / v + (theta - law["dc"] / v) * np.exp(-v * t / law["dc"])


def respond(step: dict) -> dict[str, np.ndarray]:
    """Time in s, slip in m, velocity in m/s, theta in s, mu; shape (3 samples).

    The block slides steadily at v0, then at v0 + delta_v, then at v0. The velocity of a step is
    imposed at once: the slip there stands twice. `step` has the keys of the configuration.
    """
    time = slip = 0.0
    theta = step["dc"] / step["v0"]
    phases = []
    for key, faster in (("slip_before", 0.0), ("slip_after", step["delta_v"]), ("slip_after", 0)):
        v = step["v0"] + faster
        t = np.linspace(0.0, step[key] * step["dc"] / v, step["samples"])
        state = state_after(step, v, t, theta)
        mu = friction_of(step, v, state)
        phases.append((time + t, slip + v * t, np.full(t.size, v), state, mu))
        time, slip, theta = time + t[-1], slip + v * t[-1], state[-1]
    names = ("time", "slip", "velocity", "theta", "mu")
    return dict(zip(names, map(np.concatenate, zip(*phases, strict=True)), strict=True))


def columns_of(rows: list[dict]) -> dict[str, np.ndarray]:
    """The response by the rows of its table; the law's parameters are the same in all rows."""
    return {key: np.array([row[key] for row in rows]) for key in rows[0]}


def effects_of(columns: dict[str, np.ndarray]) -> tuple[float, float]:
    """The jump of friction at the step up, and its change over the slip that follows."""
    up, down = np.flatnonzero(np.diff(columns["velocity"])) + 1
    mu = columns["mu"]
    return float(mu[up] - mu[up - 1]), float(mu[down - 1] - mu[up])


if __name__ == "__main__":
    with logged(snakemake.log[0]):
        step = snakemake.params.step
        response = respond(step)
        law = {key: step[key] for key in ("mu0", "a", "b", "dc", "v0", "b_state", "delta_v")}
        samples = zip(*response.values(), strict=True)
        write_table(
            snakemake.output[0],
            [dict(zip(response, map(as_digits, sample), strict=True)) | law for sample in samples],
        )
