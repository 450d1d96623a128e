"""Rows of the figure that contradict scenes."""

from collections.abc import Iterator

from scripts.config.checks import wrong


def contradictions(config: dict) -> Iterator[str]:
    """Rows whose scenes have no attractors."""
    scenes = config["scenes"]
    for row, shown in config["figures"]["true_torus"]["rows"].items():
        if shown["scene"] in scenes and "attractors" not in scenes[shown["scene"]]:
            place = f"config figures true_torus rows {row}"
            yield wrong(place, shown, "scene", "a scene with the key attractors")
