"""Procedures of a chain: the equations once for each of its blocks, with loops over these.

A model is a chain where an equation has the second difference of a state, along the blocks. States
stand block by block in their order, so that the Jacobian is banded.

Blocks of a series are computed in tiles of some lanes. Coefficient k + 1 of a tile needs
coefficient k of its neighbours, so tile i is at order k when the front is at i + k: a few tiles are
computed in turn and stay in the cache. Neighbours are within a tile or in the next ones.

Disturbances are in lanes themselves, and blocks are computed one at a time: block i is at order k
when the front is at i + k reach, where neighbours are up to `reach` places apart.
"""

import re
from collections.abc import Callable
from dataclasses import dataclass

import sympy

from generator.definition import Model
from generator.fortran import indented, text_of
from generator.graph import in_order
from generator.pointwise import braced, guard_lines, jacobian_entries, without_value
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
from generator.slow import Balance, slow_tangent_parts
from generator.tangents import Parts, of_order, of_used, tangent_parts

LANES, LANE_ARRAYS, KEPT = (
    "real(wp), dimension(lanes)",
    "real(wp), dimension(lanes, 0:degree, 0:degree)",
    "real(wp), dimension(lanes, 0:degree)",
)
"""Declarations: of one tile, of all coefficients of the tiles in turn, of one number of these."""


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
            neighbour = f"self%{side}({block})"
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
        ("self%left(block)", "by_difference"),
        ("self%right(block)", "by_difference"),
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


def in_block(lines: list[str]) -> list[str]:
    """Statements for one block as statements for a block of the chain at its turn.

    States and delayed states are those of the block, and what is kept between orders has a slot.
    """
    changes = [
        (r"\b(y|before|dy)\(([^,()]+), (\d+)(?=[,)])", r"\1(\2, at + \3"),
        (r"\b(d?z)\(([^,()]+), (place_\d+)", r"\1(\2, (block - 1)*self%delays + \3"),
        (r"\b(\w+_series|\w+_before)\(([^,()]+)\)", r"\1(\2, slot)"),
        (r"\b(d_\w+)\((:\w*), ([^()]+)\)", r"\1(\2, \3, slot)"),
        (r"\b(d_\w+_all|d_rate_before) = ", r"\1(:, :, slot) = "),
    ]
    for pattern, new in changes:
        lines = [re.sub(pattern, new, line) for line in lines]
    return lines


def renamed(lines: list[str]) -> list[str]:
    """Statements with another name for the orders of their own loops."""
    return [re.sub(r"\bk\b", "i", line) for line in lines]


def disturbed_differences(model: Model, parts: Parts) -> list[str]:
    """Statements that set second differences of disturbances at order k."""
    lines = []
    for state, symbol in model.differences.items():
        name = f"d_{symbol.name}"
        lines.append(f"{name} = -(2.0_wp + self%mode)*{parts.texts[state]}")
        for side in ("left", "right"):
            column = column_of(model, state, f"self%{side}(block)")
            lines.append(
                f"if (self%{side}(block) > 0) {name}(:used) = {name}(:used) "
                f"+ dy(k, {column}, first:last)"
            )
    return lines


def tangent_procedure(
    model: Model, parts: Parts, states: list[str], begin: list[str], body: list[str], orders: str
) -> Procedure:
    """Coefficients of disturbances of all blocks, a block at its turn."""
    places = {state: place for place, state in enumerate(model.states, 1)}
    held = {name: text for name, text in parts.texts.items() if "(" not in text}
    loads = [
        line
        for state in states
        if state in held
        for line in (
            f"{held[state]} = 0.0_wp",
            f"{held[state]}(:used) = dy(k, {places[state]}, first:last)",
        )
    ]
    # integrated auxiliaries are in no vector of states
    kept = [text for name, text in held.items() if name not in places]
    loads += [f"{text} = next_{text}(:, slot)" for text in kept]
    body = [*body, *(f"next_{text}(:, slot) = {text}" for text in kept)]
    inside = [
        "block = front - self%reach*k + 1",
        f"at = {len(places)}*(block - 1)",
        f"slot = modulo(block, self%reach*({orders}) + 1)",
        "if (k == 0) then",
        *indented(in_block(renamed([*parts.base, *parts.delayed, *begin]))),
        "else",
        *indented(in_block(loads)),
        "end if",
        *in_block(disturbed_differences(model, parts)),
        *in_block(parts.inverses),
        *in_block(body),
    ]
    lines = [
        *parts.constants,
        "do first = 1, vectors, lanes",
        "   last = min(vectors, first + lanes - 1)",
        "   used = last - first + 1",
        f"   do front = 0, self%blocks - 1 + self%reach*({orders})",
        "      start = max(0, front - self%blocks + self%reach)/self%reach",
        f"      do k = start, min(front/self%reach, {orders})",
        *indented(inside, 9),
        "      end do",
        "   end do",
        "end do",
    ]
    series = [name for name in parts.arrays if name.endswith(("_series", "_before"))]
    return Procedure(
        parts.reals,
        [name for name in parts.arrays if name not in series],
        [*parts.integers, "at", "block", "front", "i", "slot", "start"],
        lines,
        others={
            "real(wp), dimension(0:degree, 0:self%reach*degree)": series,
            LANES: [
                *parts.lanes,
                *(f"d_{symbol.name}" for symbol in model.differences.values()),
            ],
            "real(wp), dimension(lanes, 0:degree + 1, 0:self%reach*degree)": parts.lane_arrays,
            "real(wp), dimension(lanes, 0:self%reach*degree)": [f"next_{text}" for text in kept],
        },
    )


def tangent_series_procedure(model: Model) -> Procedure:
    """Coefficients 1 to degree of disturbances of all blocks from their values."""
    parts = tangent_parts(model)
    places = {state: place for place, state in enumerate(model.states, 1)}
    later = of_used(of_order(parts.texts, "k + 1"))
    stores = [f"dy(k + 1, {at}, first:last) = {later[state]}" for state, at in places.items()]
    begin = [*parts.starts(places), *parts.other_starts]
    return tangent_procedure(
        model, parts, list(places), begin, [*parts.body, *stores], "degree - 1"
    )


def slow_tangent_series_procedure(model: Model, balance: Balance) -> Procedure:
    """Coefficients of disturbances of the slow solution of all blocks."""
    parts = slow_tangent_parts(model, balance)
    places = {name: place for place, name in enumerate(model.states, 1)}
    others = {state: place for state, place in places.items() if state != balance.state}
    now = of_used(parts.texts)
    later = of_used(of_order(parts.texts, "k + 1"))
    body = [
        *parts.body,
        f"dy(k, {places[balance.state]}, first:last) = {now[balance.state]}",
        "if (k == degree) cycle",
        *parts.steps,
        *(f"dy(k + 1, {place}, first:last) = {later[state]}" for state, place in others.items()),
    ]
    begin = [*parts.growth, *parts.starts(others)]
    return tangent_procedure(model, parts, list(others), begin, body, "degree")
