"""Procedures that compute Taylor series of solutions, and what all procedures share.

For each state w of which exp(w) is taken, v = exp(w) may be integrated beside w, by v' = v w'.
This pays where v' needs fewer convolutions than the recurrence of the exponential: in the block
v' is linear, and w' = v'/v takes one.
"""

from dataclasses import dataclass

import sympy

from generator.definition import LARGEST_EXPONENT, TIME, Model
from generator.fortran import indented, text_of
from generator.graph import Graph, Node, convolutions, in_order
from generator.recurrences import Constants, Recurrences, fetch_parameters

REFUSED = {
    sympy.log: ".not. {} > 0.0_wp",
    **dict.fromkeys((sympy.sinh, sympy.cosh), f"abs({{}}) > {LARGEST_EXPONENT}.0_wp"),
    **dict.fromkeys((sympy.asin, sympy.acos, sympy.atanh), ".not. abs({}) < 1.0_wp"),
    sympy.acosh: ".not. {} > 1.0_wp",
}
"""Arguments for which functions have no value or no derivative, or overflow, as conditions."""


@dataclass
class Procedure:
    """The parts of a procedure: variables by their type, and statements."""

    reals: list[str]
    arrays: list[str]
    integers: list[str]
    lines: list[str]
    lanes: list[str] | tuple = ()
    lane_arrays: list[str] | tuple = ()
    others: dict[str, list[str]] | None = None
    """Names by what stands before :: in their declarations."""


def input_names(model: Model) -> dict[sympy.Symbol, str]:
    """States, delayed states and time by their names in statements."""
    names = {model.symbol(state): state for state in model.states}
    names |= {one.symbol: one.symbol.name for one in model.delayed}
    names |= {symbol: symbol.name for symbol in model.differences.values()}
    return names | {TIME: "time"}


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


def conditions_of(model: Model, expressions: list[sympy.Expr], names: dict) -> list[list[str]]:
    """Conditions under which the expressions have no value: a list for each depth of nesting."""
    found: dict[sympy.Expr, tuple[int, str]] = {}

    def visit(one: sympy.Expr) -> int:
        depth = max([visit(argument) for argument in one.args], default=0)
        text = None
        if one.func is sympy.exp:
            text = REFUSED[sympy.sinh].format(text_of(one.args[0], names))
            for delayed in model.delayed:
                if delayed.symbol == one.args[0] and delayed.state in model.domain:
                    text = window_condition(names[delayed.symbol], model.domain[delayed.state])
        elif one.func in REFUSED:
            text = REFUSED[one.func].format(text_of(one.args[0], names))
        elif one.is_Pow and not one.exp.is_Integer and one.base is not sympy.E:
            text = REFUSED[sympy.log].format(text_of(one.base, names))
        elif one.is_Pow and one.exp.is_Integer and one.exp < 0 and not one.base.is_Symbol:
            text = f".not. abs({text_of(one.base, names)}) > 0.0_wp"
        if text is None or not one.free_symbols & model.variables:
            return depth
        found.setdefault(one, (depth, text))
        return depth + 1

    for expression in map(model.plain, expressions):
        visit(expression)
    levels: list[list[str]] = []
    for depth, text in found.values():
        while len(levels) <= depth:
            levels.append([])
        if text not in levels[depth]:
            levels[depth].append(text)
    outer = [
        window_condition(names[model.symbol(state)], window)
        for state, window in model.domain.items()
    ]
    return [level for level in [outer, *levels] if level]


def window_condition(name: str, window: tuple[float, float]) -> str:
    """Whether a value is outside a window, or no number."""
    least, largest = (text_of(sympy.Rational(str(bound))) for bound in window)
    return f".not. ({name} >= {least} .and. {name} <= {largest})"


def refusals(model: Model, expressions: list[sympy.Expr], names: dict, result: str) -> list[str]:
    """Statements that end a procedure with no number where an expression has no value."""
    lines = []
    for level in conditions_of(model, expressions, names):
        lines += [
            f"if ({' .or. '.join(level)}) then",
            f"   {result} = ieee_value(1.0_wp, ieee_quiet_nan)",
            "   return",
            "end if",
        ]
    return lines


def fetch_inputs(model: Model, nodes: list[Node], order: str) -> tuple[list[str], list[str]]:
    """Statements that set delayed states and time at order 0 or k, and the names that they set."""
    suffix = "_0" if order == "0" else ""
    used = {node.name for node in nodes if node.kind == "input"}
    lines, names = [], []
    for number, one in enumerate(model.delayed, 1):
        if one.symbol.name in used:
            name = one.symbol.name + suffix
            names.append(name)
            lines += [
                f"{name} = {one.state}{suffix}",
                f"if (place_{number} > 0) {name} = z({order}, place_{number})",
            ]
    if "time" in used:
        names.append("time" + suffix)
        lines.append("time_0 = t" if order == "0" else "time = merge(unit, 0.0_wp, k == 1)")
    return lines, names


def fetch_places(model: Model) -> list[str]:
    """Statements that set where the delayed states are."""
    return [f"place_{number} = place({number})" for number, _ in enumerate(model.delayed, 1)]


def place_names(model: Model) -> list[str]:
    """Names that these statements set."""
    return [f"place_{number}" for number, _ in enumerate(model.delayed, 1)]


