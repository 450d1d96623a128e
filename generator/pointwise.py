"""Procedures that need one state: the right-hand side and its derivatives."""

import sympy

from generator.definition import Model
from generator.fortran import text_of
from generator.recurrences import fetch_parameters
from generator.series import Procedure, guarded, refusals, uses_parameters
from generator.slow import Balance


def fetch_states(
    model: Model, expressions: list[sympy.Expr]
) -> tuple[list[str], list[str], list[str]]:
    """Statements that set states, delayed states and auxiliaries; and the names that they set.

    The auxiliaries are by themselves: they may have no value.
    """
    symbols = set().union(*(one.free_symbols for one in expressions)) if expressions else set()
    states, names = [], []
    wanted = {one.state for one in model.delayed if one.symbol in symbols}
    wanted |= {state for name, state in model.auxiliary.items() if model.symbol(name) in symbols}
    wanted |= set(model.domain)
    for place, state in enumerate(model.states, 1):
        if model.symbol(state) in symbols or state in wanted:
            states.append(f"{state} = y({place})")
            names.append(state)
    for number, one in enumerate(model.delayed, 1):
        if one.symbol in symbols:
            name = one.symbol.name
            states += [
                f"{name} = {one.state}",
                f"if (place({number}) > 0) {name} = z(place({number}))",
            ]
            names.append(name)
    auxiliary = [
        f"{name} = exp({state})"
        for name, state in model.auxiliary.items()
        if model.symbol(name) in symbols
    ]
    names += [name for name in model.auxiliary if model.symbol(name) in symbols]
    return states, auxiliary, names


def guard_lines(model: Model, result: str) -> list[str]:
    """Statements that end a procedure where the equations have no value."""
    names = {model.symbol(name): f"exp({state})" for name, state in model.auxiliary.items()}
    names |= {model.symbol(state): state for state in model.states}
    names |= {one.symbol: one.symbol.name for one in model.delayed}
    return refusals(model, list(model.equations.values()), names, result)


def rhs_procedure(model: Model) -> Procedure:
    """The equations themselves."""
    equations = list(model.equations.values())
    states, auxiliary, names = fetch_states(model, [*equations, *guarded(model)])
    parameters = uses_parameters(model, equations)
    lines = [
        *fetch_parameters(model, parameters),
        *states,
        *guard_lines(model, "dydt"),
        *auxiliary,
        *(f"dydt({place}) = {text_of(one)}" for place, one in enumerate(equations, 1)),
    ]
    return Procedure([*parameters, *names], [], [], lines)


def jacobian_entries(model: Model):
    """Derivatives that are not 0, by equation and by what; parts that they share, and their texts.

    They are by the name of a state, or by the symbol of a delayed state or a second difference.
    """
    entries: dict[tuple, sympy.Expr] = {}
    for row, equation in enumerate(map(model.plain, model.equations.values()), 1):
        for state in model.states:
            entries[row, state] = model.by_state(equation, state)
        for symbol in [*(one.symbol for one in model.delayed), *model.differences.values()]:
            entries[row, symbol] = equation.diff(symbol)
    entries = {place: value for place, value in entries.items() if value != 0}
    shared, reduced = sympy.cse(
        list(entries.values()), symbols=sympy.numbered_symbols("part_", real=True, start=1)
    )
    return entries, shared, dict(zip(entries, map(text_of, reduced), strict=True))


def jacobian_procedure(model: Model) -> Procedure:
    """Derivatives of the equations by states and delayed states."""
    entries, shared, texts = jacobian_entries(model)
    values = [*entries.values(), *guarded(model)]
    states, auxiliary, names = fetch_states(model, values)
    parameters = uses_parameters(model, values)
    columns = {state: column for column, state in enumerate(model.states, 1)}
    lines = [
        *fetch_parameters(model, parameters),
        *states,
        *guard_lines(model, "by_y"),
        *auxiliary,
        *(f"{name} = {text_of(value)}" for name, value in shared),
        "by_y = 0.0_wp",
        *(
            f"by_y({row}, {columns[of]}) = {text}"
            for (row, of), text in texts.items()
            if of in columns
        ),
    ]
    # without its delay a delayed state is the present one
    for number, one in enumerate(model.delayed, 1):
        rows = {row: text for (row, of), text in texts.items() if of == one.symbol}
        place = f"place({number})"
        lines += [f"if ({place} > 0) then", f"   by_z(:, {place}) = 0.0_wp"]
        lines += [f"   by_z({row}, {place}) = {text}" for row, text in rows.items()]
        lines += ["else"]
        for row, text in rows.items():
            entry = f"by_y({row}, {columns[one.state]})"
            lines.append(f"   {entry} = {entry} + {braced(text)}")
        lines += ["end if"]
    lines = without_value(lines)
    return Procedure([*parameters, *names, *(str(name) for name, _ in shared)], [], [], lines)


def without_value(lines: list[str]) -> list[str]:
    """Statements that also leave no number in the derivatives by delayed states."""
    return [
        part
        for line in lines
        for part in (["   by_z = by_y(1, 1)", line] if line == "   return" else [line])
    ]


def braced(text: str) -> str:
    """A summand."""
    return f"({text})" if text.startswith("-") else text


def relaxation_procedure(model: Model, balance: Balance) -> Procedure:
    """The rate at which the fast state approaches its balance, (rate of the definition)/v."""
    parameters = uses_parameters(model, [balance.rate])
    place = list(model.states).index(balance.state) + 1
    least = text_of(sympy.Rational(str(model.domain.get(balance.state, (-300, 0))[0])))
    lines = [
        *fetch_parameters(model, parameters),
        f"rate = {text_of(balance.rate)}*exp(-max({least}, y({place})))",
    ]
    return Procedure(parameters, [], [], lines)
