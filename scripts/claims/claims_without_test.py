"""Claims of the paper that no test of results can decide, each with the reason."""

from scripts.claims.declare import not_testable

CLAIMS = {
    (9, "source_of_aperiodicity", "abstract; sections 4 and 5"): (
        "The delay may explain why earthquakes do not recur periodically.",
        "The claim is about earthquakes; neither the paper nor this project uses earthquake data.",
    ),
    (10, "neurons", "sections 1 and 5"): (
        "The stick phase of the block resembles the refractory time of a neuron.",
        "The claim is an analogy; the paper names no quantity that could be compared.",
    ),
    (11, "dde_biftool", "section 1"): (
        "The results were confirmed with DDE-BIFTOOL.",
        "The paper shows neither output nor settings of its run.",
    ),
    (47, "ground_motion", "section 4"): (
        "Aperiodic motion of this kind may be partly responsible for irregular ground motion.",
        "The claim is about ground motion, which the model does not contain.",
    ),
    (55, "memory_of_real_faults", "section 5"): (
        "The results confirm that delayed memory is a natural feature of real earthquakes.",
        "A model cannot confirm a property of real faults without data from faults.",
    ),
}
"""By number, name and place in the paper: the claim, and why it cannot be tested."""

for about, words_and_reason in CLAIMS.items():
    not_testable(*about, *words_and_reason)
