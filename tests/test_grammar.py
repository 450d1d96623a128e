"""Drawn equations over all that the generator's grammar has, against mpmath.

All forms of a model are compared in quadruple precision, so that rounding hides no wrong digit.
Reference values need nothing but values of the equations as written. `./test long` draws more.
"""

import ctypes
import functools
import itertools
import random
import re
import struct
from contextlib import suppress

import hypothesis.strategies as st
import mpmath as mp
import pytest
from hypothesis import HealthCheck, Phase, given, seed, settings

from generator.compile import compile_module
from generator.definition import read_model
from generator.fortran import FUNCTIONS, SHORT, in_words
from generator.model import ModelError
from generator.module import write_module

DEGREE, VECTORS = 8, 5
"""Of series; disturbances, more than are computed at a time."""
GOOD = 1e-20
"""Allowed error, relative to the largest of the numbers that are compared, or to 1."""
CLOSE = 1e-9
"""Least distance from where an equation is not smooth."""
LARGEST = 25
"""Largest argument of a function; that of a value is its third power."""
PARAMETERS = {"p": 1.3, "κ": 0.7, "lag": 0.9}
LATE = {"a(t - lag)": "a1", "λ(t - lag)": "l1", "a(t - 3/10)": "a2", "λ(t - lag/2)": "l2"}
VARIABLES = ["t", "a", "l", *LATE.values()]
REFERENCES = {**LATE, "v(t - lag)": "exp(l1)", "v": "exp(l)", "λ": "l"}
"""What the text of an equation has, by its order of replacement, and what reference values take."""
NUMBERS = st.one_of(st.integers(1, 9).map(str), st.floats(0.1, 3).map(repr), st.just("1e-3"))
LEAVES = st.sampled_from([*LATE, "v(t - lag)", *"aλvtpκe", "pi", ""]).flatmap(
    lambda name: st.just(name) if name else NUMBERS
)
NARROW = {
    **dict.fromkeys(("asin", "acos", "atanh"), "sin({})/3"),
    **dict.fromkeys(("log", "ln", "log2", "log10", "sqrt", "acosh"), "(1.1 + ({})**2)"),
}
"""Functions that are not defined everywhere, and what their arguments become."""
SWITCHED = {
    **{"abs": abs, "sign": mp.sign, "heaviside": lambda x: (1 + mp.sign(x)) / 2},
    **{"min": min, "max": max},
}
ARGUMENTS = dict.fromkeys(("atan2", "min", "max"), 2) | {"where": 5}
WHERE = "where(not -1 < {} <= {} and t > {} or κ > 1, {}, {})"
EVERY = [*FUNCTIONS, *SHORT, *SWITCHED, "where"]


def called(name: str, *arguments):
    """The value of a function of real arguments of moderate size."""
    if not all(isinstance(one, mp.mpf) and abs(one) <= LARGEST for one in arguments):
        raise ValueError(name)
    if name in SWITCHED:
        if abs(mp.fdot(arguments, (1, -1))) < CLOSE:
            raise ValueError(name)
        return SWITCHED[name](*arguments)
    return mp.log(*arguments, 2) if name == "log2" else getattr(mp, name)(*arguments)


KNOWN = {name: functools.partial(called, name) for name in EVERY}
KNOWN |= {"p": mp.mpf(1.3), "κ": mp.mpf(0.7), "mpf": mp.mpf, "e": mp.e, "pi": mp.pi}
KNOWN["where"] = lambda condition, one, other: one if condition else other


def of(name: str, parts):
    """A function of parts."""
    inside = st.tuples(*[parts] * ARGUMENTS.get(name, 1))
    if name == "where":
        return inside.map(lambda texts: WHERE.format(*texts))
    inside = inside.map(", ".join)
    return inside.map(lambda text: f"{name}({NARROW.get(name, '{}').format(text)})")


def combined(parts):
    """Sums, products, quotients, powers, functions."""
    powers = st.sampled_from(["-3", "-2", "-1", "2", "3", "4", "0.5", "p", "(1/3)", "(-κ)"])
    return st.one_of(
        st.tuples(parts, st.sampled_from("+-*/"), parts).map("({0[0]}) {0[1]} ({0[2]})".format),
        st.tuples(parts, powers).map("({0[0]})**{0[1]}".format),
        st.sampled_from(EVERY).flatmap(lambda name: of(name, parts)),
        parts.map("-({})".format),
    )


PARTS = st.one_of(LEAVES, combined(st.one_of(LEAVES, combined(LEAVES))))


