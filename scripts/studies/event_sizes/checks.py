"""Scenes that have no chain."""

from collections.abc import Iterator

from scripts.config.checks import check_scenes
from scripts.plans.scenes import is_chain


def contradictions(config: dict) -> Iterator[str]:
    """Names of no chain among those whose events are sized."""
    names = config["event_sizes"]["scenes"]
    yield from check_scenes(config, "config event_sizes scenes", names, kind=is_chain)
