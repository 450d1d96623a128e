"""Ranges of the block's parameters, as the schema has them, for windows of several values."""

from functools import cache
from pathlib import Path

from scripts.files.read_config import read

SCHEMA = Path(__file__).parents[2] / "config" / "schema.yaml"


@cache
def rules() -> dict:
    """The schema of the configuration, not to be changed."""
    return read(SCHEMA)


@cache
def range_of(parameter: str) -> dict[str, float]:
    """The bound `above` which a parameter lies, or the `least` that it may be."""
    bounded = rules()["$defs"][parameter]
    bounds = {"above": bounded.get("exclusiveMinimum"), "least": bounded.get("minimum")}
    return {name: float(bound) for name, bound in bounds.items() if bound is not None}
