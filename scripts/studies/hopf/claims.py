"""Claims about stability and Hopf bifurcations of steady sliding."""

from typing import Annotated

import numpy as np

from scripts.claims.claims_results import (
    REPRODUCED,
    Finding,
    Results,
    changes,
    decided,
    equations,
    join,
    short,
)
from scripts.claims.declare import (
    Plane,
    Planes,
    Scenes,
    Spread,
    claim,
    reads,
    says,
    some,
    tested_with,
)
from scripts.claims.words import boundary

KINDS = {"supercritical": -1, "subcritical": 1}
"""Kinds of a Hopf bifurcation by the sign of the first Lyapunov coefficient."""
Kinds = Annotated[list[str], some("kinds of Hopf bifurcations", list(KINDS))]


@claim(1, "hopf_by_delay", "abstract", look_at="linear-stability.tsv")
@says("With all else fixed, a delay leads from stable steady sliding to a Hopf bifurcation.")
@tested_with(scenes=["fixed_point", "oscillation", "torus", "chaos"])
@reads("linear_stability")
def hopf_by_delay(results: Results, *, scenes: Scenes) -> Finding:
    """Whether steady sliding that is stable without delay loses its stability at some delay."""
    parts, already, never = [], [], []
    for scene in scenes:
        row = results.stability_of(scene)
        where = f"{scene} ({equations(row, ['epsilon', 'xi'])})"
        crossed = changes(row["tau_of_changes"])
        if not crossed:
            never.append(where)
        elif crossed[0][1] > 0:
            already.append(where)
        else:
            parts.append(f"{where} at $tau = {short(crossed[0][0], 6)}$")
    return decided(
        bool(parts),
        "Steady sliding is stable without delay, and a pair of roots crosses the imaginary axis"
        f" when only the delay grows, in {join(parts)}. It is already unstable without delay in"
        f" {join(already)}.{f' No pair crosses the axis in {join(never)}.' if never else ''}",
        "In none of the scenes does a delay make stable steady sliding unstable.",
    )


@claim(2, "hopf_only_by_delay", "abstract", look_at="hopf-points.tsv")
@says("Steady sliding undergoes a Hopf bifurcation only by the delay.")
@tested_with(plane="tau_of_epsilon", scenes=["fixed_point", "oscillation", "torus", "chaos"])
@reads("hopf_points", "linear_stability")
def hopf_only_by_delay(results: Results, *, plane: Plane, scenes: Scenes) -> Finding:
    """Whether there is no Hopf point without delay ("only by"), or a delay suffices ("merely by").

    It holds if the first reading does, and with a correction if the second does.
    """
    merely = hopf_by_delay(results, scenes=scenes)
    suffices = merely.verdict == REPRODUCED
    points = [
        row
        for row in results.hopf_points
        if row["of"] == plane and row["kind"] == "hopf_without_delay"
    ]
    if not points:
        evidence = f"Read as 'only by a delay': no Hopf point at $tau = 0$ in the plane {plane}."
        return Finding(REPRODUCED, evidence)
    point = points[0]
    xi, square = point["xi"], point["gamma"] ** 2
    expected = square * xi / (xi + square)
    kind = "supercritical" if point["l1_1"] < 0 else "subcritical"
    return decided(
        False,
        f"Read as 'only by a delay' it fails: at $tau = 0$, $xi = {short(xi)}$ and $gamma ="
        f" {short(point['gamma'])}$ there is a Hopf point at $epsilon ="
        f" {short(point['epsilon'], 9)}$. The Routh-Hurwitz criterion gives the same value,"
        f" $gamma^2 xi/(xi + gamma^2) = {short(expected, 9)}$. The bifurcation is {kind}: the"
        f" first Lyapunov coefficient is {short(point['l1_1'])}. Read as 'merely by a delay' it"
        f" {'holds' if suffices else 'fails'}. {merely.evidence}",
        f"At $tau = 0$ there is one at $epsilon = gamma^2 xi/(xi + gamma^2) = {short(expected)}$.",
        partly=suffices,
    )


