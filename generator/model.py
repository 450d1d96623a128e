# SPDX-License-Identifier: BSD-3-Clause
"""A model in symbols: a system y' = f(t, y, z) with parameters and delayed states."""

from dataclasses import dataclass, field, replace

import sympy

from .fortran import in_words

TIME = sympy.Symbol("t", real=True)
MODE = sympy.Symbol("self%mode", real=True)
"""Of a chain whose blocks move alike: minus a second difference over the state."""


NODE, FAR, NEAR = "node", "far", "near"
"""Delayed values of networks: of each node by its own delays, and, for each edge by its delays, of
the other node or of the node itself."""


class ModelError(ValueError):
    """What is wrong with a definition: what, where, and what is expected."""


@dataclass(frozen=True)
class Parameter:
    """A number that stands in the equations."""

    name: str
    meaning: str
    unit: str = "nondimensional"
    above: float | None = None
    at_least: float | None = None
    default: float | None = None


@dataclass(frozen=True)
class Delayed:
    """A state some time ago."""

    state: str
    lag: sympy.Expr
    symbol: sympy.Symbol
    moves: bool = False
    """Whether the delay depends on t or the states."""
    read: str = NODE
    """Of a network, by whose delays the value of which node is read."""


@dataclass(frozen=True)
class Sum:
    """A sum over all nodes of a network."""

    symbol: sympy.Symbol
    term: sympy.Expr
    """Of what belongs to the node, to the other one, and to the edge between them."""


@dataclass(frozen=True)
class Switch:
    """Where an expression passes 0, and equations are not smooth or the state changes."""

    value: sympy.Expr
    text: str
    """The term, or the event, as written."""
    symbol: sympy.Symbol
    """1 where the expression is > 0, else 0."""
    changes: dict[str, sympy.Expr] = field(default_factory=dict)
    """Of an event, new values of states."""
    direction: int = 0
    """Of an event, 1 where the expression rises, -1 where it falls, 0 for both."""
    said: str = ""
    """Of an event, it and its changes as written."""


def of_other(symbol: sympy.Symbol) -> sympy.Symbol:
    """What the other node of an edge has, by the symbol of the node."""
    return sympy.Symbol(f"{symbol.name}_other", real=True)


@dataclass
class Observed:
    """What is looked at in motions: the signal, a state or an exponential of one; its levels."""

    signal: str
    event: float | None = None
    """An event lasts while the signal is above this; None: above its value at rest."""
    section: float | None = None
    """The section is where the signal rises through this; None: through its value at rest."""
    integral: str | None = None
    """The state that grows by the integral of the signal over an event ..."""
    with_time: bool = False
    """... less the time of the event, or by the integral alone."""
    coordinates: tuple[str, ...] = ()
    """States that are the coordinates of points of the section, at most two."""


@dataclass
class Model:
    """A system y' = f(t, y, z) in symbols."""

    name: str
    about: str
    kind: str
    source: str
    parameters: list[Parameter]
    states: dict[str, str]
    """Meanings by name, in the order of the state vector."""
    auxiliary: dict[str, str]
    """For each name that stands for exp(state), the state."""
    texts: dict[str, str]
    """The equation of each state as written, with definitions filled in by name."""
    definitions: dict[str, str]
    equations: dict[str, sympy.Expr]
    delayed: list[Delayed] = field(default_factory=list)
    """Those whose delay moves stand last."""
    longest_delay: sympy.Expr | None = None
    """Bound of the delays that move, of parameters; None: all of the past is kept."""
    steady_state: dict[str, sympy.Expr] | None = None
    """Of each state an expression of parameters, or its own symbol where it is computed."""
    near: dict[str, sympy.Expr] | None = None
    """Where the computation of the steady state starts."""
    fast: str | None = None
    observed: Observed | None = None
    domain: dict[str, tuple[float, float]] = field(default_factory=dict)
    differences: dict[str, sympy.Symbol] = field(default_factory=dict)
    """Second difference along the chain of each state of which the equations take one."""
    switches: list[Switch] = field(default_factory=list)
    """Events stand last."""
    index: str = ""
    """Of a network, the index of its nodes in the equations of each of them."""
    vectors: list[Parameter] = field(default_factory=list)
    """Parameters that each node of a network has, and those that each edge has."""
    matrices: list[Parameter] = field(default_factory=list)
    sums: list[Sum] = field(default_factory=list)
    written: dict[str, str] = field(default_factory=dict)
    """Names of the definition by those that stand for them here and in the generated code."""

    def symbol(self, name: str) -> sympy.Symbol:
        """The symbol of a parameter, a state or an auxiliary."""
        return sympy.Symbol(name, real=True)

    @property
    def signed(self) -> dict[sympy.Symbol, sympy.Symbol]:
        """For the symbol of each parameter that is never negative one that is known not to be."""
        names = [
            one.name
            for one in self.parameters
            if any(bound is not None and bound >= 0 for bound in (one.above, one.at_least))
        ]
        return {self.symbol(name): sympy.Symbol(name, nonnegative=True) for name in names}

    @property
    def variables(self) -> set[sympy.Symbol]:
        """Symbols that change in time."""
        names = [*self.states, *self.auxiliary]
        others = [*(one.symbol for one in self.delayed), *self.differences.values()]
        known = {*map(self.symbol, names), *others}
        of_others = map(of_other, known) if self.index else ()
        return {TIME, *known, *of_others, *(one.symbol for one in self.sums)}

    @property
    def moving(self) -> list[Delayed]:
        """Delayed states whose delay depends on t or the states."""
        return [one for one in self.delayed if one.moves]

    @property
    def events(self) -> list[Switch]:
        """Switches at which the state changes."""
        return [one for one in self.switches if one.changes]

    @property
    def sides(self) -> set[sympy.Symbol]:
        """Symbols that are constant between two switches."""
        return {one.symbol for one in self.switches}

    def by_state(self, expression: sympy.Expr, state: str) -> sympy.Expr:
        """The derivative by a state, of which auxiliaries are functions."""
        expression = self.plain(expression)
        result = expression.diff(self.symbol(state))
        for name, of in self.auxiliary.items():
            if of == state:
                result += self.symbol(name) * expression.diff(self.symbol(name))
        return result

    def plain(self, expression: sympy.Expr) -> sympy.Expr:
        """An expression without expm1 and log1p, and with the names of exponentials."""
        names = {sympy.exp(self.symbol(w)): self.symbol(v) for v, w in self.auxiliary.items()}
        return sympy.expand_func(expression).xreplace(names)

    def frozen(self) -> "Model":
        """The model whose delays are those at the steady state: the same near it (Cooke and Huang
        1996, Proc. Am. Math. Soc. 124, 1417)."""
        lags = [replace(one, lag=self.at_steady_state(one.lag)) for one in self.delayed]
        return replace(self, delayed=lags) if self.moving else self

    def at_steady_state(self, expression: sympy.Expr) -> sympy.Expr:
        """An expression with all states, now and before, at the steady state."""
        values = {self.symbol(name): value for name, value in self.steady_state.items()}
        for name, state in self.auxiliary.items():
            values[self.symbol(name)] = sympy.exp(self.steady_state[state])
        for one in self.delayed:
            values[one.symbol] = self.steady_state[one.state]
        values |= dict.fromkeys(self.differences.values(), sympy.S.Zero)
        found = expression.subs(values)
        if found.has(sympy.zoo, sympy.nan, sympy.oo):
            where = f"model {self.name}: {expression} at the steady state"
            raise ModelError(in_words(f"{where}: {found}; expected a number", self.written))
        return found
