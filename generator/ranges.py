# SPDX-License-Identifier: BSD-3-Clause
"""Ranges of parameters and of values of the history, as definitions give them."""

import math


def range_of(rules: dict) -> dict[str, float]:
    """The bound `above` which a value lies, or the `least` that it may be."""
    bounds = {"above": rules.get("above"), "least": rules.get("at_least")}
    return {name: float(bound) for name, bound in bounds.items() if bound is not None}


def is_inside(value: float, rules: dict) -> bool:
    """Whether a value lies in its range."""
    return value > rules.get("above", -math.inf) and value >= rules.get("at_least", -math.inf)


def expected_of(name: str, rules: dict) -> str:
    """What a value is, its unit and its range, as messages write them."""
    signs = {"above": ">", "at_least": ">="}
    bounds = [f"{sign} {rules[key]:g}" for key, sign in signs.items() if key in rules]
    kind = " ".join(["a finite number", *bounds])
    return f"{rules.get('meaning', name)}, {rules.get('unit', 'nondimensional')}, {kind}"
