# SPDX-License-Identifier: BSD-3-Clause
"""Procedures that compute Taylor series of solutions, order by order.

One block alone has its coefficients in scalars. Blocks of a chain are computed in tiles of some
lanes. Coefficient k + 1 of a tile needs coefficient k of its neighbours, so tile i is at order k
when the front is at i + k: a few tiles are computed in turn and stay in the cache. Neighbours are
within a tile or in the next ones.
"""

from .address import Address
from .flow import (
    Procedure,
    exponential_lines,
    flow_of,
    flow_with,
    guard_names,
    input_names,
    refusals,
)
from .fortran import indented
from .graph import in_order
from .model import Model
from .recurrences import Constants, Recurrences
from .slow import Balance, inertia_lines


class Series:
    """The statements of the series of all states, or of those on the slow solution.

    On the slow solution the fast state is not advanced but its balance less v'/rate, with v' as it
    was.
    """

    def __init__(self, model: Model, balance: Balance | None):
        self.model, self.balance, self.at = model, balance, Address(model)
        self.flow = flow_with(model, {}) if balance else flow_of(model)
        self.fast = [balance.state] if balance else []
        self.rates = {name: node for name, node in self.flow.rates.items() if name not in self.fast}
        self.advanced = [state for state in model.states if state in self.rates]
        self.constants = Constants(model)
        roots = list(self.rates.values())
        in_lanes = self.at.in_chain
        self.recurrences = Recurrences(in_order(roots), roots, self.constants, in_lanes=in_lanes)
        self.inertia = inertia_lines(balance, self.constants)
        self.last = "degree" if balance else "degree - 1"

    def before(self) -> list[str]:
        """Statements before all others."""
        return [*self.at.places(), *self.constants.fetched(), *self.inertia]

    def rate_before(self, lane: str) -> list[str]:
        """Statements that set v' times the unit of the iteration before."""
        if not self.balance:
            return []
        v, rate = self.balance.auxiliary, self.at.kept("rate_before", lane, "i - 1")
        return [
            *exponential_lines(
                self.at, v, "y", lambda order: f"{v}_series({order})", self.constants
            ),
            "do i = 1, degree",
            f"   {rate} = i*{v}_series(i)",
            "end do",
        ]

    def balanced(self, order: str, end: str = "") -> list[str]:
        """The statement that sets the fast state, from others whose names have an end."""
        if not self.balance:
            return []
        others = [*self.advanced, *(one.name for one in self.model.differences.values())]
        names = {name: f"{name}{end}" for name in others}
        text = self.balance.text(names, self.constants, whole=order == "0")
        rate = self.at.kept("rate_before", ":" * self.at.in_chain, order)
        return [f"{self.balance.state}{end} = {text} - inertia*{rate}"]

    def integrated_at_0(self) -> list[str]:
        """Statements that set auxiliaries that are integrated."""
        return [f"{name}_0 = exp({state}_0)" for name, state in self.flow.integrated.items()]

    def guards(self) -> list[str]:
        """Statements that end the procedure where equations have no value."""
        equations = {state: self.model.equations[state] for state in self.advanced}
        result, names = "y" if self.fast else "y(1:, :)", guard_names(self.model, "_0")
        return refusals(self.model, equations, names, result, in_lanes=self.at.in_chain)

    def procedure(self, lines: list[str], names: dict[str, list[str]]) -> Procedure:
        """The procedure, with names beside those that all have."""
        slow = bool(self.fast)
        reals = [*self.constants.scalars(), "step", *["by_unit", "inertia"] * slow]
        integers = [*self.at.place_names(), "j", "k", *["i"] * slow]
        names["real(wp)"] = [*reals, "time", "time_0", *names.get("real(wp)", [])]
        names["integer"] = [*integers, *names.get("integer", [])]
        series = [f"{self.balance.auxiliary}_series"] if slow else []
        arrays = "real(wp), dimension(0:degree)"
        return Procedure({**names, arrays: [*series, *names.get(arrays, [])]}, lines)


def series_procedure(model: Model, balance: Balance | None = None) -> Procedure:
    """Coefficients 1 to degree of the states from their values, or those of the slow solution."""
    series = Series(model, balance)
    return of_chain(series) if series.at.in_chain else of_one_block(series)


def of_one_block(series: Series) -> Procedure:
    """Order 0, then a loop over higher orders."""
    model, at, recurrences = series.model, series.at, series.recurrences
    inputs = {node.name for node in recurrences.nodes if node.kind == "input"}

    def given(order: str, end: str) -> list[str]:
        """Statements that set delayed states and time."""
        time = "time_0 = t" if order == "0" else "time = merge(unit, 0.0_wp, k == 1)"
        return [*at.fetched(inputs, order, end=end), *[time] * ("time" in inputs)]

    texts = {name: recurrences.rate_text(node) for name, node in series.rates.items()}
    start = {name: recurrences.rate_text(node, first=True) for name, node in series.rates.items()}
    body = [
        *series.balanced("k"),
        *(f"{at.state('y', 'k', state=state)} = {state}" for state in series.fast),
        *["if (k == degree) exit"] * bool(series.fast),
        *recurrences.at_k(given("k", "")),
        *(f"{name}_rate = {text}" for name, text in texts.items()),
        "step = unit*reciprocal(k + 1)",
        *(f"{name} = step*{name}_rate" for name in texts),
        *(f"{at.state('y', 'k + 1', state=state)} = {state}" for state in series.advanced),
    ]
    lines = [
        *(f"{state}_0 = {at.state('y', '0', state=state)}" for state in series.advanced),
        *series.balanced("0", "_0"),
        *given("0", "_0"),
        *series.guards(),
        *series.integrated_at_0(),
        *recurrences.at_0(),
        *(f"{at.state('y', '0', state=state)} = {state}_0" for state in series.fast),
        "if (degree == 0) return",
        *(f"{name} = unit*({text})" for name, text in start.items()),
        *(f"{at.state('y', '1', state=state)} = {state}" for state in series.advanced),
        f"do k = 1, {series.last}",
        *indented(body),
        "end do",
    ]
    rate_before = series.rate_before("")
    if rate_before:
        lines = [*rate_before, f"{at.kept('rate_before', 'degree')} = 0.0_wp", *lines]
    delayed = [one.symbol.name for one in model.delayed]
    reals = [f"{name}{end}" for name in [*series.flow.rates, *delayed] for end in ("", "_0")]
    return series.procedure(
        [*series.before(), *lines],
        {
            "real(wp)": [*reals, *(f"{name}_rate" for name in texts), *recurrences.scalars],
            "real(wp), dimension(0:degree)": [
                *recurrences.arrays(),
                *["rate_before"] * bool(rate_before),
            ],
        },
    )


