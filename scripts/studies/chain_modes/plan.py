"""Where modes of a chain are unstable: Hopf curves of all modes over epsilon and tau."""

from scripts.plans.declare import Figure, Run, Study, Table
from scripts.requests.parameters import plane_group


def modes_of(config: dict) -> range:
    """Numbers of modes that differ in their frequencies; 0 is a block alone, if it is no mode."""
    blocks, ends = config["chain_modes"]["blocks"], config["chain_modes"]["ends"]
    # on a ring a standing wave has a second one beside it
    last = blocks // 2 + 1 if ends == "ring" else blocks
    return range(0 if ends == "plate" else 1, last + 1)


def groups(config: dict, mode_plane: str, mode: str) -> dict[str, dict]:
    """A plane of Hopf curves of a mode."""
    study, number = config["chain_modes"], int(mode)
    plane, axes = dict(study["planes"][mode_plane]), {"abscissa": "epsilon", "ordinate": "tau"}
    windows = {f"{axis}_window": plane.pop(f"{name}_window") for axis, name in axes.items()}
    chain = {key: study[key] for key in ("kappa", "ends", "cells")}
    chain |= {"blocks": study["blocks"] if number else 1, "mode": number}
    return {"hopf_curves": plane_group(config, plane | axes | windows | chain)}


def curves(config: dict) -> list[str]:
    """Hopf curves of each mode in each plane, plane by plane."""
    planes, modes = config["chain_modes"]["planes"], modes_of(config)
    return [f"<results>/modes/{plane}/{mode}.nc" for plane in planes for mode in modes]


def params(config: dict) -> dict:
    """The planes and the chain."""
    study = config["chain_modes"]
    return {
        "planes": list(study["planes"].values()),
        "chain": {key: study[key] for key in ("blocks", "kappa", "ends")},
    }


FIGURE = {
    "category": "Chains",
    "inputs": lambda config: {"curves": curves(config)},
    "params": params,
}
STUDY = Study(
    entries={"mode_plane": ("chain_modes", "planes")},
    wildcards={"mode": r"\d+"},
    runs=(Run("mode_curves", "hopf", "modes/{mode_plane}/{mode}.nc", groups),),
    tables=(
        Table(
            *("chain_modes_table", "tables/chain-modes.tsv"),
            lambda config: {"modes": curves(config)},
            params={"planes": lambda config: list(config["chain_modes"]["planes"])},
            wanted=lambda config: bool(config["chain_modes"]["planes"]),
        ),
    ),
    figures=(Figure("chain_modes", place=440, **FIGURE),),
    kinds=(Figure("mode_planes", place=80, shows=("chain_modes", "planes"), **FIGURE),),
)
