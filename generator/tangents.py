"""Procedures that compute Taylor series of small disturbances: the derivatives of the recurrences.

    p = a b       dp = a db + b da            e = exp(a)    de = e da
    q = a/b       b dq = da - q db            l = log(a)    a dl = da
    p = a**c      dp = (c p/a) da             f = f(a)      df = g da with its slope g
    v = exp(w), integrated    v dw = dv

Disturbances are computed in lanes, several at a time: the recurrences of one wait for their own
last terms, those of several overlap. One product of each sum is one statement: compilers then keep
the sums in registers.
"""

from dataclasses import dataclass, field

from generator.definition import Model
from generator.fortran import indented, text_of
from generator.graph import Node, in_order
from generator.recurrences import Constants, Recurrences, weighted_sum
from generator.series import (
    Flow,
    Procedure,
    exponential_lines,
    fetch_inputs,
    fetch_places,
    flow_of,
    integral_of,
    place_names,
)


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
    sums: list[tuple[str, str]] = field(default_factory=list)
    series: dict[Node, None] = field(default_factory=dict)
    """Nodes whose own series are needed."""
    stored: dict[Node, None] = field(default_factory=dict)
    """Nodes whose disturbances sums take."""
    lanes: list[str] = field(default_factory=list)
    early: list[Node] = field(default_factory=list)

    def __post_init__(self):
        # which sums stand alone, and which within the expression that takes them
        self.inlined = Recurrences(self.nodes, self.roots, Constants(self.constants.model)).inlined
        for node in self.nodes:
            if self.is_early(node):
                self.early.append(node)
        for node in self.nodes:
            if node.is_convolution:
                self.formula(node)
        self.alone = [
            node
            for node in self.nodes
            if node.kind != "input" and node not in self.inlined and not self.is_constant(node)
        ]
        self.lanes = [f"d_{node.name}" for node in self.alone if node not in self.stored]

    def is_constant(self, node: Node) -> bool:
        """Whether a node does not change in time."""
        return node.kind == "sum" and not node.args

    def is_early(self, node: Node) -> bool:
        """Whether the disturbance follows without sums over lower orders."""
        return node.kind == "input" or (node.kind == "sum" and all(map(self.is_early, node.args)))

    def text(self, node: Node) -> str:
        """The disturbance of a node at order k: its name, or the sum itself."""
        if node in self.inlined:
            text = self.sum_text(node)
            return text if text.replace("_", "").isalnum() else f"({text})"
        return f"d_{node.name}_all(:, k)" if node in self.stored else f"d_{node.name}"

    def sum_text(self, node: Node) -> str:
        """The sum of a node."""
        parts = [
            (weight, self.text(one)) for weight, one in zip(node.weights, node.args, strict=True)
        ]
        return weighted_sum(parts, self.constants) or "0.0_wp"

    def rate_text(self, node: Node) -> str:
        """The disturbance of a rate, without brackets around a sum."""
        return self.sum_text(node) if node in self.inlined else self.text(node)

    def total(self, series: Node, of: Node, shift: str = "k - j") -> str:
        """The name of the sum of series_(k-j) disturbance_j, the newest term left out if late."""
        self.series.setdefault(series)
        self.stored.setdefault(of)
        pair = (f"{series.name}_series({shift})", f"d_{of.name}_all(:, j)")
        if pair not in self.sums:
            self.sums.append(pair)
        return f"d_total_{self.sums.index(pair) + 1}"

    def times(self, series: Node, of: Node) -> str:
        """The whole sum over j <= k."""
        total = self.total(series, of)
        return total if of in self.early else f"{total} + {series.name}_series(0)*{self.text(of)}"

    def statement(self, node: Node) -> str:
        """The statement that sets the disturbance of a node."""
        return f"{self.text(node)} = {self.formula(node)}"

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
                return f"{self.times(a, b)} + {self.times(b, a)}"
            case "quotient":
                b = node.args[1]
                # the newest term of the quotient itself is a zero here
                own = self.total(b, node)
                above = "" if self.is_constant(a) else f"{self.text(a)} - "
                minus = "" if above else "-"
                return f"{minus}({above}({self.times(node, b)} + {own}))/{b.name}_series(0)"
            case "exp":
                return self.times(node, a)
            case "log":
                own = self.total(a, node)
                return f"({self.text(a)} - {own})/{a.name}_series(0)"
            case "power":
                ratio = self.ratio(node, a)
                exponent = (
                    text_of(node.exponent)
                    if node.exponent.is_Integer
                    else self.constants.text(node.exponent)
                )
                return f"{exponent}*({self.times(ratio, a)})"
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
        names = [f"d_total_{i + 1}" for i in range(len(self.sums))]
        return [
            *(
                f"d_{node.name}_all(:, k) = 0.0_wp"
                for node in self.stored
                if node not in self.early
            ),
            *(f"{name} = 0.0_wp" for name in names),
            "do j = 0, k",
            *(
                f"   {n} = {n} + {left}*{right}"
                for n, (left, right) in zip(names, self.sums, strict=True)
            ),
            "end do",
        ]

    def before_loop(self) -> list[str]:
        """Statements of early nodes."""
        return [self.statement(node) for node in self.alone if node in self.early]

    def after_loop(self) -> list[str]:
        """Statements of the others."""
        return [self.statement(node) for node in self.alone if node not in self.early]

    def lane_names(self) -> list[str]:
        """Scalars of each lane."""
        return [*self.lanes, *(f"d_total_{i + 1}" for i in range(len(self.sums)))]

    def arrays(self) -> list[str]:
        """Arrays of each lane."""
        return [f"d_{node.name}_all" for node in self.stored]


