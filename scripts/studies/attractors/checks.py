"""Keys of attractors that contradict each other."""

from collections.abc import Iterator

from scripts.config.checks import check_histories, check_observation, wrong
from scripts.models.models import model_of


def contradictions(config: dict) -> Iterator[str]:
    """Problems of the histories and of the observation."""
    study = config["attractors"]
    yield from check_histories("config attractors histories", study["histories"])
    place = "config attractors observation"
    yield from check_observation(place, study["observation"], config["spectra"])
    if study["observation"]["kept"] == 0:
        yield f"{place}: kept = 0; expected a whole number >= 1"
    for name, scene in config["scenes"].items():
        if (
            scene.get("attractors", {}).get("histories", 1) > 1
            and not model_of(config, scene).is_block
        ):
            expected = "1: ranges of histories are those of the block"
            yield wrong(f"scene '{name}' attractors", scene["attractors"], "histories", expected)
