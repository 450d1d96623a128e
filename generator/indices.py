# SPDX-License-Identifier: BSD-3-Clause
"""The grammar of networks: states and parameters with indices, and sums over all nodes.

The equations are those of a node i. There x[i] and p[i] belong to the node; within sum(j, ...) x[j]
and p[j] belong to another node, and a[i, j] to the edge from it.
"""

import ast
import re

import sympy

from .model import FAR, NEAR, NODE, TIME, Delayed, Sum, of_other
from .network_file import INDEXED

MOST_MATRICES = 8
"""The description of a module has 2**MOST_MATRICES letters for them."""
REFUSED = ("auxiliary", "fast", "domain", "steady_state", "longest_delay", "events", "section")
"""Keys of a definition that a network cannot have."""


def without_indices(reader, values: dict) -> tuple[dict, str]:
    """A definition whose states have no index, and the index; "" of a model without."""
    found = [INDEXED.fullmatch(str(key).strip()) for key in values["equations"]]
    if not any(found):
        return values, ""
    names = {match[2] for match in found if match}
    if not all(match and not match[3] for match in found) or len(names) > 1:
        reader.refuse("equations", ", ".join(values["equations"]), "one index of all states")
    index = names.pop()
    known = [match[1] for match in found]
    if index in {*known, *(values.get("parameters") or {}), "t"}:
        reader.refuse("index", index, "a name that is no state, parameter or t")
    for key in REFUSED:
        if values.get(key):
            reader.refuse(key, values[key], "none of a network")
    own = dict(zip(known, values["equations"].values(), strict=True))
    states = {re.sub(r"\s*\[.*", "", str(key)): text for key, text in values["states"].items()}
    return {**values, "equations": own, "states": states}, index


def take_parameters(reader) -> None:
    """Tell the parameters of nodes and edges from the others, by their indices."""
    model, uses = reader.model, reader.uses
    model.vectors = [one for one in model.parameters if uses.get(one.name) == 1]
    model.matrices = [one for one in model.parameters if uses.get(one.name) == 2]
    model.parameters = [one for one in model.parameters if not uses.get(one.name)]
    if len(model.matrices) > MOST_MATRICES:
        names = ", ".join(one.name for one in model.matrices)
        reader.refuse("parameters with two indices", names, f"at most {MOST_MATRICES}")
    if model.switches:
        reader.refuse("equations", model.switches[0].text, "smooth ones in a network")


def expect_unindexed(expression, node: ast.Name, name: str) -> None:
    """Refuse a state of a network without its index; a parameter is the same for all nodes."""
    model = expression.reader.model
    if model.index and name in model.states:
        expression.refuse(node, f"{name}[{model.index}]")
    use(expression, node, name, 0)


def use(expression, node: ast.AST, name: str, count: int) -> None:
    """Note how many indices a parameter has, always the same number."""
    if expression.reader.uses.setdefault(name, count) != count:
        expression.refuse(node, f"{name} with the same number of indices everywhere")


def indices_of(expression, node: ast.Subscript) -> tuple[str, list[str]]:
    """The name and the indices of x[i] or a[i, j]."""
    match node:
        case ast.Subscript(value=ast.Name(id=name), slice=ast.Name(id=one)):
            return name, [one]
        case ast.Subscript(
            value=ast.Name(id=name), slice=ast.Tuple(elts=[ast.Name(id=one), ast.Name(id=other)])
        ):
            return name, [one, other]
    expression.refuse(node, "NAME[INDEX] or NAME[INDEX, INDEX]")


def is_other(expression, node: ast.Subscript, index: str) -> bool:
    """Whether an index is that of the sum around it, not that of the node."""
    model, bound = expression.reader.model, expression.reader.bound
    if index not in (model.index, bound) or not index:
        known = " or ".join(filter(None, (model.index, bound)))
        expression.refuse(node, f"the index {known}" if known else "no index: states have none")
    return index == bound


