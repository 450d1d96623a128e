"""Keys of a chain that contradict each other."""

from collections.abc import Iterator

from scripts.config.checks import check_chain


def contradictions(config: dict) -> Iterator[str]:
    """Problems of the chains whose events are sized."""
    for name, chain in config["event_sizes"]["chains"].items():
        yield from check_chain(f"config event_sizes chains {name}", chain)
