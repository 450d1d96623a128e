# SPDX-License-Identifier: BSD-3-Clause
"""Expressions and statements as text of Fortran."""

import re

import sympy
from sympy.codegen.cfunctions import expm1, log1p

FUNCTIONS = {
    **{"exp": sympy.exp, "expm1": expm1, "log": sympy.log, "log1p": log1p, "sqrt": sympy.sqrt},
    **{"sin": sympy.sin, "cos": sympy.cos, "tan": sympy.tan, "atan2": sympy.atan2},
    **{"sinh": sympy.sinh, "cosh": sympy.cosh, "tanh": sympy.tanh},
    **{"asin": sympy.asin, "acos": sympy.acos, "atan": sympy.atan},
    **{"asinh": sympy.asinh, "acosh": sympy.acosh, "atanh": sympy.atanh},
    **{"erf": sympy.erf, "erfc": sympy.erfc},
}
"""The functions that an expression may have, by their names in definitions and in Fortran: all are
analytic, and have series by a recurrence."""
SHORT = {
    "ln": sympy.log,
    "log10": lambda x: sympy.log(x) / sympy.log(10),
    "log2": lambda x: sympy.log(x) / sympy.log(2),
    "sec": lambda x: 1 / sympy.cos(x),
    "csc": lambda x: 1 / sympy.sin(x),
    "cot": lambda x: sympy.cos(x) / sympy.sin(x),
    "sech": lambda x: 1 / sympy.cosh(x),
    "csch": lambda x: 1 / sympy.sinh(x),
    "coth": lambda x: 1 / sympy.tanh(x),
}
"""Names of expressions of these functions."""
CONSTANTS = {"pi": sympy.pi, "e": sympy.E}
DIGITS = 40
"""Of numbers that no short quotient gives: quadruple precision holds 34."""
SUM, PRODUCT, POWER, ATOM = range(4)
"""How tightly the parts of an expression hold together."""
WIDTH = 100
WORD = re.compile(r"(?<!\d\.)\b[^\W\d_]\w*")
"""A name; the e of 2.e-3 is none."""


class within(sympy.Function):  # noqa: N801
    """A number, at most a bound in size, but differentiated as if it were not limited."""

    @classmethod
    def eval(cls, x, bound):
        return x if x.is_number and abs(x) <= bound else None

    def fdiff(self, argindex=1):
        return sympy.S.One


def literal(number: sympy.Rational) -> str:
    """A positive rational number, exact in any kind: digits where these end, else a quotient."""
    rest = number.q
    for prime in (2, 5):
        while rest % prime == 0:
            rest //= prime
    if rest != 1 and is_short(number):
        return f"{number.p}.0_wp/{number.q}.0_wp"
    if rest != 1:
        number = sympy.Rational(str(sympy.Float(number, DIGITS)))
    places = 0
    while (number * 10**places).q != 1:
        places += 1
    digits = str(int(number * 10**places)).rjust(places + 1, "0")
    whole, fraction = digits[: len(digits) - places], digits[len(digits) - places :]
    if len(whole) > 15 or len(fraction) > 15:
        mantissa = digits.strip("0")
        exponent = len(digits.lstrip("0")) - 1 - places
        return f"{mantissa[0]}.{mantissa[1:] or '0'}e{exponent}_wp"
    return f"{whole}.{fraction or '0'}_wp"


