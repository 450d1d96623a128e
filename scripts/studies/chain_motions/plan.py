"""Exponents of chaotic chains: their spectra over the blocks, and how many are positive."""

from scripts.namelists.chains import groups_of_chain
from scripts.namelists.parameters import place_of, zero_of
from scripts.plans.declare import LONGEST, Figure, Run, Study, Table

OF_MOTIONS = ("t_end", "t_transient", "sample_interval", "tolerance", "method")
"""What all chains of the table of motions have."""
MORE_EXPONENTS = 2
"""Exponents of a chain beyond one a block."""


def motion_chains(config: dict) -> dict[str, dict]:
    """Chains whose motions are told apart, by name: those named, and chains of blocks of scenes."""
    study = config["chain_motions"]
    shared = {key: study[key] for key in OF_MOTIONS}
    chains = {name: {**config["chains"][name], **shared} for name in study["chains"]}
    return chains | {
        f"{scene}_{blocks}_kappa_{kappa:g}".replace(".", "_"): {
            **place_of(config, config["scenes"][scene]),
            **{"history": config["scenes"][scene]["history"], "blocks": blocks, "kappa": kappa},
            **{key: study[key] for key in ("ends", "disturbance")},
            **shared,
        }
        for scene in study["scenes"]
        for kappa in study["kappa"]
        for blocks in study["blocks"]
    }


def groups(config: dict, motion: str) -> dict[str, dict]:
    """A chain of a scene for its trajectory."""
    chain = {**motion_chains(config)[motion], "variables": ["v"]}
    return groups_of_chain(config, motion, chain)


def exponents_groups(config: dict, motion: str) -> dict[str, dict]:
    """A chain of a scene for its exponents, a few more than it has blocks."""
    study = config["chain_motions"]
    exponents = {
        "blocks": config["exponents"]["blocks"],
        **zero_of(config),
        **{key: study[key] for key in ("t_end", "t_turning", "interval")},
        "count": motion_chains(config)[motion]["blocks"] + MORE_EXPONENTS,
    }
    return {**groups(config, motion), "exponents": exponents}


def inputs(config: dict) -> dict[str, list[str]]:
    """Trajectories and exponents of chains of scenes, in the same order."""
    names = motion_chains(config)
    return {
        "trajectories": [f"<results>/chain_motions/{name}.nc" for name in names],
        "exponents": [f"<results>/chain_exponents/{name}.nc" for name in names],
    }


def of_user(config: dict) -> None:
    """Tell motions apart of the paper's chains and scenes alone."""
    config["chain_motions"] |= {"chains": [], "scenes": []}


STUDY = Study(
    reads=("attractors", "chain", "exponents", "scenes"),
    wildcards={"motion": lambda config: list(motion_chains(config))},
    runs=(
        Run("motion_trajectory", "trajectory", "chain_motions/{motion}.nc", groups),
        Run(
            *("motion_exponents", "exponents", "chain_exponents/{motion}.nc", exponents_groups),
            priority=LONGEST,
            minutes=120,
        ),
    ),
    tables=(Table("chain_motions_table", "tables/chain-motions.tsv", inputs),),
    figures=(
        Figure(
            "chain_exponents",
            category="Chains",
            place=430,
            inputs=lambda _config: {"motions": "<results>/tables/chain-motions.tsv"},
        ),
    ),
    of_user=of_user,
)
