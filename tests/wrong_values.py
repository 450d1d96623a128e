"""Values that the schema of the configuration refuses, made from its own words."""

import math
import re
from collections.abc import Iterator

from scripts.config.check_models import with_parameters
from scripts.plans import studies

SIGNS = {"exclusiveMinimum": ">", "minimum": ">=", "exclusiveMaximum": "<", "maximum": "<="}
NO_NUMBERS = ["0.5", True, None, {"a": 0.5}, math.nan, math.inf, -math.inf]
Place = tuple[str | int, ...]
"""Keys, and places in lists, that lead to a value."""


def rules_in(config: dict) -> Iterator[tuple[Place, object, dict]]:
    """Each value of a configuration, of a list the last one, with its place and what the schema
    says of it."""
    schema = with_parameters(studies.schema(), config)

    def whole(rules: dict) -> dict:
        if "$ref" not in rules:
            return rules
        at = schema
        for step in rules["$ref"].removeprefix("#/").split("/"):
            at = at[step]
        return {**whole(at), **rules}

    def inside(value, rules: dict, path: Place = ()):
        rules = whole(rules)
        yield path, value, rules
        items = [*enumerate(value)][-1:] if isinstance(value, list) else []
        known = rules.get("properties", {})
        for key, part in value.items() if isinstance(value, dict) else items:
            below = known.get(key, rules.get("additionalProperties", rules.get("items")))
            if isinstance(below, dict):
                yield from inside(part, below, (*path, key))

    yield from inside(config, schema)


def wrong_values(value, rules: dict) -> Iterator[tuple[object, str]]:
    """Values that these rules refuse, and words of the refusal."""
    kinds = rules.get("type", "")
    if "number" in kinds or kinds == "integer":
        yield from ((one, "number") for one in NO_NUMBERS)
        yield (1.5, "whole number") if kinds == "integer" else (10**400, "finite number")
    for key, sign in SIGNS.items():
        if key in rules and isinstance(value, int | float):
            bound, outwards = rules[key], -1 if key.lower().endswith("minimum") else 1
            beyond = bound + outwards if kinds == "integer" else float(bound)
            if kinds != "integer" and not key.startswith("exclusive"):
                beyond = math.nextafter(bound, outwards * math.inf)
            has_range = re.search("(finite|whole) number", rules.get("description", ""))
            yield beyond, "number" if has_range else f"{sign} {bound}"
    if "enum" in rules:
        yield "nonsense", rules["enum"][-1]
    if kinds == "object":
        yield 5, ""
        if rules.get("minProperties"):
            yield {}, ""
    if kinds == "array":
        yield 5, ""
        if rules.get("minItems"):
            yield value[: rules["minItems"] - 1], ""
        if "maxItems" in rules and value:
            yield (value * (1 + rules["maxItems"]))[: 1 + rules["maxItems"]], ""
        if rules.get("uniqueItems") and value:
            yield [*value, value[-1]], ""
