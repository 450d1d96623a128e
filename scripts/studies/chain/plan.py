"""Chains of blocks: ln v over time and block, how far blocks are apart, and which modes move.

Formulas and sources: `chain.yaml`, `chain.f90`.
"""

from scripts.namelists.chains import groups_of_chain
from scripts.plans.declare import Figure, Run, Study


def groups(config: dict, chain: str) -> dict[str, dict]:
    """A chain for its trajectory."""
    return groups_of_chain(config, chain, config["chains"][chain])


FIGURE = {
    "category": "Chains",
    "inputs": lambda config: {
        "chains": [f"<results>/chains/{chain}.nc" for chain in config["chains"]]
    },
    "variables": ("v",),
}
STUDY = Study(
    entries={"chain": ("chains",)},
    runs=(Run("chain_trajectory", "trajectory", "chains/{chain}.nc", groups, data="chains"),),
    figures=(Figure("chain", place=410, **FIGURE),),
    kinds=(Figure("chains", place=70, shows=("chains",), **FIGURE),),
)
