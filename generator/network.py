# SPDX-License-Identifier: BSD-3-Clause
"""Procedures of a network: loops over its nodes and edges, whose number is that of a run.

The nodes are the blocks of the model (address.py). Edges stand in compressed rows: those that end
at node `block` have the numbers left(block) to left(block + 1) - 1, and edge number `edge` begins
at node right(edge). Behind the parameters are those that each node has, one after another, then
those that each edge has. `place` has the number of each delayed value, those of nodes before those
of edges, or 0 where its delay is 0; and behind these the first equation that takes each value.
"""

from dataclasses import dataclass

import sympy

from .address import Address
from .flow import Procedure, guard_names, refusals
from .fortran import indented, text_of
from .indices import needed_edges
from .model import FAR, NODE, Delayed, Model, Sum, of_other
from .recurrences import fetch_parameters, names_of_parameters

EDGES = "(left(self%blocks + 1) - 1)"


@dataclass
class Network:
    """Where a node, its edges and the other nodes have what the equations take."""

    model: Model

    def __post_init__(self):
        self.at = Address(self.model)
        self.of_nodes = [one for one in self.model.delayed if one.read == NODE]
        self.of_edges = [one for one in self.model.delayed if one.read != NODE]
        self.names: dict[str, None] = {}

    def is_alone(self, one: Sum) -> bool:
        """Whether a sum is the same for all nodes: it is computed once."""
        model = self.model
        edge = [*self.own(), *map(model.symbol, (one.name for one in model.matrices))]
        edge += [one.symbol for one in self.of_edges]
        return not one.term.free_symbols & set(edge)

    def own(self) -> dict[sympy.Symbol, str | Delayed]:
        """What a node has: elements of arrays, and delayed values."""
        return self.of_node("block")

    def others(self) -> dict[sympy.Symbol, str | Delayed]:
        """What the other node of an edge has."""
        return {of_other(symbol): value for symbol, value in self.of_node("other").items()}

    def of_node(self, node: str) -> dict[sympy.Symbol, str | Delayed]:
        model = self.model
        found: dict[sympy.Symbol, str | Delayed] = {
            model.symbol(state): f"y({self.at.column(state, node)})" for state in model.states
        }
        for number, one in enumerate(model.vectors):
            place = f"{len(model.parameters)} + {number}*self%blocks + {node}"
            found[model.symbol(one.name)] = f"parameters({place})"
        return found | {one.symbol: one for one in self.of_nodes}

    def of_edge(self) -> dict[sympy.Symbol, str | Delayed]:
        """What an edge has."""
        model = self.model
        before = f"{len(model.parameters)} + {len(model.vectors)}*self%blocks"
        found: dict[sympy.Symbol, str | Delayed] = {
            model.symbol(one.name): f"parameters({before} + {number}*{EDGES} + edge)"
            for number, one in enumerate(model.matrices)
        }
        return found | {one.symbol: one for one in self.of_edges}

    def value(self, one: Delayed, other: bool) -> str:
        """The number of a delayed value, an element of `place`."""
        if one.read == NODE:
            return (
                f"place({self.of_nodes.index(one)}*self%blocks + {'other' if other else 'block'})"
            )
        before = f"{len(self.of_nodes)}*self%blocks + {self.of_edges.index(one)}*{EDGES}"
        return f"place({before} + edge)"

    def present(self, one: Delayed, other: bool) -> sympy.Symbol:
        """The state whose past a delayed value is."""
        state = self.model.symbol(one.state)
        return of_other(state) if one.read == FAR or other else state

    def fetched(
        self, known: dict[sympy.Symbol, str | Delayed], taken: set, other=False
    ) -> list[str]:
        """Statements that set what is taken of a node or an edge."""
        lines = []
        for symbol, value in known.items():
            if symbol not in taken:
                continue
            self.names[symbol.name] = None
            if isinstance(value, str):
                lines.append(f"{symbol} = {value}")
                continue
            lines += [
                f"{symbol} = {self.present(value, other)}",
                f"value = {self.value(value, other)}",
                f"if (value > 0) {symbol} = z(value)",
            ]
        return lines

    def taken(self, expressions) -> set[sympy.Symbol]:
        """All that expressions take, with the states whose past is taken."""
        found = set().union(*(one.free_symbols for one in expressions))
        for delayed in self.model.delayed:
            for symbol, other in ((delayed.symbol, False), (of_other(delayed.symbol), True)):
                if symbol in found:
                    found.add(self.present(delayed, other))
        return found

    def loops(self, lines_of) -> tuple[list[str], list[str]]:
        """Loops over edges, and over all nodes, each around the lines for its sums."""
        found = []
        edges = ["do edge = left(block), left(block + 1) - 1", "   other = right(edge)"]
        for first, alone in ((edges, False), (["do other = 1, self%blocks"], True)):
            sums = [one for one in self.model.sums if self.is_alone(one) == alone]
            inside = lines_of(sums)
            found.append([*first, *indented(inside), "end do"] if inside else [])
        return found[0], found[1]

    def edge_values(self, expressions) -> list[str]:
        """Statements that set what these take of the edge and of its other node."""
        taken = self.taken(expressions)
        lines = self.fetched(self.others(), taken, other=True)
        return lines + self.fetched(self.of_edge(), taken)

    def sum_lines(self, results: list[str]) -> tuple[list[str], list[str]]:
        """Statements that compute the sums of a node, and those that are the same for all."""
        model, names = self.model, guard_names(self.model)

        def lines_of(sums: list[Sum]) -> list[str]:
            lines = self.edge_values([one.term for one in sums])
            for one in sums:
                lines += refusals(model, {one.symbol.name: one.term}, names, *results)
                lines.append(f"{one.symbol} = {one.symbol} + {braced(one.term)}")
            return lines

        zeros: dict[bool, list[str]] = {False: [], True: []}
        for one in model.sums:
            self.names[one.symbol.name] = None
            zeros[self.is_alone(one)].append(f"{one.symbol} = 0.0_wp")
        edges, alone = self.loops(lines_of)
        return [*zeros[False], *edges], [*zeros[True], *alone]

    def procedure(self, before: list[str], inside: list[str]) -> Procedure:
        """A procedure with statements for all nodes."""
        lines = ["do block = 1, self%blocks", *indented(inside), "end do"]
        reals = [*names_of_parameters(self.model), *self.names]
        integers = ["at", "block", "edge", "first", "other", "value"]
        return Procedure(
            {"real(wp)": reals, "integer": integers},
            [*fetch_parameters(self.model), *before, *lines],
        )


