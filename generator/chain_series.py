"""Taylor series of all blocks of a chain.

Blocks are computed in tiles of some lanes. Coefficient k + 1 of a tile needs coefficient k of its
neighbours, so tile i is at order k when the front is at i + k: a few tiles are computed in turn and
stay in the cache. Neighbours are within a tile or in the next ones.
"""

import re
from dataclasses import dataclass

import sympy

from generator.chain import LANES, delayed_index, difference_lines, names_of_states, renamed
from generator.definition import Model
from generator.fortran import indented
from generator.graph import in_order
from generator.recurrences import Constants, Recurrences, fetch_parameters
from generator.series import (
    Procedure,
    conditions_of,
    exponential_lines,
    fetch_places,
    flow_of,
    flow_with,
    guarded,
    input_names,
    place_names,
    uses_parameters,
)
from generator.slow import Balance

LANE_ARRAYS, KEPT = (
    "real(wp), dimension(lanes, 0:degree, 0:degree)",
    "real(wp), dimension(lanes, 0:degree)",
)
"""Declarations: of all coefficients of the tiles in turn, and of one number of these."""


@dataclass
class Tile:
    """The statements of one tile at one order."""

    gather: list[str]
    """Set states, delayed states and differences of its lanes."""
    first: list[str]
    """Of order 0."""
    later: list[str]
    """Of a higher order."""
    always: list[str]
    """After them: new coefficients."""
    kept: list[str]
    """Lane variables of order 0, or of the order before, that later orders take."""


def gathered(model: Model, states: list[str]) -> list[str]:
    """Statements that set the coefficients k of the lanes of a tile; other lanes are at rest."""
    size = len(model.states)
    places = {state: place for place, state in enumerate(model.states, 1)}
    lines = [f"{name} = 0.0_wp" for name in names_of_states(model)]
    inside = ["block = first + lane", f"at = {size}*(block - 1)"]
    inside += [f"{state}(lane) = y(k, at + {places[state]})" for state in states]
    inside += difference_lines(model, "block", lambda column: f"y(k, {column})", "(lane)")
    for number, one in enumerate(model.delayed, 1):
        inside.append(
            f"if (place_{number} > 0) {one.symbol.name}(lane) = z(k, {delayed_index(number)})"
        )
    lines += ["do lane = 1, last", *indented(inside), "end do"]
    return lines


def present_lines(model: Model) -> list[str]:
    """Statements that set delayed states without their delay."""
    return [
        f"if (place_{number} == 0) {one.symbol.name} = {one.state}"
        for number, one in enumerate(model.delayed, 1)
    ]


def scattered(model: Model, order: str, states: list[str]) -> list[str]:
    """Statements that write coefficients of the lanes of a tile."""
    size = len(model.states)
    places = {state: place for place, state in enumerate(model.states, 1)}
    inside = [f"at = {size}*(first + lane - 1)"]
    inside += [f"y({order}, at + {places[state]}) = {state}(lane)" for state in states]
    return ["do lane = 1, last", *indented(inside), "end do"]


def used_later(names: list[str], lines: list[str]) -> list[str]:
    """Those of the names that stand in lines."""
    words = {word for line in lines for word in re.findall(r"\w+", line)}
    return [name for name in names if name in words]


def refusals(model: Model, expressions: list[sympy.Expr], result: str) -> list[str]:
    """Statements that end a series with no number where an expression has no value in a lane."""
    names = {symbol: f"{name}_0" for symbol, name in input_names(model).items()}
    names |= {model.symbol(name): f"exp({state}_0)" for name, state in model.auxiliary.items()}
    lines = []
    for level in conditions_of(model, expressions, names):
        lines += [
            f"if ({' .or. '.join(f'any({one})' for one in level)}) then",
            f"   {result} = ieee_value(1.0_wp, ieee_quiet_nan)",
            "   return",
            "end if",
        ]
    return lines


