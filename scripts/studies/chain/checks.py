"""Keys of a chain that contradict each other."""

from collections.abc import Iterator

from scripts.config.checks import check_chain


def contradictions(config: dict) -> Iterator[str]:
    """Problems of chains."""
    for name, chain in config["chains"].items():
        yield from check_chain(f"config chains {name}", chain)
