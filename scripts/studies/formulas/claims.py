"""Claims about the printed equations: each put into (5) on the Hopf curves of results/hopf/."""

import dataclasses

import numpy as np

from scripts.claims.claims_results import Finding, Results, decided, decided_after_correction, short
from scripts.claims.declare import Plane, Planes, Residual, claim, reads, says, tested_with
from scripts.studies.formulas.printed_formulas import (
    epsilon_of_8,
    friction_corrected,
    friction_of_3,
    friction_of_4,
    least_residual_of_5,
    mismatch_with_5,
    points_of,
    residual_of_5,
    residual_of_6,
    tau_of_10,
    xi_of_9,
)

FREQUENCIES = 2000
"""Frequencies at which (9) is tried."""


@claim(15, "equation_3", "section 2, (3)", look_at="figure_2")
@says("Without delay the scaled equations are (3); the first has $theta (1 + epsilon) log v$.")
@tested_with(plane="tau_of_epsilon")
@reads("curves")
def equation_3(results: Results, *, plane: Plane, limit: Residual = 1e-10) -> Finding:
    """Whether (5) without delay follows from (3)."""
    points = points_of(results.curves[plane])
    tau = np.zeros_like(points.omega)
    printed = mismatch_with_5(points, tau, friction_of_3).max()
    corrected = mismatch_with_5(points, tau, friction_corrected).max()
    return decided_after_correction(
        printed <= limit,
        corrected <= limit,
        f"The linearisation of (3) is compared with (5) at $tau = 0$, at {points.omega.size}"
        f" points. As printed, it differs by up to {short(printed)} of the largest term. With"
        f" $theta + (1 + epsilon) ln v$ it differs by up to {short(corrected)}.",
        "It has $theta + (1 + epsilon) log v$.",
    )


@claim(18, "equation_4", "section 2, (4)", look_at="figure_2")
@says(
    "With the delay the equations are (4); the first has $theta (1 + epsilon) log(v - tau)$, and"
    " (5) follows."
)
@tested_with(plane="tau_of_epsilon")
@reads("curves")
def equation_4(results: Results, *, plane: Plane, limit: Residual = 1e-10) -> Finding:
    """Whether (5) follows from (4)."""
    points = points_of(results.curves[plane])
    printed = mismatch_with_5(points, points.tau, friction_of_4)
    corrected = mismatch_with_5(points, points.tau, friction_corrected).max()
    there = printed[np.isfinite(printed)]
    elsewhere = ""
    if there.size:
        elsewhere = (
            f" Elsewhere it differs from (5) by up to {short(there.max())} of the largest term."
        )
    return decided_after_correction(
        printed.max() <= limit,
        corrected <= limit,
        f"The linearisation of (4) as printed has no value at {printed.size - there.size} of"
        f" {printed.size} points, where $v - tau <= 0$.{elsewhere} With"
        f" $theta + (1 + epsilon) ln v(t - tau)$ it differs by up to {short(corrected)}.",
        "It has $theta + (1 + epsilon) log v(t - tau)$.",
    )


@claim(20, "equation_6", "section 3, (6)", look_at="figure_2")
@says("An imaginary root of (5) satisfies (6).")
@tested_with(planes=["tau_of_epsilon", "xi_of_epsilon"])
@reads("curves")
def equation_6(results: Results, *, planes: Planes, limit: Residual = 1e-10) -> Finding:
    """Whether (6) holds on the curves."""
    largest = max(residual_of_6(points_of(results.curves[plane])).max() for plane in planes)
    return decided(
        largest <= limit,
        f"Largest residual of (6) as printed on the curves of {' and '.join(planes)}:"
        f" {short(largest)}. The right side of (6) has absolute value 1.",
        f"The residual of (6) is up to {short(largest, 2)}.",
    )


@claim(21, "equation_8", "section 3, (7) and (8)", look_at="figure_2")
@says("(7) and (8), with $gamma^1$ in (8), give $epsilon$ on the Hopf curves.")
@tested_with(plane="tau_of_epsilon")
@reads("curves")
def equation_8(results: Results, *, plane: Plane, limit: Residual = 1e-10) -> Finding:
    """Whether (5) can hold with the epsilon of (7) and (8), whatever the delay."""
    points = points_of(results.curves[plane])
    printed, corrected = (
        least_residual_of_5(points, epsilon_of_8(points, power)).max() for power in (1, 2)
    )
    off = np.abs(epsilon_of_8(points, 1) - points.epsilon).max()
    return decided_after_correction(
        printed <= limit,
        corrected <= limit,
        f"Largest residual of (5) with the delay that fits best: {short(printed)} with $gamma^1$ as"
        f" printed, {short(corrected)} with $gamma^2$. With $gamma^1$ the error of $epsilon$ is up"
        f" to {short(off)}.",
        "The power in (8) is $gamma^2$.",
    )


