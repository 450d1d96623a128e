"""Claims about the printed equations: each put into (5) on the Hopf curves of results/hopf/."""

import dataclasses

import numpy as np

from scripts.claims.claims_results import Finding, Results, decided, decided_after_correction, short
from scripts.claims.printed_formulas import (
    epsilon_of_8,
    friction_corrected,
    friction_of_3,
    friction_of_4,
    least_residual_of_5,
    mismatch_with_5,
    points_of,
    residual_of_5,
    residual_of_6,
    xi_of_9,
)

FREQUENCIES = 2000
"""Frequencies at which (9) is tried."""


def equation_3(results: Results, *, plane: str, limit: float) -> Finding:
    """Whether (5) without delay follows from (3)."""
    points = points_of(results.curves[plane])
    tau = np.zeros_like(points.omega)
    printed = mismatch_with_5(points, tau, friction_of_3).max()
    corrected = mismatch_with_5(points, tau, friction_corrected).max()
    return decided_after_correction(
        printed <= limit,
        corrected <= limit,
        f"The linearisation of (3) is compared with (5) at tau = 0, at {points.omega.size} points."
        f" As printed, it differs by up to {short(printed)} of the largest term. With theta +"
        f" (1 + epsilon) ln v it differs by up to {short(corrected)}.",
        "It has theta + (1 + epsilon) log v.",
    )


def equation_4(results: Results, *, plane: str, limit: float) -> Finding:
    """Whether (5) follows from (4)."""
    points = points_of(results.curves[plane])
    printed = mismatch_with_5(points, points.tau, friction_of_4)
    corrected = mismatch_with_5(points, points.tau, friction_corrected).max()
    there = printed[np.isfinite(printed)]
    elsewhere = (
        f" Elsewhere it differs from (5) by up to {short(there.max())} of the largest term."
        if there.size
        else ""
    )
    return decided_after_correction(
        printed.max() <= limit,
        corrected <= limit,
        f"The linearisation of (4) as printed has no value at {printed.size - there.size} of"
        f" {printed.size} points, where v - tau <= 0.{elsewhere} With theta + (1 + epsilon)"
        f" ln v(t - tau) it differs by up to {short(corrected)}.",
        "It has theta + (1 + epsilon) log v(t - tau).",
    )


def equation_6(results: Results, *, planes: list[str], limit: float) -> Finding:
    """Whether (6) holds on the curves."""
    largest = max(residual_of_6(points_of(results.curves[plane])).max() for plane in planes)
    return decided(
        largest <= limit,
        f"Largest residual of (6) as printed on the curves of {' and '.join(planes)}:"
        f" {short(largest)}. The right side of (6) has absolute value 1.",
        f"The residual of (6) is up to {short(largest, 2)}.",
    )


def equation_8(results: Results, *, plane: str, limit: float) -> Finding:
    """Whether (5) can hold with the epsilon of (7) and (8), whatever the delay."""
    points = points_of(results.curves[plane])
    printed, corrected = (
        least_residual_of_5(points, epsilon_of_8(points, power)).max() for power in (1, 2)
    )
    off = np.abs(epsilon_of_8(points, 1) - points.epsilon).max()
    return decided_after_correction(
        printed <= limit,
        corrected <= limit,
        f"Largest residual of (5) with the delay that fits best: {short(printed)} with gamma^1 as"
        f" printed, {short(corrected)} with gamma^2. With gamma^1 the error of epsilon is up to"
        f" {short(off)}.",
        "The power in (8) is gamma^2.",
    )


def equation_9(results: Results, *, plane: str, limit: float) -> Finding:
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
        f"At {points.omega.size} points of the Hopf curves at tau = {short(tau[0])} the relative"
        f" error of xi by (9) as printed is at most {short(on_curve)}. Remark: (9) also gives a xi"
        f" where (6) asks for 1 + epsilon < 0. This happens at {false} of {kept.sum()} frequencies"
        " with a xi within the figure.",
        f"The relative error of xi by (9) is up to {short(on_curve, 2)}.",
    )


def equation_10(results: Results, *, plane: str, limit: float) -> Finding:
    """Whether (5) holds at the delay of (10)."""
    curves = results.curves[plane]
    printed, corrected = float(curves.printed_residual.max()), float(curves.residual.max())
    off = float(np.abs(curves.printed_tau - curves.tau).max())
    return decided_after_correction(
        printed <= limit,
        corrected <= limit,
        f"Largest residual of (5): {short(printed)} with (10) as printed, {short(corrected)} with"
        " + gamma^2 and the two-argument arctangent. The error of tau by (10) as printed is up to"
        f" {short(off)}.",
        "The numerator has + gamma^2, and the arctangent takes two arguments.",
    )


def hopf_curves(results: Results, *, planes: list[str], limit: float) -> Finding:
    """Whether (7) to (10) taken together give the curves of these planes."""
    printed = corrected = points = branches = 0
    for plane in planes:
        curves = results.curves[plane]
        on_curve = points_of(curves)
        delay = curves.printed_tau.values if curves.attrs["ordinate"] == "tau" else on_curve.tau
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


def lag_of_the_plate(results: Results, *, plane: str, limit: float) -> Finding:
    """Whether the curves are those of a block that a lag parts from the plate.

    A plate of constant speed that lags by tau shifts u by -tau and nothing else, so (5) holds
    without its factor exp(-s tau).
    """
    points = points_of(results.curves[plane])
    lagging = residual_of_5(points, points.epsilon, np.zeros_like(points.tau)).max()
    return decided(
        lagging <= limit,
        "The plate has a constant speed: a lag tau between plate and block only shifts u by -tau,"
        " and the roots of (5) are those without delay. On the Hopf curves the residual of (5)"
        f" without delay is up to {short(lagging)}, with delay"
        f" {short(residual_of_5(points, points.epsilon, points.tau).max())}.",
        "The delay of (4) is another: friction responds to the velocity of the block a time tau"
        " ago.",
    )


TESTS = {
    "equation_3": equation_3,
    "equation_4": equation_4,
    "equation_6": equation_6,
    "equation_8": equation_8,
    "equation_9": equation_9,
    "equation_10": equation_10,
    "hopf_curves": hopf_curves,
    "lag_of_the_plate": lag_of_the_plate,
}
