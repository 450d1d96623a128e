# SPDX-License-Identifier: BSD-3-Clause
"""Right-hand sides as a graph of operations whose Taylor coefficients follow by recurrences."""

from dataclasses import dataclass

import sympy
from sympy.codegen.cfunctions import expm1, log1p

from .fortran import within
from .model import Model


@dataclass(eq=False)
class Node:
    """A quantity: an input, a sum of multiples of others, or one operation on one or two of them.

    Kinds: input, sum, product, quotient, power, path (the integral of a slope along an argument,
    from 0), and the names of functions.
    """

    kind: str
    name: str
    args: tuple["Node", ...] = ()
    weights: tuple[sympy.Expr, ...] = ()
    """Of a sum: what each argument is multiplied by, without variables."""
    constant: sympy.Expr = sympy.S.Zero
    exponent: sympy.Expr = sympy.S.Zero
    """Of a power, or the bound of `within`."""
    exact: str = ""
    """The function of `of` that coefficient 0 is, where its kind would lose digits."""
    of: tuple["Node", ...] = ()
    slope: "Node | None" = None
    """Of a function f(a) without a recurrence of its own: its derivative by a, times `sign`."""
    sign: str = ""

    @property
    def is_convolution(self) -> bool:
        """Whether a coefficient takes all coefficients of lower order."""
        return self.kind not in ("input", "sum")


class Graph:
    """The operations of some expressions, each quantity once."""

    def __init__(self, model: Model, inputs: dict[sympy.Symbol, str]):
        self.variables, self.plain = model.variables, model.plain
        self.known: dict[sympy.Expr, Node] = {
            symbol: Node("input", name) for symbol, name in inputs.items()
        }
        for auxiliary, state in model.auxiliary.items():
            symbol = model.symbol(auxiliary)
            if symbol not in self.known and model.symbol(state) in self.known:
                self.known[symbol] = Node("exp", auxiliary, (self.known[model.symbol(state)],))
        self.counts: dict[str, int] = {}

    def add(self, kind: str, *args: Node, **rest) -> Node:
        """A new node with a name after its kind."""
        word = {"exp": "exponential", "log": "logarithm"}.get(kind, kind)
        self.counts[word] = self.counts.get(word, 0) + 1
        return Node(kind, f"{word}_{self.counts[word]}", args, **rest)

    def is_constant(self, expression: sympy.Expr) -> bool:
        """Whether an expression does not change in time."""
        return not expression.free_symbols & self.variables

    def node(self, expression: sympy.Expr) -> Node:
        """The node of an expression."""
        if expression not in self.known:
            self.known[expression] = self.made(expression)
        return self.known[expression]

    def made(self, one: sympy.Expr) -> Node:
        if self.is_constant(one):
            return self.add("sum", constant=one)
        if one.is_Add:
            constant = sympy.Add(*(term for term in one.args if self.is_constant(term)))
            parts = [
                self.scaled(term) for term in one.as_ordered_terms() if not self.is_constant(term)
            ]
            return self.add(
                "sum",
                *(node for _, node in parts),
                weights=tuple(weight for weight, _ in parts),
                constant=constant,
            )
        if one.is_Mul:
            weight, node = self.scaled(one)
            return node if weight == 1 else self.add("sum", node, weights=(weight,))
        if one.is_Pow:
            return self.power(one.base, one.exp)
        if one.func in (expm1, log1p):
            node = self.made(self.plain(one))
            node.exact, node.of = one.func.__name__, (self.node(one.args[0]),)
            return node
        if one.func is within:
            of = (self.node(one.args[0]),)
            weights, bound = (sympy.S.One,), one.args[1]
            return self.add("sum", *of, weights=weights, exponent=bound, exact="within", of=of)
        if one.func is sympy.atan2:
            # what it grows by along each argument; the rest is its value at order 0
            of, paths = tuple(map(self.node, one.args)), []
            for place, argument in enumerate(one.args, 1):
                if not self.is_constant(argument):
                    paths.append(self.add("path", of[place - 1], slope=self.node(one.fdiff(place))))
            weights = (sympy.S.One,) * len(paths)
            return self.add("sum", *paths, weights=weights, exact="atan2", of=of)
        node = self.add(one.func.__name__, self.node(one.args[0]))
        if one.func not in (sympy.exp, sympy.log):
            # the slope may take the function itself
            self.known[one] = node
            factor, node.slope = self.scaled(one.fdiff())
            if abs(factor) != 1:
                node.slope = self.node(one.fdiff())
            node.sign = "-" if factor == -1 else ""
        return node

    def power(self, base: sympy.Expr, exponent: sympy.Expr) -> Node:
        if not exponent.is_Integer:
            return self.add("power", self.node(base), exponent=exponent)
        if exponent < 0:
            return self.add("quotient", self.node(sympy.S.One), self.node(base**-exponent))
        # a**n by its own recurrence divides by a(0), which may be 0
        half = self.node(base ** (exponent // 2))
        square = self.add("product", half, half) if exponent > 1 else half
        if exponent % 2:
            return self.add("product", square, self.node(base))
        return square

    def scaled(self, one: sympy.Expr) -> tuple[sympy.Expr, Node]:
        """A term as a constant times a node."""
        if not one.is_Mul:
            return sympy.S.One, self.node(one)
        weight, above, below = sympy.S.One, [], []
        for factor in one.as_ordered_factors():
            if self.is_constant(factor):
                weight *= factor
            elif factor.is_Pow and factor.exp.is_Integer and factor.exp < 0:
                below.append(1 / factor)
            else:
                above.append(factor)
        if not below and len(above) == 1:
            return weight, self.node(above[0])
        key = sympy.Mul(*above, *(1 / factor for factor in below), evaluate=False)
        if key not in self.known:
            node = self.node(above[0]) if above else self.node(sympy.S.One)
            for factor in above[1:]:
                node = self.add("product", node, self.node(factor))
            if below:
                node = self.add("quotient", node, self.node(sympy.Mul(*below)))
            self.known[key] = node
        return weight, self.known[key]


def in_order(
    roots: list[Node], given: frozenset[Node] = frozenset(), *, slopes: bool = True
) -> list[Node]:
    """All nodes that some nodes take, each after its arguments; not what given ones take.

    Slopes are taken at lower orders alone: they come last, or not at all.
    """
    found: dict[Node, None] = {}
    started: set[Node] = set()

    def visit(node: Node) -> None:
        if node in started:
            return
        started.add(node)
        for one in () if node in given else (*node.args, *node.of):
            visit(one)
        found[node] = None

    wanted = list(roots)
    for root in wanted:
        before = len(found)
        visit(root)
        new = list(found)[before:]
        wanted += [node.slope for node in new if slopes and node.slope and node not in given]
    return list(found)


def convolutions(roots: list[Node]) -> int:
    """How many sums over all lower orders the nodes take: their cost."""
    return sum(1 + (node.kind == "power") for node in in_order(roots) if node.is_convolution)
