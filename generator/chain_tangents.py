"""Taylor series of disturbances of all blocks of a chain.

Disturbances are in lanes, and blocks are computed one at a time: block i is at order k when the
front is at i + k reach, where neighbours are up to `reach` places apart.
"""

import re

from generator.chain import LANES, column_of, renamed
from generator.definition import Model
from generator.fortran import indented
from generator.series import (
    Procedure,
)
from generator.slow import Balance, slow_tangent_parts
from generator.tangents import Parts, of_order, of_used, tangent_parts


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


def disturbed_differences(model: Model, parts: Parts) -> list[str]:
    """Statements that set second differences of disturbances at order k."""
    lines = []
    for state, symbol in model.differences.items():
        name = f"d_{symbol.name}"
        lines.append(f"{name} = -(2.0_wp + self%mode)*{parts.texts[state]}")
        for side in ("left", "right"):
            column = column_of(model, state, f"{side}(block)")
            lines.append(
                f"if ({side}(block) > 0) {name}(:used) = {name}(:used) "
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
