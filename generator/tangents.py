"""Procedures that compute Taylor series of small disturbances: the derivatives of the recurrences.

    p = a b       dp = a db + b da            e = exp(a)    de = e da
    q = a/b       b dq = da - q db            l = log(a)    a dl = da
    p = a**c      dp = (c p/a) da             f = f(a)      df = g da with its slope g
    v = exp(w), integrated    v dw = dv

Disturbances are computed in lanes, several at a time: the recurrences of one wait for their own
last terms, those of several overlap. One product of each sum is one statement: compilers then keep
the sums in registers.

Blocks of a chain are computed one at a time: block i is at order k when the front is at
i + k reach, where neighbours are up to `reach` places apart.
"""

from dataclasses import dataclass, field

from generator.address import Address
from generator.definition import Model
from generator.flow import Flow, Procedure, exponential_lines, flow_of, flow_with, integral_of
from generator.fortran import indented, text_of
from generator.graph import Node, in_order
from generator.recurrences import Constants, Recurrences, weighted_sum
from generator.slow import Balance


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
        pair = (self.series_text(series, shift), self.text(of, "j"))
        if pair not in self.sums:
            self.sums.append(pair)
        return f"d_total_{self.sums.index(pair) + 1}"

    def times(self, series: Node, of: Node) -> str:
        """The whole sum over j <= k."""
        total = self.total(series, of)
        if of in self.early:
            return total
        return f"{total} + {self.series_text(series, '0')}*{self.text(of)}"

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
                return f"{minus}({above}({self.times(node, b)} + {own}))/{self.series_text(b, '0')}"
            case "exp":
                return self.times(node, a)
            case "log":
                own = self.total(a, node)
                return f"({self.text(a)} - {own})/{self.series_text(a, '0')}"
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
            *(f"{self.text(node)} = 0.0_wp" for node in self.stored if node not in self.early),
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


def base_series(
    model: Model, wanted: list[Node], flow: Flow, constants: Constants
) -> tuple[list[str], list[str], list[str], list[str]]:
    """Statements that compute the series of nodes from those of the states.

    The names that they set are scalars, arrays of one use, and the series.
    """
    at = Address(model)
    given = frozenset(flow.graph.known[model.symbol(name)] for name in model.auxiliary)
    auxiliaries = [node.name for node in given if node in in_order(wanted)]
    lines = [
        line
        for name in auxiliaries
        for line in exponential_lines(
            model,
            name,
            lambda order, state: at.state("y", order, state=state),
            lambda order, name=name: at.kept(f"{name}_series", order),
            constants,
        )
    ]
    reals = ["by_unit"] * any(integral_of(model, name) for name in auxiliaries)
    kept = [f"{name}_series" for name in [*auxiliaries, *(node.name for node in wanted)]]
    rest = [node for node in wanted if node not in given]
    if not rest:
        return lines, reals, [], kept
    # auxiliaries are inputs here
    nodes = in_order(rest, given)
    recurrences = Recurrences([one for one in nodes if one not in given], rest, constants, k="i")
    inputs = {node.name for node in nodes if node.kind == "input" or node in given}
    delayed = [(i, one) for i, one in enumerate(model.delayed, 1) if one.symbol.name in inputs]
    inputs |= {one.state for _, one in delayed}
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
        for number, one in delayed:
            name = f"{one.symbol.name}{end}"
            reals.append(name)
            value = at.delayed("z", order, number=number)
            statements.append(f"{name} = {one.state}{end}")
            statements.append(f"if (place_{number} > 0) {name} = {value}")
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
    return lines, [*reals, *recurrences.scalars], recurrences.arrays(), kept


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
    if "time" in used:
        at_order.append(f"{steps.text(used['time'])} = 0.0_wp")
    return before, at_order, arrays