def fronts(model: Model, orders: str, tile: Tile) -> list[str]:
    """The loops over tiles and orders."""
    kept = [(name, f"{name}_kept(:, slot)") for name in tile.kept]
    body = [
        "first = lanes*(front - k)",
        "last = min(lanes, self%blocks - first)",
        f"slot = modulo(front - k, {orders} + 1)",
        *tile.gather,
        "if (k == 0) then",
        *indented(tile.first),
        *indented([f"{place} = {name}" for name, place in kept]),
        "else",
        *indented([f"{name} = {place}" for name, place in kept]),
        *indented(tile.later),
        "end if",
        *tile.always,
    ]
    return [
        "last_tile = (self%blocks - 1)/lanes",
        f"do front = 0, last_tile + {orders}",
        f"   do k = max(0, front - last_tile), min(front, {orders})",
        *indented(body, 6),
        "   end do",
        "end do",
    ]


INTEGERS = ["at", "block", "first", "front", "j", "k", "lane", "last", "last_tile", "slot"]


def series_procedure(model: Model) -> Procedure:
    """Coefficients 1 to degree of the states of all blocks from their values."""
    flow = flow_of(model)
    roots = list(flow.rates.values())
    nodes = in_order(roots)
    constants = Constants(model)
    recurrences = Recurrences(nodes, roots, constants, in_lanes=True)
    states, integrated = list(model.states), list(flow.integrated)
    first = [line for node in nodes for line in recurrences.first.get(node, [])]
    later = [
        *(f"{name} = {name}_next(:, slot)" for name in integrated),
        *recurrences.loop(),
        *(line for node in nodes for line in recurrences.later.get(node, [])),
        *recurrences.stores(),
        *(f"{name}_rate = {recurrences.rate_text(node)}" for name, node in flow.rates.items()),
    ]
    zeros = [f"{name}_0" for name in [*names_of_states(model), *flow.integrated]]
    tile = Tile(
        gather=[*gathered(model, states), *present_lines(model)],
        first=[
            *(f"{name}_0 = {name}" for name in names_of_states(model)),
            *refusals(model, list(model.equations.values()), "y(1:, :)"),
            *(f"{name}_0 = exp({state}_0)" for name, state in flow.integrated.items()),
            *first,
            *(
                f"{name}_rate = {recurrences.rate_text(node, first=True)}"
                for name, node in flow.rates.items()
            ),
        ],
        later=later,
        always=[
            "step = unit*reciprocal(k + 1)",
            *(f"{state} = step*{state}_rate" for state in states),
            *(f"{name}_next(:, slot) = step*{name}_rate" for name in integrated),
            *scattered(model, "k + 1", states),
        ],
        kept=used_later([*zeros, *recurrences.scalars], later),
    )
    tile.kept = [name for name in tile.kept if set_at_0(name, tile.first)]
    lines = [
        *fetch_places(model),
        *fetched_constants(model, constants),
        "if (degree == 0) return",
        *fronts(model, "degree - 1", tile),
    ]
    lane_names = [
        *names_of_states(model),
        *zeros,
        *(f"{name}_rate" for name in flow.rates),
        *integrated,
        *recurrences.scalars,
    ]
    return Procedure(
        [*constant_names(model, constants), "step"],
        [],
        [*place_names(model), *INTEGERS],
        lines,
        others={
            LANES: lane_names,
            LANE_ARRAYS: recurrences.arrays(),
            KEPT: [*(f"{name}_kept" for name in tile.kept), *(f"{one}_next" for one in integrated)],
        },
    )


def set_at_0(name: str, lines: list[str]) -> bool:
    """Whether statements set a name."""
    return any(line.startswith(f"{name} = ") for line in lines)


def guard_parameters(model: Model, constants: Constants) -> list[str]:
    """Parameters that only conditions take."""
    known = constants.parameters()
    return [name for name in uses_parameters(model, guarded(model)) if name not in known]


def fetched_constants(model: Model, constants: Constants) -> list[str]:
    """Statements that set parameters and constants."""
    return [*fetch_parameters(model, guard_parameters(model, constants)), *constants.fetched()]


