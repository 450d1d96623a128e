"""A claim about models with more than one block."""

from typing import Annotated

from scripts.claims.claims_results import Finding, Results, decided
from scripts.claims.declare import Names, claim, reads, says, tested_with
from scripts.tables.chain_motions import moves_alike, rests, strongest_mode

Chains = Annotated[list[str], Names("chain", several=True)]


@claim(64, "more_blocks", "section 5", look_at="chain")
@says(
    "The strategy applied to one block can be replicated for a greater number of blocks, in order "
    "to understand chaos better."
)
@tested_with(chains=["pattern", "delay_pattern", "chaos", "no_delay"])
@reads("chains")
def blocks_differ(results: Results, *, chains: Chains) -> Finding:
    """Whether chains were computed in which the blocks move differently: more than one block can.

    Chains begin with small differences between blocks.
    """
    parts, differ = [], 0
    for name in chains:
        chain = results.chains[name]
        place = f"{name.replace('_', ' ')} of {chain.attrs['blocks']} blocks"
        if rests(chain):
            parts.append(f"Chain {place} comes to rest.")
        elif moves_alike(chain):
            parts.append(f"Chain {place} moves as one block.")
        else:
            mode, share = strongest_mode(chain)
            differ += 1
            parts.append(
                f"In chain {place} mode {mode} is the strongest beside the mean;"
                f" {100 * share:.0f} % of the mean square of ln v is in such modes."
            )
    return decided(differ > 0, " ".join(parts), "All chains move as one block does.")
