# SPDX-License-Identifier: BSD-3-Clause
"""Procedures that compute Taylor series of small disturbances.

Blocks of a chain are computed one at a time: block i is at order k when the front is at
i + k reach, where neighbours are up to `reach` places apart.
"""

from functools import partial

from .address import Address
from .disturbances import Disturbances, base_series, lane_inputs
from .flow import Procedure, exponential_lines, flow_of, flow_with, integral_of
from .fortran import indented
from .graph import in_order
from .model import Model
from .recurrences import Constants
from .slow import Balance, inertia_lines


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


class Tangents:
    """The statements for disturbances of all states, or of those on the slow solution.

    On the slow solution the disturbance of the fast state is that of its balance less v'/rate.
    """

    def __init__(self, model: Model, balance: Balance | None):
        self.model, self.balance, self.at = model, balance, Address(model)
        self.flow = flow_with(model, {}) if balance else flow_of(model)
        known = self.flow.graph.known
        self.known = {name: known[model.symbol(name)] for name in self.flow.rates}
        self.driven = {state: auxiliary for auxiliary, state in self.flow.integrated.items()}
        """States that follow from integrated auxiliaries."""
        self.fast = [balance.state] if balance else []
        self.advanced = [state for state in model.states if state not in self.fast]
        skipped = (*self.fast, *self.driven)
        self.rates = {name: one for name, one in self.flow.rates.items() if name not in skipped}
        self.constants = Constants(model)
        roots = list(self.rates.values())
        nodes = in_order(roots, slopes=False)
        self.steps = Disturbances(self.flow, nodes, roots, self.constants, self.at)
        # of v = exp(w), integrated: v_0 dw_(k+1) = dv_(k+1) - sum over j <= k of v_(k+1-j) dw_j
        self.shifted = [
            self.steps.total(self.known[auxiliary], self.known[state], "k + 1 - j")
            for state, auxiliary in self.driven.items()
        ]
        self.delayed, self.at_order, self.delayed_arrays = lane_inputs(model, self.steps)
        early = self.steps.early
        early += [node for node in self.known.values() if node not in early]
        self.held = {
            name: self.text(name)
            for name, node in self.known.items()
            if node not in self.steps.stored
        }
        """Disturbances that are in no array."""
        # what follows asks for constants
        self.body = self.of_order_k()
        series = list(self.steps.series)
        self.base = base_series(model, series, self.flow, self.constants)
        self.solution = [*self.exponential(), *self.base.lines]
        self.inertia = inertia_lines(balance, self.constants)
        self.last = "degree" if balance else "degree - 1"

    def text(self, name: str, order: str = "k", lanes: str = ":") -> str:
        """The disturbance of a state or an auxiliary."""
        return self.steps.text(self.known[name], order, lanes)

    def value(self, state: str, order: str) -> str:
        """The coefficients of a state in the result."""
        return self.at.state("dy", order, state=state, rest="first:last")

    def before(self) -> list[str]:
        """Statements before all others."""
        return [*self.at.places(), *self.constants.fetched(), *self.inertia]

    def exponential(self) -> list[str]:
        """Statements that compute the series of v of the iteration before."""
        balance, at = self.balance, self.at
        if not balance:
            return []
        v = balance.auxiliary
        series = partial(at.kept, f"{v}_before")
        return exponential_lines(at, v, "before", series, self.constants)

    def inverses(self) -> list[str]:
        """Statements that set inverses of coefficients 0 of integrated auxiliaries."""
        return [
            f"by_{name} = 1.0_wp/{self.at.kept(f'{name}_series', '0')}"
            for name in self.driven.values()
        ]

    def start(self) -> list[str]:
        """Statements before order 0 of some disturbances."""
        lines = list(self.delayed)
        if self.balance:
            lines += growth_lines(self.model, self.balance, self.at)
        for state in self.advanced:
            lines.append(f"{self.text(state, '0')} = 0.0_wp")
            lines.append(f"{self.text(state, '0', ':used')} = {self.value(state, '0')}")
        for state, auxiliary in self.driven.items():
            series = self.at.kept(f"{auxiliary}_series", "0")
            lines.append(f"{self.text(auxiliary, '0')} = {series}*{self.text(state, '0')}")
        return lines

    def balanced(self) -> list[str]:
        """Statements that set the disturbance of the fast state, of which no others are taken."""
        if not self.balance:
            return []
        names = {name: self.text(name) for name in self.model.states}
        for symbol in self.model.differences.values():
            names[symbol.name] = self.steps.text(self.flow.graph.known[symbol])
        total = self.balance.text(names, self.constants, whole=False)
        state, rate = self.balance.state, self.at.kept("d_rate_before", ":", "k")
        return [
            f"{self.text(state)} = {total} - inertia*{rate}",
            f"{self.value(state, 'k')} = {self.text(state, lanes=':used')}",
            f"if (k == degree) {'cycle' if self.at.in_chain else 'exit'}",
        ]

    def of_order_k(self) -> list[str]:
        """Statements of order k, which set the states of the next one."""
        steps, text = self.steps, self.text
        return [
            *self.balanced(),
            *self.at_order,
            *steps.statements(early=True),
            *steps.loop(),
            *steps.statements(early=False),
            *(f"d_{name}_rate = {steps.rate_text(node)}" for name, node in self.rates.items()),
            "step = unit*reciprocal(k + 1)",
            *(f"{text(name, 'k + 1')} = step*d_{name}_rate" for name in self.rates),
            *(
                f"{text(state, 'k + 1')} = by_{name}*({text(name, 'k + 1')} - {total})"
                for (state, name), total in zip(self.driven.items(), self.shifted, strict=True)
            ),
            *(
                f"{self.value(state, 'k + 1')} = {text(state, 'k + 1', ':used')}"
                for state in self.advanced
            ),
        ]

    def names(self) -> dict[str, list[str]]:
        """Names in all these statements."""
        steps, slow = self.steps, bool(self.balance)
        slots = ", 0:self%reach*degree" if self.at.in_chain else ""
        before = [f"{self.balance.auxiliary}_before"] if slow else []
        reals = [*self.constants.scalars(), *self.base.reals, "step"]
        names = {
            "real(wp)": [*reals, *(f"by_{name}" for name in self.driven.values())],
            "integer": [*self.at.place_names(), "first", "i", "j", "k", "last", "used"],
            "real(wp), dimension(lanes)": [
                *self.held.values(),
                *(f"d_{name}_rate" for name in self.rates),
                *(f"d_{symbol.name}" for symbol in self.model.differences.values()),
                *steps.lane_names(),
            ],
            f"real(wp), dimension(0:degree{slots})": [*self.base.series, *before],
            f"real(wp), dimension(lanes, 0:degree + 1{slots})": [
                *steps.arrays(),
                *self.delayed_arrays,
                *["d_rate_before"] * slow,
            ],
        }
        names["real(wp)"] += ["by_unit", "inertia"] * slow
        names.setdefault("real(wp), dimension(0:degree)", []).extend(self.base.arrays)
        return names


