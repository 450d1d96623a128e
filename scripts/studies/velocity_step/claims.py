"""Claims about the friction law (1.1) and (1.2), by the velocity step of Figure 8."""

from typing import Annotated

import numpy as np

from scripts.claims.claims_results import Finding, Results, decided, decided_after_correction, short
from scripts.claims.declare import claim, number, reads, says, tested_with
from scripts.studies.velocity_step.table import columns_of, effects_of

Difference = Annotated[float, number("largest difference that counts as none")]


@claim(13, "mu0_is_steady_friction", "section 1, below (1.2)", look_at="figure_8")
@says("In (1.1) $mu0$ is the steady friction at $v = v0$.")
@tested_with(limit=1e-06)
@reads("velocity_step")
def mu0_is_steady_friction(results: Results, *, limit: Difference) -> Finding:
    """Whether steady friction at v0 is mu0."""
    friction = columns_of(results.velocity_step)
    a, b, mu0, v0, dc, b_state = (
        float(friction[key][0]) for key in ("a", "b", "mu0", "v0", "dc", "b_state")
    )
    # the block slides steadily at v0 before the step
    steady = float(friction["mu"][0])
    off = steady - mu0
    of_v, of_theta = -a * np.log(2), b * np.log(dc / (v0 * b_state) + 1)
    # rounded: theta at v0 may be b but for the last digit
    without = round(b * np.log(dc / (v0 * b_state)), 12) + 0.0
    return decided(
        abs(off) <= limit,
        f"By (1.1) steady friction at $v0 = {short(v0)}$ m/s is {short(steady, 6)}"
        f" and $mu0$ is {short(mu0)}. The difference is ${short(off)} = -A ln 2 + B ln(theta/b +"
        f" 1)$ with $-A ln 2 = {short(of_v)}$ and $B ln(theta/b + 1) = {short(of_theta)}$. Without"
        f" the 1 in both logarithms it is $B ln(theta/b) = {short(without)}$.",
        "Steady friction at $v0$ also contains the 1 in both logarithms.",
    )


@claim(14, "same_state_law", "section 2, above (2)", look_at="figure_8")
@says("The equations of motion (2) are coupled with the friction law (1.1) and (1.2).")
@tested_with(limit=1e-06)
@reads("velocity_step")
def same_state_law(results: Results, *, limit: Difference) -> Finding:
    """Whether the state law of (2) is (1.2), with theta of (2) as B ln(theta v0/Dc) of (1.2)."""
    friction = columns_of(results.velocity_step)
    x = friction["velocity"] * friction["theta"] / friction["dc"]
    ageing, slip = 1 - x, -x * np.log(x)
    off = np.abs(ageing - slip)
    largest = int(off.argmax())
    return decided(
        off[largest] <= limit,
        "(1.2) is the ageing form of the state law: $d theta/dt = 1 - x$ with $x = v theta/Dc$."
        " (2) is the slip form: with $B ln(theta v0/Dc)$ in the place of its $theta$ it gives $d"
        f" theta/dt = -x ln x$. At {x.size} samples of the velocity step $x$ ranges from"
        f" {short(x.min())} to {short(x.max())}. The forms differ most at $x ="
        f" {short(x[largest])}$: $d theta/dt = {short(ageing[largest])}$ by (1.2) and"
        f" {short(slip[largest])} by (2). Near steady sliding ($x = 1$) they agree in first order.",
        "(2) has another state law than (1.2): the slip form, not the ageing form.",
    )


@claim(46, "figure_8", "Figure 8, caption", look_at="figure_8")
@says("Friction responds to a step of the imposed velocity.")
@reads("velocity_step")
def velocity_step(results: Results) -> Finding:
    """Whether friction rises with a sudden velocity and then falls to below its first value."""
    friction = columns_of(results.velocity_step)
    direct, evolution = effects_of(friction)
    last = float(friction["mu"][-1] - friction["mu"][0])
    v0, step = friction["v0"][0], friction["delta_v"][0]
    return decided(
        direct > 0 > direct + evolution and abs(last) < abs(direct + evolution),
        f"$v$ rises from {short(v0)} m/s by {short(step)} m/s. Friction jumps by {short(direct)},"
        f" then changes by {short(evolution)}. After the step back it ends {short(last)} from"
        " its first value.",
        f"Friction changes by {short(direct)} at the step and by {short(evolution)} over the slip"
        " that follows.",
    )


@claim(45, "friction_falls_with_epsilon", "section 4", look_at="figure_8")
@says("A larger $epsilon$ means a smaller friction on the contact.")
@reads("velocity_step")
def friction_falls_with_epsilon(results: Results) -> Finding:
    """Whether friction falls with epsilon: by (1.1) in any state, by (2) in steady sliding.

    In steady sliding theta of (2) is -B ln(v/v0), and its friction is -(B - A) ln(v/v0).
    """
    friction = columns_of(results.velocity_step)
    by_b = np.log(friction["theta"] / friction["b_state"] + 1)
    by_a = np.log(friction["v0"] / friction["velocity"] + 1)
    most = float((abs(friction["velocity"]) / friction["v0"]).max())
    return decided_after_correction(
        bool((by_b < 0).all() and (by_a < 0).all()),
        most > 1,
        f"$epsilon = (B - A)/A$ grows with a larger $B$ or a smaller $A$. In the {by_b.size}"
        f" states of the velocity step friction by (1.1) changes by {short(by_b.min())} to"
        f" {short(by_b.max())} per unit of $B$, and by {short(by_a.min())} to {short(by_a.max())}"
        " per unit by which $A$ becomes smaller. A positive number is more friction. By (2), the"
        " law that is solved, friction in steady sliding is $-(B - A) ln(v/v0)$. At the largest"
        f" velocity of the step, {short(most)} $v0$, it changes by {short(-np.log(most))} per unit"
        " of $B - A$. Slower than $v0$ it grows with $B - A$.",
        "By (1.1) friction grows with $epsilon$ in"
        f" {int(((by_b > 0) & (by_a > 0)).sum())} of {by_b.size} states. It falls by (2), in steady"
        " sliding faster than $v0$.",
    )
