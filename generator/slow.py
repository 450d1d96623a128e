"""Procedures for the slow solution of a stiff model, on which a fast state is in balance.

The fast state w with v = exp(w) has w' = (rate/v) (balance - w). Its slow solution is the balance
less v'/rate, with v' of the iteration before (Fraser 1988, "The steady state and equilibrium
approximations: A geometrical picture", J. Chem. Phys. 88, 4732).
"""

from dataclasses import dataclass

import sympy

from generator.definition import TIME, Model
from generator.fortran import indented
from generator.graph import in_order
from generator.recurrences import Constants, Recurrences, fetch_parameters, weighted_sum
from generator.series import (
    Procedure,
    exponential_lines,
    fetch_inputs,
    fetch_places,
    flow_with,
    guarded,
    integral_of,
    place_names,
    refusals,
    uses_parameters,
)
from generator.tangents import Disturbances, Parts, base_series, lane_inputs, of_order, of_used


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
    if model.fast is None:
        return None
    for auxiliary, state in model.auxiliary.items():
        if state != model.fast:
            continue
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
    return None


def slow_series_procedure(model: Model, balance: Balance) -> Procedure:
    """Coefficients of the slow solution: w is its balance less v'/rate, with v' as it was."""
    flow = flow_with(model, {})
    fast, places = balance.state, {name: i for i, name in enumerate(model.states, 1)}
    others = [state for state in model.states if state != fast]
    roots = [flow.rates[state] for state in others]
    nodes = in_order(roots)
    constants = Constants(model)
    recurrences = Recurrences(nodes, roots, constants)
    inertia = constants.text(1 / balance.rate)
    v = balance.auxiliary
    exponential = exponential_lines(model, v, "y", f"{v}_series", constants)
    names = {model.symbol(state): f"{state}_0" for state in model.states}
    names |= {one.symbol: f"{one.symbol.name}_0" for one in model.delayed}
    names |= {model.symbol(name): f"exp({state}_0)" for name, state in model.auxiliary.items()}
    names[TIME] = "time_0"

    known, known_names = fetch_inputs(model, nodes, "0")
    newest, newest_names = fetch_inputs(model, nodes, "k")
    first = [line for node in nodes for line in recurrences.first.get(node, [])]
    later = [line for node in nodes for line in recurrences.later.get(node, [])]
    at_0 = balance.text({state: f"{state}_0" for state in others}, constants)
    at_k = balance.text({state: state for state in others}, constants, whole=False)
    guards = refusals(model, [model.equations[state] for state in others], names, "y")
    body = [
        *recurrences.loop(),
        f"{fast} = {at_k} - inertia*rate_before(k)",
        *newest,
        *later,
        *recurrences.stores(),
        *(f"y(k, {places[state]}) = {state}" for state in model.states),
        *(f"{state}_rate = {recurrences.rate_text(flow.rates[state])}" for state in others),
        "step = unit*reciprocal(k + 1)",
        *(f"{state} = step*{state}_rate" for state in others),
    ]
    start = [
        *(f"{state}_0 = y(0, {places[state]})" for state in others),
        f"{fast}_0 = {at_0} - inertia*rate_before(0)",
        *known,
        *guards,
        *first,
        *(f"y(0, {places[state]}) = {state}_0" for state in model.states),
        *(
            f"{state} = unit*({recurrences.rate_text(flow.rates[state], first=True)})"
            for state in others
        ),
    ]
    guard_parameters = [
        name
        for name in uses_parameters(model, guarded(model))
        if name not in constants.parameters()
    ]
    lines = [
        *fetch_places(model),
        *fetch_parameters(model, guard_parameters),
        *constants.fetched(),
        f"inertia = {inertia}/unit",
        *exponential,
        "do k = 0, degree - 1",
        f"   rate_before(k) = (k + 1)*{v}_series(k + 1)",
        "end do",
        "rate_before(degree) = 0.0_wp",
        *start,
        "do k = 1, degree",
        *indented(body),
        "end do",
    ]
    reals = [
        *constants.scalars(),
        *guard_parameters,
        *["by_unit"] * (integral_of(model, v) is not None),
        "inertia",
        *(f"{state}{end}" for state in model.states for end in ("", "_0")),
        *(f"{state}_rate" for state in others),
        *known_names,
        *newest_names,
        *recurrences.scalars,
        "step",
    ]
    arrays = [*recurrences.arrays(), "rate_before", f"{v}_series"]
    integers = [*place_names(model), "j", "k"]
    return Procedure(reals, arrays, integers, lines)


