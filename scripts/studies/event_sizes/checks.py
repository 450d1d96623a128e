"""Scenes that have no chain."""

from collections.abc import Iterator

from scripts.config.checks import check_scenes


def contradictions(config: dict) -> Iterator[str]:
    """Names of no chain among those whose events are sized."""
    names = config["event_sizes"]["scenes"]
    yield from check_scenes("config event_sizes scenes", names, config["scenes"], chains=True)
