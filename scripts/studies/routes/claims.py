"""Claims about what changes along a parameter, by the tables of the routes.

One point may not decide: a class counts where two neighbouring points of a run have it, or two runs
at one point. Torus bifurcations are those of the cycles followed on the same line.
"""

from collections import Counter
from dataclasses import dataclass
from itertools import pairwise, product

import numpy as np

from scripts.claims.claims_results import REPRODUCED, Finding, Results, decided, equations, short
from scripts.claims.declare import (
    Class,
    Classes,
    Plane,
    Planes,
    Route,
    Routes,
    Scenes,
    Spread,
    claim,
    reads,
    says,
    tested_with,
)
from scripts.claims.words import boundary, class_with_loops, places_along, torus_points
from scripts.files.tsv import rows_by
from scripts.namelists.parameters import PARAMETERS
from scripts.tables.motion_rows import UNDECIDED, parameter_of

THREE = "3-torus"
"""Class of a torus with three frequencies."""


@dataclass
class Stretch:
    """Points of one class that follow each other; undecided ones between them are left out."""

    motion: str
    first: float
    last: float

    def __str__(self) -> str:
        end = f" to {short(self.last)}" if self.last > self.first else ""
        return f"{self.motion} {short(self.first)}{end}"


Turns = dict[str, list[list[Stretch]]]
"""Stretches that belong together, by run."""


@claim(48, "fixed_point_to_cycle", "section 5", look_at="routes")
@says("A limit cycle bifurcates from the fixed point.")
@tested_with(routes=["chaos_in_tau", "torus_in_tau"], expected=["fixed point", "cycle"])
@claim(50, "torus_to_chaos", "section 5", look_at="routes")
@says("As the parameters grow, the torus breaks up into a chaotic set.")
@tested_with(routes=["chaos_in_tau", "torus_in_tau"], expected=["torus", "chaos"])
@reads("routes")
def route(results: Results, *, routes: Routes, expected: Classes) -> Finding:
    """Whether these classes follow each other along at least one of the routes."""
    found = [in_turn(results, name, expected) for name in routes]
    evidence = " ".join(words for _, words in found)
    instead = f"No run shows {', then '.join(expected)}."
    return decided(any(shown for shown, _ in found), evidence, instead)


@claim(49, "cycle_to_torus", "section 5", look_at="routes")
@says("Quasiperiodic motion bifurcates from the limit cycle.")
@tested_with(routes=["chaos_in_tau", "torus_in_tau"], expected=["cycle", "torus"])
@reads("routes", "cycle_points")
def torus_route(results: Results, *, routes: Routes, expected: Classes) -> Finding:
    """Whether these classes follow each other, a cycle and a torus at a torus bifurcation."""
    found = [in_turn(results, name, expected, at_bifurcations=True) for name in routes]
    evidence = " ".join(words for _, words in found)
    instead = (
        f"No run shows {', then '.join(expected)} with a torus bifurcation between cycle and torus."
    )
    return decided(any(shown for shown, _ in found), evidence, instead)


@claim(5, "quasiperiodic_route", "abstract; section 3, below Figure 2", look_at="routes")
@says("The route to chaos is quasiperiodic, that of Ruelle, Takens and Newhouse.")
@tested_with(routes=["chaos_in_tau", "torus_in_tau"], fine="torus_breaks")
@reads("routes", "cycle_points", "atlas")
def quasiperiodic_route(results: Results, *, routes: Routes, fine: Route) -> Finding:
    """Whether chaos follows a torus of two frequencies, and one of three, along the routes.

    The first is torus breakdown. The theorem of Ruelle, Takens and Newhouse is about the second: a
    flow on a torus of three frequencies can be perturbed into one with a strange attractor. Where
    both are found the claim holds, with a correction where one is. The fine route shows how.
    """
    breakdown = torus_route(results, routes=routes, expected=["cycle", "torus", "chaos"])
    strict = route(results, routes=routes, expected=["torus", THREE, "chaos"])
    found = {
        "torus breakdown (cycle, torus of two frequencies, chaos)": breakdown.verdict,
        "a third frequency, of which Ruelle, Takens and Newhouse speak": strict.verdict,
    }
    holds = [name for name, verdict in found.items() if verdict == REPRODUCED]
    fails = [name for name in found if name not in holds]
    evidence = (
        f"Torus breakdown: {breakdown.evidence} {locking_in_words(results.route(fine))} A torus of"
        f" three frequencies between torus and chaos: {strict.evidence}"
        f" {three_tori_in_atlas(results.atlas)}"
    )
    instead = f"The routes show neither {' nor '.join(fails)}."
    if holds and fails:
        instead = f"The routes show {holds[0]}, but not {fails[0]}."
    return decided(not fails, evidence, instead, partly=bool(holds))


