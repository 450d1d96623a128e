"""Chains of blocks: ln v over time and block, how far blocks are apart, and which modes move."""

VARIABLES = ("v",)


def inputs(config: dict) -> dict:
    """Trajectories of the chains that the configuration lists."""
    return {"chains": [f"<results>/chains/{chain}.nc" for chain in config["chains"]]}
