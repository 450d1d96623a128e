# SPDX-License-Identifier: BSD-3-Clause
"""Exponents of the exponential terms of the equations.

A term exp(a) with large |a| vanishes, or saturates what holds it, in the rounding of other terms.
Then no estimate of an error shows when a comes back: the solver follows the exponents themselves.
"""

import sympy

from .address import Address
from .flow import Procedure
from .fortran import text_of, within
from .model import Model
from .pointwise import of_all_blocks

LARGEST_ALGEBRAIC = 4
"""Powers up to this are seen in the rounding of others wherever their base is not tiny."""

FARTHEST = 100
"""A power below exp(-FARTHEST) is as good as 0: its base may pass through 0, where the logarithm
does not."""


def exponents_of(model: Model) -> list[str]:
    """The text of each exponent a of which exp(a) or exp(-a) is a term, once."""
    exponentials = {
        model.symbol(name): sympy.exp(model.symbol(w)) for name, w in model.auxiliary.items()
    }
    variables = model.variables
    found: dict[sympy.Expr, str] = {}
    for equation in model.equations.values():
        # beyond the bounds of `within`, too
        whole = sympy.expand_func(equation.replace(within, lambda one, _: one))
        for one in sympy.preorder_traversal(whole.xreplace(exponentials)):
            exponent, names = sympy.S.Zero, {}
            if one.func in (sympy.exp, sympy.sinh, sympy.cosh):
                exponent = one.args[0]
            elif one.func is sympy.tanh:
                exponent = 2 * one.args[0]
            elif one.func in (sympy.erf, sympy.erfc):
                exponent = one.args[0] ** 2
            elif one.is_Pow and not (one.exp.is_number and abs(one.exp) <= LARGEST_ALGEBRAIC):
                exponent = one.exp * sympy.log(one.base)
                names = {sympy.log(one.base): logarithm_of(one)}
            if exponent.free_symbols & variables and not {exponent, -exponent} & {*found}:
                found[exponent] = text_of(exponent, names)
    return list(found.values())


def logarithm_of(power: sympy.Pow) -> str:
    """The text of the logarithm of a base, of a larger one where the power is below
    exp(-FARTHEST)."""
    base, exponent = text_of(power.base), text_of(power.exp)
    least = f"-{FARTHEST}.0_wp/max(abs({exponent}), 1.0_wp)"
    return f"max(log(max(abs({base}), tiny(1.0_wp))), {least})"


def exponents_procedure(model: Model, exponents: list[str]) -> Procedure:
    """The exponents in a state."""
    first = f"{len(exponents)}*(block - 1) + " if Address(model).in_chain else ""
    lines = [f"exponents({first}{number}) = {text}" for number, text in enumerate(exponents, 1)]
    return of_all_blocks(model, "exponents", lines, [], guarded={})
