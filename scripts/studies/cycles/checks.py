"""Keys of cycles that contradict each other."""

from collections.abc import Iterator

from generator.ranges import range_of
from scripts.config.checks import check_constant_delays, check_line, check_rest, window
from scripts.models.models import block_parameters, model_of


def contradictions(config: dict) -> Iterator[str]:
    """Problems of the lines, and of the windows of curves."""
    study = config["cycles"]
    yield from check_curves("config cycles curves", study.get("curves", {}), block_parameters())
    for name, line in study["lines"].items():
        place, known = f"config cycles lines {name}", model_of(config, line).parameters
        yield from check_line(config, place, line)
        yield from check_rest(config, place, line)
        yield from check_constant_delays(config, place, line)
        yield from check_curves(f"{place} curves", line.get("curves", {}), known)


def check_curves(place: str, curves: dict, known: dict[str, dict]) -> Iterator[str]:
    """Problems of two parameters and their windows."""
    for name, values in curves.items():
        if name not in known:
            yield f"{place}: unknown key [{name!r}]; allowed: {', '.join(known)}"
        else:
            yield from window(place, name, values, **range_of(known[name]))
