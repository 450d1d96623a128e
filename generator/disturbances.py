# SPDX-License-Identifier: BSD-3-Clause
"""Taylor series of small disturbances: the derivatives of the recurrences.

    p = a b       dp = a db + b da            e = exp(a)    de = e da
    q = a/b       b dq = da - q db            l = log(a)    a dl = da
    p = a**c      dp = (c p/a) da             f = f(a)      df = g da with its slope g
    v = exp(w), integrated    v dw = dv

Disturbances are computed in lanes, several at a time: the recurrences of one wait for their own
last terms, those of several overlap. One product of each sum is one statement: compilers then keep
the sums in registers.
"""

from dataclasses import dataclass, field
from functools import partial

from .address import Address
from .flow import Flow, exponential_lines, integral_of
from .fortran import indented
from .graph import Node, in_order
from .model import Model
from .recurrences import Constants, Recurrences, weighted_sum


@dataclass
class Disturbances:
    """Statements for the disturbance of each node at order k, and the sums and series they take.

    A disturbance is early where it follows at order k without sums over lower orders: those of
    states do, and sums of early ones. The sums then hold their newest terms. Of the others the
    newest terms are added later, and stand as zeros before.
    """

    flow: Flow
    nodes: list[Node]
    roots: list[Node]
    constants: Constants
    at: Address
    sums: list[tuple[str, str]] = field(default_factory=list)
    series: dict[Node, None] = field(default_factory=dict)
    """Nodes whose own series are needed."""
    stored: dict[Node, None] = field(default_factory=dict)
    """Nodes whose disturbances sums take."""

    def __post_init__(self):
        # which sums stand alone, and which within the expression that takes them
        self.inlined = Recurrences(self.nodes, self.roots, Constants(self.constants.model)).inlined
        self.early = [node for node in self.nodes if self.is_early(node)]
        for node in self.nodes:
            if node.is_convolution and not self.is_fixed(node):
                self.formula(node)
        self.alone = [
            node
            for node in self.nodes
            if node.kind != "input" and node not in self.inlined and not self.is_fixed(node)
        ]

    def is_fixed(self, node: Node) -> bool:
        """Whether a node has no disturbance: it is a constant, or takes time alone."""
        return all(map(self.is_fixed, node.args)) if node.kind != "input" else node.name == "time"

    def is_early(self, node: Node) -> bool:
        """Whether the disturbance follows without sums over lower orders."""
        is_sum = node.kind == "sum" and all(map(self.is_early, node.args))
        return node.kind == "input" or is_sum or self.is_fixed(node)

    def text(self, node: Node, order: str = "k", lanes: str = ":") -> str:
        """The disturbance of a node at an order, that of the present one if it is not stored."""
        if node in self.inlined:
            text = self.sum_text(node)
            return text if text.replace("_", "").isalnum() else f"({text})"
        if node in self.stored:
            return self.at.kept(f"d_{node.name}_all", lanes, order)
        return f"d_{node.name}" + (f"({lanes})" if lanes != ":" else "")

    def series_text(self, node: Node, order: str) -> str:
        """A coefficient of the series of a node."""
        return self.at.kept(f"{node.name}_series", order)

    def sum_text(self, node: Node) -> str:
        """The sum of a node."""
        parts = [
            (weight, self.text(one))
            for weight, one in zip(node.weights, node.args, strict=True)
            if not self.is_fixed(one)
        ]
        return weighted_sum(parts, self.constants) or "0.0_wp"

    def rate_text(self, node: Node) -> str:
        """The disturbance of a rate, without brackets around a sum."""
        if self.is_fixed(node):
            return "0.0_wp"
        return self.sum_text(node) if node in self.inlined else self.text(node)

    def total(self, series: Node, of: Node, shift: str = "k - j") -> str:
        """The name of the sum of series_(k-j) disturbance_j, the newest term left out if late."""
        self.series.setdefault(series)
        self.stored.setdefault(of)
        pair = (self.series_text(series, shift), self.text(of, "j"))
        if pair not in self.sums:
            self.sums.append(pair)
        return f"d_total_{self.sums.index(pair) + 1}"

    def times(self, series: Node, of: Node) -> str:
        """The whole sum over j <= k; "" where there is no disturbance."""
        if self.is_fixed(of):
            return ""
        total = self.total(series, of)
        if of in self.early:
            return total
        return f"{total} + {self.series_text(series, '0')}*{self.text(of)}"

    def formula(self, node: Node) -> str:
        """The disturbance of a node from those of its arguments."""
        a = node.args[0] if node.args else node
        match node.kind:
            case "sum":
                return self.sum_text(node)
            case "product":
                b = node.args[1]
                if a is b:
                    return f"2.0_wp*({self.times(a, a)})"
                return " + ".join(filter(None, (self.times(a, b), self.times(b, a))))
            case "quotient":
                b = node.args[1]
                # the newest term of the quotient itself is a zero here
                own = self.total(b, node)
                above = "" if self.is_fixed(a) else f"{self.text(a)} - "
                minus = "" if above else "-"
                taken = " + ".join(filter(None, (self.times(node, b), own)))
                return f"{minus}({above}({taken}))/{self.series_text(b, '0')}"
            case "exp":
                return self.times(node, a)
            case "log":
                own = self.total(a, node)
                return f"({self.text(a)} - {own})/{self.series_text(a, '0')}"
            case "power":
                ratio = self.ratio(node, a)
                return f"{self.constants.text(node.exponent)}*({self.times(ratio, a)})"
        product = self.times(node.slope, a)
        return f"-({product})" if node.sign else product

    def ratio(self, power: Node, base: Node) -> Node:
        """The node a**c/a."""
        known = [one for one in self.series if one.kind == "quotient" and one.args == (power, base)]
        return known[0] if known else self.flow.graph.add("quotient", power, base)

    def loop(self) -> list[str]:
        """The sums, and zeros for the terms that come later."""
        if not self.sums:
            return []
        names = self.totals()
        return [
            *(f"{self.text(node)} = 0.0_wp" for node in self.stored if node not in self.early),
            *(f"{name} = 0.0_wp" for name in names),
            "do j = 0, k",
            *(
                f"   {n} = {n} + {left}*{right}"
                for n, (left, right) in zip(names, self.sums, strict=True)
            ),
            "end do",
        ]

    def statements(self, *, early: bool) -> list[str]:
        """Statements that set the disturbances of early nodes, or of the others."""
        nodes = [node for node in self.alone if (node in self.early) == early]
        return [f"{self.text(node)} = {self.formula(node)}" for node in nodes]

    def totals(self) -> list[str]:
        """Names of the sums."""
        return [f"d_total_{i + 1}" for i in range(len(self.sums))]

    def lane_names(self) -> list[str]:
        """Scalars of each lane."""
        own = [f"d_{node.name}" for node in self.alone if node not in self.stored]
        return [*own, *self.totals()]

    def arrays(self) -> list[str]:
        """Arrays of each lane."""
        return [f"d_{node.name}_all" for node in self.stored]


