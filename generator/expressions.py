# SPDX-License-Identifier: BSD-3-Clause
"""The grammar of expressions.

They are read by Python's own parser and never evaluated: a definition cannot run commands.
"""

import ast
import math
import operator as operators

import sympy

from .branches import NAMES, either
from .fortran import CONSTANTS, FUNCTIONS, SHORT
from .indices import expect_unindexed, indexed, indexed_before, summed
from .model import TIME

LARGEST_POWER = 256
"""Largest exponent that is a number: 9**9**9 has more digits than there is memory for."""
LARGEST_LOGARITHM = 700
"""Largest logarithm of a power of numbers: ((9**64)**64)**64 has a million digits."""
OPERATORS = {
    **{ast.Add: operators.add, ast.Sub: operators.sub, ast.Mult: operators.mul},
    **{ast.Div: operators.truediv, ast.Pow: operators.pow},
}
ORDERS = {ast.Lt: "<", ast.LtE: "<=", ast.Gt: ">", ast.GtE: ">="}


class Expression:
    """Turns the parsed text of one expression into symbols."""

    def __init__(self, reader, place: str, text: str):
        self.reader, self.place, self.text = reader, place, text

    def refuse(self, node: ast.AST, expected: str):
        self.reader.refuse(self.place, self.segment(node), expected)

    def value(self, node: ast.AST) -> sympy.Expr:
        match node:
            case ast.Constant(value=int() | float()) if not isinstance(node.value, bool):
                digits = ast.get_source_segment(self.text, node).replace("_", "")
                is_zero = not set("123456789") & set(digits.lower().partition("e")[0])
                if not math.isfinite(float(digits)) or (float(digits) == 0) != is_zero:
                    self.refuse(node, "a number from 1e-308 to 1e308")
                # the decimal digits as written are exact
                return sympy.Rational(digits)
            case ast.Name(id=name):
                return self.named(node, name)
            case ast.UnaryOp(op=ast.USub(), operand=one):
                return -self.value(one)
            case ast.UnaryOp(op=ast.UAdd(), operand=one):
                return self.value(one)
            case ast.BinOp(left=left, op=operator, right=right):
                return self.combined(node, operator, self.value(left), self.value(right))
            case ast.Call(func=ast.Name(id=name), args=args, keywords=[]):
                return self.called(node, name, args)
            case ast.Subscript():
                return indexed(self, node)
            case ast.Call(func=ast.Subscript() as one, args=[time], keywords=[]):
                return indexed_before(self, node, one, time)
        self.refuse(node, "numbers, names, + - * / **, and functions")

    def named(self, node: ast.Name, name: str) -> sympy.Expr:
        model = self.reader.model
        if name == "t":
            return TIME
        if name in model.definitions:
            return self.reader.definition(name)
        known = [*(one.name for one in model.parameters), *model.states, *model.auxiliary]
        if name in known:
            expect_unindexed(self, node, name)
            return model.symbol(name)
        if name in CONSTANTS:
            return CONSTANTS[name]
        self.refuse(node, f"one of {', '.join([*known, *model.definitions])}")

    def combined(self, node, operator, left: sympy.Expr, right: sympy.Expr) -> sympy.Expr:
        if type(operator) not in OPERATORS:
            self.refuse(node, "+ - * / **")
        if isinstance(operator, ast.Pow) and left is not sympy.E:
            if right.free_symbols & self.reader.model.variables:
                self.refuse(node, "a power with a constant exponent; write exp(b*log(a))")
            if right.is_number and abs(right) > LARGEST_POWER:
                self.refuse(node, f"an exponent of size <= {LARGEST_POWER}")
            size = abs(right) * sympy.log(abs(left)) if left.is_number and left != 0 else 0
            if right.is_number and abs(sympy.N(size)) > LARGEST_LOGARITHM:
                self.refuse(node, f"a power below exp({LARGEST_LOGARITHM})")
        return OPERATORS[type(operator)](left, right)

    def called(self, node: ast.Call, name: str, args: list[ast.AST]) -> sympy.Expr:
        model = self.reader.model
        if model.index and name == "sum":
            return summed(self, node, args)
        if name in {*model.states, *model.auxiliary}:
            return self.delayed(node, name, args)
        if name == "derivative" and len(args) == 2 and isinstance(args[1], ast.Name):
            return model.by_state(self.value(args[0]), args[1].id)
        if name == "second_difference":
            return self.second_difference(node, args)
        if name[:1].lower() + name[1:] in NAMES:
            return self.branched(node, name[:1].lower() + name[1:], args)
        known = {**FUNCTIONS, **SHORT}
        if name not in known or len(args) != 1 + (name == "atan2"):
            expected = f"one of {', '.join(known)} of one argument (atan2: 2), {', '.join(NAMES)}"
            self.refuse(node, f"{expected}, or STATE(t - delay): others have no series here")
        argument, *others = map(self.value, args)
        for auxiliary, state in model.auxiliary.items():
            of, value = model.symbol(state), model.symbol(auxiliary)
            if name == "log" and argument == value:
                return of
            if name == "exp" and argument in (of, -of):
                return value ** (1 if argument == of else -1)
        return known[name](argument, *others)

    def branched(self, node: ast.Call, name: str, args: list[ast.AST]) -> sympy.Expr:
        """A function that is smooth on each side of a switch."""
        match name, args:
            case "abs" | "sign", [one]:
                value = self.value(one)
                direction = 2 * self.side(self.segment(node), value) - 1
                return direction * value if name == "abs" else direction
            case "heaviside", [one] | [one, _]:
                return self.side(self.segment(node), self.value(one))
            case "min" | "max", [first, _, *_]:
                texts, found = [self.segment(first)], self.value(first)
                for one in args[1:]:
                    value = self.value(one)
                    texts.append(self.segment(one))
                    above = self.side(f"{name}({', '.join(texts)})", found - value)
                    larger = above if name == "max" else 1 - above
                    found = larger * found + (1 - larger) * value
                return found
            case "where", [condition, one, other]:
                return either(self.condition(condition), self.value(one), self.value(other))
            case "piecewise", [*rest, ast.Tuple(elts=[last, ast.Constant(value=True)])]:
                found = self.value(last)
                for pair in reversed(rest):
                    if not isinstance(pair, ast.Tuple) or len(pair.elts) != 2:
                        self.refuse(pair, "(VALUE, CONDITION)")
                    found = either(self.condition(pair.elts[1]), self.value(pair.elts[0]), found)
                return found
        self.refuse(
            node,
            "abs, sign, heaviside of one argument, min, max of two or more, "
            "where(CONDITION, VALUE, VALUE), Piecewise((VALUE, CONDITION), ..., (VALUE, True))",
        )

    def segment(self, node: ast.AST) -> str:
        """The text of a part."""
        return ast.get_source_segment(self.text, node) or self.text

    def side(self, text: str, value: sympy.Expr) -> sympy.Expr:
        return self.reader.side(self.place, text, value)

    def condition(self, node: ast.AST) -> sympy.Expr:
        """1 where a condition holds, 0 elsewhere."""
        match node:
            case ast.Constant(value=bool()):
                return sympy.Integer(node.value)
            case ast.UnaryOp(op=ast.Not() | ast.Invert(), operand=one):
                return 1 - self.condition(one)
            case ast.BinOp(op=ast.BitAnd() | ast.BitOr(), left=one, right=other):
                return self.joined(node.op, [one, other])
            case ast.BoolOp(op=operator, values=parts):
                return self.joined(operator, parts)
            case ast.Compare(left=first, ops=operators, comparators=others):
                pairs = zip([first, *others], operators, others, strict=False)
                return sympy.Mul(*(self.compared(node, *pair) for pair in pairs))
        self.refuse(node, "a condition of < <= > >=, and, or, not")

    def joined(self, operator, parts: list[ast.AST]) -> sympy.Expr:
        """All conditions, or one of them."""
        found = list(map(self.condition, parts))
        if isinstance(operator, ast.And | ast.BitAnd):
            return sympy.Mul(*found)
        return 1 - sympy.Mul(*(1 - one for one in found))

    def compared(self, node: ast.AST, left: ast.AST, operator, right: ast.AST) -> sympy.Expr:
        """Two numbers in their order."""
        if type(operator) not in ORDERS:
            self.refuse(node, "< <= > >=: motions have exactly this value for no time")
        order = ORDERS[type(operator)]
        text = f"{self.segment(left)} {order} {self.segment(right)}"
        value = self.value(left) - self.value(right)
        if value == 0:
            return sympy.Integer("=" in order)
        return self.side(text, value if ">" in order else -value)

    def delayed(self, node: ast.Call, name: str, args: list[ast.AST]) -> sympy.Expr:
        model = self.reader.model
        lag = TIME - self.value(args[0]) if len(args) == 1 else TIME
        if lag == 0:
            return model.symbol(name)
        # one whose sign depends on the parameters is seen with their values, before a run
        now = {TIME, *map(model.symbol, [*model.states, *model.auxiliary])}
        if lag.free_symbols & (model.variables | model.sides) - now or (
            lag.subs(model.signed).is_nonpositive
        ):
            expected = "a delay >= 0 of numbers, parameters, t and the states at t"
            self.refuse(node, f"{name}(t - DELAY) with {expected}")
        if name in model.auxiliary:
            return sympy.exp(self.reader.delayed(model.auxiliary[name], lag))
        return self.reader.delayed(name, lag)

    def second_difference(self, node: ast.Call, args: list[ast.AST]) -> sympy.Expr:
        model = self.reader.model
        match args:
            case [ast.Name(id=state)] if state in model.states:
                symbol = sympy.Symbol(f"{state}_difference", real=True)
                return model.differences.setdefault(state, symbol)
        self.refuse(node, f"the second difference of one of the states {', '.join(model.states)}")
