"""Where modes of a chain are unstable: Hopf curves of all modes over epsilon and tau."""

import math

from scripts.namelists.chains import eigenvalues
from scripts.namelists.parameters import plane_group
from scripts.plans.declare import Figure, Run, Study, Table


def stiffness_of_modes(modes: dict) -> list[float]:
    """s = 1 + kappa mu of the modes of a chain; the first is that of a block alone."""
    found = [1.0 + modes["kappa"] * mu for mu in eigenvalues(modes["blocks"], modes["ends"])]
    return found if found[0] == 1.0 else [1.0, *found]


def groups(config: dict, mode_plane: str, mode: str) -> dict[str, dict]:
    """A plane of Hopf curves of a mode: those of a block at gamma sqrt(s) and xi s."""
    study = config["chain_modes"]
    plane = study["planes"][mode_plane]
    s = stiffness_of_modes(study)[int(mode)]
    settings = {key: value for key, value in plane.items() if key != "tau_window"}
    changes = {"xi": plane["xi"] * s, "gamma": plane["gamma"] * math.sqrt(s)}
    of_tau = {"ordinate": "tau", "ordinate_window": plane["tau_window"], "cells": study["cells"]}
    return {"hopf_curves": plane_group(config, {**settings, **changes, **of_tau})}


def stiffness(config: dict) -> list[float]:
    """The stiffness of each mode."""
    return stiffness_of_modes(config["chain_modes"])


def curves(config: dict) -> list[str]:
    """Hopf curves of each mode in each plane, plane by plane."""
    planes, modes = config["chain_modes"]["planes"], range(len(stiffness(config)))
    return [f"<results>/modes/{plane}/{mode}.nc" for plane in planes for mode in modes]


def params(config: dict) -> dict:
    """The planes, and the stiffness of each mode."""
    study = config["chain_modes"]
    return {
        "planes": list(study["planes"].values()),
        "stiffness": stiffness(config),
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
            params={
                "planes": lambda config: list(config["chain_modes"]["planes"]),
                "stiffness": stiffness,
            },
            wanted=lambda config: bool(config["chain_modes"]["planes"]),
        ),
    ),
    figures=(Figure("chain_modes", place=440, **FIGURE),),
    kinds=(Figure("mode_planes", place=80, shows=("chain_modes", "planes"), **FIGURE),),
)
