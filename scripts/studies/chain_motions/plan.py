"""Exponents of chaotic chains: their spectra over the blocks, and how many are positive."""

from scripts.plans.declare import Figure, Study, Table
from scripts.plans.scenes import is_chain, paths_of_scenes, scenes_with


def chains_of(config: dict) -> list[str]:
    """Scenes of more than one block that ask for exponents."""
    return [name for name in scenes_with(config, "exponents") if is_chain(config, name)]


def inputs(config: dict) -> dict[str, list[str]]:
    """Trajectories and exponents of chains, in the same order."""
    names = chains_of(config)
    return {
        "trajectories": paths_of_scenes("trajectories", names),
        "exponents": paths_of_scenes("exponents", names),
    }


STUDY = Study(
    reads=("chain", "exponents", "scenes"),
    tables=(
        Table(
            *("chain_motions_table", "tables/chain-motions.tsv", inputs),
            wanted=lambda config: bool(chains_of(config)),
        ),
    ),
    figures=(
        Figure(
            "chain_exponents",
            category="Chains",
            place=430,
            inputs=lambda _config: {"motions": "<results>/tables/chain-motions.tsv"},
        ),
    ),
)
