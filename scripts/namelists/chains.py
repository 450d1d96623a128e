"""Chains of blocks: namelists of their trajectories, of their modes, and of their synchrony."""

import math

import numpy as np

from scripts.namelists.laws import law_group
from scripts.namelists.study_cases import HISTORY, place_of, with_parameters, zero_of

CHAIN = ["blocks", "kappa", "ends"]
"""Keys of a chain beside those of a block."""
OF_MOTIONS = ("t_end", "t_transient", "sample_interval", "tolerance", "method")
"""What all chains of the table of motions have."""
MORE_EXPONENTS = 2
"""Exponents of a chain beyond one a block."""


def histories_of(chain: dict) -> dict[str, list[float]]:
    """Values for t <= 0 of each block: those of `history`, and the disturbance."""
    blocks, disturbance = chain["blocks"], chain["disturbance"]
    values = {
        key: np.array(value if isinstance(value, list) else [value] * blocks, dtype=float)
        for key, value in chain["history"].items()
    }
    values["v"] = np.log(values["v"])
    draw = np.random.default_rng(disturbance["seed"]).uniform
    for key, size in (("theta", "theta"), ("u", "u"), ("v", "ln_v")):
        # drawn of each, so that one size does not change another's numbers
        change = disturbance[size] * draw(-1.0, 1.0, blocks)
        if disturbance["block"] > 0:
            change = disturbance[size] * (np.arange(1, blocks + 1) == disturbance["block"])
        values[key] = values[key] + change
    values["v"] = np.exp(values["v"])
    return {key: values[key].tolist() for key in HISTORY}


def chain_groups(config: dict, chain: str) -> dict[str, dict]:
    """A chain for its trajectory."""
    return _groups_of(config, chain, config["chains"][chain])


def event_chain_groups(config: dict, event_chain: str) -> dict[str, dict]:
    """A chain for the slips of its blocks from the start on: events are found in all of them."""
    study = config["event_sizes"]
    own = {"t_transient": 0.0, "thresholds": study["thresholds"]}
    return _groups_of(config, event_chain, study["chains"][event_chain] | own)


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


def motion_groups(config: dict, motion: str) -> dict[str, dict]:
    """A chain of a scene for its trajectory."""
    return _groups_of(config, motion, {**motion_chains(config)[motion], "variables": ["v"]})


def motion_exponents_groups(config: dict, motion: str) -> dict[str, dict]:
    """A chain of a scene for its exponents, a few more than it has blocks."""
    study = config["chain_motions"]
    exponents = {
        "blocks": config["exponents"]["blocks"],
        **zero_of(config),
        **{key: study[key] for key in ("t_end", "t_turning", "interval")},
        "count": motion_chains(config)[motion]["blocks"] + MORE_EXPONENTS,
    }
    return {**motion_groups(config, motion), "exponents": exponents}


def _groups_of(config: dict, chain: str, settings: dict) -> dict[str, dict]:
    """A chain as a scene; the group `blocks` has the histories."""
    histories = histories_of(settings)
    left_out = {"history", "disturbance", *CHAIN}
    scene = {key: value for key, value in settings.items() if key not in left_out}
    groups = with_parameters(config, {"name": chain, **scene})
    groups["parameters"] |= {key: settings[key] for key in CHAIN}
    groups["history"] = {key: values[0] for key, values in histories.items()}
    return {"scene": groups, "blocks": histories}


def eigenvalues(blocks: int, ends: str) -> list[float]:
    """Minus the second difference over the mode, of each mode in ascending order, each once."""
    numbers = range(1, blocks + 1) if ends == "plate" else range(blocks)
    turns = {"free": 0.5 / blocks, "ring": 1.0 / blocks, "plate": 0.5 / (blocks + 1)}[ends]
    values = [4.0 * math.sin(math.pi * turns * number) ** 2 for number in numbers]
    return sorted({round(value, 12) for value in values})


def stiffness_of_modes(modes: dict) -> list[float]:
    """s = 1 + kappa mu of the modes of a chain; the first is that of a block alone."""
    found = [1.0 + modes["kappa"] * mu for mu in eigenvalues(modes["blocks"], modes["ends"])]
    return found if found[0] == 1.0 else [1.0, *found]


def mode_groups(config: dict, mode_plane: str, mode: str) -> dict[str, dict]:
    """A plane of Hopf curves of a mode: those of a block at gamma sqrt(s) and xi s."""
    study = config["chain_modes"]
    plane = study["planes"][mode_plane]
    s = stiffness_of_modes(study)[int(mode)]
    return {
        "hopf_curves": {
            "ordinate": "tau",
            "parameters": {
                "xi": plane["xi"] * s,
                "gamma": plane["gamma"] * math.sqrt(s),
                **law_group(config, plane),
            },
            "epsilon_window": plane["epsilon_window"],
            "ordinate_window": plane["tau_window"],
            "cells": study["cells"],
        }
    }


def synchrony_groups(config: dict, scene: str) -> dict[str, dict]:
    """The motion of one block, and the modes that are tried along it."""
    study = config["synchrony"]
    settings = {
        key: value
        for key, value in config["scenes"][scene].items()
        if key not in ("exponents", "attractors", "si")
    }
    measured = {key: value for key, value in study.items() if key != "scenes"}
    scene_of_one = {"name": scene, **settings, "t_end": study["t_end"]}
    scene_of_one["tolerance"] = measured.pop("tolerance")
    return {"scene": with_parameters(config, scene_of_one), "synchrony": measured}