def braced(term: sympy.Expr) -> str:
    """A term as a summand."""
    text = text_of(term)
    return f"({text})" if text.startswith("-") else text


def rhs_procedure(model: Model) -> Procedure:
    """The equations of all nodes."""
    net = Network(model)
    of_node, alone = net.sum_lines(["dydt"])
    equations = model.equations
    inside = [
        *net.at.start(),
        *net.fetched(net.own(), net.taken([*equations.values(), *terms(model)])),
        *of_node,
        *refusals(
            model,
            equations,
            guard_names(model),
            "dydt",
            of=lambda state: net.at.state("dydt", state=state),
        ),
        *(f"{net.at.state('dydt', state=s)} = {text_of(one)}" for s, one in equations.items()),
    ]
    return net.procedure(alone, inside)


def terms(model: Model) -> list[sympy.Expr]:
    """The terms of all sums."""
    return [one.term for one in model.sums]


def jacobian_procedure(model: Model) -> Procedure:
    """Derivatives of the equations by states, a band, and by delayed values."""
    net = Network(model)
    equations = {row: model.plain(one) for row, one in enumerate(model.equations.values(), 1)}
    variables = model.variables
    entries = {
        (row, symbol): slope
        for row, one in equations.items()
        for symbol in sorted(one.free_symbols & variables, key=str)
        if (slope := one.diff(symbol)) != 0
    }
    factors = {(row, s.symbol): sympy.Symbol(f"by_{s.symbol}_{row}") for row in equations
               for s in model.sums if (row, s.symbol) in entries}  # fmt: skip
    texts, own_lines = shortened(net, list(entries.values()), "part")
    for place, text in zip(entries, texts, strict=True):
        if place in factors:
            net.names[factors[place].name] = None
            own_lines.append(f"{factors[place]} = {text}")
        else:
            own_lines += added(net, *place, text)

    def lines_of(sums: list[Sum]) -> list[str]:
        found: dict[tuple, sympy.Expr] = {}
        for (row, symbol), factor in factors.items():
            for one in sums:
                term = model.plain(one.term)
                for variable in sorted(term.free_symbols & variables, key=str):
                    if one.symbol == symbol and (slope := term.diff(variable)) != 0:
                        place = (row, variable)
                        found[place] = found.get(place, sympy.S.Zero) + factor * slope
        texts, lines = shortened(net, list(found.values()), "share")
        lines = [*net.edge_values(found.values()), *lines]
        for place, text in zip(found, texts, strict=True):
            lines += added(net, *place, text)
        return lines

    results = ["by_y", "by_z"]
    of_node, alone = net.sum_lines(results)
    if not any(one.free_symbols & {s.symbol for s in model.sums} for one in entries.values()):
        of_node, alone = [], []
    by_edge, by_all = net.loops(lines_of)
    inside = [
        *net.at.start(),
        *net.fetched(net.own(), net.taken([*model.equations.values(), *terms(model)])),
        *of_node,
        *refusals(model, model.equations, guard_names(model), *results),
        *own_lines,
        *by_edge,
        *by_all,
    ]
    return net.procedure([*(f"{one} = 0.0_wp" for one in results), *alone], inside)


