"""Slip events of chains: their sizes by several definitions, cut-offs, and aftershocks.

Formulas and sources: `slip_events.f90`, `laws.py`.
"""

from scripts.namelists.chains import groups_of_chain
from scripts.plans.declare import LONG, Figure, Run, Study, Table


def groups(config: dict, event_chain: str) -> dict[str, dict]:
    """A chain for the slips of its blocks from the start on: events are found in all of them."""
    study = config["event_sizes"]
    own = {"t_transient": 0.0, "thresholds": study["thresholds"]}
    return groups_of_chain(config, event_chain, study["chains"][event_chain] | own)


def slips(config: dict) -> list[str]:
    """Slips of the blocks of all chains."""
    return [f"<results>/chain_slips/{name}.nc" for name in config["event_sizes"]["chains"]]


def events(config: dict) -> list[str]:
    """Tables of the events of all chains."""
    return [f"<results>/tables/chain-events/{name}.tsv" for name in config["event_sizes"]["chains"]]


def transient(config: dict, event_chain: str) -> float:
    """The time before which events of a chain are left out."""
    return config["event_sizes"]["chains"][event_chain]["t_transient"]


def transients(config: dict) -> list[float]:
    """These times of all chains."""
    return [transient(config, name) for name in config["event_sizes"]["chains"]]


def inputs(config: dict) -> dict:
    """Events and slips of each chain, and the laws fitted to them."""
    return {
        "events": events(config),
        "slips": slips(config),
        "laws": "<results>/tables/event-sizes.tsv",
    }


FIGURE = {
    "category": "Chains",
    "inputs": inputs,
    "params": lambda config: {"names": list(config["event_sizes"]["chains"])},
}
STUDY = Study(
    entries={"event_chain": ("event_sizes", "chains")},
    runs=(
        Run(
            *("chain_slips", "slip_events", "chain_slips/{event_chain}.nc", groups),
            priority=LONG,
            minutes=120,
        ),
    ),
    tables=(
        Table(
            *("chain_events", "tables/chain-events/{event_chain}.tsv"),
            lambda _config, event_chain: {"slips": f"<results>/chain_slips/{event_chain}.nc"},
            params={"t_transient": transient},
            script="events_table.py",
        ),
        Table(
            *("event_sizes_table", "tables/event-sizes.tsv"),
            lambda config: {"slips": slips(config), "events": events(config)},
            params={
                "t_transient": transients,
                "thresholds": lambda config: config["event_sizes"]["thresholds"],
            },
            wanted=lambda config: bool(config["event_sizes"]["chains"]),
        ),
    ),
    figures=(Figure("event_sizes", place=450, **FIGURE),),
    kinds=(Figure("event_chains", place=90, shows=("event_sizes", "chains"), **FIGURE),),
)
