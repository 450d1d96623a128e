"""Check chains of blocks: problems that involve more than one key."""

from scripts.config import check_attractors
from scripts.config.check_attractors import wrong
from scripts.namelists.laws import PREFIX

LEAST_RING = 3
"""Blocks of the smallest ring."""


def contradictions(config: dict):
    """Problems of chains, of planes of their modes, and of the scenes whose synchrony is tried."""
    for name, chain in config["chains"].items():
        yield from _contradictions_of_chain(f"config chains {name}", chain)
    yield from _contradictions_of_motions(config)
    for name, chain in config["event_sizes"]["chains"].items():
        yield from _contradictions_of_chain(f"config event_sizes chains {name}", chain)
    modes = config["chain_modes"]
    yield from _contradictions_of_ends("config chain_modes", modes)
    for name, plane in modes["planes"].items():
        place = f"config chain_modes planes {name}"
        yield from check_attractors.window(
            place, "epsilon_window", plane["epsilon_window"], above=-1.0
        )
        yield from check_attractors.window(place, "tau_window", plane["tau_window"], least=0.0)
        if plane["law"].startswith(PREFIX):
            yield wrong(place, plane, "law", "a law with inertia, which chains have")
    synchrony = config["synchrony"]
    place = "config synchrony"
    yield from check_attractors.window(place, "s_window", synchrony["s_window"], least=1.0)
    yield from _contradictions_of_scenes(place, synchrony, config["scenes"])
    for name in config["scenes"].keys() & set(synchrony["scenes"]):
        scene = config["scenes"][name]
        if synchrony["t_end"] <= scene["t_transient"]:
            expected = f"a finite number > t_transient = {scene['t_transient']} of scene '{name}'"
            yield wrong(place, synchrony, "t_end", expected)


def _contradictions_of_scenes(place: str, study: dict, scenes: dict):
    """Scenes that are not there, or whose law chains have not."""
    for name in study["scenes"]:
        if name not in scenes:
            yield f"{place} scenes: {name!r}; expected one of: {', '.join(scenes)}"
        elif scenes[name]["law"].startswith(PREFIX):
            law = scenes[name]["law"]
            yield f"{place} scenes: {name!r} has the law {law}; chains have no such law"


def _contradictions_of_motions(config: dict):
    """Problems of the chains whose motions are told apart."""
    study = config["chain_motions"]
    place = "config chain_motions"
    yield from _contradictions_of_scenes(place, study, config["scenes"])
    for name in study["chains"]:
        if name not in config["chains"]:
            yield f"{place} chains: {name!r}; expected one of: {', '.join(config['chains'])}"
    for blocks in study["blocks"]:
        yield from _contradictions_of_ends(place, {**study, "blocks": blocks})
    yield from check_attractors.check_samples(place, study, max(study["blocks"]))
    begin = study["t_transient"] + study["t_turning"]
    if begin >= study["t_end"]:
        expected = f"a finite number > t_transient + t_turning = {begin}"
        yield wrong(place, study, "t_end", expected)


def _contradictions_of_chain(place: str, chain: dict):
    """Problems of one chain."""
    yield from _contradictions_of_ends(place, chain)
    blocks, t_end = chain["blocks"], chain["t_end"]
    for key, value in chain["history"].items():
        if isinstance(value, list) and len(value) != blocks:
            yield (
                f"{place} history: {key} has {len(value)} numbers; expected one number, or"
                f" {blocks}, one for each block"
            )
    if chain["disturbance"]["block"] > blocks:
        expected = f"a whole number >= 0 and <= blocks = {blocks}"
        yield wrong(f"{place} disturbance", chain["disturbance"], "block", expected)
    if chain["t_transient"] >= t_end:
        yield wrong(place, chain, "t_transient", f"a finite number >= 0 and < t_end = {t_end}")
    yield from check_attractors.check_samples(place, chain, blocks)
    if chain["law"].startswith(PREFIX):
        yield wrong(place, chain, "law", "a law with inertia, which chains have")


def _contradictions_of_ends(place: str, chain: dict):
    """A ring that is too short."""
    if chain["ends"] == "ring" and chain["blocks"] < LEAST_RING:
        yield wrong(place, chain, "blocks", f"a whole number >= {LEAST_RING} with ends = ring")
