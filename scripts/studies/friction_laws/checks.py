"""Keys of the comparison of laws that contradict each other."""

from collections.abc import Iterator

from generator.ranges import range_of
from scripts.config.checks import check_observation, check_scenes, check_values, window
from scripts.models.models import HISTORY, block_parameters, models


def contradictions(config: dict) -> Iterator[str]:
    """Laws without parameters of their own; planes and scenes by different names."""
    place, study = "config friction_laws", config["friction_laws"]
    known = block_parameters()
    yield from check_values(f"{place} history", study["history"], HISTORY)
    yield from check_observation(f"{place} observation", study["observation"], config["spectra"])
    yield from window(
        place, "epsilon_window", study["epsilon_window"], **range_of(known["epsilon"])
    )
    for name, plane in study["planes"].items():
        inside, fixed = f"{place} planes {name}", plane.keys() - {"tau_window"}
        yield from window(inside, "tau_window", plane["tau_window"], **range_of(known["tau"]))
        others = {key: known[key] for key in known.keys() - {"tau", "epsilon"}}
        yield from check_values(inside, {key: plane[key] for key in fixed}, others)
    bare = [name for name, one in models(config).items() if one.is_block and not one.own_parameters]
    for law in study["laws"]:
        if law not in bare:
            yield f"{place} laws: {law!r}; expected some of: {', '.join(bare)}"
    yield from check_scenes(config, f"{place} scenes", study["scenes"])
    for name in set(study["planes"]) & set(config["scenes"]):
        yield f"{place} planes: {name!r}; expected a name that no scene has"