def locking_in_words(rows: list[dict]) -> str:
    """Where a torus is locked to a cycle of several loops, and where runs differ."""
    along = parameter_of(rows)
    places = {
        place: Counter(map(class_with_loops, at)) for place, at in rows_by(rows, along).items()
    }
    parts = [
        f"{', '.join(f'{motion} in {n} runs' for motion, n in motions.items())} at {short(place)}"
        for place, motions in sorted(places.items())
        if len(motions) > 1 or "loops" in next(iter(motions))
    ]
    if not parts:
        return f"Along ${along}$ in fine steps no locking was met."
    return f"Along ${along}$ in fine steps runs lock or differ: {'; '.join(parts)}."


def three_tori_in_atlas(atlas: list[dict]) -> str:
    """Where the atlas has tori of three frequencies, and beside how many it has chaos."""
    tori = [row for row in atlas if row["class"] == THREE]
    if not tori:
        return "The atlas has no torus of three frequencies."
    beyond = dict.fromkeys(("tau", "epsilon"), 0)
    for torus, along in product(tori, beyond):
        larger = [
            row
            for row in atlas
            if row[along] > torus[along]
            and row["class"] not in (THREE, UNDECIDED)
            and all(row[key] == torus[key] for key in PARAMETERS if key != along)
        ]
        following = min(larger, key=lambda row: row[along], default={"class": ""})
        beyond[along] += following["class"] == "chaos"
    places = Counter(equations(row, ["xi", "gamma"]) for row in tori)
    counts = [f"{count} at {place}" for place, count in places.items()]
    least, most = (short(end(row["tau"] for row in tori)) for end in (min, max))
    return (
        f"The atlas has {len(tori)} tori of three frequencies: {'; '.join(counts)}, for $tau$ from"
        f" {least} to {most}. The next class is chaos beyond {beyond['tau']} of them with a"
        f" longer delay, and beyond {beyond['epsilon']} with a larger $epsilon$."
    )


@claim(31, "two_supercritical_hopfs", "section 3, below Figure 2", look_at="cycles")
@says("Two supercritical Hopf bifurcations lead from regular motion to the strange attractor.")
@tested_with(
    routes=["chaos_in_tau", "torus_in_tau"], planes=["tau_of_epsilon", "tau_of_epsilon_xi_08"]
)
@reads("curves", "routes", "cycle_points")
def two_supercritical_hopfs(results: Results, *, routes: Routes, planes: Planes) -> Finding:
    """Whether the Hopf bifurcation of steady sliding and that of the cycle are supercritical.

    The second is a torus bifurcation of a stable cycle. The first is where a pair of roots becomes
    unstable in the plane with the xi of the route, nearest to its epsilon.
    """
    parts, kinds = [], []
    for name in routes:
        rows = results.route(name)
        at = rows[0]
        (curves,) = (
            results.curves[plane] for plane in planes if results.curves[plane].xi[0] == at["xi"]
        )
        lost = curves.isel(point=(curves.unstable_roots == 0) & (curves.crossing > 0))
        first = lost.isel(point=abs(lost.epsilon.values - at["epsilon"]).argmin())
        along = parameter_of(rows)
        fixed = {key: at[key] for key in PARAMETERS if key != along}
        found = [
            (float(first[along]), "subcritical" if first.l1 > 0 else "supercritical"),
            *((point[along], point["criticality"]) for point in torus_points(results, fixed)),
        ]
        kinds.append([kind for _, kind in found])
        of_sliding, *of_cycles = (f"{kind} near ${along} = {short(at)}$" for at, kind in found)
        parts.append(
            f"With {equations(fixed, fixed)} the Hopf bifurcation of steady sliding is"
            f" {of_sliding}. Torus bifurcations of stable cycles:"
            f" {', '.join(of_cycles) or 'none'}."
        )
    holds = [len(each) > 1 and set(each) == {"supercritical"} for each in kinds]
    instead = f"All are supercritical on {sum(holds)} of {len(holds)} lines."
    return decided(all(holds), " ".join(parts), instead, partly=any(holds))