def is_short(number: sympy.Rational) -> bool:
    """Whether numerator and denominator are exact in double precision."""
    odd = [one // (one & -one) for one in (number.p, number.q) if one]
    return max(odd) < 2**53 and max(number.p, number.q) < 10**300


def text_of(expression: sympy.Expr, names: dict[sympy.Expr, str] | None = None) -> str:
    """An expression with names in place of some of its parts."""
    return _Printer(names or {}).text(sympy.sympify(expression), SUM)


class _Printer:
    def __init__(self, names: dict[sympy.Expr, str]):
        self.names = names

    def text(self, one: sympy.Expr, within: int) -> str:
        """Text that may stand within a sum, a product, a power."""
        written, holds = self.parts(one)
        return written if holds >= within else f"({written})"

    def parts(self, one: sympy.Expr) -> tuple[str, int]:
        if one in self.names:
            return self.names[one], ATOM
        if one.is_Rational:
            sign = "-" if one < 0 else ""
            written = literal(abs(one))
            return sign + written, SUM if sign else PRODUCT if "/" in written else ATOM
        if one.is_Symbol:
            return one.name, ATOM
        if one.is_Add:
            # a term without a sign first, where there is one
            terms = sorted(one.as_ordered_terms(), key=lambda term: term.could_extract_minus_sign())
            written = self.text(terms[0], SUM)
            for term in terms[1:]:
                if term.could_extract_minus_sign():
                    written += " - " + self.text(-term, PRODUCT)
                else:
                    written += " + " + self.text(term, PRODUCT)
            return written, SUM
        if one.is_Mul:
            return self.product(one)
        if one.is_Pow and one.base is not sympy.E:
            return self.power(one)
        if one is sympy.E:
            return "exp(1.0_wp)", ATOM
        if one is sympy.pi:
            return "acos(-1.0_wp)", ATOM
        if one.func in FUNCTIONS.values() or one.func is within:
            arguments = ", ".join(self.text(argument, SUM) for argument in one.args)
            return f"{one.func.__name__}({arguments})", ATOM
        raise TypeError(f"no Fortran for {one}")

    def product(self, one: sympy.Mul) -> tuple[str, int]:
        above, below = [], []
        sign = ""
        for factor in one.as_ordered_factors():
            if factor.is_Rational:
                if factor < 0:
                    sign, factor = "-", -factor
                if not is_short(factor):
                    above.append(literal(factor))
                    continue
                if factor.p != 1:
                    above.append(literal(sympy.Integer(factor.p)))
                if factor.q != 1:
                    below.append(literal(sympy.Integer(factor.q)))
            elif (
                factor.is_Pow
                and factor.exp.is_Rational
                and factor.exp < 0
                and factor not in self.names
            ):
                below.append(self.text(1 / factor, ATOM if not (1 / factor).is_Pow else POWER))
            else:
                above.append(self.text(factor, POWER))
        written = "*".join(above) or "1.0_wp"
        if len(below) == 1:
            written += "/" + below[0]
        elif below:
            written += "/(" + "*".join(below) + ")"
        return sign + written, SUM if sign else PRODUCT

    def power(self, one: sympy.Pow) -> tuple[str, int]:
        base, exponent = one.base, one.exp
        if exponent.is_Rational and exponent < 0:
            return f"1.0_wp/{self.text(1 / one, POWER)}", PRODUCT
        if exponent == sympy.Rational(1, 2):
            return f"sqrt({self.text(base, SUM)})", ATOM
        written = str(int(exponent)) if exponent.is_Integer else self.text(exponent, ATOM)
        return f"{self.text(base, ATOM)}**{written}", POWER


def wrapped(line: str, width: int = WIDTH) -> list[str]:
    """A statement or comment on some lines, broken at blanks outside of character constants."""
    indent = line[: len(line) - len(line.lstrip())]
    comment = line.lstrip().startswith("!")
    mark = line.lstrip().split(" ")[0] + " " if comment else "   "
    lines = []
    while len(line) > width:
        places = [
            at
            for at, letter in enumerate(line[: width - 1])
            if letter == " "
            and at > len(indent) + 20
            and (comment or line[:at].count('"') % 2 == 0)
        ]
        if not places:
            break
        lines.append(line[: places[-1]] + ("" if comment else " &"))
        line = indent + mark + line[places[-1] + 1 :]
    return [*lines, line]


def indented(lines: list[str], by: int = 3) -> list[str]:
    """Lines further to the right."""
    return [" " * by + line if line else line for line in lines]


def in_words(text, names: dict[str, str]):
    """A text with other names; what is no text is left as it is."""
    if not isinstance(text, str):
        return text
    return WORD.sub(lambda word: names.get(word[0], word[0]), text)
