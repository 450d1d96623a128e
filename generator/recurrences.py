# SPDX-License-Identifier: BSD-3-Clause
"""Statements that compute the Taylor coefficients of a graph, order by order.

With a_k for coefficient k (Jorba and Zou 2005, "A software package for the numerical integration of
ODEs by means of high-order Taylor methods", sec. 2):

    p = a b       p_k = sum_j a_(k-j) b_j
    q = a/b       b_0 q_k = a_k - sum_(j<k) b_(k-j) q_j
    e = exp(a)    k e_k = sum_j e_(k-j) j a_j
    l = log(a)    a_0 k l_k = k a_k - sum_(0<j<k) a_(k-j) j l_j
    p = a**c      a_0 k p_k = c sum_j p_(k-j) j a_j - sum_(0<j<k) a_(k-j) j p_j
    f = f(a)      k f_k = sum_j g_(k-j) j a_j, where the slope g = df/da is 1 - f**2 of tanh,
                  1/(1 + a**2) of atan, and so on

Order 0 is computed by itself. Of every higher order the terms with a newest coefficient are
computed last, from scalars: the others, 0 < j < k, are known before, in one loop for all sums.
There the left factor is stored backwards, so that both factors are read forwards.
"""

from dataclasses import dataclass, field

import sympy

from .fortran import text_of
from .graph import Node
from .model import Model


@dataclass
class Constants:
    """What does not change in time: parameters, and numbers computed from them once a call."""

    model: Model
    names: dict[sympy.Expr, str] = field(default_factory=dict)
    lines: list[str] = field(default_factory=list)

    def text(self, value: sympy.Expr) -> str:
        """A positive factor: a number, a parameter, or the name of a constant."""
        if value.is_Integer:
            return text_of(value)
        if value.is_Symbol:
            self.names[value] = value.name
        elif value not in self.names:
            self.names[value] = f"constant_{len(self.lines) + 1}"
            self.lines.append(f"{self.names[value]} = {text_of(value)}")
        return self.names[value]

    def fetched(self) -> list[str]:
        """Statements that set parameters and constants."""
        return [*fetch_parameters(self.model), *self.lines]

    def scalars(self) -> list[str]:
        """Names that these statements set."""
        return [*names_of_parameters(self.model), *self.names.values()]


def names_of_parameters(model: Model) -> list[str]:
    """Names of all parameters, and of the sides of switches, which follow them."""
    return [one.name for one in (*model.parameters, *(one.symbol for one in model.switches))]


def fetch_parameters(model: Model) -> list[str]:
    """Statements that set them."""
    names = names_of_parameters(model)
    return [f"{name} = parameters({place})" for place, name in enumerate(names, 1)]


def weighted_sum(parts: list[tuple[sympy.Expr, str]], constants: Constants) -> str:
    """A sum of weights times texts; "" without parts."""
    written = ""
    # a term without a sign first, where there is one
    for weight, text in sorted(parts, key=lambda part: part[0].could_extract_minus_sign()):
        negative = weight.could_extract_minus_sign()
        size = -weight if negative else weight
        factors = [constants.text(size)] * (size != 1 or not text) + [text] * bool(text)
        term = "*".join(factors)
        sign = ("-" if negative else "") if not written else " - " if negative else " + "
        written += sign + term
    return written


