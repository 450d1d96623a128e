"""Keys of the modes of a chain that contradict each other."""

from collections.abc import Iterator

from scripts.config.checks import check_ends, window, wrong
from scripts.namelists.laws import PREFIX


def contradictions(config: dict) -> Iterator[str]:
    """Problems of the chain and of the planes."""
    modes = config["chain_modes"]
    yield from check_ends("config chain_modes", modes)
    for name, plane in modes["planes"].items():
        place = f"config chain_modes planes {name}"
        yield from window(place, "epsilon_window", plane["epsilon_window"], above=-1.0)
        yield from window(place, "tau_window", plane["tau_window"], least=0.0)
        if plane["law"].startswith(PREFIX):
            yield wrong(place, plane, "law", "a law with inertia, which chains have")
