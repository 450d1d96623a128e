# SPDX-License-Identifier: BSD-3-Clause
"""Procedures at the steady state: itself, derivative forms there, and the characteristic function.

A steady state is an expression of the parameters, or numbers: Newton's method finds these from
where the definition says. Procedures get the numbers in both cases, and have the expressions in
their place where there are any.
"""

import sympy

from .flow import Procedure, refusals, with_parameters
from .fortran import indented, text_of
from .model import MODE, Model


def at(model: Model, array: str = "state") -> dict[sympy.Expr, str]:
    """Elements of an array by the symbols of the states."""
    return {model.symbol(state): f"{array}({i})" for i, state in enumerate(model.states, 1)}


def steady_state_procedure(model: Model) -> Procedure:
    """The state at rest, or where Newton's method starts."""
    values = list((model.near or model.steady_state).values())
    lines = [f"state({place}) = {text_of(value)}" for place, value in enumerate(values, 1)]
    if model.near:
        given = f"parameters(:{len(model.parameters)}), state(:{len(values)})"
        lines.append(f"call approach(equations_at_rest, {given})")
    return with_parameters(model, lines)


def rest_procedure(model: Model) -> Procedure:
    """The equations with all states alike, now and before, and their derivatives."""
    at_rest = {state: model.at_steady_state(one) for state, one in model.equations.items()}
    equations = list(at_rest.values())
    names = at(model)
    guarded = names | {
        model.symbol(v): f"exp({names[model.symbol(w)]})" for v, w in model.auxiliary.items()
    }
    lags = {one.symbol.name: model.at_steady_state(one.lag) for one in model.moving}
    lines = refusals(model, at_rest | lags, guarded, "rates")
    lines += [f"rates({row}) = {text_of(one, names)}" for row, one in enumerate(equations, 1)]
    for array, symbols in (
        ("by_state", list(names)),
        ("by_parameter", [model.symbol(one.name) for one in model.parameters]),
    ):
        lines += [f"if (present({array})) then", f"   {array} = 0.0_wp"]
        for row, one in enumerate(equations, 1):
            for column, symbol in enumerate(symbols, 1):
                if (slope := one.diff(symbol)) != 0:
                    lines.append(f"   {array}({row}, {column}) = {text_of(slope, names)}")
        lines.append("end if")
    return with_parameters(model, lines)


def derivative_procedure(model: Model) -> Procedure:
    """The k-linear forms of the equations at the steady state, by nilpotent numbers."""
    equations = list(map(model.plain, model.equations.values()))
    symbols = set().union(*(one.free_symbols for one in equations))
    values = {name: text_of(value, at(model)) for name, value in model.steady_state.items()}
    places = {state: place for place, state in enumerate(model.states, 1)}
    made = [(state, state, 1) for state in model.states]
    made += [(one.symbol.name, one.state, i) for i, one in enumerate(model.delayed, 2)]
    lines = [
        f"{name} = disturbed({values[state]}, arguments({places[state]}, {column}, :))"
        for name, state, column in made
    ]
    auxiliary = [name for name in model.auxiliary if model.symbol(name) in symbols]
    lines += [f"{name} = exp({model.auxiliary[name]})" for name in auxiliary]
    for place, equation in enumerate(equations, 1):
        constant = not equation.free_symbols & model.variables
        lines.append(f"form({place}) = " + ("0.0_wp" if constant else f"top({text_of(equation)})"))
    procedure = with_parameters(model, lines)
    procedure.names["type(nilpotent_type)"] = [*(name for name, _, _ in made), *auxiliary]
    return procedure


def shortest(expression: sympy.Expr) -> sympy.Expr:
    """The sum or the product of an expression, whatever takes fewer operations."""
    return min(sympy.expand(expression), sympy.factor(expression), key=sympy.count_ops)


def linear_part(model: Model) -> dict[tuple[int, int, int], sympy.Expr]:
    """Derivatives at the steady state, by equation, state and number of the delayed state or 0."""
    found = {}
    for row, equation in enumerate(model.equations.values()):
        for column, state in enumerate(model.states):
            present = model.by_state(equation, state)
            for of, symbol in model.differences.items():
                if of == state:
                    present -= equation.diff(symbol) * MODE
            found[row, column, 0] = present
            for number, one in enumerate(model.delayed, 1):
                if one.state == state:
                    found[row, column, number] = equation.diff(one.symbol)
    found = {place: model.at_steady_state(value) for place, value in found.items()}
    return {place: value for place, value in found.items() if value != 0}


def computed(model: Model) -> dict[tuple | sympy.Expr, sympy.Expr]:
    """What is a function of a steady state that is computed: derivatives there, by their places,
    and delays, by themselves."""
    if not model.near:
        return {}
    return linear_part(model) | {one.lag: one.lag for one in model.moving}


