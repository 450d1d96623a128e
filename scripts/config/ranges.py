"""Ranges of parameters and of values of the history, for windows of several values."""

from scripts.namelists.laws import block_parameters
from scripts.plans.studies import schema


def range_of(parameter: str, own: dict[str, dict] | None = None) -> dict[str, float]:
    """The bound `above` which a parameter lies, or the `least` that it may be.

    Parameters of the block and `own` ones of a law have those of the definition.
    """
    parameters = {**block_parameters(), **(own or {})}
    bounded = parameters.get(parameter) or schema()["$defs"].get(parameter, {})
    above = bounded.get("above", bounded.get("exclusiveMinimum"))
    bounds = {"above": above, "least": bounded.get("at_least")}
    return {name: float(bound) for name, bound in bounds.items() if bound is not None}
