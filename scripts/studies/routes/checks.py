"""Keys of routes that contradict each other."""

from collections.abc import Iterator

from scripts.config.checks import (
    check_line,
    check_not_driven,
    check_observation,
    check_values,
)
from scripts.models.models import HISTORY


def contradictions(config: dict) -> Iterator[str]:
    """Problems of the observation, of the names of histories and of the lines."""
    study = config["routes"]
    place = "config routes observation"
    yield from check_observation(place, study["observation"], config["spectra"])
    if study["observation"]["kept"] == 0:
        yield f"{place}: kept = 0; expected a whole number >= 1"
    for name in set(study["histories"]) & {"up", "down"}:
        yield (
            f"config routes histories: name {name!r}; expected another, this is the name of a sweep"
        )
    for name, history in study["histories"].items():
        yield from check_values(f"config routes histories {name}", history, HISTORY)
    for name, line in study["lines"].items():
        yield from check_line(config, f"config routes lines {name}", line, histories=True)
        yield from check_not_driven(config, f"config routes lines {name}", line)
