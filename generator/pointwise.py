# SPDX-License-Identifier: BSD-3-Clause
"""Procedures that need one state: the right-hand side and its derivatives."""

import sympy

from .address import Address
from .flow import Procedure, guard_names, refusals, with_parameters
from .fortran import indented, text_of
from .model import Model
from .recurrences import fetch_parameters, names_of_parameters
from .slow import Balance


def of_all_blocks(
    model: Model, result: str, lines: list[str], names: list[str], guarded=None
) -> Procedure:
    """A procedure with these statements for every block.

    It ends with no number where an expression of `guarded`, all equations by default, has no value.
    """
    at = Address(model)
    guarded = model.equations if guarded is None else guarded
    states = [*at.start(), *(f"{name} = {at.state('y', state=name)}" for name in model.states)]
    delayed = [one.symbol.name for one in model.delayed]
    results = ["by_y", "by_z"] if result == "by_y" else [result]
    of = (lambda state: at.state(result, state=state)) if result == "dydt" else None
    inside = [
        *states,
        *at.fetched(delayed),
        *at.differences(lambda column: f"y({column})"),
        *refusals(model, guarded, guard_names(model), *results, of=of),
        *(f"{name} = exp({state})" for name, state in model.auxiliary.items()),
        *lines,
    ]
    if at.in_chain:
        inside = ["do block = 1, self%blocks", *indented(inside), "end do"]
    before = [f"{one} = 0.0_wp" for one in results] if result == "by_y" else []
    differences = [symbol.name for symbol in model.differences.values()]
    reals = [*names_of_parameters(model), *model.states, *model.auxiliary, *names]
    return Procedure(
        {
            "real(wp)": [*reals, *delayed, *differences],
            "integer": [*at.place_names(), *["at", "block"] * at.in_chain],
        },
        [*fetch_parameters(model), *at.places(), *before, *inside],
    )


def rhs_procedure(model: Model) -> Procedure:
    """The equations themselves."""
    at = Address(model)
    lines = [
        f"{at.state('dydt', state=state)} = {text_of(model.equations[state])}"
        for state in model.states
    ]
    return of_all_blocks(model, "dydt", lines, [])


def jacobian_procedure(model: Model) -> Procedure:
    """Derivatives of the equations by states and delayed states.

    In a chain the first are banded, and the others are those of the equations of the same block.
    """
    at = Address(model)
    entries: dict[tuple, sympy.Expr] = {}
    variables = [*(one.symbol for one in model.delayed), *model.differences.values()]
    for row, equation in enumerate(map(model.plain, model.equations.values()), 1):
        for state in model.states:
            entries[row, state] = model.by_state(equation, state)
        for symbol in variables:
            entries[row, symbol] = equation.diff(symbol)
    entries = {place: value for place, value in entries.items() if value != 0}
    shared, reduced = sympy.cse(
        list(entries.values()), symbols=sympy.numbered_symbols("part_", real=True, start=1)
    )
    texts = dict(zip(entries, map(text_of, reduced), strict=True))
    lines = [f"{name} = {text_of(value)}" for name, value in shared]
    lines += [
        f"{at.slope(row, of)} = {text}" for (row, of), text in texts.items() if of in model.states
    ]
    for (row, of), text in texts.items():
        for state, symbol in model.differences.items():
            if of == symbol:
                lines += neighbour_entries(at, row, state, text)
        for number, one in enumerate(model.delayed, 1):
            if of == one.symbol:
                # without its delay a delayed state is the present one
                entry = at.slope(row, one.state)
                lines += [
                    f"if (place_{number} > 0) then",
                    f"   {at.delayed('by_z', str(row), number=number)} = {text}",
                    "else",
                    f"   {entry} = {entry} + {braced(text)}",
                    "end if",
                ]
    names = [str(name) for name, _ in shared]
    return of_all_blocks(model, "by_y", lines, [*names, *["by_difference"] * at.in_chain])


def neighbour_entries(at: Address, row: int, state: str, text: str) -> list[str]:
    """Statements that add derivatives by the states of which a second difference is made."""
    lines = [f"by_difference = {text}"]
    for block, weight in (
        ("block", "-(2.0_wp + self%mode)*by_difference"),
        ("left(block)", "by_difference"),
        ("right(block)", "by_difference"),
    ):
        entry = at.slope(row, state, block)
        line = f"{entry} = {entry} + {braced(weight)}"
        lines.append(line if block == "block" else f"if ({block} > 0) {line}")
    return lines


def braced(text: str) -> str:
    """A summand."""
    return f"({text})" if text.startswith("-") else text


def switching_procedure(model: Model) -> Procedure:
    """What is 0 where the equations switch, each no number where it has no value."""
    names, lines = guard_names(model), []
    for number, one in enumerate(model.switches, 1):
        place = f"values({number})"
        refused = refusals(model, {place: one.value}, names, place)
        leave = [line.replace("return", f"exit switch_{number}") for line in refused]
        inside = [*leave, f"{place} = {text_of(one.value)}"]
        if leave:
            inside = [f"switch_{number}: block", *indented(inside), f"end block switch_{number}"]
        lines += inside
    return of_all_blocks(model, "values", lines, [], guarded={})


def act_procedure(model: Model) -> Procedure:
    """The state after an event, all from the values before; no number where one has no value."""
    at, lines = Address(model), []
    for number, one in enumerate(model.events, 1):
        way = {1: " .and. rises == 1", -1: " .and. rises == 0", 0: ""}[one.direction]
        inside = [
            "acts = 1",
            *refusals(model, one.changes, guard_names(model), "y"),
            *(f"{at.state('y', state=s)} = {text_of(value)}" for s, value in one.changes.items()),
        ]
        lines += [f"if (number == {number}{way}) then", *indented(inside), "end if"]
    return of_all_blocks(model, "y", ["acts = 0", *lines], [], guarded={})


def moving_procedure(model: Model) -> Procedure:
    """The delays that move, each no number where one has no value."""
    own = {place: one.lag for place, one in enumerate(model.moving, 1)}
    lines = [f"{state} = y({place})" for place, state in enumerate(model.states, 1)]
    lines += refusals(model, own, guard_names(model), f"lag(:{len(own)})")
    lines += [f"{name} = exp({state})" for name, state in model.auxiliary.items()]
    lines += [f"lag({place}) = {text_of(lag)}" for place, lag in own.items()]
    return with_parameters(model, lines, *model.states, *model.auxiliary)


def relaxation_procedure(model: Model, balance: Balance) -> Procedure:
    """The least rate at which the fast state of a block approaches its balance, rate/v."""
    place, size = list(model.states).index(balance.state) + 1, len(model.states)
    least = text_of(sympy.Rational(str(model.domain.get(balance.state, (-300, 0))[0])))
    value = f"maxval(y({place}::{size}))" if Address(model).in_chain else f"y({place})"
    return with_parameters(model, [f"rate = {text_of(balance.rate)}*exp(-max({least}, {value}))"])