def of_chain(series: Series) -> Procedure:
    """Loops over tiles and orders."""
    model, at, recurrences = series.model, series.at, series.recurrences
    delayed = list(enumerate((one.symbol.name for one in model.delayed), 1))
    names = [name for symbol, name in input_names(model).items() if name != "time"]
    integrated = list(series.flow.integrated)

    def each_lane(lines: list[str]) -> list[str]:
        return [
            "do lane = 1, last",
            *indented(["block = first + lane", *at.start(), *lines]),
            "end do",
        ]

    def scattered(order: str, states: list[str]) -> list[str]:
        return each_lane([f"{at.state('y', order, state=one)} = {one}(lane)" for one in states])

    def balanced(order: str) -> list[str]:
        if not series.fast:
            return []
        stored = scattered("k", series.fast)
        return [*series.balanced(order), *stored, "if (k == degree) cycle"]

    # a delayed state without delay is the present one, which may be its balance
    present = [f"if (place_{i} == 0) {name} = {model.delayed[i - 1].state}" for i, name in delayed]
    gathered = [
        *(f"{name} = 0.0_wp" for name in names),
        *each_lane(
            [
                *(f"{one}(lane) = {at.state('y', 'k', state=one)}" for one in series.advanced),
                *at.differences(lambda column: f"y(k, {column})", lane="(lane)"),
                *(
                    f"if (place_{i} > 0) {name}(lane) = {at.delayed('z', 'k', number=i)}"
                    for i, name in delayed
                ),
            ]
        ),
    ]
    rates = {name: recurrences.rate_text(node) for name, node in series.rates.items()}
    start = {name: recurrences.rate_text(node, first=True) for name, node in series.rates.items()}
    rate_before = series.rate_before("lane")
    if rate_before:
        rate_before = ["rate_before(:, :, slot) = 0.0_wp", *each_lane(rate_before)]
    first = [
        *rate_before,
        *balanced("0"),
        *present,
        *(f"{name}_0 = {name}" for name in names),
        *series.guards(),
        *series.integrated_at_0(),
        *recurrences.at_0(),
        *(f"{name}_rate = {text}" for name, text in start.items()),
    ]
    later = [
        *balanced("k"),
        *present,
        *(f"{name} = {name}_next(:, slot)" for name in integrated),
        *recurrences.at_k([]),
        *(f"{name}_rate = {text}" for name, text in rates.items()),
    ]
    kept = [(name, f"{name}_kept(:, slot)") for name in recurrences.kept if name != "time_0"]
    body = [
        "first = lanes*(front - k)",
        "last = min(lanes, self%blocks - first)",
        f"slot = modulo(front - k, {series.last} + 1)",
        "time = merge(unit, 0.0_wp, k == 1)",
        *gathered,
        "if (k == 0) then",
        *indented([*first, *(f"{place} = {name}" for name, place in kept)]),
        "else",
        *indented([*(f"{name} = {place}" for name, place in kept), *later]),
        "end if",
        "step = unit*reciprocal(k + 1)",
        *(f"{state} = step*{state}_rate" for state in series.advanced),
        *(f"{name}_next(:, slot) = step*{name}_rate" for name in integrated),
        *scattered("k + 1", series.advanced),
    ]
    lines = [
        *series.before(),
        *["if (degree == 0) return"] * (not series.fast),
        "time_0 = t",
        "last_tile = (self%blocks - 1)/lanes",
        f"do front = 0, last_tile + {series.last}",
        f"   do k = max(0, front - last_tile), min(front, {series.last})",
        *indented(body, 6),
        "   end do",
        "end do",
    ]
    all_names = [*names, *(f"{name}_0" for name in [*names, *integrated]), *integrated]
    return series.procedure(
        lines,
        {
            "integer": ["at", "block", "first", "front", "lane", "last", "last_tile", "slot"],
            "real(wp), dimension(lanes)": [
                *all_names,
                *(f"{name}_rate" for name in rates),
                *recurrences.scalars,
            ],
            "real(wp), dimension(lanes, 0:degree, 0:degree)": [
                *recurrences.arrays(),
                *["rate_before"] * bool(rate_before),
            ],
            "real(wp), dimension(lanes, 0:degree)": [
                *(f"{name}_kept" for name, _ in kept),
                *(f"{name}_next" for name in integrated),
            ],
        },
    )