def numbered(entries: dict[tuple | sympy.Expr, sympy.Expr]) -> dict:
    """Elements of an array in their place."""
    return {place: sympy.Symbol(f"entry({i})") for i, place in enumerate(entries, 1)}


def characteristic_terms(model: Model) -> list[tuple[sympy.Expr, int, sympy.Expr]]:
    """The terms c s^m exp(-s d) of det(s I - A_0 - sum of A_k exp(-s lag_k)): c, m and d.

    Of a chain they are those of a mode, in which a second difference is -mode times the state. Of
    a steady state that is computed c is a polynomial of the elements of the matrices, and d may
    be a sum of delays there.
    """
    s = sympy.Symbol("s_")
    decays = [sympy.Symbol(f"decay_{i}") for i, _ in enumerate(model.delayed, 1)]
    shorten = sympy.expand if model.near else shortest
    names = numbered(computed(model))
    linear = {place: names.get(place, value) for place, value in linear_part(model).items()}
    if not model.near:
        linear = {place: sympy.simplify(value) for place, value in linear.items()}
    matrix = s * sympy.eye(len(model.states))
    for (row, column, number), value in linear.items():
        matrix[row, column] -= value * decays[number - 1] if number else value
    polynomial = sympy.Poly(matrix.det(method="berkowitz"), s, *decays)
    terms: dict[tuple, sympy.Expr] = {}
    for (power, *times), coefficient in polynomial.terms():
        # several delayed states may have one delay, and sums of delays may be alike
        lags = (names.get(one.lag, one.lag) for one in model.delayed)
        delay = sympy.Add(*(n * lag for n, lag in zip(times, lags, strict=True)))
        terms[power, delay] = terms.get((power, delay), 0) + coefficient
    shortened = {place: shorten(coefficient) for place, coefficient in terms.items()}
    return [(value, *place) for place, value in shortened.items() if value != 0]


def characteristic_procedure(model: Model) -> Procedure:
    """Coefficients, powers and delays of the terms, and their derivatives where these are not 0."""
    terms, entries, count = characteristic_terms(model), computed(model), len(model.parameters)
    lines = entry_lines(model, entries)
    parts = [sympy.S.Zero]
    for i, (coefficient, power, delay) in enumerate(terms, 1):
        if delay not in parts:
            parts.append(delay)
        lines += [
            f"coefficient({i}) = {text_of(coefficient)}",
            f"power({i}) = {power}",
            f"delay({i}) = {text_of(delay)}",
            f"part({i}) = {parts.index(delay) + 1}",
        ]
        for array, value in (("coefficient_by", coefficient), ("delay_by", delay)):
            for j, one in enumerate(model.parameters, 1):
                slope = shortest(value.diff(model.symbol(one.name)))
                if slope != 0:
                    lines.append(f"{array}({i}, {j}) = {text_of(slope)}")
            moves = [
                f" + ({text_of(slope)})*entry_by({j}, :)"
                for j, entry in enumerate(numbered(entries).values(), 1)
                if (slope := value.diff(entry)) != 0
            ]
            if moves:
                row = f"{array}({i}, :{count})"
                lines.append(f"{row} = {row}{''.join(moves)}")
    size = len(model.states)
    arrays = [f"rates({size})", f"by_state({size}, {size})", f"moves({size}, {count})"]
    arrays += [f"entry({len(entries)})", f"entry_by({len(entries)}, {count})"]
    return with_parameters(model, lines, *(arrays if entries else []))


def entry_lines(model: Model, entries: dict[tuple | sympy.Expr, sympy.Expr]) -> list[str]:
    """Statements that set functions of the steady state, and their derivatives by the parameters.

    The steady state moves with the parameters: with f = 0 there df/dy dy/dp = -df/dp.
    """
    if not entries:
        return []
    states, size = at(model), len(model.states)
    given = f"parameters(:{len(model.parameters)}), state(:{size})"
    lines = [
        f"call equations_at_rest({given}, rates, by_state, moves)",
        "call solve(by_state, moves)",
        "entry_by = 0.0_wp",
    ]
    for i, value in enumerate(entries.values(), 1):
        lines.append(f"entry({i}) = {text_of(value, states)}")
        for j, one in enumerate(model.parameters, 1):
            if (slope := value.diff(model.symbol(one.name))) != 0:
                lines.append(f"entry_by({i}, {j}) = {text_of(slope, states)}")
        for j, symbol in enumerate(states, 1):
            if (slope := value.diff(symbol)) != 0:
                text = text_of(slope, states)
                lines.append(f"entry_by({i}, :) = entry_by({i}, :) - ({text})*moves({j}, :)")
    nowhere = [f"{array} = ieee_value(1.0_wp, ieee_quiet_nan)" for array in ("entry", "entry_by")]
    there = f"if (.not. any(ieee_is_nan(state(:{size})))) then"
    return [*nowhere, there, *indented(lines), "end if"]