@claim(22, "equation_9", "section 3, (9)", look_at="figure_3")
@says("(9) gives $xi$ on the Hopf curves.")
@tested_with(plane="xi_of_epsilon", limit=1e-08)
@reads("curves")
def equation_9(results: Results, *, plane: Plane, limit: Residual = 1e-10) -> Finding:
    """Whether (9) gives xi at every point of the curves; also, how often it gives others."""
    points = points_of(results.curves[plane])
    given = xi_of_9(omega=points.omega, tau=points.tau, gamma=points.gamma)
    on_curve = np.abs(given / points.xi - 1).max()
    omega = np.linspace(points.omega.min(), points.omega.max(), FREQUENCIES)
    tau = np.full_like(omega, points.tau[0])
    xi = xi_of_9(omega=omega, tau=tau, gamma=points.gamma)
    kept = (xi >= points.xi.min()) & (xi <= points.xi.max())
    tried = dataclasses.replace(
        points, epsilon=0 * xi[kept], tau=tau[kept], xi=xi[kept], omega=omega[kept]
    )
    residual = residual_of_5(tried, epsilon_of_8(tried, 2), tried.tau)
    false = int((residual > limit).sum())
    return decided(
        on_curve <= limit,
        f"At {points.omega.size} points of the Hopf curves at $tau = {short(tau[0])}$ the relative"
        f" error of $xi$ by (9) as printed is at most {short(on_curve)}. Remark: (9) also gives a"
        f" $xi$ where (6) asks for $1 + epsilon < 0$. This happens at {false} of {kept.sum()}"
        " frequencies with a $xi$ within the figure.",
        f"The relative error of $xi$ by (9) is up to {short(on_curve, 2)}.",
    )


@claim(23, "equation_10", "section 3, (10)", look_at="figure_2")
@says(
    "(10), without $gamma^2$ in its numerator and with a plain arctangent, gives the critical"
    " delay."
)
@tested_with(plane="tau_of_epsilon")
@reads("curves")
def equation_10(results: Results, *, plane: Plane, limit: Residual = 1e-10) -> Finding:
    """Whether (5) holds at the delay of (10)."""
    curves = results.curves[plane]
    points = points_of(curves)
    tau = tau_of_10(points, curves.branch.values)
    printed = float(residual_of_5(points, points.epsilon, tau).max())
    corrected = float(curves.residual.max())
    off = float(np.abs(tau - points.tau).max())
    return decided_after_correction(
        printed <= limit,
        corrected <= limit,
        f"Largest residual of (5): {short(printed)} with (10) as printed, {short(corrected)} with"
        " $+ gamma^2$ and the two-argument arctangent. The error of $tau$ by (10) as printed is up"
        f" to {short(off)}.",
        "The numerator has $+ gamma^2$, and the arctangent takes two arguments.",
    )


@claim(29, "figure_2", "Figure 2", look_at="figure_2")
@says("The formulas give the Hopf curves $tau(epsilon)$ at $xi = 0.5$, $gamma = 0.8$.")
@tested_with(planes=["tau_of_epsilon"])
@claim(34, "figure_3", "Figure 3", look_at="figure_3")
@says("The formulas give the Hopf curves $xi(epsilon)$ at $tau = 12$, $gamma = 0.8$.")
@tested_with(planes=["xi_of_epsilon"])
@claim(51, "exact_curves", "section 5", look_at="figure_2")
@says("The parametric formulas of the Hopf curves are exact.")
@tested_with(planes=["tau_of_epsilon", "xi_of_epsilon"])
@reads("curves")
def hopf_curves(results: Results, *, planes: Planes, limit: Residual = 1e-10) -> Finding:
    """Whether (7) to (10) taken together give the curves of these planes."""
    printed = corrected = points = branches = 0
    for plane in planes:
        curves = results.curves[plane]
        on_curve = points_of(curves)
        of_tau = curves.attrs["ordinate"] == "tau"
        delay = tau_of_10(on_curve, curves.branch.values) if of_tau else on_curve.tau
        residual = residual_of_5(on_curve, epsilon_of_8(on_curve, 1), delay)
        printed = max(printed, residual.max())
        corrected = max(corrected, float(curves.residual.max()))
        points += residual.size
        branches += np.unique(curves.branch.values).size
    return decided_after_correction(
        printed <= limit,
        corrected <= limit,
        f"Largest residual of (5) at {points} points of {branches} branches: {short(printed)} with"
        f" the formulas as printed, {short(corrected)} with the corrected formulas.",
        f"At {points} points the residual of (5) is up to {short(printed, 2)} as printed and"
        f" {short(corrected, 2)} after correction.",
    )


@claim(17, "lag_of_the_plate", "section 2, above (4); section 4", look_at="figure_2")
@says("The delay is the lag between the motion of the plate and that of the block.")
@tested_with(plane="tau_of_epsilon")
@reads("curves")
def lag_of_the_plate(results: Results, *, plane: Plane, limit: Residual = 1e-10) -> Finding:
    """Whether the curves are those of a block that a lag parts from the plate.

    A plate of constant speed that lags by tau shifts u by -tau and nothing else, so (5) holds
    without its factor exp(-s tau).
    """
    points = points_of(results.curves[plane])
    lagging = residual_of_5(points, points.epsilon, np.zeros_like(points.tau)).max()
    return decided(
        lagging <= limit,
        "The plate has a constant speed: a lag $tau$ between plate and block only shifts $u$ by"
        " $-tau$, and the roots of (5) are those without delay. On the Hopf curves the residual"
        f" of (5) without delay is up to {short(lagging)}, with delay"
        f" {short(residual_of_5(points, points.epsilon, points.tau).max())}.",
        "The delay of (4) is another: friction responds to the velocity of the block a time $tau$"
        " ago.",
    )