@dataclass
class Recurrences:
    """The nodes of a graph in order, with a statement for each at order 0 and at order k."""

    nodes: list[Node]
    roots: list[Node]
    """Those whose coefficients are wanted."""
    constants: Constants
    in_lanes: bool = False
    """Whether names are arrays of lanes: then both factors of a sum are stored forwards."""
    k: str = "k"
    """The order of which coefficients are computed."""
    inlined: set[Node] = field(default_factory=set)
    """Sums that stand within the expression that takes them."""
    sums: list[tuple[str, str]] = field(default_factory=list)
    """Left array, stored backwards, and right array of each sum over lower orders."""
    backwards: dict[str, str] = field(default_factory=dict)
    """Stored backwards: the array of each quantity."""
    forwards: dict[str, str] = field(default_factory=dict)
    scalars: list[str] = field(default_factory=list)
    kept: dict[str, None] = field(default_factory=dict)
    """Names set at order 0 that higher orders take."""

    def __post_init__(self):
        uses: dict[Node, int] = {}
        for one in self.roots:
            uses[one] = uses.get(one, 0) + 1
        for node in self.nodes:
            for place, one in enumerate((*node.args, *node.of)):
                # what a convolution takes is stored, but for the dividend
                stored = node.is_convolution and not (node.kind == "quotient" and place == 0)
                uses[one] = uses.get(one, 0) + (2 if stored else 1)
            if node.slope:
                uses[node.slope] = uses.get(node.slope, 0) + 2
        self.inlined = {node for node in self.nodes if node.kind == "sum" and uses.get(node, 0) < 2}
        self.first: dict[Node, list[str]] = {}
        self.later: dict[Node, list[str]] = {}
        for node in self.nodes:
            if node.kind != "input" and node not in self.inlined:
                self.first[node], self.later[node] = self.statements(node)

    def text(self, node: Node, *, first: bool = False) -> str:
        """The coefficient of a node: its name, or the sum itself."""
        if node in self.inlined:
            text = self.sum_text(node, first=first)
            return text if text.replace("_", "").isalnum() else f"({text})"
        return f"{node.name}_0" if first else node.name

    def sum_text(self, node: Node, *, first: bool) -> str:
        """The sum of a node, or the function that coefficient 0 is."""
        if first and node.exact:
            bound = f", {text_of(node.exponent)}" if node.exponent else ""
            of = ", ".join(self.rate_text(one, first=True) for one in node.of)
            return f"{node.exact}({of}{bound})"
        parts = [
            (weight, self.text(one, first=first))
            for weight, one in zip(node.weights, node.args, strict=True)
        ]
        if first and node.constant != 0:
            parts.append((node.constant, ""))
        return weighted_sum(parts, self.constants) or "0.0_wp"

    def rate_text(self, node: Node, *, first: bool = False) -> str:
        """The coefficient of a rate, without brackets around a sum."""
        inside = node in self.inlined
        return self.sum_text(node, first=first) if inside else self.text(node, first=first)

    def convolved(self, left: str, right: str) -> str:
        """The name of the sum over 0 < j < k of left_(k-j) right_j."""
        self.backwards.setdefault(left, f"{left}_all" if self.in_lanes else f"{left}_back")
        self.forwards.setdefault(right, f"{right}_all")
        pair = (self.backwards[left], self.forwards[right])
        if pair not in self.sums:
            self.sums.append(pair)
        return f"total_{self.sums.index(pair) + 1}"

    def keep(self, name: str) -> str:
        """A name that is set at order 0."""
        self.kept.setdefault(name)
        return name

    def define(self, name: str) -> str:
        """A scalar that is set."""
        if name not in self.scalars:
            self.scalars.append(name)
        return name

    def statements(self, node: Node) -> tuple[list[str], list[str]]:
        """The statements of a node at order 0 and at order k."""
        name = self.define(node.name)
        zero = self.define(f"{name}_0")
        if node.kind == "sum":
            return (
                [f"{zero} = {self.sum_text(node, first=True)}"],
                [f"{name} = {self.sum_text(node, first=False)}"],
            )
        return getattr(self, node.kind, self.function)(node, name, zero)

    def product(self, node, name, zero):
        left, right = node.args
        a, b = self.text(left), self.text(right)
        rest = self.convolved(a, b)
        a_0, b_0 = self.keep(f"{a}_0"), self.keep(f"{b}_0")
        newest = f"2.0_wp*{a_0}*{a}" if a == b else f"{a_0}*{b} + {a}*{b_0}"
        return [f"{zero} = {a_0}*{b_0}"], [f"{name} = {rest} + {newest}"]

    def quotient(self, node, name, zero):
        above, below = node.args
        b = self.text(below)
        inverse = self.keep(self.define(f"by_{b}"))
        rest = self.convolved(b, name)
        self.keep(zero)
        above_text = self.text(above)
        newest = "" if above_text == "0.0_wp" else f"{above_text} - "
        return (
            [f"{inverse} = 1.0_wp/{b}_0", f"{zero} = {inverse}*{self.text(above, first=True)}"],
            [f"{name} = {inverse}*({newest}{zero}*{b} - {rest})"]
            if newest
            else [f"{name} = -{inverse}*({zero}*{b} + {rest})"],
        )

    def multiple(self, a: str) -> tuple[str, str]:
        """The name of k times coefficient k, and the statement that sets it."""
        name = self.define(f"multiple_of_{a}")
        return name, f"{name} = {self.k}*{a}"

    def exp(self, node, name, zero):
        a = self.text(node.args[0])
        multiple, line = self.multiple(a)
        rest = self.convolved(name, multiple)
        return (
            [f"{zero} = exp({a}_0)"],
            [line, f"{name} = {self.over_k}({rest} + {self.keep(zero)}*{multiple})"],
        )

    def log(self, node, name, zero):
        a = self.text(node.args[0])
        (multiple, _), inverse = self.multiple(name), self.keep(self.define(f"by_{a}"))
        rest = self.convolved(a, multiple)
        value = self.sum_text(node, first=True) if node.exact else f"log({a}_0)"
        return (
            [f"{inverse} = 1.0_wp/{a}_0", f"{zero} = {value}"],
            [
                f"{multiple} = {inverse}*({self.k}*{a} - {rest})",
                f"{name} = {self.over_k}{multiple}",
            ],
        )

    def power(self, node, name, zero):
        a = self.text(node.args[0])
        exponent = self.constants.text(node.exponent)
        (own, _), (given, line) = self.multiple(name), self.multiple(a)
        inverse = self.keep(self.define(f"by_{a}"))
        grows, rest = self.convolved(name, given), self.convolved(a, own)
        self.keep(zero)
        return (
            [f"{inverse} = 1.0_wp/{a}_0", f"{zero} = {a}_0**{exponent}"],
            [
                line,
                f"{own} = {inverse}*({exponent}*({grows} + {zero}*{given}) - {rest})",
                f"{name} = {self.over_k}{own}",
            ],
        )

    def function(self, node, name, zero):
        a, slope = self.text(node.args[0]), node.slope.name
        multiple, line = self.multiple(a)
        rest = self.convolved(slope, multiple)
        slope_0 = self.keep(f"{slope}_0")
        return (
            [f"{zero} = {node.kind}({a}_0)"],
            [line, f"{name} = {node.sign}{self.over_k}({rest} + {slope_0}*{multiple})"],
        )

    def path(self, node, name, zero):
        return [f"{zero} = 0.0_wp"], self.function(node, name, zero)[1]

    @property
    def over_k(self) -> str:
        """A factor 1/k."""
        return f"reciprocal({self.k})*"

    def at_0(self) -> list[str]:
        """The statements of order 0."""
        return [line for node in self.nodes for line in self.first.get(node, [])]

    def at_k(self, newest: list[str]) -> list[str]:
        """The statements of order k, with those that set the newest coefficients of inputs."""
        later = [line for node in self.nodes for line in self.later.get(node, [])]
        return [*self.loop(), *newest, *later, *self.stores()]

    def loop(self) -> list[str]:
        """The sums over lower orders."""
        if not self.sums:
            return []
        names = [f"total_{i + 1}" for i in range(len(self.sums))]
        for name in names:
            self.define(name)
        left_part, right_part = (
            (f"(:, {self.k} - j, slot)", "(:, j, slot)")
            if self.in_lanes
            else (f"(degree - {self.k} + j)", "(j)")
        )
        return [
            *(f"{name} = 0.0_wp" for name in names),
            f"do j = 1, {self.k} - 1",
            *(
                f"   {name} = {name} + {left}{left_part}*{right}{right_part}"
                for name, (left, right) in zip(names, self.sums, strict=True)
            ),
            "end do",
        ]

    def stores(self) -> list[str]:
        """Keep the newest coefficients for the sums of higher orders."""
        if self.in_lanes:
            stored = {array: name for name, array in {**self.backwards, **self.forwards}.items()}
            return [f"{array}(:, {self.k}, slot) = {name}" for array, name in stored.items()]
        return [
            *(f"{array}(degree - {self.k}) = {name}" for name, array in self.backwards.items()),
            *(f"{array}({self.k}) = {name}" for name, array in self.forwards.items()),
        ]

    def arrays(self) -> list[str]:
        """Names of all arrays."""
        return list(dict.fromkeys([*self.backwards.values(), *self.forwards.values()]))
