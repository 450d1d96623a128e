"""Exponents of chaotic chains: their spectra over the blocks, and how many are positive."""


def inputs(_config: dict) -> dict:
    """Motions of chains of blocks of the scenes."""
    return {"motions": "<results>/tables/chain-motions.tsv"}
