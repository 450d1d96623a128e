"""Claims about stiffness, stick-slip, the stationary state and friction."""

import numpy as np

from scripts.claims.claims_results import Finding, Results, decided, decided_after_correction, short

SMALL = 1e-3
"""An error that a figure does not show."""
WITHIN_EXPECTED = 100.0
"""Times tolerance and amplification within which an error is what these let expect."""


def out_of_reach(results: Results, *, method: str, least: float, most: float) -> Finding:
    """Whether no run of this method with gamma in this range comes to its end."""
    runs = [
        row
        for row in results.stability
        if row["method"] == method and least <= row["gamma"] <= most
    ]
    done = [row for row in runs if row["status"] == "ok"]
    compared = [row for row in done if row["error_expected"] > 0]
    small = sum(row["error"] <= SMALL for row in compared)
    trusted = sum(row["error"] <= WITHIN_EXPECTED * row["error_expected"] for row in compared)
    told = (
        f"; of {len(compared)} errors against quadruple precision {small} are at most {SMALL:g} and"
        f" {trusted} within {WITHIN_EXPECTED:g} times tolerance times amplification"
        if compared
        else ""
    )
    return decided(
        bool(runs) and not done,
        f"{len(done)} of {len(runs)} runs by the method {method} with gamma from {least:g} to"
        f" {most:g} come to their end{told}.",
    )


def relaxation(results: Results, *, method: str, ratio: float) -> Finding:
    """Whether v spans at least this ratio between stick and slip in some run."""
    runs = [row for row in results.stability if row["method"] == method and row["status"] == "ok"]
    if not runs:
        return decided(False, f"No run of {method} comes to its end.")
    spans = np.array([row["most_ln_v"] - row["least_ln_v"] for row in runs])
    widest = runs[int(spans.argmax())]
    wide = int((spans >= np.log(ratio)).sum())
    return decided(
        wide > 0,
        f"In {wide} of {len(runs)} runs v spans a factor of {ratio:g} or more; in the widest"
        f" ({widest['case']}) ln v goes from {short(widest['least_ln_v'])} to"
        f" {short(widest['most_ln_v'])}.",
    )


def stationary_state(results: Results, *, within: float) -> Finding:
    """Whether runs over long times that decay end at (0, 0, 1), and nothing else is stationary."""
    runs = [row for row in results.stability if str(row["reference"]).startswith("exact")]
    ends = [row["error"] for row in runs if row["status"] == "ok"]
    return decided(
        len(ends) == len(runs) > 0 and max(ends) <= within,
        "du/dt = 0 leaves v = 1, then d theta/dt = 0 leaves theta = 0 and dv/dt = 0 leaves u = 0;"
        f" {len(ends)} of {len(runs)} long runs that decay reach their end, at most"
        f" {short(max(ends, default=np.nan))} from there.",
    )


def velocity_step(results: Results) -> Finding:
    """Whether friction rises with a sudden velocity and then falls to below its first value."""
    friction = results.friction
    direct, evolution = (friction.attrs[f"{name}_effect"] for name in ("direct", "evolution"))
    last = float(friction.mu[-1] - friction.mu[0])
    return decided(
        direct > 0 > direct + evolution and abs(last) < abs(direct + evolution),
        f"On a step of v from {short(friction.attrs['v0'])} by {short(friction.attrs['delta_v'])}"
        f" m/s friction jumps by {short(direct)}, then changes by {short(evolution)}; after the"
        f" step back it ends {short(last)} from its first value.",
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
        f" the {of_b.size} samples of the velocity step, and its change after the step up by"
        f" {short(of_change)}: where only the second is negative, a larger epsilon means more"
        " friction at any given state, and a larger fall once the block has become faster.",
    )


TESTS = {
    "out_of_reach": out_of_reach,
    "relaxation": relaxation,
    "stationary_state": stationary_state,
    "velocity_step": velocity_step,
    "friction_falls_with_epsilon": friction_falls_with_epsilon,
}