class Case:
    """A model of two equations, and a point at which it is compared."""

    def __init__(self, name: str, texts: list[str], place: int):
        self.name, self.texts, self.draw = name, texts, random.Random(place)
        codes = []
        for text in texts:
            for written, meant in REFERENCES.items():
                text = re.sub(rf"(?<!\w){re.escape(written)}(?!\w)", meant, text)
            codes.append(re.sub(r"(?<![\w.])\d[\d.]*(e-\d+)?", r"mpf('\g<0>')", text))
        bound = re.compile(rf"\b(t|where|{'|'.join(SWITCHED)})\b")
        self.rests = not any(map(bound.search, codes))
        self.functions = [eval(f"lambda {', '.join(VARIABLES)}: {code}", KNOWN) for code in codes]
        self.point = dict(zip(VARIABLES, self.drawn(len(VARIABLES)), strict=True))
        self.rest = {name: self.point[name[0]] for name in VARIABLES}
        for rate in self.rates() + self.rates(**self.rest):
            if not isinstance(rate, mp.mpf) or abs(rate) > LARGEST**3:
                raise ValueError

    def write(self) -> None:
        """Its module, and its delayed states in their order."""
        values = {"name": self.name, "states": {"a": "", "λ": ""}, "auxiliary": {"v": "exp(λ)"}}
        values |= {"parameters": dict.fromkeys(PARAMETERS)}
        values |= {"equations": dict(zip(values["states"], self.texts, strict=True))}
        if self.rests:
            values["steady_state"] = {"near": {"a": 0, "λ": 0}}
        model = read_model(values)
        self.switches = len(model.switches)
        late = [f"{one.state}(t - {one.lag})" for one in model.delayed]
        self.late = [LATE[in_words(text, model.written)] for text in late]
        self.code = write_module(model).replace('"model_', f'"{self.name}_')

    def drawn(self, size: int) -> list:
        """Numbers that are not close to 0, where quotients are large."""
        return [self.draw.choice([-1, 1]) * mp.mpf(self.draw.uniform(0.3, 1)) for _ in range(size)]

    def rates(self, **changes) -> list:
        """The equations where some variables have other values."""
        return [function(**self.point | changes) for function in self.functions]

    def compare(self, what: str, found: list, expected: list) -> None:
        worst = max(abs(a - b) for a, b in zip(found, expected, strict=True))
        worst /= max(1, *map(abs, expected))
        assert worst < GOOD, f"{what} of {self.texts} at {self.point}: error {mp.nstr(worst, 3)}"

    def check(self, library: ctypes.CDLL) -> None:
        """All forms against the equations."""
        names, late, n, count = ["a", "l", *self.late], len(self.late), 2, DEGREE + 1
        shape = struct.pack("<6i8x", n, late, 1, late, 1, n - 1) + quad(0)
        places = struct.pack(f"<{late}i", *range(1, late + 1))
        sides = [0] * self.switches

        def call(name: str, *arguments, results: int = 1) -> list:
            """What a procedure makes of its last arguments; whole numbers are tuples."""
            buffers = []
            for one in arguments:
                stored = struct.pack("<i", *one) if type(one) is tuple else b"".join(map(quad, one))
                buffers.append(ctypes.create_string_buffer(stored, len(stored)))
            parameters = b"".join(map(quad, [*PARAMETERS.values(), *sides]))
            first = [shape, parameters, *[places, b"", b""] * (name != "derivative")]
            getattr(library, f"{self.name}_{name}")(*first, *buffers)
            return numbers(b"".join(one.raw for one in buffers[-results:]))

        t, values = [self.point["t"]], [self.point[name] for name in names]
        y, z = values[:n], values[n:]
        for _ in sides:
            # a side may depend on those before it
            sides = [int(x > 0) for x in call("switching", t, y, z, [0] * self.switches)]
        self.compare("equations", call("rhs", t, y, z, [0] * n), self.rates())
        slopes = [
            mp.diff(lambda x, name=name, i=i: self.rates(**{name: x})[i], self.point[name])
            for name, i in itertools.product(names, range(n))
        ]
        found = call("jacobian", t, y, z, (n,), (n,), [0] * n * n, [0] * n * late, results=2)
        self.compare("Jacobian", found, slopes)
        unit, tails = mp.mpf(0.7), self.drawn(DEGREE * late)
        past = [x for i, one in enumerate(z) for x in (one, *tails[i * DEGREE :][:DEGREE])]
        before = (t, [unit], (DEGREE,), past)
        series = call("series", *before, [x for one in y for x in (one, *[0] * DEGREE)])
        moved = [self.drawn(len(names) * count) for _ in range(VECTORS - 1)]
        # the last of the disturbances is the sum of the others
        moved.append([sum(of_all) for of_all in zip(*moved, strict=True)])
        dz = [x for one in moved for x in one[n * count :]]
        dy = [x * (i % count == 0) for one in moved for i, x in enumerate(one[: n * count])]
        dy = call("tangent_series", *before, series, series, (VECTORS,), dz, dy)
        *parts, last = (dy[i : i + n * count] for i in range(0, len(dy), n * count))
        self.compare("last tangents", last, [sum(of_all) for of_all in zip(*parts, strict=True)])
        whole = columns(series + past)
        beside = columns(parts[0] + moved[0][n * count :])

        def rate(i: int, e, s):
            """An equation, on the series with a share of a disturbance."""
            values = {
                name: mp.polyval(own[::-1], s) + e * mp.polyval(other[::-1], s)
                for name, own, other in zip(names, whole, beside, strict=True)
            }
            return unit * self.rates(t=t[0] + unit * s, **values)[i]

        for order, i in itertools.product((0, 1), range(n)):
            found = [k * x for k, x in enumerate((whole, beside)[order][i])][1:]

            def slope(s, i=i, order=order):
                return mp.diff(lambda e: rate(i, e, s), 0, order)

            self.compare(("series", "tangents")[order], found, mp.taylor(slope, 0, DEGREE - 1))
        for order in (1, 2, 3) if self.rests else ():
            # of each argument the present states, then those of each delayed one
            shifts = [self.drawn(n * (1 + late)) for _ in range(order)]
            places = [
                0,
                1,
                *(n * (1 + k) + "al".index(name[0]) for k, name in enumerate(self.late)),
            ]

            def shifted(i, *e, shifts=shifts, places=places):
                sums = (mp.fdot(e, (one[place] for one in shifts)) for place in places)
                at = {a: self.rest[a] + b for a, b in zip(names, sums, strict=True)}
                return self.rates(**self.rest | at)[i]

            flat = [part for one in shifts for x in one for part in (x, 0)]
            found = call("derivative", y, (late,), (order,), flat, [0] * 2 * n)[::2]
            orders = ((0,) * order, (1,) * order)
            slopes = [mp.diff(functools.partial(shifted, i), *orders) for i in range(n)]
            self.compare(f"form {order}", found, slopes)


