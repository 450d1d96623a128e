# SPDX-License-Identifier: BSD-3-Clause
"""Expressions of branches: on each side of a condition another one, in numbers that are 0 or 1."""

import sympy
from sympy.codegen.cfunctions import expm1, log1p

NAMES = ("abs", "sign", "heaviside", "min", "max", "where", "piecewise")
"""Functions that are not smooth; SymPy writes some with a capital."""
REGULAR = {
    **dict.fromkeys((sympy.exp, sympy.sinh, sympy.cosh, expm1, log1p), 0),
    **dict.fromkeys((sympy.asin, sympy.acos, sympy.atanh), 0),
    **{sympy.log: 1, sympy.atan2: 1, sympy.acosh: 2},
}
"""Last arguments at which functions that have no value or overflow elsewhere are regular."""


def either(condition: sympy.Expr, one: sympy.Expr, other: sympy.Expr) -> sympy.Expr:
    """One expression where a condition is 1, another where it is 0."""
    if condition in (0, 1):
        return one if condition == 1 else other
    left = 1 - condition
    return condition * regular(one, condition) + left * regular(other, left)


def regular(one: sympy.Expr, condition: sympy.Expr) -> sympy.Expr:
    """An expression that has a value, whatever it is, also where a condition is 0."""
    if one.is_number or not one.args:
        return one
    args = [regular(part, condition) for part in one.args]
    if one.func in REGULAR:
        args[-1] = condition * args[-1] + (1 - condition) * REGULAR[one.func]
    elif one.is_Pow and not (one.exp.is_Integer and one.exp > 0):
        args[0] = condition * args[0] + (1 - condition)
    return one.func(*args)