def base_series(model: Model, wanted: list[Node], flow: Flow, constants: Constants, y: str):
    """Statements that compute the series of nodes from those of the states, and their names."""
    given = frozenset(flow.graph.known[model.symbol(name)] for name in model.auxiliary)
    auxiliaries = [node for node in given if node in in_order(wanted)]
    lines = [
        line
        for node in auxiliaries
        for line in exponential_lines(model, node.name, y, f"{node.name}_series", constants)
    ]
    own = ["by_unit"] * any(integral_of(model, node.name) for node in auxiliaries)
    rest = [node for node in wanted if node not in given]
    # auxiliaries are inputs here
    nodes = [node for node in in_order(rest, given) if node not in given]
    if not rest:
        return lines, own, [f"{node.name}_series" for node in wanted]
    recurrences = Recurrences(nodes, rest, constants)
    places = {name: place for place, name in enumerate(model.states, 1)}
    inputs = [node for node in in_order(rest, given) if node.kind == "input" or node in given]
    reals: list[str] = []

    def fetched(order: str) -> list[str]:
        end = "_0" if order == "0" else ""
        found = []
        states = {
            one.state for one in model.delayed if one.symbol.name in {node.name for node in inputs}
        }
        for name in [*model.states, *model.auxiliary]:
            if name in states or name in {node.name for node in inputs}:
                source = (
                    f"{y}({order}, {places[name]})" if name in places else f"{name}_series({order})"
                )
                found.append(f"{name}{end} = {source}")
                reals.append(f"{name}{end}")
        more, names = fetch_inputs(model, inputs, order)
        reals.extend(names)
        return [*found, *more]

    def kept(order: str) -> list[str]:
        first = order == "0"
        texts = [(node, recurrences.rate_text(node, first=first)) for node in rest]
        return [f"{node.name}_series({order}) = {text}" for node, text in texts]

    first = [line for node in nodes for line in recurrences.first.get(node, [])]
    later = [line for node in nodes for line in recurrences.later.get(node, [])]
    lines += [
        *fetched("0"),
        *first,
        *kept("0"),
        "do k = 1, degree",
        *indented([*recurrences.loop(), *fetched("k"), *later, *recurrences.stores(), *kept("k")]),
        "end do",
    ]
    arrays = [*recurrences.arrays(), *(f"{node.name}_series" for node in wanted)]
    arrays += [f"{node.name}_series" for node in auxiliaries]
    return lines, [*own, *reals, *recurrences.scalars], arrays


def lane_inputs(model: Model, steps: Disturbances) -> tuple[list[str], list[str], list[str]]:
    """Statements that set delayed disturbances before all orders and at order k; their arrays."""
    before, at_order, arrays = [], [], []
    used = {node.name: node for node in steps.nodes if node.kind == "input"}
    for number, one in enumerate(model.delayed, 1):
        if one.symbol.name not in used:
            continue
        steps.stored.setdefault(used[one.symbol.name])
        name = f"d_{one.symbol.name}_all"
        arrays.append(name)
        before += [
            f"if (place_{number} > 0) then",
            f"   {name} = 0.0_wp",
            f"   {name}(:used, 0:degree) = transpose(dz(:, place_{number}, first:last))",
            "end if",
        ]
        present = steps.flow.graph.known[model.symbol(one.state)]
        at_order.append(f"if (place_{number} == 0) {name}(:, k) = {steps.text(present)}")
    if "time" in used:
        at_order.append(f"{steps.text(used['time'])} = 0.0_wp")
    return before, at_order, arrays


def of_order(texts: dict[str, str], order: str) -> dict[str, str]:
    """Texts of disturbances at another order; scalars are those of the present one."""
    return {name: text.replace("(:, k)", f"(:, {order})") for name, text in texts.items()}


def of_used(texts: dict[str, str]) -> dict[str, str]:
    """Texts of disturbances in the lanes that are in use."""
    return {
        name: text.replace("(:, ", "(:used, ") if "(" in text else f"{text}(:used)"
        for name, text in texts.items()
    }