def uses_parameters(model: Model, expressions: list[sympy.Expr]) -> list[str]:
    """Names of the parameters in expressions."""
    symbols = set().union(*(one.free_symbols for one in expressions)) if expressions else set()
    return [one.name for one in model.parameters if model.symbol(one.name) in symbols]


def series_procedure(model: Model) -> Procedure:
    """Coefficients 1 to degree of the states from their values."""
    flow = flow_of(model)
    roots = list(flow.rates.values())
    nodes = in_order(roots)
    constants = Constants(model)
    recurrences = Recurrences(nodes, roots, constants)
    names = {model.symbol(state): f"{state}_0" for state in model.states}
    names |= {one.symbol: f"{one.symbol.name}_0" for one in model.delayed}
    names |= {model.symbol(name): f"exp({state}_0)" for name, state in model.auxiliary.items()}
    names[TIME] = "time_0"
    states = list(model.states)
    known, known_names = fetch_inputs(model, nodes, "0")
    newest, newest_names = fetch_inputs(model, nodes, "k")
    guards = refusals(model, list(model.equations.values()), names, "y(1:, :)")
    first = [line for node in nodes for line in recurrences.first.get(node, [])]
    later = [line for node in nodes for line in recurrences.later.get(node, [])]
    steps_first = [
        f"{name} = unit*({recurrences.rate_text(node, first=True)})"
        for name, node in flow.rates.items()
    ]
    rates = [f"{name}_rate = {recurrences.rate_text(node)}" for name, node in flow.rates.items()]
    body = [
        *recurrences.loop(),
        *newest,
        *later,
        *recurrences.stores(),
        *rates,
        "step = unit*reciprocal(k + 1)",
        *(f"{name} = step*{name}_rate" for name in flow.rates),
        *(f"y(k + 1, {place}) = {state}" for place, state in enumerate(states, 1)),
    ]
    guard_parameters = uses_parameters(model, guarded(model))
    lines = [
        *fetch_places(model),
        *(f"{state}_0 = y(0, {place})" for place, state in enumerate(states, 1)),
        *known,
        *fetch_parameters(
            model, [name for name in guard_parameters if name not in constants.parameters()]
        ),
        *constants.fetched(),
        *guards,
        "if (degree == 0) return",
        *(f"{name}_0 = exp({state}_0)" for name, state in flow.integrated.items()),
        *first,
        *steps_first,
        *(f"y(1, {place}) = {state}" for place, state in enumerate(states, 1)),
        "do k = 1, degree - 1",
        *indented(body),
        "end do",
    ]
    reals = [
        *constants.scalars(),
        *(name for name in guard_parameters if name not in constants.parameters()),
        *(f"{name}{end}" for name in flow.rates for end in ("", "_0", "_rate")),
        *known_names,
        *newest_names,
        *recurrences.scalars,
        "step",
    ]
    integers = [*place_names(model), *["j"] * bool(recurrences.sums), "k"]
    return Procedure(reals, recurrences.arrays(), integers, lines)


def guarded(model: Model) -> list[sympy.Expr]:
    """Arguments of functions that have no value everywhere."""
    kinds = (sympy.exp, sympy.Pow, *REFUSED)
    return [
        part.args[0]
        for equation in map(model.plain, model.equations.values())
        for part in sympy.preorder_traversal(equation)
        if isinstance(part, kinds) and part.free_symbols & model.variables
    ]


def integral_of(model: Model, auxiliary: str) -> tuple[int, sympy.Expr] | None:
    """The place of a state x with x' = c v + constant, and c: its series holds that of v."""
    v = model.symbol(auxiliary)
    for place, equation in enumerate(map(model.plain, model.equations.values()), 1):
        by_v = equation.diff(v)
        if (
            by_v != 0
            and not (by_v.free_symbols | (equation - by_v * v).free_symbols) & model.variables
        ):
            return place, by_v
    return None


def exponential_lines(
    model: Model, auxiliary: str, y: str, series: str, constants: Constants
) -> list[str]:
    """Statements that compute the series of v = exp(w) from those of the states.

    Where x' = c v + constant they are those of x, but for the last, by v' = v w'.
    """
    w = list(model.states).index(model.auxiliary[auxiliary]) + 1
    window = model.domain.get(model.auxiliary[auxiliary], (0, LARGEST_EXPONENT))
    largest = text_of(sympy.Rational(str(window[1])))
    found = integral_of(model, auxiliary)
    lines = [f"{series}(0) = exp(min({y}(0, {w}), {largest}))"]
    sums = [
        f"{series}(k) = 0.0_wp",
        "do j = 1, k",
        f"   {series}(k) = {series}(k) + j*{y}(j, {w})*{series}(k - j)",
        "end do",
        f"{series}(k) = reciprocal(k)*{series}(k)",
    ]
    if found is None:
        return [*lines, "do k = 1, degree", *indented(sums), "end do"]
    place, factor = found
    scale = "1.0_wp/unit" if factor == 1 else f"1.0_wp/({weighted_unit(factor, constants)})"
    return [
        *lines,
        f"by_unit = {scale}",
        "do k = 1, degree - 1",
        f"   {series}(k) = (by_unit*(k + 1))*{y}(k + 1, {place})",
        "end do",
        "do k = max(1, degree), degree",
        *indented(sums),
        "end do",
    ]


def weighted_unit(factor: sympy.Expr, constants: Constants) -> str:
    """A unit of time times a factor."""
    sign = "-" if factor.could_extract_minus_sign() else ""
    return f"{sign}{constants.text(-factor if sign else factor)}*unit"
