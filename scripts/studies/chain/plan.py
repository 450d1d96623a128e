"""Chains of blocks: ln v over time and block, how far blocks are apart, and which modes move.

Formulas and sources: `chain.yaml`, `model_chain.f90`.
"""

from scripts.plans.declare import Figure, Study, Table
from scripts.plans.scenes import is_chain, paths_of_scenes, scenes_of, scenes_with

TABLE = "tables/chain-motions.tsv"


def inputs_of(scenes: list[str]) -> dict:
    """Trajectories of chains, and the roots of all their modes."""
    return {
        "chains": paths_of_scenes("trajectories", scenes),
        "roots": paths_of_scenes("linear_stability", scenes),
    }


def measured_chains(config: dict) -> dict[str, list[str]]:
    """Trajectories and exponents, in the same order, of the chains that ask for exponents."""
    names = [name for name in scenes_with(config, "exponents") if is_chain(config, name)]
    return {kind: paths_of_scenes(kind, names) for kind in ("trajectories", "exponents")}


FIGURE = {"category": "Chains", "variables": ("v",)}
STUDY = Study(
    reads=("exponents", "linear_stability", "scenes"),
    tables=(
        Table(
            *("chain_motions_table", TABLE, measured_chains),
            wanted=lambda config: any(measured_chains(config).values()),
        ),
    ),
    figures=(
        Figure(
            "chain",
            place=410,
            inputs=lambda config: inputs_of(scenes_of(config, "chain")),
            **FIGURE,
        ),
        Figure(
            "chain_exponents",
            category="Chains",
            place=430,
            title="Exponents of chaotic chains: their spectra over the blocks, and how many are"
            " positive.",
            inputs=lambda _config: {"motions": f"<results>/{TABLE}"},
            module="exponents_figure",
            caption="exponents.rst",
        ),
    ),
    kinds=(
        Figure(
            "scenes",
            place=70,
            inputs=lambda config: inputs_of(list(config["scenes"])),
            shows=("scenes",),
            shows_entry=is_chain,
            **FIGURE,
        ),
    ),
)
