"""A claim about models with more than one block."""

from scripts.claims.claims_results import Finding, Results, decided
from scripts.claims.declare import Scenes, claim, reads, says, tested_with
from scripts.studies.chain.table import moves_alike, rests, strongest_mode


@claim(64, "more_blocks", "section 5", look_at="chain")
@says(
    "The strategy applied to one block can be replicated for a greater number of blocks, in order "
    "to understand chaos better."
)
@tested_with(scenes=["pattern", "delay_pattern", "chain_chaos", "chain_no_delay"])
@reads("trajectories")
def blocks_differ(results: Results, *, scenes: Scenes) -> Finding:
    """Whether chains were computed in which the blocks move differently: more than one block can.

    Chains begin with small differences between blocks.
    """
    sentences, differ = [], 0
    for name in scenes:
        chain = results.trajectories[name]
        place = f"{name.replace('_', ' ')} of {chain.attrs['blocks']} blocks"
        if rests(chain):
            sentences.append(f"Scene {place} comes to rest.")
        elif moves_alike(chain):
            sentences.append(f"Scene {place} moves as one block.")
        else:
            mode, share = strongest_mode(chain)
            differ += 1
            sentences.append(
                f"In scene {place} mode {mode} is the strongest beside the mean;"
                f" {100 * share:.0f} % of the mean square of ln v is in such modes."
            )
    return decided(differ > 0, " ".join(sentences), "All chains move as one block does.")
