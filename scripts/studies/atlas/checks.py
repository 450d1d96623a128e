"""Keys of the atlas that contradict each other."""

from collections.abc import Iterator

from scripts.config.checks import (
    check_not_driven,
    check_observation,
    check_own_history,
    check_plane,
    check_values,
    wrong,
)
from scripts.models.models import HISTORY
from scripts.studies.atlas.plan import part_of, refinements_of

MOST_POINTS = 1_000_000
"""Points that one run of the program takes."""


def contradictions(config: dict) -> Iterator[str]:
    """Problems of the observation, and of planes, each divided into parts, which are runs."""
    place, atlas = "config atlas", config["atlas"]
    yield from check_observation(f"{place} observation", atlas["observation"], config["spectra"])
    yield from check_values(f"{place} history", atlas["history"], HISTORY)
    for name, plane in atlas["planes"].items():
        shared = {"abscissa_window": atlas["abscissa_window"]}
        yield from check_plane(config, f"{place} planes {name}", shared | plane)
        yield from check_own_history(config, f"{place} planes {name}", plane)
        yield from check_not_driven(config, f"{place} planes {name}", plane)
    delays, parts = atlas["ordinate_count"], atlas["parts"]
    if parts > delays:
        yield wrong(place, atlas, "parts", f"a whole number >= 1 and <= ordinate_count = {delays}")
        return
    distance = 2 ** refinements_of(atlas)
    ends = (part_of(delays, parts, part, distance) for part in range(1, parts + 1))
    points = atlas["abscissa_count"] * max(last - first + 1 for first, last in ends)
    if points > MOST_POINTS:
        yield f"{place}: parts = {parts} of {points} points; expected at most {MOST_POINTS} in each"
