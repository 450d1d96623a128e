"""Ranges of parameters and of values of the history, for windows of several values."""

from functools import cache
from pathlib import Path

from scripts.files.read_config import read
from scripts.namelists.laws import block_parameters

SCHEMA = Path(__file__).parents[2] / "config" / "schema.yaml"


@cache
def rules() -> dict:
    """The schema of the configuration, not to be changed."""
    return read(SCHEMA)


def range_of(parameter: str, own: dict[str, dict] | None = None) -> dict[str, float]:
    """The bound `above` which a parameter lies, or the `least` that it may be.

    Parameters of the block and `own` ones of a law have those of the definition.
    """
    parameters = {**block_parameters(), **(own or {})}
    bounded = parameters.get(parameter) or rules()["$defs"].get(parameter, {})
    above = bounded.get("above", bounded.get("exclusiveMinimum"))
    bounds = {"above": above, "least": bounded.get("at_least")}
    return {name: float(bound) for name, bound in bounds.items() if bound is not None}
