# SPDX-License-Identifier: BSD-3-Clause
"""What the procedures of a model share: rates as a graph, where they have no value, exponentials.

For each state w of which exp(w) is taken, v = exp(w) may be integrated beside w, by v' = v w'.
This pays where v' needs fewer convolutions than the recurrence of the exponential: in the block
v' is linear, and w' = v'/v takes one.
"""

import re
from collections import defaultdict
from collections.abc import Callable
from dataclasses import dataclass

import sympy

from .address import Address
from .fortran import indented, text_of, within
from .graph import Graph, Node, convolutions
from .model import TIME, Model
from .recurrences import Constants, fetch_parameters

LARGEST_EXPONENT = 700
"""The argument of exp is refused beyond this, unless `domain` says otherwise or the exponential
stands in a bounded quotient (saturation.py): exp(709.8) is the largest number."""
REFUSED = {
    sympy.log: ".not. {} > 0.0_wp",
    sympy.exp: f"{{}} > {LARGEST_EXPONENT}.0_wp",
    **dict.fromkeys((sympy.sinh, sympy.cosh), f"abs({{}}) > {LARGEST_EXPONENT}.0_wp"),
    **dict.fromkeys((sympy.asin, sympy.acos, sympy.atanh), ".not. abs({}) < 1.0_wp"),
    sympy.acosh: ".not. {} > 1.0_wp",
    sympy.atan2: ".not. max(abs({}), abs({})) > 0.0_wp",
}
"""Arguments for which functions have no value or no derivative, or overflow, as conditions."""


@dataclass
class Procedure:
    """Names by what stands before :: in their declarations, and statements."""

    names: dict[str, list[str]]
    lines: list[str]


def with_parameters(model: Model, lines: list[str], *reals: str) -> Procedure:
    """A procedure whose statements take the parameters, and set real numbers of these names."""
    own = [one.name for one in model.parameters]
    names = {"real(wp)": [*own, *reals]}
    # those behind them are not given here
    return Procedure(names, [*fetch_parameters(model)[: len(own)], *lines])


def input_names(model: Model) -> dict[sympy.Symbol, str]:
    """States, delayed states, second differences and time by their names in statements."""
    names = {model.symbol(state): state for state in model.states}
    names |= {one.symbol: one.symbol.name for one in model.delayed}
    names |= {symbol: symbol.name for symbol in model.differences.values()}
    return names | {TIME: "time"}


def guard_names(model: Model, end: str = "") -> dict[sympy.Symbol, str]:
    """Names in conditions, with an end; auxiliaries have no value yet."""
    names = {symbol: f"{name}{end}" for symbol, name in input_names(model).items()}
    names |= {} if end else {TIME: "t"}
    return names | {
        model.symbol(name): f"exp({state}{end})" for name, state in model.auxiliary.items()
    }


def rate_of_auxiliary(model: Model, auxiliary: str) -> sympy.Expr:
    """v' = v w' of v = exp(w), term by term, so that powers of v cancel."""
    rate = model.equations[model.auxiliary[auxiliary]]
    terms = rate.args if rate.is_Add else (rate,)
    return sympy.Add(*(model.symbol(auxiliary) * term for term in terms))


@dataclass
class Flow:
    """Rates of states as nodes, and of auxiliaries that are integrated beside them."""

    graph: Graph
    rates: dict[str, Node]
    integrated: dict[str, str]
    """Integrated auxiliaries and their states."""


def flow_of(model: Model) -> Flow:
    """The cheapest way to the rates."""
    integrated: dict[str, str] = {}
    best = flow_with(model, integrated)
    for auxiliary, state in model.auxiliary.items():
        other = flow_with(model, {**integrated, auxiliary: state})
        if convolutions(list(other.rates.values())) < convolutions(list(best.rates.values())):
            integrated, best = {**integrated, auxiliary: state}, other
    return best


def flow_with(model: Model, integrated: dict[str, str]) -> Flow:
    """Rates where these auxiliaries are integrated."""
    names = input_names(model) | {model.symbol(name): name for name in integrated}
    graph = Graph(model, names)
    rates = {}
    for auxiliary, state in integrated.items():
        rate, symbol = rate_of_auxiliary(model, auxiliary), model.symbol(auxiliary)
        rates[auxiliary] = graph.node(rate)
        graph.known[model.equations[state]] = graph.add(
            "quotient", rates[auxiliary], graph.known[symbol]
        )
    rates |= {state: graph.node(equation) for state, equation in model.equations.items()}
    return Flow(graph, {state: rates[state] for state in [*model.states, *integrated]}, integrated)


