"""Claims about cycles at a scene's parameters, by their Floquet multipliers and special points."""

import xarray as xr

from scripts.claims.claims_of_attractors import attractor_class
from scripts.claims.claims_results import (
    CORRECTED,
    NOT_REPRODUCED,
    REPRODUCED,
    Finding,
    Results,
    listed,
    short,
)
from scripts.namelists.study_cases import PARAMETERS
from scripts.tables.attractor_tables import SAME_MAXIMUM
from scripts.tables.cycle_branches import CycleThere, cycles_there


def torus_of_scene(results: Results, *, scene: str) -> Finding:
    """Whether a scene's run ends on a torus, and no stable cycle exists at its parameters."""
    by_runs = attractor_class(results, scene=scene, expected="torus")
    found = cycles_at(results, scene)
    evidence = f"{by_runs.evidence} {cycles_in_words(found)}"
    if by_runs.verdict == REPRODUCED and has_stable(found):
        return Finding(CORRECTED, evidence, "There is a stable limit cycle, too.")
    return Finding(by_runs.verdict, evidence, by_runs.instead)


def second_hopf(results: Results, *, scene: str) -> Finding:
    """Whether the cycle at a scene has undergone a torus bifurcation, or one elsewhere has.

    It has if the scene's run has two zero exponents, no stable cycle exists at its parameters, and
    a line through the scene has a torus bifurcation of a stable cycle.
    """
    own = results.attractors_of(scene)[0]
    found = cycles_at(results, scene)
    parts, elsewhere = [], []
    for cycles in lines_through(results, scene).values():
        along = cycles.attrs["along"]
        fixed = {key: cycles.attrs[key] for key in PARAMETERS if key != along}
        places = [short(point[along]) for point in torus_points(results, fixed)]
        where = ", ".join(f"{key} = {short(value)}" for key, value in fixed.items())
        at = f"at {along} = {' and '.join(places)}"
        parts.append(f"{at if places else 'none'} along {along} ({where})")
        elsewhere += [at] * bool(places)
    evidence = (
        "A second Hopf bifurcation of a cycle is a torus bifurcation: a pair of multipliers leaves"
        f" the unit circle. Class of scene {scene} by its exponents: {own['by_exponents']}."
        f" {cycles_in_words(found)} Torus bifurcations of stable cycles on lines through the"
        f" scene: {'; '.join(parts) or 'none'}."
    )
    if not elsewhere:
        instead = "No torus bifurcation of a stable cycle is known on these lines."
        return Finding(NOT_REPRODUCED, evidence, instead)
    if own["by_exponents"] == "torus" and not has_stable(found):
        return Finding(REPRODUCED, evidence)
    instead = f"With all other parameters the same it occurs {' or '.join(elsewhere)}."
    return Finding(CORRECTED, evidence, instead)


def confirmed_by_multipliers(
    results: Results, *, scenes: list[str], expected: list[str]
) -> Finding:
    """Whether roots of (5) and multipliers of cycles agree with the classes of all scenes, or some.

    They agree with a fixed point where no root is unstable, with a cycle where a stable one exists,
    and with a torus or chaos where steady sliding is unstable and all cycles followed are.
    """
    parts, agree = [], []
    for scene, motion in zip(scenes, expected, strict=True):
        pairs = results.stability_of(scene)["unstable_pairs"]
        found = cycles_at(results, scene)
        stable = has_stable(found)
        if motion == "fixed point":
            agree.append(pairs == 0)
        elif motion == "cycle":
            agree.append(stable)
        else:
            agree.append(pairs > 0 and bool(found) and not stable)
        counted = f"cycles: {len(found)}, {'one of them' if stable else 'none of them'} stable"
        sliding = "unstable" if pairs > 0 else "stable"
        parts.append(
            f"{scene} ({motion} in the paper) {'agrees' if agree[-1] else 'does not agree'}: steady"
            f" sliding is {sliding}; {counted if found else 'no cycle'}"
        )
    evidence = (
        "The paper shows neither output nor settings of its run. The same methods were used here:"
        f" roots of (5), cycles by collocation, and their multipliers. {'. '.join(parts)}."
    )
    if all(agree):
        return Finding(REPRODUCED, evidence)
    others = [scene for scene, agrees in zip(scenes, agree, strict=True) if not agrees]
    instead = f"Roots and multipliers do not agree with the paper for {listed(others)}."
    return Finding(CORRECTED if any(agree) else NOT_REPRODUCED, evidence, instead)


def lines_through(results: Results, scene: str) -> dict[str, xr.Dataset]:
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
        f"{'stable' if cycle.unstable == 0 else 'unstable'} with v up to {short(cycle.most, 3)}"
        f" (modulus {short(cycle.modulus, 2)})"
        for cycle in found
    ]
    return (
        "Cycles followed to these parameters, and the modulus of their largest Floquet multiplier"
        f" but 1: {listed(parts)}."
    )


def torus_points(results: Results, fixed: dict[str, float]) -> list[dict]:
    """Torus bifurcations of stable cycles on a line, given by what is fixed on it, in order."""
    found = {
        tuple(point[key] for key in PARAMETERS): point
        for point in results.cycle_points
        if point["kind"] == "torus"
        and min(point["unstable_before"], point["unstable_behind"]) == 0
        and all(point[key] == value for key, value in fixed.items())
    }
    return [found[place] for place in sorted(found)]


TESTS = {
    "torus_of_scene": torus_of_scene,
    "second_hopf": second_hopf,
    "confirmed_by_multipliers": confirmed_by_multipliers,
}
