"""Keys of the comparison of laws that contradict each other."""

from collections.abc import Iterator

from scripts.config.checks import check_observation, check_scenes, window
from scripts.config.ranges import range_of
from scripts.namelists.laws import definitions, own_parameters


def contradictions(config: dict) -> Iterator[str]:
    """Laws without parameters of their own; planes and scenes by different names."""
    place, study = "config friction_laws", config["friction_laws"]
    yield from check_observation(f"{place} observation", study["observation"], config["spectra"])
    yield from window(place, "epsilon_window", study["epsilon_window"], **range_of("epsilon"))
    for name, plane in study["planes"].items():
        yield from window(
            f"{place} planes {name}", "tau_window", plane["tau_window"], **range_of("tau")
        )
    bare = [law for law in definitions(config) if not own_parameters(config, law)]
    for law in study["laws"]:
        if law not in bare:
            yield f"{place} laws: {law!r}; expected some of: {', '.join(bare)}"
    yield from check_scenes(f"{place} scenes", study["scenes"], config["scenes"])
    for name in set(study["planes"]) & set(config["scenes"]):
        yield f"{place} planes: {name!r}; expected a name that no scene has"