def conditions_of(model: Model, equations: dict, names: dict) -> list[dict[str, set[str]]]:
    """Conditions under which equations have no value, with their states; one dict for each depth of
    nesting."""
    levels: defaultdict[int, dict[str, set[str]]] = defaultdict(dict)

    def visit(one: sympy.Expr, state: str) -> int:
        depth = max([visit(argument, state) for argument in one.args], default=0)
        text = None
        if one.func in REFUSED and not one.has(within):
            text = REFUSED[one.func].format(*(text_of(argument, names) for argument in one.args))
            for delayed in model.delayed:
                known = one.func is sympy.exp and delayed.symbol == one.args[0]
                if known and delayed.state in model.domain:
                    text = window_condition(names[delayed.symbol], model.domain[delayed.state])
        elif one.is_Pow and not one.exp.is_Integer and one.base is not sympy.E:
            text = REFUSED[sympy.log].format(text_of(one.base, names))
        elif one.is_Pow and one.exp.is_Integer and one.exp < 0 and not one.base.is_Symbol:
            text = f".not. abs({text_of(one.base, names)}) > 0.0_wp"
        if text is None or not one.free_symbols & model.variables:
            return depth
        levels[depth].setdefault(text, set()).add(state)
        return depth + 1

    for state, equation in equations.items():
        visit(model.plain(equation), state)
    for state, window in model.domain.items():
        levels[-1][window_condition(names[model.symbol(state)], window)] = {state}
    return [levels[depth] for depth in sorted(levels)]


def window_condition(name: str, window: tuple[float, float]) -> str:
    """Whether a value is outside a window, or no number."""
    least, largest = (text_of(sympy.Rational(str(bound))) for bound in window)
    return f".not. ({name} >= {least} .and. {name} <= {largest})"


def refusals(
    model: Model,
    equations: dict[str, sympy.Expr],
    names: dict,
    *results: str,
    of: Callable[[str], str] | None = None,
    in_lanes: bool = False,
) -> list[str]:
    """Statements that end a procedure with no number where an equation has no value.

    With `of` only the elements of these equations are no numbers, else all of the results.
    """
    lines = []
    lanes = {name for symbol, name in names.items() if in_lanes and symbol != TIME}
    for level in conditions_of(model, equations, names):
        conditions = [
            f"any({one})" if lanes & set(re.findall(r"\w+", one)) else one for one in level
        ]
        marked = [f"   {result} = ieee_value(1.0_wp, ieee_quiet_nan)" for result in results]
        if of:
            marked = [f"   {result} = 0.0_wp" for result in results] + [
                f"   if ({condition}) {of(state)} = ieee_value(1.0_wp, ieee_quiet_nan)"
                for condition, states in level.items()
                for state in sorted(states)
            ]
        lines += [f"if ({' .or. '.join(conditions)}) then", *marked, "   return", "end if"]
    return lines


def integral_of(model: Model, auxiliary: str) -> tuple[str, sympy.Expr] | None:
    """A state x with x' = c v + constant, and c: its series holds that of v."""
    v = model.symbol(auxiliary)
    for state, equation in model.equations.items():
        equation = model.plain(equation)
        by_v = equation.diff(v)
        if (
            by_v != 0
            and not by_v.free_symbols & model.sides
            and not (by_v.free_symbols | (equation - by_v * v).free_symbols) & model.variables
        ):
            return state, by_v
    return None


def exponential_lines(
    at: Address, auxiliary: str, states: str, series: Callable[[str], str], constants: Constants
) -> list[str]:
    """Statements that compute the series of v = exp(w) from those of the states, in an array.

    Where x' = c v + constant they are those of x, but for the last, by v' = v w'. `series` has the
    text of a coefficient of v by the order.
    """
    model = at.model
    w = model.auxiliary[auxiliary]

    def state(order: str, name: str = w) -> str:
        return at.state(states, order, state=name)

    window = model.domain.get(w, (0, LARGEST_EXPONENT))
    largest = text_of(sympy.Rational(str(window[1])))
    found = integral_of(model, auxiliary)
    lines = [f"{series('0')} = exp(min({state('0')}, {largest}))"]
    sums = [
        f"{series('i')} = 0.0_wp",
        "do j = 1, i",
        f"   {series('i')} = {series('i')} + j*{state('j')}*{series('i - j')}",
        "end do",
        f"{series('i')} = reciprocal(i)*{series('i')}",
    ]
    if found is None:
        return [*lines, "do i = 1, degree", *indented(sums), "end do"]
    integral, factor = found
    scale = "1.0_wp/unit" if factor == 1 else f"1.0_wp/({weighted_unit(factor, constants)})"
    return [
        *lines,
        f"by_unit = {scale}",
        "do i = 1, degree - 1",
        f"   {series('i')} = (by_unit*(i + 1))*{state('i + 1', integral)}",
        "end do",
        "do i = max(1, degree), degree",
        *indented(sums),
        "end do",
    ]


def weighted_unit(factor: sympy.Expr, constants: Constants) -> str:
    """A unit of time times a factor."""
    sign = "-" if factor.could_extract_minus_sign() else ""
    return f"{sign}{constants.text(-factor if sign else factor)}*unit"