@dataclass
class SlowParts(Parts):
    """The parts of a procedure for disturbances of the slow solution."""

    growth: list[str]
    """Statements that set disturbances of v' of the iteration before."""
    steps: list[str]
    """Statements that set the next coefficients of the other states."""


def slow_tangent_parts(model: Model, balance: Balance) -> SlowParts:
    """Coefficients of disturbances of the slow solution: the derivative of its series."""
    flow = flow_with(model, {})
    fast, auxiliary = balance.state, balance.auxiliary
    known = {name: flow.graph.known[model.symbol(name)] for name in model.states}
    place = list(model.states).index(fast) + 1
    others = [state for state in model.states if state != fast]
    roots = [flow.rates[state] for state in others]
    nodes = in_order(roots, slopes=False)
    constants = Constants(model)
    steps = Disturbances(flow, nodes, roots, constants)
    before, at_order, delayed = lane_inputs(model, steps)
    rate_lines = [f"d_{state}_rate = {steps.rate_text(flow.rates[state])}" for state in others]
    now = {name: steps.text(node) for name, node in known.items()}
    taken = now | {symbol.name: f"d_{symbol.name}" for symbol in model.differences.values()}
    fast_line = (
        f"{now[fast]} = {balance.text(taken, constants, whole=False)} - inertia*d_rate_before(:, k)"
    )
    statements = [*steps.before_loop()], [*steps.after_loop()]
    inertia = constants.text(1 / balance.rate)
    exponential = exponential_lines(model, auxiliary, "before", f"{auxiliary}_before", constants)
    base, reals, arrays = base_series(model, list(steps.series), flow, constants, "y")
    integral = integral_of(model, auxiliary)
    if integral is None:
        growth = [
            "do k = 0, degree - 1",
            "   do j = 0, k + 1",
            "      d_rate_before(:used, k) = d_rate_before(:used, k) &",
            f"         + {auxiliary}_before(k + 1 - j)*dy(j, {place}, first:last)",
            "   end do",
            "   d_rate_before(:, k) = (k + 1)*d_rate_before(:, k)",
            "end do",
        ]
    else:
        growth = [
            "do k = 0, degree - 2",
            "   d_rate_before(:used, k) = (by_unit*((k + 1)*(k + 2)))"
            f"*dy(k + 2, {integral[0]}, first:last)",
            "end do",
            "do j = 0, degree",
            "   d_rate_before(:used, degree - 1) = d_rate_before(:used, degree - 1) &",
            f"      + degree*{auxiliary}_before(degree - j)*dy(j, {place}, first:last)",
            "end do",
        ]
    later = of_order(now, "k + 1")
    own = ["by_unit"] * (integral is not None)
    return SlowParts(
        constants=[*fetch_places(model), *constants.fetched(), f"inertia = {inertia}/unit"],
        base=[*exponential, *base],
        inverses=[],
        delayed=before,
        other_starts=[],
        body=[
            fast_line,
            *at_order,
            *statements[0],
            *steps.loop(),
            *statements[1],
        ],
        texts=now,
        reals=[*constants.scalars(), *reals, *own, "inertia", "step"],
        arrays=[*arrays, f"{auxiliary}_before"],
        integers=[*place_names(model), "first", "j", "k", "last", "used"],
        lanes=[
            *(text for text in now.values() if "(" not in text),
            *(f"d_{state}_rate" for state in others),
            *steps.lane_names(),
        ],
        lane_arrays=["d_rate_before", *steps.arrays(), *delayed],
        growth=["d_rate_before = 0.0_wp", *growth],
        steps=[
            *rate_lines,
            "step = unit*reciprocal(k + 1)",
            *(f"{later[state]} = step*d_{state}_rate" for state in others),
        ],
    )


def slow_tangent_series_procedure(model: Model, balance: Balance) -> Procedure:
    """Coefficients of disturbances of the slow solution: the derivative of its series."""
    parts = slow_tangent_parts(model, balance)
    places = {name: place for place, name in enumerate(model.states, 1)}
    others = {state: place for state, place in places.items() if state != balance.state}
    part = of_used(parts.texts)
    stores = [f"dy(k, {place}, first:last) = {part[state]}" for state, place in places.items()]
    return parts.of_one_block(
        [*parts.delayed, *parts.growth, *parts.starts(others)],
        [*parts.body, *stores, *parts.steps],
        "degree",
    )
