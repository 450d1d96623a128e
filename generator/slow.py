# SPDX-License-Identifier: BSD-3-Clause
"""The slow solution of a stiff model, on which a fast state is in balance.

The fast state w with v = exp(w) has w' = (rate/v) (balance - w). Its slow solution is the balance
less v'/rate, with v' of the iteration before (Fraser 1988, "The steady state and equilibrium
approximations: A geometrical picture", J. Chem. Phys. 88, 4732).
"""

from dataclasses import dataclass

import sympy

from .model import Model
from .recurrences import Constants, weighted_sum


@dataclass
class Balance:
    """A fast state w near its balance: w' = (rate/v) (balance - w), with v = exp(w)."""

    state: str
    auxiliary: str
    rate: sympy.Expr
    value: sympy.Expr
    slopes: dict[str, sympy.Expr]
    """What each of the other states, and second differences, is multiplied by in the balance."""
    constant: sympy.Expr

    def text(self, names: dict[str, str], constants: Constants, *, whole: bool = True) -> str:
        """The balance from these texts of the other states, its constant part left out or not."""
        parts = [(slope, names[state]) for state, slope in self.slopes.items() if slope != 0]
        parts += [(self.constant, "")] * (whole and self.constant != 0)
        return weighted_sum(parts, constants)


def balance_of(model: Model) -> Balance | None:
    """The balance of the fast state; None unless it is a sum of multiples of the other states.

    Other balances would need sums over lower orders before the fast state is known.
    """
    state = model.fast
    auxiliary = next((v for v, w in model.auxiliary.items() if w == state), None)
    if auxiliary is None:
        return None
    w, v = model.symbol(state), model.symbol(auxiliary)
    rate = sympy.simplify(-model.equations[state].diff(w) * v)
    if rate == 0 or rate.free_symbols & model.variables:
        return None
    value = sympy.expand(w + model.equations[state] * v / rate)
    others = {name: model.symbol(name) for name in model.states if name != state}
    others |= {symbol.name: symbol for symbol in model.differences.values()}
    slopes = {name: value.diff(symbol) for name, symbol in others.items()}
    linear = sympy.Add(*(slope * others[name] for name, slope in slopes.items()))
    constant = sympy.expand(value - linear)
    if any(one.free_symbols & model.variables for one in [*slopes.values(), constant]):
        return None
    return Balance(state, auxiliary, rate, value, slopes, constant)


def inertia_lines(balance: Balance | None, constants: Constants) -> list[str]:
    """The statement that sets what v' is multiplied by."""
    return [f"inertia = {constants.text(1 / balance.rate)}/unit"] if balance else []
