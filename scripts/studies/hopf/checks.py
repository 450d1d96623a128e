"""Keys of planes of Hopf curves that contradict each other."""

from collections.abc import Iterator

from scripts.config.checks import check_axis, window, wrong
from scripts.config.ranges import range_of
from scripts.namelists.laws import own_parameters


def contradictions(config: dict) -> Iterator[str]:
    """Problems of the axes."""
    for name, plane in config["hopf_curves"].items():
        place = f"config hopf_curves {name}"
        values, own = plane["epsilon_window"], own_parameters(config, plane["law"])
        yield from window(place, "epsilon_window", values, **range_of("epsilon"))
        yield from check_axis(place, plane, "ordinate", own, "epsilon")
        if plane["epsilon_window"][1] <= 0:
            yield wrong(place, plane, "epsilon_window", "an end > 0")
