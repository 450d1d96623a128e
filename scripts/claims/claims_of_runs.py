"""Claims about stiffness, stick-slip, the stationary state and friction."""

import numpy as np

from scripts.claims.claims_results import Finding, Results, decided, decided_after_correction, short

SMALL = 1e-3
"""An error that a figure does not show."""
WITHIN_EXPECTED = 100.0
"""Largest error that is expected, over tolerance times amplification."""


def out_of_reach(results: Results, *, method: str, least: float, most: float) -> Finding:
    """Whether no run of this method with gamma in this range is completed."""
    runs = [
        row
        for row in results.stability
        if row["method"] == method and least <= row["gamma"] <= most
    ]
    done = [row for row in runs if row["status"] == "ok"]
    compared = [row for row in done if row["error_expected"] > 0]
    small = sum(row["error"] <= SMALL for row in compared)
    trusted = sum(row["error"] <= WITHIN_EXPECTED * row["error_expected"] for row in compared)
    errors = (
        f" {small} of {len(compared)} errors against quadruple precision are at most {SMALL:g}."
        f" {trusted} are at most {WITHIN_EXPECTED:g} times tolerance times amplification."
        if compared
        else ""
    )
    return decided(
        bool(runs) and not done,
        f"{len(done)} of {len(runs)} runs by the method {method} with gamma from {least:g} to"
        f" {most:g} are completed.{errors}",
    )


def relaxation(results: Results, *, method: str, ratio: float) -> Finding:
    """Whether v spans at least this ratio between stick and slip in some run."""
    runs = [row for row in results.stability if row["method"] == method and row["status"] == "ok"]
    if not runs:
        return decided(False, f"No run by the method {method} is completed.")
    spans = np.array([row["most_ln_v"] - row["least_ln_v"] for row in runs])
    widest = runs[int(spans.argmax())]
    wide = int((spans >= np.log(ratio)).sum())
    return decided(
        wide > 0,
        f"In {wide} of {len(runs)} runs v spans a factor of {ratio:g} or more. The factor is"
        f" largest in {widest['case']}: ln v ranges from {short(widest['least_ln_v'])} to"
        f" {short(widest['most_ln_v'])}.",
    )


def stationary_state(results: Results, *, within: float) -> Finding:
    """Whether runs over long times that decay end at (0, 0, 1), and nothing else is stationary."""
    runs = [row for row in results.stability if str(row["reference"]).startswith("exact")]
    ends = [row["error"] for row in runs if row["status"] == "ok"]
    return decided(
        len(ends) == len(runs) > 0 and max(ends) <= within,
        "du/dt = 0 gives v = 1. Then d theta/dt = 0 gives theta = 0, and dv/dt = 0 gives u = 0."
        f" {len(ends)} of {len(runs)} long runs that decay are completed. They end at most"
        f" {short(max(ends, default=np.nan))} from this state.",
    )


def velocity_step(results: Results) -> Finding:
    """Whether friction rises with a sudden velocity and then falls to below its first value."""
    friction = results.friction
    direct, evolution = (friction.attrs[f"{name}_effect"] for name in ("direct", "evolution"))
    last = float(friction.mu[-1] - friction.mu[0])
    return decided(
        direct > 0 > direct + evolution and abs(last) < abs(direct + evolution),
        f"v rises from {short(friction.attrs['v0'])} m/s by {short(friction.attrs['delta_v'])} m/s."
        f" Friction jumps by {short(direct)}, then changes by {short(evolution)}. After the step"
        f" back it ends {short(last)} from its first value.",
    )


def friction_falls_with_epsilon(results: Results) -> Finding:
    """Whether friction (1.1) is smaller where epsilon is larger by B: itself, or its change."""
    friction = results.friction
    of_b = np.log(friction.theta.values / friction.attrs["b_state"] + 1)
    of_change = friction.attrs["evolution_effect"] / friction.attrs["b"]
    return decided_after_correction(
        bool((of_b < 0).all()),
        of_change < 0,
        f"By (1.1) friction changes by {short(of_b.min())} to {short(of_b.max())} per unit of B at"
        f" the {of_b.size} samples of the velocity step. Its change after the step up varies by"
        f" {short(of_change)} per unit of B. If only the second value is negative, a larger"
        " epsilon gives more friction in a given state, but a larger fall after the step up.",
    )


TESTS = {
    "out_of_reach": out_of_reach,
    "relaxation": relaxation,
    "stationary_state": stationary_state,
    "velocity_step": velocity_step,
    "friction_falls_with_epsilon": friction_falls_with_epsilon,
}
