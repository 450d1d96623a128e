# SPDX-License-Identifier: BSD-3-Clause
"""Exponentials in quotients that are bounded, as in 1/(1 + exp(u)): u may be any number there.

Such a quotient is a rational function r(x) of x = exp(u) that stays finite as x goes to 0 and to
infinity. With u kept within a bound its terms and those of its derivative do not overflow, and its
error is below exp(-bound), 5e-131 in this example. Elsewhere the size of exp(u) matters, and one
that is too large is refused.
"""

import sympy
from sympy.codegen.cfunctions import expm1

from .fortran import within

X = sympy.Symbol("X_", positive=True)
GROWING = {
    sympy.exp: lambda x: x,
    expm1: lambda x: x - 1,
    sympy.cosh: lambda x: (x + 1 / x) / 2,
    sympy.sinh: lambda x: (x - 1 / x) / 2,
}
"""Functions that may overflow, by the exponential of their argument."""
BOUNDED = (sympy.tanh, sympy.sin, sympy.cos, sympy.atan, sympy.erf, sympy.erfc)
"""Functions of which a small error of the argument is a small error."""
ROOM = 600
"""Logarithm of the largest power in a bounded quotient and its derivative; exp(709.8) overflows."""


def limited(one: sympy.Expr, variables: set[sympy.Symbol]) -> sympy.Expr:
    """An expression whose bounded quotients have their arguments of exponentials limited."""
    found = outermost(one, variables)
    if not found:
        return one
    keys = {key for _, key in found.values()}
    if len(keys) == 1 and (whole := bounded(one, found, keys.pop())) is not None:
        return whole
    if one.is_Add or one.func in BOUNDED or (one.is_Pow and one.exp.is_Integer and one.exp > 0):
        return one.func(*(limited(part, variables) for part in one.args))
    if one.is_Mul:
        # factors of one exponential belong together, as exp(u)/(1 + exp(u))
        groups: dict[frozenset, sympy.Expr] = {}
        for factor in one.args:
            mine = frozenset(key for _, key in outermost(factor, variables).values())
            groups[mine] = groups.get(mine, sympy.S.One) * factor
        if len(groups) > 1 and sum(map(len, groups)) == len(keys):
            parts = [limited(part, variables) for part in groups.values()]
            if not any(outermost(part, variables) for part in parts):
                return sympy.Mul(*parts)
    return one


def outermost(one: sympy.Expr, variables: set[sympy.Symbol]) -> dict[sympy.Expr, tuple]:
    """Growing functions that are not limited yet, each with its argument as multiple and key."""
    if one.func is sympy.exp and one.args[0].is_nonpositive:
        return {}
    if one.func in GROWING and one.free_symbols & variables and not one.has(within):
        multiple, key = one.args[0].as_content_primitive()
        sign = -1 if key.could_extract_minus_sign() else 1
        return {one: (sign * multiple, sign * key)}
    return {atom: key for part in one.args for atom, key in outermost(part, variables).items()}


def bounded(one: sympy.Expr, found: dict, key: sympy.Expr) -> sympy.Expr | None:
    """The expression with its argument limited, or None unless it is a bounded quotient."""
    unit = min(abs(multiple) for multiple, _ in found.values())
    shares = {atom: multiple / unit for atom, (multiple, _) in found.items()}
    if not all(share.is_Integer for share in shares.values()):
        return None
    rational = one.xreplace({a: GROWING[a.func](X**share) for a, share in shares.items()})
    try:
        parts = [sympy.fraction(sympy.together(rational.subs(X, x))) for x in (X, 1 / X)]
        degrees = [(sympy.degree(above, X), sympy.degree(below, X)) for above, below in parts]
    except sympy.PolynomialError:
        return None
    if any(above > below for above, below in degrees):
        return None
    argument = within(unit * key, ROOM // (1 + max(below for _, below in degrees)))
    return one.xreplace({a: a.func(share * argument) for a, share in shares.items()})