@claim(28, "chaos_by_a_and_b", "section 4", look_at="routes")
@says("Larger values of $A$ and $B$ lead to chaos.")
@tested_with(routes=["chaos_in_epsilon", "chaos_in_xi"])
@reads("routes")
def chaos_by_a_and_b(results: Results, *, routes: Routes) -> Finding:
    """Whether chaos follows from a larger B alone, and from a larger A with B in proportion.

    B alone raises epsilon = (B - A)/A. A and B in proportion lower xi = k L/A. A alone lowers both.
    """
    leads = {}
    for name in routes:
        rows = results.route(name)
        ends = [(run[0].motion, run[-1].motion) for run in stretches_of(rows).values() if run]
        for direction, before, behind in (("larger", 0, 1), ("smaller", 1, 0)):
            chaotic = [pair[before] != "chaos" == pair[behind] for pair in ends]
            leads[parameter_of(rows), direction] = sum(chaotic), len(ends)
    parts = [
        f"A {direction} ${along}$ leads to chaos in {count} of {runs} runs."
        for (along, direction), (count, runs) in leads.items()
    ]
    by_b, by_both = leads["epsilon", "larger"][0] > 0, leads["xi", "smaller"][0] > 0
    evidence = (
        "A larger $B$ raises $epsilon = (B - A)/A$. A larger $A$ lowers $epsilon$ and"
        f" $xi = k L/A$; with $B$ in proportion it lowers $xi$ alone. {' '.join(parts)}"
    )
    instead = "Neither $B$ alone nor $A$ and $B$ in proportion do."
    if by_b:
        instead = "A larger $B$ alone does; $A$ and $B$ in proportion do not."
    elif by_both:
        instead = "$A$ and $B$ in proportion do; a larger $B$ alone does not."
    return decided(by_b and by_both, evidence, instead, partly=by_b or by_both)


@claim(4, "delay_alone_makes_chaos", "abstract; section 3, below Figure 2", look_at="routes")
@says("A longer delay makes the motion chaotic, with all other parameters the same.")
@tested_with(routes=["chaos_in_tau", "torus_in_tau"], before=["fixed point"], after="chaos")
@claim(27, "chaos_by_epsilon_and_xi", "section 3, below (10); section 4", look_at="routes")
@says("Larger values of $epsilon$ and of $xi$ lead to chaos.")
@tested_with(
    routes=["chaos_in_epsilon", "chaos_in_xi"],
    before=["fixed point", "cycle", "torus"],
    after="chaos",
)
@reads("routes")
def leads_to(results: Results, *, routes: Routes, before: Classes, after: Class) -> Finding:
    """Whether a class is met beyond others along all of the routes, or along some of them."""
    lines = [results.route(name) for name in routes]
    found = [changes(rows, before, after) for rows in lines]
    evidence = " ".join(map(in_a_sentence, lines, found))
    holds = [any(met.values()) for met in found]
    parameters = " or ".join(dict.fromkeys(f"${parameter_of(rows)}$" for rows in lines))
    instead = f"No run along {parameters} shows {after} beyond {' or '.join(before)}."
    if any(holds):
        instead = f"It does along {sum(holds)} of {len(holds)} lines."
    return decided(all(holds), evidence, instead, partly=any(holds))


@claim(39, "longer_delays_in_turn", "section 3, below Figure 5", look_at="routes")
@says(
    "With growing delay and slight changes of the other parameters, the fixed point gives way "
    "to oscillations, torus and chaos in this order."
)
@tested_with(
    scenes=["fixed_point", "oscillation", "torus", "chaos"],
    expected=["fixed point", "cycle", "torus", "chaos"],
    route="torus_in_tau",
)
@reads("attractors", "linear_stability", "routes", "cycle_points")
def delays_in_turn(results: Results, *, scenes: Scenes, expected: Classes, route: Route) -> Finding:
    """Whether scenes with longer and longer delays are of these classes in turn, or a route is.

    On the route a cycle and a torus meet at a torus bifurcation.
    """
    own = [results.attractors_of(scene)[0] for scene in scenes]
    delays = [results.stability_of(scene)["tau"] for scene in scenes]
    grow = all(before < after for before, after in pairwise(delays))
    met = [f"{class_with_loops(row)} at {short(tau)}" for row, tau in zip(own, delays, strict=True)]
    shows, shown = in_turn(results, route, expected, at_bifurcations=True)
    evidence = (
        f"The paper's delays in its order, with other parameters changed, too: {', '.join(met)}."
        f" These delays {'grow' if grow else 'do not grow'} from one to the next. Only"
        f" the delay changes on the route {route}. {shown}"
    )
    instead = "At fixed parameters a longer delay gives this order."
    if not shows:
        instead = f"Nor does the route {route} show this order."
    holds = grow and [row["class"] for row in own] == expected
    return decided(holds, evidence, instead, partly=shows)