def growth_lines(model: Model, balance: Balance, at: Address) -> list[str]:
    """Statements that set disturbances of v' of the iteration before."""

    def state(order: str, state: str) -> str:
        return at.state("dy", order, state=state, rest="first:last")

    def rate(order: str, lanes: str = ":used") -> str:
        return at.kept("d_rate_before", lanes, order)

    def series(order: str) -> str:
        return at.kept(f"{balance.auxiliary}_before", order)

    integral = integral_of(model, balance.auxiliary)
    if integral is None:
        lines = [
            "do i = 0, degree - 1",
            "   do j = 0, i + 1",
            f"      {rate('i')} = {rate('i')} + {series('i + 1 - j')}*{state('j', balance.state)}",
            "   end do",
            f"   {rate('i', ':')} = (i + 1)*{rate('i', ':')}",
            "end do",
        ]
    else:
        last = rate("degree - 1")
        lines = [
            "do i = 0, degree - 2",
            f"   {rate('i')} = (by_unit*((i + 1)*(i + 2)))*{state('i + 2', integral[0])}",
            "end do",
            "do j = 0, degree",
            f"   {last} = {last} + degree*{series('degree - j')}*{state('j', balance.state)}",
            "end do",
        ]
    return [f"{rate(':', ':')} = 0.0_wp", *lines]