def shortened(
    net: Network, expressions: list[sympy.Expr], name: str
) -> tuple[list[str], list[str]]:
    """Texts of expressions, and statements that set what they share."""
    symbols = sympy.numbered_symbols(f"{name}_", real=True, start=1)
    shared, reduced = sympy.cse(expressions, symbols=symbols)
    net.names |= {str(name): None for name, _ in shared}
    return list(map(text_of, reduced)), [f"{name} = {text_of(value)}" for name, value in shared]


def added(net: Network, row: int, symbol: sympy.Symbol, text: str) -> list[str]:
    """Statements that add to the derivative of an equation by a symbol."""
    model = net.model
    states = {model.symbol(state): (state, "block") for state in model.states}
    states |= {of_other(one): (state, "other") for one, (state, _) in states.items()}
    text = f"({text})" if text.startswith("-") else text
    if symbol in states:
        entry = net.at.slope(row, *states[symbol])
        return [f"{entry} = {entry} + {text}"]
    for one in model.delayed:
        if symbol in (one.symbol, of_other(one.symbol)):
            other = symbol != one.symbol
            entry = f"by_z(1 + at + {row} - first, value)"
            return [
                f"value = {net.value(one, other)}",
                "if (value > 0) then",
                f"   first = place({len(net.of_nodes)}*self%blocks + {len(net.of_edges)}*{EDGES} &",
                "                 + value)",
                f"   {entry} = {entry} + {text}",
                "else",
                *indented(added(net, row, net.present(one, other), text)),
                "end if",
            ]
    return []


def lags_procedure(model: Model) -> Procedure:
    """The delays of nodes, then those of edges."""
    net = Network(model)
    lags = [one.lag for one in net.of_edges]
    own = net.fetched(net.own(), net.taken([*lags, *(one.lag for one in net.of_nodes)]))
    lines = [
        f"lag({number}*self%blocks + block) = {text_of(one.lag)}"
        for number, one in enumerate(net.of_nodes)
    ]
    if lags:
        before = f"{len(net.of_nodes)}*self%blocks"
        of_edges = [
            f"lag({before} + {number}*{EDGES} + edge) = {text_of(one)}"
            for number, one in enumerate(lags)
        ]
        head = ["do edge = left(block), left(block + 1) - 1", "   other = right(edge)"]
        lines += [*head, *indented([*net.edge_values(lags), *of_edges]), "end do"]
    found = net.procedure([], [*own, *lines])
    found.names["integer"] = ["block", "edge", "other"]
    return found


def network_lines(model: Model) -> list[tuple[str, ...]]:
    """Lines of the description: how many parameters nodes and edges have, which edges take part,
    whether all nodes depend on all; of each delayed value its state and whose it is."""
    net, states = Network(model), list(model.states)
    sums = [one for one in model.sums if not net.is_alone(one)]
    counts = (str(len(model.vectors)), str(len(model.matrices)))
    full = str(int(len(sums) < len(model.sums)))
    return [
        ("network", *counts, needed_edges(model, sums), full),
        *(("delayed", one.read, str(states.index(one.state) + 1))
          for one in (*net.of_nodes, *net.of_edges)),
    ]  # fmt: skip
