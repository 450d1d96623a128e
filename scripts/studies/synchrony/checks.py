"""Keys of synchrony that contradict each other."""

from collections.abc import Iterator

from scripts.config.checks import check_scenes, window, wrong
from scripts.models.models import ALONE, model_of


def contradictions(config: dict) -> Iterator[str]:
    """Problems of the scenes whose synchrony is tried."""
    synchrony = config["synchrony"]
    place = "config synchrony"
    yield from window(place, "s_window", synchrony["s_window"], least=1.0)
    yield from check_scenes(config, f"{place} scenes", synchrony["scenes"])
    for name in config["scenes"].keys() & set(synchrony["scenes"]):
        scene = config["scenes"][name]
        if model_of(config, scene).kind != ALONE:
            yield f"{place} scenes: {name!r} has the law {scene['law']}; chains have no such law"
        if synchrony["t_end"] <= scene["t_transient"]:
            expected = f"a finite number > t_transient = {scene['t_transient']} of scene '{name}'"
            yield wrong(place, synchrony, "t_end", expected)
