"""Claims about the delays at which scenes lose and regain their stability."""

from scripts.claims.claims_results import Finding, Results, changes, decided, join, short
from scripts.claims.declare import Scenes, claim, reads, says, tested_with
from scripts.claims.words import motions_beside_rest


@claim(52, "delay_destabilises", "section 5", look_at="linear-stability.tsv")
@says("At given parameters some delay makes steady sliding unstable.")
@tested_with(scenes=["fixed_point", "oscillation", "torus", "chaos"])
@reads("linear_stability")
def delay_destabilises(results: Results, *, scenes: Scenes) -> Finding:
    """Whether each scene has a delay at which steady sliding loses its stability."""
    places, never = [], []
    for scene in scenes:
        row = results.stability_of(scene)
        lost = [place for place, before, _ in changes(row["tau_of_changes"]) if before == 0]
        places.append(f"{scene} at {delays_in_words(lost) or 'no $tau$'}")
        never += [] if lost else [scene]
    return decided(
        not never,
        f"A longer delay makes steady sliding unstable: {'; '.join(places)}.",
        f"No longer delay makes steady sliding unstable in {join(never)}.",
    )


@claim(33, "amplitude_death", "section 3, above Figure 3", look_at="linear-stability.tsv")
@says("A longer delay alone can bring oscillations back to rest (amplitude death).")
@tested_with(scenes=["fixed_point", "oscillation", "torus", "chaos"])
@reads("linear_stability", "basins")
def amplitude_death(results: Results, *, scenes: Scenes) -> Finding:
    """Whether steady sliding that is unstable at a delay is stable at a longer one."""
    places = []
    for scene in scenes:
        row = results.stability_of(scene)
        regained = [
            place for place, before, after in changes(row["tau_of_changes"]) if before > after == 0
        ]
        if regained:
            places.append(f"{scene} at {delays_in_words(regained)}")
    return decided(
        bool(places),
        f"Scenes in which a longer delay restores stability: {'; '.join(places) or 'none'}."
        f" {motions_beside_rest(results)}",
        "In none of the scenes does a longer delay restore stability.",
    )


def delays_in_words(delays: list[float]) -> str:
    """Delays in a sentence; empty if there is none."""
    first, *others = [short(delay, 6) for delay in delays] or [""]
    return ", ".join([f"$tau = {first}$", *others]) if first else ""
