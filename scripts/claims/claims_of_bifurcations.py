"""Claims about stability and Hopf bifurcations of steady sliding."""

import numpy as np

from scripts.claims.claims_results import (
    CORRECTED,
    NOT_REPRODUCED,
    REPRODUCED,
    Finding,
    Results,
    changes,
    decided,
    listed,
    short,
)

KINDS = {"supercritical": -1, "subcritical": 1}
"""Kinds of a Hopf bifurcation by the sign of the first Lyapunov coefficient."""


def hopf_only_by_delay(results: Results, *, plane: str) -> Finding:
    """Whether there is no Hopf point without delay."""
    points = [
        row
        for row in results.hopf_points
        if row["of"] == plane and row["kind"] == "hopf_without_delay"
    ]
    if not points:
        return decided(True, f"No Hopf point at tau = 0 in the plane {plane}.")
    point = points[0]
    epsilon, xi, square = point["epsilon"], point["xi"], point["gamma"] ** 2
    expected = square * xi / (xi + square)
    cubic = [1 + square / xi, square + (square - (1 + epsilon) * square) / xi, square]
    hurwitz = cubic[0] * cubic[1] - cubic[2]
    return decided(
        False,
        f"At tau = 0, xi = {short(xi)}, gamma = {short(point['gamma'])} a pair of roots is"
        f" imaginary at epsilon = {short(epsilon, 9)}. The Routh-Hurwitz criterion gives"
        f" gamma^2 xi/(xi + gamma^2) = {short(expected, 9)}. At this point a2 a1 - a0 ="
        f" {short(hurwitz)} and the first Lyapunov coefficient is {short(point['l1_1'])}.",
    )


def kinds_of_hopf(results: Results, *, planes: list[str], expected: list[str]) -> Finding:
    """Kinds of the bifurcations at which steady sliding gains or loses stability."""
    epsilon, l1, everywhere = [], [], []
    for plane in planes:
        curves = results.curves[plane]
        at_boundary = curves.unstable_pairs.values == 0
        epsilon += list(curves.epsilon.values[at_boundary])
        l1 += list(curves.l1.values[at_boundary])
        everywhere += list(curves.l1.values)
    epsilon, signs = np.array(epsilon), np.sign(l1)
    parts = []
    for kind, sign in KINDS.items():
        these = epsilon[signs == sign]
        spread = f" (epsilon {short(these.min())} to {short(these.max())})" if these.size else ""
        parts.append(f"{these.size} {kind}{spread}")
    met = {kind for kind, sign in KINDS.items() if (signs == sign).any()}
    evidence = (
        f"Steady sliding changes its stability at {signs.size} points of {' and '.join(planes)}."
        f" By the first Lyapunov coefficient these are: {', '.join(parts)}. Of all"
        f" {len(everywhere)} points {int((np.array(everywhere) > 0).sum())} are subcritical."
    )
    if met == set(expected):
        return Finding(REPRODUCED, evidence)
    return Finding(CORRECTED if met > set(expected) else NOT_REPRODUCED, evidence)


def delay_destabilises(results: Results, *, scenes: list[str]) -> Finding:
    """Whether each scene has a delay at which steady sliding loses its stability."""
    parts, holds = [], True
    for scene in scenes:
        row = results.stability_of(scene)
        lost = [place for place, before, _ in changes(row["tau_of_changes"]) if before == 0]
        where = f"at tau = {listed([short(place, 6) for place in lost])}" if lost else "at no tau"
        parts.append(f"{scene} {where}")
        holds = holds and bool(lost)
    return decided(holds, f"A longer delay makes steady sliding unstable: {'; '.join(parts)}.")


def pairs_gained_and_lost(results: Results, *, plane: str) -> Finding:
    """Whether a longer delay makes pairs of roots unstable on some stretches, stable on others."""
    crossing = results.curves[plane].crossing.values
    gained, lost = int((crossing > 0).sum()), int((crossing < 0).sum())
    return decided(
        gained > 0 and lost > 0,
        f"With a longer delay a pair of roots becomes unstable at {gained} of {crossing.size}"
        f" points of the curves. A pair becomes stable at {lost} points.",
    )


def amplitude_death(results: Results, *, scenes: list[str]) -> Finding:
    """Whether steady sliding that is unstable at a delay is stable at a longer one."""
    parts = []
    for scene in scenes:
        row = results.stability_of(scene)
        regained = [
            place for place, before, after in changes(row["tau_of_changes"]) if before > after == 0
        ]
        if regained:
            parts.append(f"{scene} at tau = {', '.join(short(place, 6) for place in regained)}")
    return decided(
        bool(parts),
        f"Scenes in which a longer delay restores stability: {'; '.join(parts) or 'none'}.",
    )


def roots_decide(results: Results, *, scenes: list[str]) -> Finding:
    """Whether runs come to rest exactly where no root has a positive real part."""
    parts, holds = [], True
    for scene in scenes:
        pairs = results.stability_of(scene)["unstable_pairs"]
        met = results.attractors_of(scene)[0]["class"]
        parts.append(f"{scene}: {pairs:.0f}, {met}")
        holds = holds and (pairs == 0) == (met == "fixed point") and met != "undecided"
    return decided(holds, f"Unstable pairs and attractor of each scene: {'; '.join(parts)}.")


def independent_of_spring(results: Results, *, plane: str, limit: float) -> Finding:
    """Whether epsilon alone, whatever xi = k L/A, decides on stability."""
    curves = results.curves[plane]
    at_boundary = curves.unstable_pairs.values == 0
    epsilon, xi = (curves[key].values[at_boundary] for key in ("epsilon", "xi"))
    if not at_boundary.any():
        return decided(False, f"In {plane} steady sliding does not change its stability.")
    delays = curves.tau.values
    delay = short(delays[0]) if np.ptp(delays) == 0 else "various values"
    return decided(
        bool(np.ptp(epsilon) <= limit),
        f"At tau = {delay} and gamma = {short(curves.attrs['gamma'])} steady sliding changes"
        f" its stability at epsilon from {short(epsilon.min())} to {short(epsilon.max())}. There"
        f" xi = k L/A ranges from {short(xi.min())} to {short(xi.max())}.",
    )


TESTS = {
    "hopf_only_by_delay": hopf_only_by_delay,
    "kinds_of_hopf": kinds_of_hopf,
    "delay_destabilises": delay_destabilises,
    "pairs_gained_and_lost": pairs_gained_and_lost,
    "amplitude_death": amplitude_death,
    "roots_decide": roots_decide,
    "independent_of_spring": independent_of_spring,
}
