"""Claims about stability and Hopf bifurcations of steady sliding."""

import numpy as np

from scripts.claims.claims_of_routes import stretches_of
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
from scripts.claims.roots_of_5 import unstable_pairs as unstable_pairs_of_5
from scripts.tables.motion_rows import is_computed, parameter_of

KINDS = {"supercritical": -1, "subcritical": 1}
"""Kinds of a Hopf bifurcation by the sign of the first Lyapunov coefficient."""


def hopf_by_delay(results: Results, *, scenes: list[str]) -> Finding:
    """Whether steady sliding that is stable without delay loses its stability at some delay."""
    parts, already, never = [], [], []
    for scene in scenes:
        row = results.stability_of(scene)
        where = f"{scene} (epsilon = {short(row['epsilon'])}, xi = {short(row['xi'])})"
        crossed = changes(row["tau_of_changes"])
        if not crossed:
            never.append(where)
        elif crossed[0][1] > 0:
            already.append(where)
        else:
            parts.append(f"{where} at tau = {short(crossed[0][0], 6)}")
    return decided(
        bool(parts),
        "Steady sliding is stable without delay, and a pair of roots crosses the imaginary axis"
        f" when only the delay grows, in {listed(parts)}. It is already unstable without delay in"
        f" {listed(already)}.{f' No pair crosses the axis in {listed(never)}.' if never else ''}",
        "In none of the scenes does a delay make stable steady sliding unstable.",
    )


def hopf_only_by_delay(results: Results, *, plane: str, scenes: list[str]) -> Finding:
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
        evidence = f"Read as 'only by a delay': no Hopf point at tau = 0 in the plane {plane}."
        return Finding(REPRODUCED, evidence)
    point = points[0]
    epsilon, xi, square = point["epsilon"], point["xi"], point["gamma"] ** 2
    expected = square * xi / (xi + square)
    kind = "supercritical" if point["l1_1"] < 0 else "subcritical"
    return Finding(
        CORRECTED if suffices else NOT_REPRODUCED,
        f"Read as 'only by a delay' it fails: at tau = 0, xi = {short(xi)} and gamma ="
        f" {short(point['gamma'])} there is a Hopf point at epsilon = {short(epsilon, 9)}. The"
        " Routh-Hurwitz criterion gives the same value, gamma^2 xi/(xi + gamma^2) ="
        f" {short(expected, 9)}. The bifurcation is {kind}: the first Lyapunov coefficient is"
        f" {short(point['l1_1'])}. Read as 'merely by a delay' it"
        f" {'holds' if suffices else 'fails'}. {merely.evidence}",
        f"At tau = 0 there is one at epsilon = gamma^2 xi/(xi + gamma^2) = {short(expected)}.",
    )


def hopf_by_delay_at_faults(
    results: Results, *, least: float, most: float, limit: float
) -> Finding:
    """Whether a delay makes steady sliding unstable at an epsilon where it is stable without."""
    rows = [row for row in results.fault_limit if least <= row["gamma"] <= most]
    if not rows:
        raise ValueError(f"fault-limit.tsv: no gamma from {short(least)} to {short(most)}")
    widest = max(rows, key=lambda row: row["depth"] / row["without_delay"])
    xi = short(widest["xi"])
    return decided(
        widest["depth"] > limit * widest["without_delay"],
        f"The least epsilon of all Hopf curves is computed at xi = {xi} and {len(rows)} values of"
        f" gamma from {short(least)} to {short(most)}. It lies below the Hopf point without delay"
        f" by at most {short(widest['depth'], 2)}, at gamma = {short(widest['gamma'])}, where that"
        f" point has epsilon = {short(widest['without_delay'])}. To leading order the difference is"
        " xi^3 (1 + xi)/(2 gamma^4).",
        "Below epsilon = xi, for a spring stiffer than k_c = (B - A)/L, steady sliding is stable at"
        " every delay. Above it is unstable without delay.",
    )


def hopf_depends_on(
    results: Results, *, at_fixed_xi: str, at_fixed_tau: str, limit: float
) -> Finding:
    """Whether epsilon and xi alone, at constant gamma, decide where stability is lost."""
    with_tau, with_xi = (boundary(results.curves[plane]) for plane in (at_fixed_xi, at_fixed_tau))
    if not (with_tau and with_xi):
        evidence = "One of the planes has no point where stability changes."
        return Finding(NOT_REPRODUCED, evidence, evidence)
    wide = [
        max(spread["epsilon"]) - min(spread["epsilon"]) > limit for spread in (with_tau, with_xi)
    ]
    parts = [
        f"At gamma = {short(results.curves[plane].attrs['gamma'])} and {fixed} ="
        f" {short(spread[fixed][0])} the critical epsilon varies between"
        f" {short(min(spread['epsilon']))} and {short(max(spread['epsilon']))} for {varied} from"
        f" {short(min(spread[varied]))} to {short(max(spread[varied]))}."
        for plane, spread, fixed, varied in (
            (at_fixed_xi, with_tau, "xi", "tau"),
            (at_fixed_tau, with_xi, "tau", "xi"),
        )
    ]
    evidence = " ".join(parts)
    if not wide[1]:
        return Finding(NOT_REPRODUCED, evidence, "The critical epsilon does not depend on xi.")
    if wide[0]:
        return Finding(CORRECTED, evidence, "It also depends on tau.")
    return Finding(REPRODUCED, evidence)