def tangent_series_procedure(model: Model, balance: Balance | None = None) -> Procedure:
    """Coefficients 1 to degree of disturbances from their values, or those of the slow solution."""
    tangents = Tangents(model, balance)
    return of_chain(tangents) if tangents.at.in_chain else of_one_block(tangents)


def of_one_block(tangents: Tangents) -> Procedure:
    """A loop over orders."""
    loop = [f"do k = 0, {tangents.last}", *indented(tangents.body), "end do"]
    lines = [*tangents.solution, *tangents.inverses(), *in_groups([*tangents.start(), *loop])]
    return Procedure(tangents.names(), [*tangents.before(), *lines])


def of_chain(tangents: Tangents) -> Procedure:
    """Loops over blocks and orders."""
    held, last, names = tangents.held, tangents.last, tangents.names()
    loads = []
    for state in tangents.advanced:
        if state in held:
            loads += [f"{held[state]} = 0.0_wp"]
            loads += [f"{held[state]}(:used) = {tangents.value(state, 'k')}"]
    # what is in no vector of states
    own = [name for name in held if name not in tangents.model.states]
    inside = [
        "block = front - self%reach*k + 1",
        *tangents.at.start(),
        f"slot = modulo(block, self%reach*({last}) + 1)",
        "if (k == 0) then",
        *indented([*tangents.solution, *tangents.start()]),
        "else",
        *indented([*loads, *(f"{held[name]} = next_{name}(:, slot)" for name in own)]),
        "end if",
        *disturbed_differences(tangents.steps),
        *tangents.inverses(),
        *tangents.body,
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
    names["real(wp), dimension(lanes, 0:self%reach*degree)"] = [f"next_{name}" for name in own]
    return Procedure(names, [*tangents.before(), *in_groups(lines)])


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
