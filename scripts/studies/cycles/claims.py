"""Claims about cycles at a scene's parameters, by their Floquet multipliers and special points."""

from scripts.claims.claims_results import (
    CORRECTED,
    REPRODUCED,
    Finding,
    Results,
    decided,
    equations,
    join,
    short,
)
from scripts.claims.declare import TESTS, Scene, claim, reads, says, tested_with
from scripts.claims.words import places_along, torus_points
from scripts.files.inputs import Dataset
from scripts.namelists.parameters import PARAMETERS
from scripts.studies.cycles.branches import CycleThere, cycles_there
from scripts.tables.attractor_tables import SAME_MAXIMUM


@claim(37, "figure_5a", "Figure 5a", look_at="figure_5")
@says("At $tau = 10$, $epsilon = 0.5$, $xi = gamma = 0.8$ the block moves on a torus.")
@tested_with(scene="torus")
@reads("attractors", "exponents", "linear_stability", "cycles")
def torus_of_scene(results: Results, *, scene: Scene) -> Finding:
    """Whether a scene's run ends on a torus, and no stable cycle exists at its parameters."""
    by_runs = TESTS["attractor_class"].find(results, scene=scene, expected="torus")
    found = cycles_at(results, scene)
    evidence = f"{by_runs.evidence} {cycles_in_words(found)}"
    if by_runs.verdict == REPRODUCED and has_stable(found):
        return Finding(CORRECTED, evidence, "There is a stable limit cycle, too.")
    return Finding(by_runs.verdict, evidence, by_runs.instead)


@claim(42, "second_hopf", "section 3, below Figures 2 and 5; Figure 6b", look_at="cycles")
@says("A second Hopf bifurcation has occurred at the parameters of the torus.")
@tested_with(scene="torus")
@reads("attractors", "linear_stability", "cycles", "cycle_points")
def second_hopf(results: Results, *, scene: Scene) -> Finding:
    """Whether the cycle at a scene has undergone a torus bifurcation; if not, where one does.

    It has if the scene's run has two zero exponents, no stable cycle exists at its parameters, and
    a line through the scene has a torus bifurcation of a stable cycle.
    """
    own = results.attractors_of(scene)[0]
    found = cycles_at(results, scene)
    parts, elsewhere = [], []
    for cycles in lines_through(results, scene).values():
        along = cycles.attrs["along"]
        fixed = {key: cycles.attrs[key] for key in PARAMETERS if key != along}
        places = [point[along] for point in torus_points(results, fixed)]
        at = f"at {places_along(along, places)}" if places else "none"
        parts.append(f"{at} along ${along}$ ({equations(fixed, fixed)})")
        elsewhere += [at] * bool(places)
    evidence = (
        "A second Hopf bifurcation of a cycle is a torus bifurcation: a pair of multipliers leaves"
        f" the unit circle. Class of scene {scene} by its exponents: {own['by_exponents']}."
        f" {cycles_in_words(found)} Torus bifurcations of stable cycles on lines through the"
        f" scene: {'; '.join(parts) or 'none'}."
    )
    instead = "No torus bifurcation of a stable cycle is known on these lines."
    if elsewhere:
        instead = f"With all other parameters the same it occurs {' or '.join(elsewhere)}."
    here = own["by_exponents"] == "torus" and not has_stable(found)
    return decided(bool(elsewhere) and here, evidence, instead)


def lines_through(results: Results, scene: str) -> dict[str, Dataset]:
    """Cycles followed along lines that pass a scene."""
    place = results.stability_of(scene)
    return {
        name: cycles
        for name, cycles in results.cycles.items()
        if all(
            cycles.attrs[key] == place[key] for key in PARAMETERS if key != cycles.attrs["along"]
        )
    }


def cycles_at(results: Results, scene: str) -> list[CycleThere]:
    """Cycles followed at a scene's parameters, by their size; each once if lines cross there."""
    place = results.stability_of(scene)
    found: list[CycleThere] = []
    for cycles in lines_through(results, scene).values():
        for cycle in cycles_there(cycles, place[cycles.attrs["along"]]):
            if not any(abs(other.most / cycle.most - 1) < SAME_MAXIMUM for other in found):
                found.append(cycle)
    return sorted(found, key=lambda cycle: cycle.most)


def has_stable(found: list[CycleThere]) -> bool:
    """Whether one of the cycles is stable."""
    return any(cycle.unstable == 0 for cycle in found)


def cycles_in_words(found: list[CycleThere]) -> str:
    """The cycles at a scene's parameters, and their multipliers."""
    if not found:
        return "No cycle was followed to these parameters."
    parts = [
        f"{'stable' if cycle.unstable == 0 else 'unstable'} with $v$ up to {short(cycle.most, 3)}"
        f" (modulus {short(cycle.modulus, 2)})"
        for cycle in found
    ]
    return (
        "Cycles followed to these parameters, and the modulus of their largest Floquet multiplier"
        f" but 1: {join(parts)}."
    )
