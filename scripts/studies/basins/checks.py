"""Keys of basins that contradict each other."""

from collections.abc import Iterator

from scripts.config.checks import check_histories, check_observation


def contradictions(config: dict) -> Iterator[str]:
    """Problems of the histories and of the observation."""
    study = config["basins"]
    yield from check_histories("config basins histories", study["histories"])
    yield from check_observation(
        "config basins observation", study["observation"], config["spectra"]
    )