def boundary(curves) -> dict[str, list[float]]:
    """Parameters of the points where stability changes; nothing where there are none."""
    at_boundary = curves.unstable_pairs.values == 0
    if not at_boundary.any():
        return {}
    return {key: list(curves[key].values[at_boundary]) for key in ("epsilon", "tau", "xi")}


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
    parts, counts = [], []
    for kind, sign in KINDS.items():
        these = epsilon[signs == sign]
        counts.append(f"{these.size} {kind} points")
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
    instead = "Steady sliding does not change its stability."
    if met:
        both = f"Both kinds occur: {' and '.join(counts)}."
        instead = both if len(met) > 1 else f"All {signs.size} points are {met.pop()}."
    return Finding(CORRECTED if met > set(expected) else NOT_REPRODUCED, evidence, instead)


def delay_destabilises(results: Results, *, scenes: list[str]) -> Finding:
    """Whether each scene has a delay at which steady sliding loses its stability."""
    parts, never = [], []
    for scene in scenes:
        row = results.stability_of(scene)
        lost = [place for place, before, _ in changes(row["tau_of_changes"]) if before == 0]
        where = f"at tau = {listed([short(place, 6) for place in lost])}" if lost else "at no tau"
        parts.append(f"{scene} {where}")
        never += [] if lost else [scene]
    return decided(
        not never,
        f"A longer delay makes steady sliding unstable: {'; '.join(parts)}.",
        f"No longer delay makes steady sliding unstable in {listed(never)}.",
    )


def pairs_gained_and_lost(results: Results, *, plane: str) -> Finding:
    """Whether a longer delay makes pairs of roots unstable on some stretches, stable on others."""
    crossing = results.curves[plane].crossing.values
    gained, lost = int((crossing > 0).sum()), int((crossing < 0).sum())
    return decided(
        gained > 0 and lost > 0,
        f"With a longer delay a pair of roots becomes unstable at {gained} of {crossing.size}"
        f" points of the curves. A pair becomes stable at {lost} points.",
        f"A longer delay makes no pair {'stable' if gained else 'unstable'}.",
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
        f"Scenes in which a longer delay restores stability: {'; '.join(parts) or 'none'}."
        f" {motions_beside_rest(results)}",
        "In none of the scenes does a longer delay restore stability.",
    )


def motions_beside_rest(results: Results) -> str:
    """What linear stability leaves out: the share of random histories that come to rest."""
    parts = [
        f"{100 * row['share']:.0f} % of {row['histories']:.0f} at tau = {short(row['tau'])},"
        f" epsilon = {short(row['epsilon'])}, xi = {short(row['xi'])}"
        for row in results.basins
        if row["class"] == "fixed point"
    ]
    return (
        "The roots say what small disturbances do. Of random histories, up to slip events, these"
        f" come to rest where it is stable: {'; '.join(parts) or 'none'}."
    )


def roots_decide(results: Results, *, least_motion: float) -> Finding:
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
        f"{len(rows)} computed motions of the atlas and of the scenes have a class."
        f" {len(stable)} of them are at parameters where all roots have negative real parts:"
        f" {sum(at_rest)} come to rest, {len(stable) - sum(at_rest)} move on another attractor."
        f" {len(unstable)} are at parameters with unstable roots: {len(rests)} come to rest, and in"
        f" the others the largest v is at least 1 + {short(least, 2)}. {undecided} more motions are"
        f" undecided. Each point of the atlas has one history. {motions_beside_rest(results)}",
        f"{len(rests)} of {len(unstable)} motions come to rest where a root is unstable, and"
        f" {sum(at_rest)} of {len(stable)} where none is.",
    )


def independent_of_spring(results: Results, *, plane: str, route: str, limit: float) -> Finding:
    """Whether epsilon alone, whatever xi = k L/A, decides on stability, and on chaos on a route."""
    curves, rows = results.curves[plane], results.route(route)
    at_boundary = curves.unstable_pairs.values == 0
    epsilon, xi = (curves[key].values[at_boundary] for key in ("epsilon", "xi"))
    if not at_boundary.any():
        evidence = f"In {plane} steady sliding does not change its stability."
        return Finding(NOT_REPRODUCED, evidence, evidence)
    delays = curves.tau.values
    delay = short(delays[0]) if np.ptp(delays) == 0 else "various values"
    stretches = next(iter(stretches_of(rows).values()))
    steady, alike = np.ptp(epsilon) <= limit, len({one.motion for one in stretches}) == 1
    changed = [
        *["the critical epsilon of stability"] * (not steady),
        *["the class of the motion at one epsilon"] * (not alike),
    ]
    return decided(
        steady and alike,
        f"At tau = {delay} and gamma = {short(curves.attrs['gamma'])} steady sliding changes"
        f" its stability at epsilon from {short(epsilon.min())} to {short(epsilon.max())}. There"
        f" xi = k L/A ranges from {short(xi.min())} to {short(xi.max())}. Along"
        f" {parameter_of(rows)} at epsilon = {short(rows[0]['epsilon'])} and tau ="
        f" {short(rows[0]['tau'])}: {', '.join(map(str, stretches))}.",
        f"With xi = k L/A changes {' and '.join(changed)}.",
    )


TESTS = {
    "hopf_by_delay": hopf_by_delay,
    "hopf_only_by_delay": hopf_only_by_delay,
    "hopf_by_delay_at_faults": hopf_by_delay_at_faults,
    "hopf_depends_on": hopf_depends_on,
    "kinds_of_hopf": kinds_of_hopf,
    "delay_destabilises": delay_destabilises,
    "pairs_gained_and_lost": pairs_gained_and_lost,
    "amplitude_death": amplitude_death,
    "roots_decide": roots_decide,
    "independent_of_spring": independent_of_spring,
}
