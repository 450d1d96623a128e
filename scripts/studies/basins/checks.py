"""Keys of basins that contradict each other."""

from collections.abc import Iterator

from scripts.config.checks import (
    check_histories,
    check_not_driven,
    check_observation,
    check_own_history,
)
from scripts.models.models import model_of


def contradictions(config: dict) -> Iterator[str]:
    """Problems of the histories and of the observation."""
    study = config["basins"]
    yield from check_histories("config basins histories", study["histories"])
    yield from check_observation(
        "config basins observation", study["observation"], config["spectra"]
    )
    for name, place in study["places"].items():
        where = f"config basins places {name}"
        yield from check_own_history(config, where, place, "histories")
        yield from check_not_driven(config, where, place)
        if "histories" in place:
            rules = model_of(config, place).history
            yield from check_histories(f"{where} histories", place["histories"], rules)
