"""Keys of the motions of chains that contradict each other."""

from collections.abc import Iterator

from scripts.config.checks import check_ends, check_samples, check_scenes_of_chains, wrong


def contradictions(config: dict) -> Iterator[str]:
    """Problems of the chains whose motions are told apart."""
    study = config["chain_motions"]
    place = "config chain_motions"
    yield from check_scenes_of_chains(place, study, config["scenes"])
    for name in study["chains"]:
        if name not in config["chains"]:
            yield f"{place} chains: {name!r}; expected one of: {', '.join(config['chains'])}"
    for blocks in study["blocks"]:
        yield from check_ends(place, {**study, "blocks": blocks})
    yield from check_samples(place, study, max(study["blocks"]))
    begin = study["t_transient"] + study["t_turning"]
    if begin >= study["t_end"]:
        expected = f"a finite number > t_transient + t_turning = {begin}"
        yield wrong(place, study, "t_end", expected)
