"""Slip events of chains: their sizes by several definitions, cut-offs, and aftershocks."""

from scripts.results.paths import events_of_chains, slips_of_chains


def inputs(config: dict) -> dict:
    """Events and slips of each chain, and the laws fitted to them."""
    return {
        "events": events_of_chains(config),
        "slips": slips_of_chains(config),
        "laws": "<results>/tables/event-sizes.tsv",
    }


def params(config: dict) -> dict:
    """Names of the chains, in order."""
    return {"names": list(config["event_sizes"]["chains"])}