def constant_names(model: Model, constants: Constants) -> list[str]:
    """Names that these statements set."""
    return [*guard_parameters(model, constants), *constants.scalars()]


def slow_series_procedure(model: Model, balance: Balance) -> Procedure:
    """Coefficients of the slow solution of all blocks: w is its balance less v'/rate."""
    flow = flow_with(model, {})
    fast, v = balance.state, balance.auxiliary
    states = list(model.states)
    others = [state for state in states if state != fast]
    roots = [flow.rates[state] for state in others]
    nodes = in_order(roots)
    constants = Constants(model)
    recurrences = Recurrences(nodes, roots, constants, in_lanes=True)
    inertia = constants.text(1 / balance.rate)
    before = before_lines(v, model, constants)
    size = len(states)
    names = {name: name for name in [*others, *(one.name for one in model.differences.values())]}
    at_k = balance.text(names, constants, whole=False)
    at_0 = balance.text({name: f"{name}_0" for name in names}, constants)
    first = [line for node in nodes for line in recurrences.first.get(node, [])]
    later = [
        f"{fast} = {at_k} - inertia*rate_before(:, k, slot)",
        *present_lines(model),
        *recurrences.loop(),
        *(line for node in nodes for line in recurrences.later.get(node, [])),
        *recurrences.stores(),
        *(f"{state}_rate = {recurrences.rate_text(flow.rates[state])}" for state in others),
    ]
    start = [
        "rate_before(:, :, slot) = 0.0_wp",
        "do lane = 1, last",
        f"   at = {size}*(first + lane - 1)",
        *indented(before),
        "end do",
        *(f"{name}_0 = {name}" for name in names),
        f"{fast}_0 = {at_0} - inertia*rate_before(:, 0, slot)",
        f"{fast} = {fast}_0",
        *present_lines(model),
        *(f"{one.symbol.name}_0 = {one.symbol.name}" for one in model.delayed),
        *refusals(model, [model.equations[state] for state in others], "y"),
        *first,
        *(
            f"{state}_rate = {recurrences.rate_text(flow.rates[state], first=True)}"
            for state in others
        ),
    ]
    zeros = [f"{name}_0" for name in names_of_states(model)]
    tile = Tile(
        gather=gathered(model, others),
        first=start,
        later=later,
        always=[
            *scattered(model, "k", [fast]),
            "if (k == degree) cycle",
            "step = unit*reciprocal(k + 1)",
            *(f"{state} = step*{state}_rate" for state in others),
            *scattered(model, "k + 1", others),
        ],
        kept=used_later([*zeros, *recurrences.scalars], later),
    )
    tile.kept = [name for name in tile.kept if set_at_0(name, tile.first)]
    lines = [
        *fetch_places(model),
        *fetched_constants(model, constants),
        f"inertia = {inertia}/unit",
        *fronts(model, "degree", tile),
    ]
    return Procedure(
        [*constant_names(model, constants), "by_unit", "inertia", "step"],
        [f"{v}_series"],
        [*place_names(model), *INTEGERS, "i"],
        lines,
        others={
            LANES: [
                *names_of_states(model),
                *zeros,
                *(f"{state}_rate" for state in others),
                *recurrences.scalars,
            ],
            LANE_ARRAYS: [*recurrences.arrays(), "rate_before"],
            KEPT: [f"{name}_kept" for name in tile.kept],
        },
    )


def before_lines(v: str, model: Model, constants: Constants) -> list[str]:
    """Statements that set v' times the unit of the iteration before, of one lane."""
    lines = [
        *exponential_lines(model, v, "y", f"{v}_series", constants),
        "do k = 1, degree",
        f"   rate_before(lane, k - 1, slot) = k*{v}_series(k)",
        "end do",
    ]
    # k is the order of the tile
    return [re.sub(r"\by\(([^,()]+), (\d+)\)", r"y(\1, at + \2)", line) for line in renamed(lines)]