@dataclass
class Parts:
    """The parts of a procedure for disturbances."""

    constants: list[str]
    """Statements that set what does not change in time."""
    base: list[str]
    """Statements that compute series of the solution, for all disturbances."""
    inverses: list[str]
    """Statements that set inverses of their coefficients 0."""
    delayed: list[str]
    """Statements that set delayed disturbances of some lanes."""
    other_starts: list[str]
    """Statements that set coefficients 0 of what is no state."""
    body: list[str]
    """Statements of order k."""
    texts: dict[str, str]
    """Disturbances of the states, and of auxiliaries, at order k."""
    reals: list[str]
    arrays: list[str]
    integers: list[str]
    lanes: list[str]
    lane_arrays: list[str]

    def starts(self, states: dict[str, int]) -> list[str]:
        """Statements that set coefficients 0 of states, by their places."""
        start = of_order(self.texts, "0")
        part = of_used(start)
        return [
            *(f"{start[state]} = 0.0_wp" for state in states),
            *(f"{part[state]} = dy(0, {place}, first:last)" for state, place in states.items()),
        ]

    def of_one_block(self, begin: list[str], body: list[str], last: str) -> Procedure:
        """The procedure, with statements before all orders and of order k."""
        lines = [
            *self.constants,
            *self.base,
            *self.inverses,
            "do first = 1, vectors, lanes",
            *indented(
                [
                    "last = min(vectors, first + lanes - 1)",
                    "used = last - first + 1",
                    *begin,
                    f"do k = 0, {last}",
                    *indented(body),
                    "end do",
                ]
            ),
            "end do",
        ]
        return Procedure(
            *(self.reals, self.arrays, self.integers, lines),
            lanes=self.lanes,
            lane_arrays=self.lane_arrays,
        )


def tangent_parts(model: Model) -> Parts:
    """Coefficients 1 to degree of disturbances from their values."""
    flow = flow_of(model)
    known = {name: flow.graph.known[model.symbol(name)] for name in flow.rates}
    driven = {state: auxiliary for auxiliary, state in flow.integrated.items()}
    rates = {name: node for name, node in flow.rates.items() if name not in driven}
    roots = list(rates.values())
    nodes = in_order(roots, slopes=False)
    constants = Constants(model)
    steps = Disturbances(flow, nodes, roots, constants)
    # of v = exp(w), integrated: v_0 dw_(k+1) = dv_(k+1) - sum over j <= k of v_(k+1-j) dw_j
    shifted = {
        state: steps.total(known[auxiliary], known[state], "k + 1 - j")
        for state, auxiliary in driven.items()
    }
    before, at_order, delayed = lane_inputs(model, steps)
    steps.early += [node for node in known.values() if node not in steps.early]
    rate_lines = [f"d_{name}_rate = {steps.rate_text(node)}" for name, node in rates.items()]
    statements = [*steps.before_loop()], [*steps.after_loop()]
    base, reals, arrays = base_series(model, list(steps.series), flow, constants, "y")
    now = {name: steps.text(node) for name, node in known.items()}
    start, later = of_order(now, "0"), of_order(now, "k + 1")
    body = [
        *at_order,
        *statements[0],
        *steps.loop(),
        *statements[1],
        *rate_lines,
        "step = unit*reciprocal(k + 1)",
        *(f"{later[name]} = step*d_{name}_rate" for name in rates),
        *(
            f"{later[state]} = by_{auxiliary}*({later[auxiliary]} - {shifted[state]})"
            for state, auxiliary in driven.items()
        ),
    ]
    return Parts(
        constants=[*fetch_places(model), *constants.fetched()],
        base=base,
        inverses=[f"by_{one} = 1.0_wp/{one}_series(0)" for one in driven.values()],
        delayed=before,
        other_starts=[
            f"{start[auxiliary]} = {auxiliary}_series(0)*{start[state]}"
            for state, auxiliary in driven.items()
        ],
        body=body,
        texts=now,
        reals=[*constants.scalars(), *reals, *(f"by_{one}" for one in driven.values()), "step"],
        arrays=arrays,
        integers=[*place_names(model), "first", "j", "k", "last", "used"],
        lanes=[
            *(text for text in now.values() if "(" not in text),
            *(f"d_{name}_rate" for name in rates),
            *steps.lane_names(),
        ],
        lane_arrays=[*steps.arrays(), *delayed],
    )


def tangent_series_procedure(model: Model) -> Procedure:
    """Coefficients 1 to degree of disturbances from their values."""
    parts = tangent_parts(model)
    places = {state: place for place, state in enumerate(model.states, 1)}
    later = of_used(of_order(parts.texts, "k + 1"))
    stores = [f"dy(k + 1, {at}, first:last) = {later[state]}" for state, at in places.items()]
    return parts.of_one_block(
        [*parts.delayed, *parts.starts(places), *parts.other_starts],
        [*parts.body, *stores],
        "degree - 1",
    )
