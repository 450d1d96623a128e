"""Keys of the modes of a chain that contradict each other."""

from collections.abc import Iterator

from generator.ranges import range_of
from scripts.config.checks import check_coupled, check_ends, window
from scripts.models.models import block_parameters


def contradictions(config: dict) -> Iterator[str]:
    """Problems of the chain and of the planes."""
    modes, known = config["chain_modes"], block_parameters()
    yield from check_ends("config chain_modes", modes)
    for name, plane in modes["planes"].items():
        place = f"config chain_modes planes {name}"
        yield from window(
            place, "epsilon_window", plane["epsilon_window"], **range_of(known["epsilon"])
        )
        yield from window(place, "tau_window", plane["tau_window"], **range_of(known["tau"]))
        yield from check_coupled(config, place, plane)
