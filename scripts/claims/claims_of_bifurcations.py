"""Claims about stability and Hopf bifurcations of steady sliding."""

from typing import Annotated

import numpy as np

from scripts.claims.claims_of_routes import stretches_of
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
    Gamma,
    Plane,
    Planes,
    Route,
    Scenes,
    Spread,
    claim,
    number,
    question,
    reads,
    says,
    some,
    tested_with,
)
from scripts.claims.roots_of_5 import unstable_pairs as unstable_pairs_of_5
from scripts.files.inputs import Dataset
from scripts.tables.motion_rows import is_computed, parameter_of

KINDS = {"supercritical": -1, "subcritical": 1}
"""Kinds of a Hopf bifurcation by the sign of the first Lyapunov coefficient."""
Kinds = Annotated[list[str], some("kinds of Hopf bifurcations", list(KINDS))]
Share = Annotated[float, number("interval of epsilon, over its end, up to which it counts as none")]
STIFFEST = 10.0
"""A xi beyond that of any fault: steady sliding is unstable there if b is 11 a or more."""
Motion = Annotated[float, number("largest v - 1 up to which the block is at rest")]


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


@question(3, "hopf_by_delay_at_faults", look_at="fault_limit")
@says(
    "Does a delay make stable steady sliding unstable at the $gamma$ of real faults, 1e4 to 1e12,"
    " in an interval of $epsilon$ wider than a millionth?"
)
@tested_with(least=1e4, most=1e12, limit=1e-06)
@reads("fault_limit")
def hopf_by_delay_at_faults(
    results: Results, *, least: Gamma, most: Gamma, limit: Share
) -> Finding:
    """Whether a delay makes steady sliding unstable at an epsilon where it is stable without.

    The interval of such epsilon has the width xi^3 (1 + xi)/(2 gamma^4), docs/method.md.
    """
    rows = [row for row in results.fault_limit if least <= row["gamma"] <= most]
    if not rows:
        raise ValueError(f"fault-limit.tsv: no gamma from {short(least)} to {short(most)}")
    widest = max(rows, key=lambda row: row["depth"] / row["without_delay"])
    stiffest = STIFFEST**3 * (1 + STIFFEST) / (2 * least**4)
    return decided(
        widest["depth"] > limit * widest["without_delay"],
        f"The least $epsilon$ of all Hopf curves is computed at {equations(widest, ['xi'])} and"
        f" {len(rows)} values of $gamma$ from {short(least)} to {short(most)}. It lies below the"
        f" Hopf point without delay by at most {short(widest['depth'], 2)}, at"
        f" {equations(widest, ['gamma'])}, where that point has"
        f" $epsilon = {short(widest['without_delay'])}$. To leading order the difference is"
        f" $xi^3 (1 + xi)/(2 gamma^4)$. At the same $gamma$ and $xi = {short(STIFFEST)}$ it is"
        f" {short(stiffest, 2)}; there $b = {short(1 + STIFFEST)} a$ is the limit of stability.",
        f"The interval is at most {short(widest['depth'], 2)} wide at {equations(widest, ['xi'])}."
        " Below it, for a spring stiffer than $k_c = (B - A)/L$, steady sliding is stable at every"
        " delay. Above it is unstable without delay.",
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


def boundary(curves: Dataset) -> Dataset:
    """The points where stability changes."""
    return curves.isel(point=curves.unstable_pairs.values == 0)


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


@claim(52, "delay_destabilises", "section 5", look_at="linear-stability.tsv")
@says("At given parameters some delay makes steady sliding unstable.")
@tested_with(scenes=["fixed_point", "oscillation", "torus", "chaos"])
@reads("linear_stability")
def delay_destabilises(results: Results, *, scenes: Scenes) -> Finding:
    """Whether each scene has a delay at which steady sliding loses its stability."""
    parts, never = [], []
    for scene in scenes:
        row = results.stability_of(scene)
        lost = [place for place, before, _ in changes(row["tau_of_changes"]) if before == 0]
        parts.append(f"{scene} at {delays_in_words(lost) or 'no $tau$'}")
        never += [] if lost else [scene]
    return decided(
        not never,
        f"A longer delay makes steady sliding unstable: {'; '.join(parts)}.",
        f"No longer delay makes steady sliding unstable in {join(never)}.",
    )


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


@claim(33, "amplitude_death", "section 3, above Figure 3", look_at="linear-stability.tsv")
@says("A longer delay alone can bring oscillations back to rest (amplitude death).")
@tested_with(scenes=["fixed_point", "oscillation", "torus", "chaos"])
@reads("linear_stability", "basins")
def amplitude_death(results: Results, *, scenes: Scenes) -> Finding:
    """Whether steady sliding that is unstable at a delay is stable at a longer one."""
    parts = []
    for scene in scenes:
        row = results.stability_of(scene)
        regained = [
            place for place, before, after in changes(row["tau_of_changes"]) if before > after == 0
        ]
        if regained:
            parts.append(f"{scene} at {delays_in_words(regained)}")
    return decided(
        bool(parts),
        f"Scenes in which a longer delay restores stability: {'; '.join(parts) or 'none'}."
        f" {motions_beside_rest(results)}",
        "In none of the scenes does a longer delay restore stability.",
    )


def delays_in_words(delays: list[float]) -> str:
    """Delays in a sentence; empty if there is none."""
    first, *others = [short(delay, 6) for delay in delays] or [""]
    return ", ".join([f"$tau = {first}$", *others]) if first else ""


def motions_beside_rest(results: Results) -> str:
    """What linear stability leaves out: the share of random histories that come to rest."""
    parts = [
        f"{100 * row['share']:.0f} % of {row['histories']:.0f} at"
        f" {equations(row, ['tau', 'epsilon', 'xi'])}"
        for row in results.basins
        if row["class"] == "fixed point"
    ]
    return (
        "The roots say what small disturbances do. Of random histories, up to slip events, these"
        f" come to rest where it is stable: {'; '.join(parts) or 'none'}."
    )


@claim(19, "roots_decide_stability", "section 3, below (5)", look_at="atlas.tsv")
@says("The signs of the real parts of the roots of (5) decide whether steady sliding is stable.")
@tested_with(least_motion=0.001)
@reads("atlas", "attractors", "basins")
def roots_decide(results: Results, *, least_motion: Motion) -> Finding:
    """Whether no computed motion of the atlas or a scene rests where (5) has an unstable root."""
    motions = [row for row in results.atlas + results.attractors if is_computed(row)]
    rows = [row for row in motions if row["class"] != "undecided"]
    stable, unstable = [], []
    for row in rows:
        pairs = unstable_pairs_of_5(**{key: row[key] for key in ("epsilon", "tau", "xi", "gamma")})
        (unstable if pairs else stable).append(row)
    at_rest = [row["class"] == "fixed point" for row in stable]
    rests = [
        row
        for row in unstable
        if row["class"] == "fixed point" or row["largest_maximum"] - 1 < least_motion
    ]
    least = min((row["largest_maximum"] - 1 for row in unstable), default=np.nan)
    undecided = len(motions) - len(rows)
    return decided(
        bool(unstable) and any(at_rest) and not rests,
        f"{len(rows)} computed motions of the atlas and of the scenes have a class. {len(stable)}"
        f" of them are at parameters where all roots have negative real parts: {sum(at_rest)} come"
        f" to rest, {len(stable) - sum(at_rest)} move on another attractor. {len(unstable)} are at"
        f" parameters with unstable roots: {len(rests)} come to rest, and in the others the"
        f" largest $v$ is at least $1 + {short(least, 2)}$. {undecided} more motions are"
        f" undecided. Each point of the atlas has one history. {motions_beside_rest(results)}",
        f"{len(rests)} of {len(unstable)} motions come to rest where a root is unstable, and"
        f" {sum(at_rest)} of {len(stable)} where none is.",
    )


@claim(44, "epsilon_alone_decides", "section 4", look_at="routes")
@says(
    "At constant $gamma$ the transitions depend on $(B - A)/A$ and not on the stiffness $k$ or"
    " the length $L$."
)
@tested_with(plane="xi_of_epsilon", route="chaos_in_xi", limit=0.001)
@reads("curves", "routes")
def independent_of_spring(
    results: Results, *, plane: Plane, route: Route, limit: Spread
) -> Finding:
    """Whether epsilon alone, whatever xi = k L/A, decides on stability, and on chaos on a route."""
    curves, rows = results.curves[plane], results.route(route)
    epsilon, xi = (boundary(curves)[key].values for key in ("epsilon", "xi"))
    if not epsilon.size:
        evidence = f"In {plane} steady sliding does not change its stability."
        return decided(False, evidence, evidence)
    delays = curves.tau.values
    delay = short(delays[0]) if np.ptp(delays) == 0 else "various values"
    stretches = next(iter(stretches_of(rows).values()))
    steady, alike = np.ptp(epsilon) <= limit, len({one.motion for one in stretches}) == 1
    changed = [
        *["the critical $epsilon$ of stability"] * (not steady),
        *["the class of the motion at one $epsilon$"] * (not alike),
    ]
    return decided(
        steady and alike,
        f"At $tau = {delay}$ and {equations(curves.attrs, ['gamma'])} steady sliding changes its"
        f" stability at $epsilon$ from {short(epsilon.min())} to {short(epsilon.max())}. There"
        f" $xi = k L/A$ ranges from {short(xi.min())} to {short(xi.max())}. Along"
        f" ${parameter_of(rows)}$ at {equations(rows[0], ['epsilon'])} and"
        f" {equations(rows[0], ['tau'])}: {', '.join(map(str, stretches))}.",
        f"With $xi = k L/A$ changes {' and '.join(changed)}.",
    )
