# SPDX-License-Identifier: BSD-3-Clause
"""Where a block has its states and what is kept of it: alone, or at its turn in a chain.

A model is a chain where an equation has the second difference of a state, or a network, whose
nodes are its blocks. The states of blocks stand one after another, so that the Jacobian is banded:
those of a block are behind `at`. Delayed values of a chain are in the same order. What blocks keep
between orders has a slot for each block at work.
"""

from collections.abc import Callable
from dataclasses import dataclass

from .model import Model


@dataclass(frozen=True)
class Address:
    """The elements of arrays that belong to a block of a model."""

    model: Model

    @property
    def in_chain(self) -> bool:
        """Whether the block has others beside it."""
        return bool(self.model.differences or self.model.index)

    def state(self, array: str, *index: str, state: str, rest: str = "") -> str:
        """An element of an array of states."""
        place = list(self.model.states).index(state) + 1
        return element(array, *index, f"at + {place}" if self.in_chain else str(place), rest)

    def delayed(self, array: str, *index: str, number: int, rest: str = "") -> str:
        """An element of an array of delayed values, by the number of the delayed state."""
        before = "(block - 1)*self%delays + " if self.in_chain else ""
        return element(array, *index, f"{before}place_{number}", rest)

    def fetched(self, inputs, *index: str, end: str = "") -> list[str]:
        """Statements that set delayed states among inputs: without its delay one is present."""
        lines = []
        for number, one in enumerate(self.model.delayed, 1):
            if (name := one.symbol.name) in inputs:
                lines.append(f"{name}{end} = {one.state}{end}")
                value = self.delayed("z", *index, number=number)
                lines.append(f"if (place_{number} > 0) {name}{end} = {value}")
        return lines

    def kept(self, array: str, *index: str) -> str:
        """What a block keeps of its own."""
        return element(array, *index, "slot" if self.in_chain else "")

    def slope(self, row: int, state: str, block: str = "block") -> str:
        """An element of the Jacobian, which is banded in a chain."""
        if not self.in_chain:
            return f"by_y({row}, {list(self.model.states).index(state) + 1})"
        column = self.column(state, block)
        return f"by_y(1 + self%upper + (at + {row}) - ({column}), {column})"

    def column(self, state: str, block: str) -> str:
        """The place of a state of a block of a chain."""
        size = len(self.model.states)
        behind = size - 1 - list(self.model.states).index(state)
        return f"{size}*{block}" + (f" - {behind}" if behind else "")

    def start(self) -> list[str]:
        """The statement that sets where the states of a block of a chain are."""
        return [f"at = {len(self.model.states)}*(block - 1)"] if self.in_chain else []

    def differences(self, value: Callable[[str], str], lane: str = "") -> list[str]:
        """Statements that set second differences; a neighbour 0 is the plate, which is at rest."""
        lines = []
        for state, symbol in self.model.differences.items():
            name = f"{symbol.name}{lane}"
            lines.append(f"{name} = -2.0_wp*{state}{lane}")
            for side in ("left", "right"):
                neighbour = f"{side}(block)"
                at = value(self.column(state, neighbour))
                lines.append(f"if ({neighbour} > 0) {name} = {name} + {at}")
        return lines

    def places(self) -> list[str]:
        """Statements that set where the delayed states are."""
        return [f"{name} = place({i})" for i, name in enumerate(self.place_names(), 1)]

    def place_names(self) -> list[str]:
        """Names that these statements set."""
        return [f"place_{number}" for number, _ in enumerate(self.model.delayed, 1)]


def element(array: str, *index: str) -> str:
    """An element of an array; an index without text is left out."""
    return f"{array}({', '.join(filter(None, index))})"


def couplings(model: Model) -> list[tuple[int, int]]:
    """Equations with a second difference, and the state of which they take it, by number."""
    states = list(model.states)
    return [
        (row, states.index(state) + 1)
        for row, equation in enumerate(model.equations.values(), 1)
        for state, symbol in model.differences.items()
        if equation.has(symbol)
    ]
