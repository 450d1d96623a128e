"""Ranges of the block's parameters, as the schema has them, for windows of several values."""

from functools import cache
from pathlib import Path

from scripts.config.read_config import read

SCHEMA = Path(__file__).parents[2] / "config" / "schema.yaml"


@cache
def rules_of(schema: Path) -> dict:
    """A schema, not to be changed."""
    return read(schema)


@cache
def range_of(parameter: str) -> dict[str, float]:
    """The bound `above` which a parameter lies, or the `least` that it may be."""
    rules = rules_of(SCHEMA)["$defs"][parameter]
    bounds = {"above": rules.get("exclusiveMinimum"), "least": rules.get("minimum")}
    return {name: float(bound) for name, bound in bounds.items() if bound is not None}
