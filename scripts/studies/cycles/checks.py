"""Keys of cycles that contradict each other."""

from collections.abc import Iterator

from scripts.config.checks import check_line, window
from scripts.config.ranges import range_of
from scripts.namelists.laws import own_parameters


def contradictions(config: dict) -> Iterator[str]:
    """Problems of the lines, and of the window of curves."""
    study = config["cycles"]
    for name, line in study["lines"].items():
        yield from check_line(
            f"config cycles lines {name}", line, own_parameters(config, line["law"])
        )
    for key in ("epsilon", "tau") if "curves" in study else ():
        values = study["curves"][f"{key}_window"]
        yield from window("config cycles curves", f"{key}_window", values, **range_of(key))