def indexed(expression, node: ast.Subscript) -> sympy.Symbol:
    """The symbol of a state or a parameter with its indices."""
    model = expression.reader.model
    name, indices = indices_of(expression, node)
    others = [is_other(expression, node, one) for one in indices]
    symbol = model.symbol(name)
    if name in model.states:
        if len(indices) > 1:
            expression.refuse(node, f"{name} with one index")
    elif name in (one.name for one in model.parameters):
        if len(indices) > 1 and others != [False, True]:
            wanted = f"{name}[{model.index}, INDEX OF A SUM]"
            expression.refuse(node, f"{wanted}: from the second node to the first")
        use(expression, node, name, len(indices))
    else:
        known = [*(one.name for one in model.parameters), *model.states]
        expression.refuse(node, f"one of {', '.join(known)}")
    return of_other(symbol) if others == [True] else symbol


def indexed_before(expression, node, one: ast.Subscript, time: ast.AST) -> sympy.Symbol:
    """The symbol of a state of a node some time ago."""
    model = expression.reader.model
    symbol, lag = indexed(expression, one), TIME - expression.value(time)
    state, (index, *_) = indices_of(expression, one)
    far = index == expression.reader.bound
    moves = lag.free_symbols & model.variables
    if state not in model.states or moves or lag.subs(model.signed).is_nonpositive:
        if lag == 0 and state in model.states:
            return symbol
        expression.refuse(node, "STATE[INDEX](t - DELAY) with a delay >= 0 of parameters")
    uses, names = expression.reader.uses, {one.name for one in lag.free_symbols}
    own = {name for name in names if uses.get(name) == 1}
    of_edge = any(uses.get(name) == 2 for name in names)
    theirs = {of_other(model.symbol(name)): model.symbol(name) for name in uses}
    if far and not of_edge and not own:
        return of_other(delayed(model, state, lag.xreplace(theirs), NODE))
    if not far and not of_edge and not lag.free_symbols & set(theirs):
        return delayed(model, state, lag, NODE)
    return delayed(model, state, lag, FAR if far else NEAR)


def delayed(model, state: str, lag: sympy.Expr, read: str) -> sympy.Symbol:
    """The symbol of a state some time ago, the same for the same time."""
    for one in model.delayed:
        if (one.state, one.lag, one.read) == (state, lag, read):
            return one.symbol
    symbol = sympy.Symbol(f"{state}_delayed_{len(model.delayed) + 1}", real=True)
    model.delayed.append(Delayed(state, lag, symbol, read=read))
    return symbol


def summed(expression, node: ast.Call, args: list[ast.AST]) -> sympy.Symbol:
    """The symbol of a sum over all nodes, the same for the same term."""
    reader = expression.reader
    model = reader.model
    match args:
        case [ast.Name(id=index), term] if not reader.bound and index not in {
            *model.states, *(one.name for one in model.parameters), model.index, "t"
        }:  # fmt: skip
            reader.bound = index
        case _:
            expression.refuse(node, "sum(INDEX, TERM) with a new index, and no sum within it")
    value = expression.value(term)
    reader.bound = ""
    reader.expect_real(expression.place, expression.segment(node), value)
    for one in model.sums:
        if one.term == value:
            return one.symbol
    symbol = sympy.Symbol(f"sum_{len(model.sums) + 1}", real=True)
    model.sums.append(Sum(symbol, value))
    return symbol


def needed_edges(model, sums: list[Sum]) -> str:
    """Which edges take part: for each set of matrices that are 0 there 1, or 0 where all terms are.

    Sets are numbers whose bit k is that of matrix k.
    """
    found = ""
    for which in range(2 ** len(model.matrices)):
        zeros = {
            model.symbol(one.name): sympy.S.Zero
            for place, one in enumerate(model.matrices)
            if which >> place & 1
        }
        found += str(int(any(one.term.subs(zeros) != 0 for one in sums)))
    return found