@dataclass
class Base:
    """Statements that compute series of the solution, and the names that they set."""

    lines: list[str]
    reals: list[str]
    arrays: list[str]
    """Those that are needed while the statements run."""
    series: list[str]


def base_series(model: Model, wanted: list[Node], flow: Flow, constants: Constants) -> Base:
    """The series of nodes from those of the states."""
    at = Address(model)
    given = frozenset(flow.graph.known[model.symbol(name)] for name in model.auxiliary)
    auxiliaries = [node.name for node in given if node in in_order(wanted)]
    lines = [
        line
        for name in auxiliaries
        for line in exponential_lines(at, name, "y", partial(at.kept, f"{name}_series"), constants)
    ]
    reals = ["by_unit"] * any(integral_of(model, name) for name in auxiliaries)
    kept = [f"{name}_series" for name in [*auxiliaries, *(node.name for node in wanted)]]
    rest = [node for node in wanted if node not in given]
    if not rest:
        return Base(lines, reals, [], kept)
    # auxiliaries are inputs here
    nodes = in_order(rest, given)
    recurrences = Recurrences([one for one in nodes if one not in given], rest, constants, k="i")
    inputs = {node.name for node in nodes if node.kind == "input" or node in given}
    delayed = [one for one in model.delayed if one.symbol.name in inputs]
    inputs |= {one.state for one in delayed}
    wanted_differences = any(one.name in inputs for one in model.differences.values())
    inputs |= set(model.differences) if wanted_differences else set()

    def fetched(order: str, end: str) -> list[str]:
        found = [(name, at.state("y", order, state=name)) for name in model.states]
        found += [(name, at.kept(f"{name}_series", order)) for name in model.auxiliary]
        found = [(name, text) for name, text in found if name in inputs]
        if "time" in inputs:
            found.append(("time", "t" if order == "0" else "merge(unit, 0.0_wp, i == 1)"))
        reals.extend(f"{name}{end}" for name, _ in found)
        statements = [f"{name}{end} = {text}" for name, text in found]
        reals.extend(f"{one.symbol.name}{end}" for one in delayed)
        statements += at.fetched(inputs, order, end=end)
        if wanted_differences:
            reals.extend(f"{one.name}{end}" for one in model.differences.values())
            statements += at.differences(lambda column: f"y({order}, {column})", end)
        return statements

    def stored(order: str) -> list[str]:
        return [
            f"{at.kept(f'{node.name}_series', order)} = "
            f"{recurrences.rate_text(node, first=order == '0')}"
            for node in rest
        ]

    lines += [
        *fetched("0", "_0"),
        *recurrences.at_0(),
        *stored("0"),
        "do i = 1, degree",
        *indented([*recurrences.at_k(fetched("i", "")), *stored("i")]),
        "end do",
    ]
    return Base(lines, [*reals, *recurrences.scalars], recurrences.arrays(), kept)


def lane_inputs(model: Model, steps: Disturbances) -> tuple[list[str], list[str], list[str]]:
    """Statements that set delayed disturbances before all orders and at order k; their arrays."""
    at, before, at_order, arrays = steps.at, [], [], []
    used = {node.name: node for node in steps.nodes if node.kind == "input"}
    for number, one in enumerate(model.delayed, 1):
        if one.symbol.name not in used:
            continue
        node = used[one.symbol.name]
        steps.stored.setdefault(node)
        arrays.append(f"d_{node.name}_all")
        value = at.delayed("dz", ":", number=number, rest="first:last")
        before += [
            f"if (place_{number} > 0) then",
            f"   {at.kept(arrays[-1], ':', ':')} = 0.0_wp",
            f"   {at.kept(arrays[-1], ':used', '0:degree')} = transpose({value})",
            "end if",
        ]
        present = steps.text(steps.flow.graph.known[model.symbol(one.state)])
        at_order.append(f"if (place_{number} == 0) {steps.text(node)} = {present}")
    return before, at_order, arrays
