"""Keys of measured cases that contradict each other."""

from collections.abc import Iterator

from scripts.config.checks import (
    check_constant_delays,
    check_reference,
    check_samples,
    check_scenes,
)


def contradictions(config: dict) -> Iterator[str]:
    """Names that mean nothing or two things, and samples too far apart or too many."""
    place, study, scenes = "config work_precision", config["work_precision"], config["scenes"]
    yield from check_reference(f"{place} reference", study["reference"])
    yield from check_scenes(config, f"{place} scenes", study["scenes"])
    for name in study["cases"]:
        if name in scenes:
            yield (
                f"{place} cases: {name!r}; expected a name that no scene has (or the scene under"
                " work_precision scenes)"
            )
    runs = len(study["methods"]) * len(study["tolerances"])
    for kind in ("scenes", "cases"):
        for name, case in study[kind].items():
            # a scene that there is not is refused above
            if entry := scenes.get(name) if kind == "scenes" else case:
                yield from check_constant_delays(config, f"{place} {kind} {name}", entry)
            yield from check_samples(f"{place} {kind} {name}", case, runs)