def tangent_series_procedure(model: Model, balance: Balance | None = None) -> Procedure:
    """Coefficients 1 to degree of disturbances from their values, or of those of the slow solution.

    On the slow solution the disturbance of the fast state is that of its balance less v'/rate.
    """
    at = Address(model)
    flow = flow_with(model, {}) if balance else flow_of(model)
    known = {name: flow.graph.known[model.symbol(name)] for name in flow.rates}
    driven = {state: auxiliary for auxiliary, state in flow.integrated.items()}
    fast = [balance.state] if balance else []
    rates = {name: one for name, one in flow.rates.items() if name not in (*fast, *driven)}
    roots = list(rates.values())
    nodes = in_order(roots, slopes=False)
    constants = Constants(model)
    steps = Disturbances(flow, nodes, roots, constants, at)
    # of v = exp(w), integrated: v_0 dw_(k+1) = dv_(k+1) - sum over j <= k of v_(k+1-j) dw_j
    shifted = {
        state: steps.total(known[auxiliary], known[state], "k + 1 - j")
        for state, auxiliary in driven.items()
    }
    before, at_order, delayed = lane_inputs(model, steps)
    steps.early += [node for node in known.values() if node not in steps.early]

    def text(name: str, order: str = "k", lanes: str = ":") -> str:
        return steps.text(known[name], order, lanes)

    def value(state: str, order: str) -> str:
        return at.state("dy", order, state=state, rest="first:last")

    balanced, exponential, inertia = [], [], []
    if balance:
        names = {name: text(name) for name in model.states}
        names |= {one.name: steps.text(flow.graph.known[one]) for one in model.differences.values()}
        total = balance.text(names, constants, whole=False)
        rate = at.kept("d_rate_before", ":", "k")
        balanced = [f"{text(balance.state)} = {total} - inertia*{rate}"]
        inertia = [f"inertia = {constants.text(1 / balance.rate)}/unit"]
        exponential = exponential_lines(
            model,
            balance.auxiliary,
            lambda order, state: at.state("before", order, state=state),
            lambda order: at.kept(f"{balance.auxiliary}_before", order),
            constants,
        )
    rate_lines = [f"d_{name}_rate = {steps.rate_text(node)}" for name, node in rates.items()]
    body = [
        *balanced,
        *(f"{value(state, 'k')} = {text(state, lanes=':used')}" for state in fast),
        *[f"if (k == degree) {'cycle' if at.in_chain else 'exit'}"] * bool(fast),
        *at_order,
        *steps.before_loop(),
        *steps.loop(),
        *steps.after_loop(),
        *rate_lines,
        "step = unit*reciprocal(k + 1)",
        *(f"{text(name, 'k + 1')} = step*d_{name}_rate" for name in rates),
        *(
            f"{text(state, 'k + 1')} = by_{name}*({text(name, 'k + 1')} - {shifted[state]})"
            for state, name in driven.items()
        ),
    ]
    base, reals, arrays, series = base_series(model, list(steps.series), flow, constants)
    advanced = [state for state in model.states if state not in fast]
    body += [f"{value(state, 'k + 1')} = {text(state, 'k + 1', ':used')}" for state in advanced]
    starts = [
        line
        for state in advanced
        for line in (
            f"{text(state, '0')} = 0.0_wp",
            f"{text(state, '0', ':used')} = {value(state, '0')}",
        )
    ]
    starts += [
        f"{text(auxiliary, '0')} = {at.kept(f'{auxiliary}_series', '0')}*{text(state, '0')}"
        for state, auxiliary in driven.items()
    ]
    growth = growth_lines(model, balance, at) if balance else []
    begin = [*before, *growth, *starts]
    inverses = [f"by_{one} = 1.0_wp/{at.kept(f'{one}_series', '0')}" for one in driven.values()]
    held = {name: text(name) for name, node in known.items() if node not in steps.stored}
    before_all = [*at.places(), *constants.fetched(), *inertia]
    solution = [*exponential, *base]
    last = "degree" if balance else "degree - 1"
    slots = ", 0:self%reach*degree" if at.in_chain else ""
    names = {
        "real(wp)": [*constants.scalars(), *reals, *(f"by_{one}" for one in driven.values())],
        "integer": [*at.place_names(), "first", "i", "j", "k", "last", "used"],
        "real(wp), dimension(lanes)": [
            *held.values(),
            *(f"d_{name}_rate" for name in rates),
            *(f"d_{symbol.name}" for symbol in model.differences.values()),
            *steps.lane_names(),
        ],
        f"real(wp), dimension(0:degree{slots})": [
            *series,
            *([f"{balance.auxiliary}_before"] if balance else []),
        ],
        f"real(wp), dimension(lanes, 0:degree + 1{slots})": [
            *steps.arrays(),
            *delayed,
            *["d_rate_before"] * bool(balance),
        ],
    }
    names["real(wp)"] += ["step", *["by_unit", "inertia"] * bool(balance)]
    names.setdefault("real(wp), dimension(0:degree)", []).extend(arrays)
    if not at.in_chain:
        lines = [*begin, f"do k = 0, {last}", *indented(body), "end do"]
        return Procedure(names, [*before_all, *solution, *inverses, *in_groups(lines)])
    # what is in no vector of states
    own = [name for name in held if name not in model.states]
    loads = [
        *(f"{held[state]} = 0.0_wp" for state in advanced if state in held),
        *(f"{held[state]}(:used) = {value(state, 'k')}" for state in advanced if state in held),
        *(f"{held[name]} = next_{name}(:, slot)" for name in own),
    ]
    inside = [
        "block = front - self%reach*k + 1",
        *at.start(),
        f"slot = modulo(block, self%reach*({last}) + 1)",
        "if (k == 0) then",
        *indented([*solution, *begin]),
        "else",
        *indented(loads),
        "end if",
        *disturbed_differences(steps),
        *inverses,
        *body,
        *(f"next_{name}(:, slot) = {held[name]}" for name in own),
    ]
    lines = [
        f"do front = 0, self%blocks - 1 + self%reach*({last})",
        "   start = max(0, front - self%blocks + self%reach)/self%reach",
        f"   do k = start, min(front/self%reach, {last})",
        *indented(inside, 6),
        "   end do",
        "end do",
    ]
    names["integer"] += ["at", "block", "front", "slot", "start"]
    names[f"real(wp), dimension(lanes{slots})"] = [f"next_{name}" for name in own]
    return Procedure(names, [*before_all, *in_groups(lines)])


def in_groups(lines: list[str]) -> list[str]:
    """Statements for as many disturbances as there are lanes, and again for others."""
    group = ["last = min(vectors, first + lanes - 1)", "used = last - first + 1"]
    return ["do first = 1, vectors, lanes", *indented([*group, *lines]), "end do"]


def disturbed_differences(steps: Disturbances) -> list[str]:
    """Statements that set second differences of disturbances at order k."""
    at, lines = steps.at, []
    for state, symbol in at.model.differences.items():
        known = steps.flow.graph.known
        own, node = steps.text(known[at.model.symbol(state)]), known[symbol]
        part = steps.text(node, lanes=":used")
        lines.append(f"{steps.text(node)} = -(2.0_wp + self%mode)*{own}")
        for side in ("left", "right"):
            value = f"dy(k, {at.column(state, f'{side}(block)')}, first:last)"
            lines.append(f"if ({side}(block) > 0) {part} = {part} + {value}")
    return lines
