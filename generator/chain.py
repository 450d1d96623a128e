"""A chain: the equations once for each of its blocks, with loops over these.

A model is a chain where an equation has the second difference of a state, along the blocks. States
stand block by block in their order, so that the Jacobian is banded. Series are in chain_series.py,
those of disturbances in chain_tangents.py.
"""

import re
from collections.abc import Callable

import sympy

from generator.definition import Model
from generator.fortran import indented, text_of
from generator.pointwise import braced, guard_lines, jacobian_entries, without_value
from generator.recurrences import fetch_parameters
from generator.series import (
    Procedure,
    fetch_places,
    guarded,
    place_names,
    uses_parameters,
)
from generator.slow import Balance

LANES = "real(wp), dimension(lanes)"
"""Declaration of the lanes of a tile, or of disturbances."""


def couplings(model: Model) -> list[tuple[int, int]]:
    """Equations with a second difference, and the state of which they take it, by number."""
    states = list(model.states)
    return [
        (row, states.index(state) + 1)
        for row, equation in enumerate(model.equations.values(), 1)
        for state, symbol in model.differences.items()
        if equation.has(symbol)
    ]


def column_of(model: Model, state: str, block: str) -> str:
    """The place of a state of a block in the state vector, a row of texts."""
    size = len(model.states)
    behind = size - 1 - list(model.states).index(state)
    return f"{size}*{block}" + (f" - {behind}" if behind else "")


def difference_lines(model: Model, block: str, value: Callable[[str], str], lane: str = ""):
    """Statements that set second differences; a neighbour 0 is the plate, which is at rest."""
    lines = []
    for state, symbol in model.differences.items():
        name = f"{symbol.name}{lane}"
        lines.append(f"{name} = -2.0_wp*{state}{lane}")
        for side in ("left", "right"):
            neighbour = f"{side}({block})"
            at = value(column_of(model, state, neighbour))
            lines.append(f"if ({neighbour} > 0) {name} = {name} + {at}")
    return lines


def state_lines(model: Model) -> list[str]:
    """Statements that set the states of one block, and what they take of others and of before."""
    size = len(model.states)
    lines = [f"at = {size}*(block - 1)"]
    lines += [f"{state} = y(at + {place})" for place, state in enumerate(model.states, 1)]
    for number, one in enumerate(model.delayed, 1):
        lines += [
            f"{one.symbol.name} = {one.state}",
            f"if (place_{number} > 0) {one.symbol.name} = z({delayed_index(number)})",
        ]
    return [*lines, *difference_lines(model, "block", lambda column: f"y({column})")]


def delayed_index(number: int, block: str = "block - 1") -> str:
    """The place of a delayed state of a block among all."""
    return f"({block})*self%delays + place_{number}"


def names_of_states(model: Model) -> list[str]:
    """Names that these statements set."""
    symbols = [*(one.symbol for one in model.delayed), *model.differences.values()]
    return [*model.states, *(symbol.name for symbol in symbols)]


def pointwise_parts(model: Model, expressions: list[sympy.Expr], result: str):
    """Statements before the loop over blocks, and at its start; names of reals."""
    parameters = uses_parameters(model, [*expressions, *guarded(model)])
    auxiliary = [f"{name} = exp({state})" for name, state in model.auxiliary.items()]
    before = [*fetch_parameters(model, parameters), *fetch_places(model)]
    inside = [*state_lines(model), *guard_lines(model, result), *auxiliary]
    return before, inside, [*parameters, *names_of_states(model), *model.auxiliary]


def rhs_procedure(model: Model) -> Procedure:
    """The equations of all blocks."""
    equations = list(model.equations.values())
    before, inside, names = pointwise_parts(model, equations, "dydt")
    inside += [f"dydt(at + {place}) = {text_of(one)}" for place, one in enumerate(equations, 1)]
    lines = [*before, "do block = 1, self%blocks", *indented(inside), "end do"]
    return Procedure(names, [], [*place_names(model), "at", "block"], lines)


def jacobian_procedure(model: Model) -> Procedure:
    """The banded derivatives by states, and those by delayed states, block by block."""
    entries, shared, texts = jacobian_entries(model)
    before, inside, names = pointwise_parts(model, list(entries.values()), "by_y")
    states = list(model.states)
    inside += [f"{name} = {text_of(value)}" for name, value in shared]
    for (row, of), text in texts.items():
        if of in states:
            column = states.index(of) + 1
            inside.append(f"{banded(f'at + {row}', f'at + {column}')} = {text}")
    for (row, of), text in texts.items():
        for state, symbol in model.differences.items():
            if of == symbol:
                inside += neighbour_entries(model, row, state, text)
        for number, one in enumerate(model.delayed, 1):
            if of == one.symbol:
                entry = banded(f"at + {row}", f"at + {states.index(one.state) + 1}")
                inside += [
                    f"if (place_{number} > 0) then",
                    f"   by_z({row}, {delayed_index(number)}) = {text}",
                    "else",
                    f"   {entry} = {entry} + {braced(text)}",
                    "end if",
                ]
    lines = [
        *before,
        "by_y = 0.0_wp",
        "by_z = 0.0_wp",
        "do block = 1, self%blocks",
        *indented(without_value(inside)),
        "end do",
    ]
    reals = [*names, *(str(name) for name, _ in shared), "by_difference"]
    return Procedure(reals, [], [*place_names(model), "at", "block"], lines)


def banded(row: str, column: str) -> str:
    """An element of the banded Jacobian."""
    return f"by_y(1 + self%upper + ({row}) - ({column}), {column})"


def neighbour_entries(model: Model, row: int, state: str, text: str) -> list[str]:
    """Statements that add derivatives by the states of which a second difference is made."""
    lines = [f"by_difference = {text}"]
    for block, weight in (
        ("block", "-(2.0_wp + self%mode)*by_difference"),
        ("left(block)", "by_difference"),
        ("right(block)", "by_difference"),
    ):
        entry = banded(f"at + {row}", column_of(model, state, block))
        line = f"{entry} = {entry} + {braced(weight)}"
        lines.append(line if block == "block" else f"if ({block} > 0) {line}")
    return lines


def relaxation_procedure(model: Model, balance: Balance) -> Procedure:
    """The least of the rates at which blocks approach their balances."""
    parameters = uses_parameters(model, [balance.rate])
    size, place = len(model.states), list(model.states).index(balance.state) + 1
    window = model.domain.get(balance.state, (-300, 0))
    least = text_of(sympy.Rational(str(window[0])))
    lines = [
        *fetch_parameters(model, parameters),
        f"rate = {text_of(balance.rate)}*exp(-max({least}, maxval(y({place}::{size}))))",
    ]
    return Procedure(parameters, [], [], lines)


def renamed(lines: list[str]) -> list[str]:
    """Statements with another name for the orders of their own loops."""
    return [re.sub(r"\bk\b", "i", line) for line in lines]