def columns(flat: list) -> list[list]:
    """Coefficients of each of several series."""
    return [flat[i : i + DEGREE + 1] for i in range(0, len(flat), DEGREE + 1)]


def quad(number) -> bytes:
    """A number in quadruple precision, as binary128 stores it."""
    mantissa, exponent = mp.frexp(abs(number))
    stored = (exponent + 16381 << 112) + int(mp.nint(mp.ldexp(mantissa, 113))) if number else 0
    return (stored | (number < 0) << 127).to_bytes(16, "little")


def numbers(stored: bytes) -> list:
    """The numbers that are stored so."""
    found = []
    for at in range(0, len(stored), 16):
        bits = int.from_bytes(stored[at : at + 16], "little")
        exponent, rest = bits >> 112 & 0x7FFF, bits & (1 << 112) - 1
        found.append(
            mp.ldexp(rest + ((exponent > 0) << 112), exponent - 16495) * (-1) ** (bits >> 127)
        )
    return found


def case(number: int) -> Case:
    """A model of two of all functions, each in its turn, which can be written and compared."""
    names = [EVERY[(2 * number + i) % len(EVERY)] for i in range(2)]
    equation = [st.tuples(PARTS, of(name, PARTS), combined(LEAVES)) for name in names]
    written = [one.map("({0[0]})*{0[1]} - ({0[2]})".format) for one in equation]
    found: list[Case] = []
    for attempt in itertools.count():

        @seed(1000 * number + attempt)
        @settings(
            max_examples=12,
            database=None,
            deadline=None,
            phases=[Phase.generate],
            suppress_health_check=list(HealthCheck),
        )
        @given(st.tuples(*written), st.integers(0, 2**32))
        def draw(texts, place):
            with suppress(ValueError, OverflowError, ZeroDivisionError, TypeError):
                found.append(Case(f"model_{number}", texts, place))

        draw()
        # the first ones are the simplest
        for one in reversed(found):
            with suppress(ModelError):
                one.write()
                return one


@pytest.mark.parametrize("count", [24, pytest.param(200, marks=pytest.mark.long)])
def test_all_forms_of_drawn_equations(tmp_path, count):
    with mp.workdps(34):
        drawn = list(map(case, range(count)))
        path = tmp_path / "models_quad" / "drawn.so"
        flags = "-O0 -std=f2018 -ffree-line-length-none"
        compile_module("".join(one.code for one in drawn), path, flags=flags)
        for one in drawn:
            one.check(ctypes.CDLL(str(path)))
    assert {(one.rests, one.switches > 0) for one in drawn} == {(0, 0), (0, 1), (1, 0)}