def in_turn(
    results: Results, route: str, expected: Classes, *, at_bifurcations: bool = False
) -> tuple[bool, str]:
    """Whether a run of a route shows these classes in turn, and what is found, in words.

    With a torus bifurcation between each cycle and torus, if it is asked for: a pair of multipliers
    of a stable cycle crosses the unit circle.
    """
    rows = results.route(route)
    found = sequences(rows, expected)
    if not at_bifurcations:
        return any(found.values()), in_a_sentence(rows, found)
    along = parameter_of(rows)
    fixed = {key: rows[0][key] for key in PARAMETERS if key != along}
    places = [point[along] for point in torus_points(results, fixed)]

    def bifurcates(turn: list[Stretch]) -> bool:
        return all(
            any(before.last <= place <= after.first for place in places)
            for before, after in pairwise(turn)
            if (before.motion, after.motion) == ("cycle", "torus")
        )

    found = {run: list(filter(bifurcates, turns)) for run, turns in found.items()}
    words = "No torus bifurcation of a stable cycle is known on this line."
    if places:
        words = (
            "A pair of multipliers of a stable cycle leaves the unit circle at"
            f" {places_along(along, places)}."
        )
    return any(found.values()), f"{in_a_sentence(rows, found)} {words}"


def sequences(rows: list[dict], expected: Classes) -> Turns:
    """Where these classes follow each other."""
    found: Turns = {}
    for run, stretches in stretches_of(rows).items():
        parts = [stretches[i : i + len(expected)] for i in range(len(stretches))]
        found[run] = [part for part in parts if [one.motion for one in part] == expected]
    return found


def changes(rows: list[dict], before: Classes, after: Class) -> Turns:
    """Stretches of some classes, and the first of another class beyond them."""
    found: Turns = {}
    for run, stretches in stretches_of(rows).items():
        motions = [stretch.motion for stretch in stretches]
        first = next((i for i, motion in enumerate(motions) if motion in before), len(motions))
        end = motions.index(after, first) if after in motions[first:] else 0
        earlier = [stretch for stretch in stretches[first:end] if stretch.motion in before]
        found[run] = [[*earlier, stretches[end]]] if earlier else []
    return found


def stretches_of(rows: list[dict]) -> dict[str, list[Stretch]]:
    """Stretches along a route by run. A cycle of several points behind a torus is locked there."""
    along = parameter_of(rows)
    times = Counter((row[along], row["class"]) for row in rows)
    found: dict[str, list[Stretch]] = {}
    for run, of_run in rows_by(rows, "run").items():
        ordered = sorted(of_run, key=lambda row: row[along])
        beside = [UNDECIDED, *(row["class"] for row in ordered), UNDECIDED]
        stretches = found.setdefault(run, [])
        for i, row in enumerate(ordered):
            confirmed = times[row[along], row["class"]] > 1
            confirmed |= row["class"] in (beside[i], beside[i + 2])
            last = stretches[-1].motion if stretches else ""
            locked = last == "torus" and row["class"] == "cycle" and row["period"] > 1
            if row["class"] == UNDECIDED or locked or not confirmed:
                continue
            if last == row["class"]:
                stretches[-1].last = row[along]
            else:
                stretches.append(Stretch(row["class"], row[along], row[along]))
    return found


def in_a_sentence(rows: list[dict], found: Turns) -> str:
    """The stretches of the run in which they are longest, and how many runs show such."""
    along = parameter_of(rows)
    fixed = equations(rows[0], [key for key in PARAMETERS if key != along])
    shown = [turns for turns in found.values() if turns]
    if not shown:
        return f"Along ${along}$ ({fixed}): in none of {len(found)} runs."
    longest = max(
        shown, key=lambda turns: sum(one.last - one.first for turn in turns for one in turn)
    )
    turns = "; ".join(", ".join(map(str, turn)) for turn in longest)
    return f"Along ${along}$ ({fixed}): {turns}; in {len(shown)} of {len(found)} runs."


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