@claim(26, "hopf_depends_on", "section 3, below (10); section 4", look_at="figure_3")
@says("At constant $gamma$ the Hopf bifurcation depends on $epsilon$ and $xi$ only.")
@tested_with(at_fixed_xi="tau_of_epsilon", at_fixed_tau="xi_of_epsilon", limit=0.001)
@reads("curves")
def hopf_depends_on(
    results: Results, *, at_fixed_xi: Plane, at_fixed_tau: Plane, limit: Spread
) -> Finding:
    """Whether epsilon and xi alone, at constant gamma, decide where stability is lost."""
    parts, spreads = [], []
    for plane, fixed, varied in ((at_fixed_xi, "xi", "tau"), (at_fixed_tau, "tau", "xi")):
        curves = boundary(results.curves[plane])
        if not curves.sizes["point"]:
            evidence = "One of the planes has no point where stability changes."
            return decided(False, evidence, evidence)
        epsilon, values = curves.epsilon.values, curves[varied].values
        spreads.append(np.ptp(epsilon))
        parts.append(
            f"At {equations(curves.attrs, ['gamma'])} and"
            f" ${fixed} = {short(curves[fixed].values[0])}$ the critical $epsilon$ varies between"
            f" {short(epsilon.min())} and {short(epsilon.max())} for ${varied}$ from"
            f" {short(values.min())} to {short(values.max())}."
        )
    with_tau, with_xi = (spread > limit for spread in spreads)
    instead = "It also depends on $tau$."
    if not with_xi:
        instead = "The critical $epsilon$ does not depend on $xi$."
    return decided(with_xi and not with_tau, " ".join(parts), instead, partly=with_xi)


@claim(30, "hopf_is_supercritical", "section 3, below Figure 2", look_at="figure_2")
@says("Steady sliding loses its stability in a supercritical Hopf bifurcation as the delay varies.")
@tested_with(planes=["tau_of_epsilon"], expected=["supercritical"])
@claim(53, "both_kinds_of_hopf", "section 5", look_at="figure_2")
@says("There are subcritical and supercritical Hopf bifurcations.")
@tested_with(planes=["tau_of_epsilon", "xi_of_epsilon"], expected=["supercritical", "subcritical"])
@reads("curves")
def kinds_of_hopf(results: Results, *, planes: Planes, expected: Kinds) -> Finding:
    """Kinds of the bifurcations at which steady sliding gains or loses stability."""
    curves = [results.curves[plane] for plane in planes]
    epsilon = np.concatenate([boundary(each).epsilon for each in curves])
    signs = np.concatenate([np.sign(boundary(each).l1) for each in curves])
    everywhere = np.concatenate([each.l1 for each in curves])
    parts, counts = [], []
    for kind, sign in KINDS.items():
        these = epsilon[signs == sign]
        counts.append(f"{these.size} {kind} points")
        spread = f" ($epsilon$ {short(these.min())} to {short(these.max())})" if these.size else ""
        parts.append(f"{these.size} {kind}{spread}")
    met = {kind for kind, sign in KINDS.items() if (signs == sign).any()}
    evidence = (
        f"Steady sliding changes its stability at {signs.size} points of {' and '.join(planes)}."
        f" By the first Lyapunov coefficient these are: {', '.join(parts)}. Of all"
        f" {everywhere.size} points {(everywhere > 0).sum()} are subcritical."
    )
    instead = "Steady sliding does not change its stability."
    if met:
        both = f"Both kinds occur: {' and '.join(counts)}."
        instead = both if len(met) > 1 else f"All {signs.size} points are {next(iter(met))}."
    return decided(met == set(expected), evidence, instead, partly=met > set(expected))


@claim(32, "pairs_gained_and_lost", "section 3, above Figure 3", look_at="figure_2")
@says(
    "A longer delay makes a pair of roots unstable on some parts of the curves and stable on "
    "others."
)
@tested_with(plane="tau_of_epsilon")
@reads("curves")
def pairs_gained_and_lost(results: Results, *, plane: Plane) -> Finding:
    """Whether a longer delay makes pairs of roots unstable on some stretches, stable on others."""
    crossing = results.curves[plane].crossing.values
    gained, lost = int((crossing > 0).sum()), int((crossing < 0).sum())
    return decided(
        gained > 0 and lost > 0,
        f"With a longer delay a pair of roots becomes unstable at {gained} of {crossing.size}"
        f" points of the curves. A pair becomes stable at {lost} points.",
        f"A longer delay makes no pair {'stable' if gained else 'unstable'}.",
    )
