# SPDX-License-Identifier: BSD-3-Clause
"""Events of a definition, at which the state changes: `when: v = 1 rising, set: { v: 0 }`."""

import re

import sympy

from .model import Switch

WHEN = re.compile(r"([^=<>]+)=([^=<>]+?)(?:\s+(rising|falling))?\s*")


def entries_of(reader, entries) -> list[dict]:
    """Entries of the shape that events have; a single one need not stand in a list."""
    entries = [entries] if isinstance(entries, dict) else entries or []
    for one in entries if isinstance(entries, list) else [entries]:
        is_event = isinstance(one, dict) and set(one) == {"when", "set"}
        if not is_event or not isinstance(one["set"], dict) or not one["set"]:
            reader.refuse("events", one, "{when: 'v = 1 rising', set: {v: 0}}, or a list of these")
    return entries


def read_events(reader, entries: list[dict]) -> list[Switch]:
    """Where the state changes, and what it is then: all from the values before."""
    model, found = reader.model, {}
    for entry in entries:
        when = reader.line("when of an event", entry["when"])
        match = WHEN.fullmatch(when)
        if not match or when in found:
            reader.refuse("when of an event", when, "LEFT = RIGHT, rising or falling, once")
        left, right = (reader.expression(f"event {when}", x.strip()) for x in match.groups()[:2])
        value = left - right
        if not value.free_symbols & model.variables:
            reader.refuse("when of an event", when, "an equation with t or the states")
        if unknown := set(entry["set"]) - set(model.states):
            expected = f"states, {', '.join(model.states)}; one whose slope is 0 for a parameter"
            reader.refuse(f"set of event {when}", ", ".join(sorted(unknown)), expected)
        changes = {
            state: reader.expression(f"event {when}: {state}", text)
            for state, text in entry["set"].items()
        }
        symbol = sympy.Symbol(f"event_{len(found) + 1}", real=True)
        direction = {"rising": 1, "falling": -1, None: 0}[match[3]]
        new = ", ".join(f"{state} = {text}" for state, text in entry["set"].items())
        said = reader.line(f"event {when}", f"{when}: {new}")
        found[when] = Switch(value, when, symbol, changes, direction, said)
    return [*found.values()]
