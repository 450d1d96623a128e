# SPDX-License-Identifier: BSD-3-Clause
"""A model as its author writes it: parameters, states, equations with delayed states, as text.

Expressions are those of expressions.py.
"""

import ast
import random
import re
import unicodedata
from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path

import sympy
from ruamel.yaml import YAML
from ruamel.yaml.error import YAMLError

from .events import entries_of, read_events
from .expressions import Expression
from .fortran import FUNCTIONS, WORD, in_words
from .indices import take_parameters, without_indices
from .model import TIME, Delayed, Model, ModelError, Observed, Parameter, Switch
from .saturation import limited

NAME = re.compile(r"[A-Za-z][A-Za-z0-9_]{0,47}\Z")
LONGEST_NAME = 48
"""Bytes of a name, which is a letter and then letters, digits and _, in any alphabet."""
RESERVED = {"t", "derivative", "second_difference", *FUNCTIONS} - {"atan2", "erf", "erfc"}
"""Names with a meaning of their own in expressions. Constants and other functions give way to the
names of a definition."""
KEYS = {
    *("name", "about", "kind", "source", "parameters", "states", "auxiliary", "definitions"),
    *("equations", "size", "steady_state", "fast", "domain"),
    *("event", "events", "section", "integral", "coordinates", "longest_delay"),
}
EVENT, SECTION = re.compile(r"(\w+) ?> ?(\S+)"), re.compile(r"(\w+) ?= ?(\S+)")
"""A signal above a level, and one at a level."""
INTEGRAL = re.compile(r"(\w+)( ?\+ ?t)?")
NUMBER = re.compile(r"-?\d+\.?\d*(e[+-]?\d+)?")
TEXTS = ("fast", "event", "section", "integral", "longest_delay")
"""Keys of a text with names."""
LARGEST = 10**308
"""Largest number, and 1/LARGEST is the least."""
TRIALS, DIGITS = 5, 40
"""Values of the parameters at which a steady state is tested, and digits of these tests."""
LONGEST_TEXT, LONGEST_UNIT, LONGEST_EQUATION = 500, 60, 50_000
"""Letters of texts that stand in files of results."""


def read_files(paths: Iterable[Path]) -> Model:
    """The model that files define together: later ones add to earlier ones and replace."""
    whole: dict = {}
    for path in paths:
        try:
            part = YAML(typ="safe", pure=True).load(Path(path).read_text(encoding="utf-8"))
        except (OSError, YAMLError) as problem:
            raise ModelError(f"{path}: {' '.join(str(problem).split())}") from None
        if not isinstance(part, dict):
            raise ModelError(f"{path}: expected keys with values below them")
        whole = overlaid(whole, part)
    return read_model(whole)


def overlaid(whole: dict, part: dict) -> dict:
    """A definition with another over it: sections are joined, None takes an entry away."""
    result = dict(whole)
    for key, value in part.items():
        if isinstance(value, dict) and isinstance(result.get(key), dict):
            entries = {**result[key], **value}
            result[key] = {name: entry for name, entry in entries.items() if entry is not None}
        else:
            result[key] = value
    return result


def near_of(values: dict) -> dict | None:
    """Where the steady state of a definition is looked for, if it is."""
    section = values.get("steady_state")
    near = section.get("near") if isinstance(section, dict) else None
    return near if isinstance(near, dict) else None


def in_ascii(name: str) -> str:
    """A name of Fortran: letters that it has not by the last word of their description."""
    words = [a if a.isascii() else unicodedata.name(a, "x").split()[-1].lower() for a in name]
    return "".join(words).replace("-", "_")


def entries_in_words(section: dict, of_keys: dict[str, str], of_values: dict[str, str]) -> dict:
    """A section with other names."""
    return {in_words(str(k), of_keys): in_words(v, of_values) for k, v in section.items()}


def read_model(values: dict) -> Model:
    """The model of a definition; raise ModelError naming what is wrong with it."""
    name = str(values.get("name", ""))
    if not NAME.match(name):
        raise ModelError(f"name: {name!r}; expected a letter, then letters, digits or _, <= 48")
    return _Reader(name, values).model


class _Reader:
    """Reads the parts of a definition in turn."""

    def __init__(self, name: str, values: dict):
        self.place, self.written = f"model {name}", {}
        if unknown := sorted(set(values) - KEYS):
            self.refuse("keys", ", ".join(unknown), f"only {', '.join(sorted(KEYS))}")
        for key in ("states", "equations"):
            if not isinstance(values.get(key), dict) or not values[key]:
                self.refuse(key, values.get(key), "at least one entry")
        values, index = without_indices(self, values)
        values = self.with_safe_names(values)
        self.uses, self.bound = {}, ""
        self.model = Model(
            name=name,
            index=index,
            written=self.written,
            about=self.line("about", values.get("about", f"The model {name}.")),
            kind=self.line("kind", values.get("kind", "")),
            source=self.line("source", values.get("source", "")),
            parameters=[
                self.parameter(key, entry or {})
                for key, entry in (values.get("parameters") or {}).items()
            ],
            states={str(key): self.line(key, text) for key, text in values["states"].items()},
            auxiliary={},
            texts={},
            definitions={
                str(key): self.line(f"definition of {key}", text)
                for key, text in (values.get("definitions") or {}).items()
            },
            equations={},
        )
        model = self.model
        for key, text in (values.get("auxiliary") or {}).items():
            found = re.match(r"exp\((\w+)\)\Z", str(text).replace(" ", ""))
            if not found or found[1] not in model.states:
                self.refuse(f"auxiliary {key}", text, "exp(STATE)")
            model.auxiliary[str(key)] = found[1]
        self.open: list[str] = []
        if set(values["equations"]) != set(model.states):
            listed = ", ".join(values["equations"])
            self.refuse("equations", listed, f"one for each of {', '.join(model.states)}")
        for state in model.states:
            model.texts[state] = self.line(
                f"equation of {state}", values["equations"][state], LONGEST_EQUATION
            )
            model.equations[state] = self.expression(f"equation of {state}", model.texts[state])
        if index:
            take_parameters(self)
        model.switches += read_events(self, values["events"])
        self.expect_smooth("second_difference", ", ".join(model.differences))
        self.expect_constant("second_difference", ", ".join(model.differences))
        self.read_longest_delay(values.get("longest_delay"))
        self.read_rest(values)
        # a domain has windows of its own
        if not model.domain:
            for state, equation in model.equations.items():
                model.equations[state] = limited(equation, model.variables)
            model.sums = [replace(s, term=limited(s.term, model.variables)) for s in model.sums]
            for place, one in enumerate(model.switches):
                value = limited(one.value, model.variables)
                new = {state: limited(x, model.variables) for state, x in one.changes.items()}
                model.switches[place] = replace(one, value=value, changes=new)

    def refuse(self, what: str, value, expected: str):
        text = f"{self.place}: {what}: {value!r}; expected {expected}"
        raise ModelError(in_words(text, self.written))

    def expect_smooth(self, what: str, value) -> None:
        """Refuse what a model that is not smooth cannot have."""
        if value and (switches := self.model.switches):
            self.refuse(what, value, f"none where the model is not smooth, at {switches[0].text}")

    def expect_constant(self, what: str, value):
        """Refuse what a model with delays that move cannot have."""
        if value and (moving := self.model.moving):
            text = f"none where a delay depends on t or the states: {moving[0].lag}"
            self.refuse(what, value, text)

    def read_longest_delay(self, text) -> None:
        """A bound of the delays that move, which stand last."""
        model = self.model
        model.delayed.sort(key=lambda one: one.moves)
        if text is None:
            return
        if not model.moving:
            self.refuse("longest_delay", text, "none where no delay depends on t or the states")
        model.longest_delay = self.expression("longest_delay", text)
        if model.longest_delay.free_symbols & (model.variables | model.sides):
            self.refuse("longest_delay", text, "an expression of parameters")

    def line(self, what: str, text, longest: int = LONGEST_TEXT) -> str:
        """A text on one line: as a comment of the generated code it must not begin another one."""
        line = " ".join(str(text).split())
        if len(in_words(line, self.written).encode()) > longest:
            self.refuse(what, f"{line[:30]}...", f"at most {longest} letters")
        return line

    def parameter(self, name: str, entry: dict) -> Parameter:
        allowed = {"meaning", "unit", "above", "at_least", "default"}
        if not isinstance(entry, dict) or set(entry) - allowed:
            self.refuse(f"parameter {name}", entry, f"keys of {', '.join(sorted(allowed))}")
        numbers = {key: entry[key] for key in ("above", "at_least", "default") if key in entry}
        for key, value in numbers.items():
            if isinstance(value, bool) or not isinstance(value, int | float):
                self.refuse(f"{key} of parameter {name}", value, "a number")
        return Parameter(
            str(name),
            self.line(f"meaning of {name}", entry.get("meaning", name)),
            self.line(f"unit of {name}", entry.get("unit", "nondimensional"), LONGEST_UNIT),
            **{key: float(value) for key, value in numbers.items()},
        )

    def with_safe_names(self, values: dict) -> dict:
        """The definition with a number and _ after the start of a name: so no other name ends."""
        safe = {}
        for key in ("parameters", "states", "auxiliary", "definitions"):
            for name in map(str, values.get(key) or ()):
                is_name = WORD.fullmatch(name) and len(name.encode()) <= LONGEST_NAME
                if name in safe or name in RESERVED or not is_name:
                    taken = ", ".join([*sorted(RESERVED), *safe])
                    self.refuse("name", name, f"a letter, then letters, digits or _; not {taken}")
                safe[name] = f"{in_ascii(name)[:24]}_{len(safe) + 1}_"
        self.written = {new: old for old, new in safe.items()}
        safe = {new: f"{new}_" for new in self.written} | safe
        said = {**values, **{key: in_words(values.get(key), safe) for key in TEXTS}}
        said["coordinates"] = [
            in_words(str(name), safe) for name in values.get("coordinates") or ()
        ]
        said["events"] = [
            {
                "when": in_words(str(one["when"]), safe),
                "set": entries_in_words(one["set"], safe, safe),
            }
            for one in entries_of(self, values.get("events"))
        ]
        for key, section in values.items():
            if isinstance(section, dict) and key != "events":
                inside = {} if key in ("parameters", "states") else safe
                said[key] = entries_in_words(section, safe, inside)
        if near := near_of(values):
            whole = {**values["steady_state"], "near": entries_in_words(near, safe, safe)}
            said["steady_state"] = whole
        return said

    def read_rest(self, values: dict) -> None:
        """What a definition may leave out."""
        model = self.model
        self.read_steady_state(values)
        fast = values.get("fast")
        self.expect_smooth("fast", fast)
        self.expect_constant("fast", fast)
        if fast is not None and fast not in model.states:
            self.refuse("fast", fast, f"one of the states {', '.join(model.states)}")
        model.fast = fast
        model.observed = self.observed(values)
        for state, window in (values.get("domain") or {}).items():
            if state not in model.states or not isinstance(window, list) or len(window) != 2:
                self.refuse(
                    f"domain of {state}", window, "a state with its least and largest value"
                )
            model.domain[state] = (float(window[0]), float(window[1]))

    def observed(self, values: dict) -> Observed:
        """What is looked at; by default the first state about its value at rest."""
        known = [*self.model.states, *self.model.auxiliary]
        found = Observed(next(iter(self.model.states)))
        for key, pattern, sign in (("event", EVENT, ">"), ("section", SECTION, "=")):
            if (text := values.get(key)) is None:
                continue
            match = pattern.fullmatch(str(text))
            if not match or match[1] not in known or not NUMBER.fullmatch(match[2]):
                self.refuse(key, text, f"NAME {sign} NUMBER with one of {', '.join(known)}")
            if key == "section" and values.get("event") and match[1] != found.signal:
                self.refuse(key, text, f"the name of event, {found.signal}")
            found.signal = match[1]
            setattr(found, key, float(match[2]))
        if (text := values.get("integral")) is not None:
            match = INTEGRAL.fullmatch(str(text))
            if not match or match[1] not in self.model.states:
                self.refuse("integral", text, "STATE or STATE + t")
            found.integral, found.with_time = match[1], bool(match[2])
        found.coordinates = tuple(values["coordinates"])
        own = self.model.auxiliary.get(found.signal, found.signal)
        others = [state for state in self.model.states if state != own]
        if len(found.coordinates) > 2 or set(found.coordinates) - set(others):
            text = ", ".join(found.coordinates)
            self.refuse("coordinates", text, f"at most two of {', '.join(others)}")
        found.coordinates = found.coordinates or tuple(others[:2])
        return found

    def read_steady_state(self, values: dict) -> None:
        """As expressions, which are tested, or where to look for it."""
        model, near, texts = self.model, near_of(values), values.get("steady_state")
        if texts is None:
            return
        self.expect_smooth("steady_state", texts)
        if near and len(texts) > 1:
            self.refuse("steady_state", ", ".join(texts), "near alone")
        texts = near or texts
        if set(texts) != set(model.states):
            self.refuse("steady_state", ", ".join(texts), "a value for each state")
        found = {}
        for state in model.states:
            found[state] = self.expression(f"steady state of {state}", texts[state])
            if found[state].free_symbols & (model.variables | model.sides):
                expected = "an expression of parameters"
                self.refuse(f"steady state of {state}", texts[state], expected)
        model.steady_state = found
        if near:
            model.near = found
            model.steady_state = {state: model.symbol(state) for state in model.states}
        for one in model.moving:
            if model.at_steady_state(one.lag).has(TIME):
                expected = f"none where a delay depends on t at rest: {one.lag}"
                self.refuse("steady_state", ", ".join(texts), expected)
        for state, equation in model.equations.items():
            if equation.has(TIME):
                text = model.texts[state]
                self.refuse(f"equation of {state} with a steady state", text, "no t")
            left = model.at_steady_state(equation)
            if not near and not self.vanishes(left):
                text = f"{model.texts[state]} = {sympy.simplify(left)}"
                self.refuse(f"equation of {state} at the steady state", text, "0")

    def vanishes(self, value: sympy.Expr) -> bool:
        """Whether an expression is 0 at values of the parameters, where it has a real value."""
        draw = random.Random(1)
        terms = sympy.Add.make_args(self.model.plain(value))
        for _ in range(TRIALS):
            at = {}
            for one in self.model.parameters:
                least = one.at_least if one.above is None else one.above
                number = draw.gauss(0, 1) if least is None else least + draw.expovariate(1)
                at[self.model.symbol(one.name)] = sympy.Rational(number)
            found = [term.evalf(DIGITS, subs=at) for term in terms]
            size = 1 + sum(map(sympy.Abs, found))
            is_real = all(one.is_comparable for one in found)
            if is_real and abs(sum(found)) > size * sympy.Rational(10) ** (-DIGITS // 2):
                return False
        return True

    def expression(self, place: str, text) -> sympy.Expr:
        """An expression from its text."""
        try:
            tree = ast.parse(str(text).strip(), mode="eval")
        except (SyntaxError, ValueError):
            if "'" in str(text):
                self.refuse(place, text, "no slope y': an equation with one is neutral")
            self.refuse(place, text, "an expression such as -v*(theta + log(v(t - tau)))")
        value = Expression(self, place, str(text).strip()).value(tree.body)
        self.expect_real(place, text, value)
        return value

    def expect_real(self, place: str, text, value: sympy.Expr) -> None:
        """Refuse what has no value that is a number."""
        sizes = [max(abs(one), abs(1 / one)) for one in value.atoms(sympy.Rational) if one != 0]
        if value.has(sympy.zoo, sympy.nan, sympy.oo) or max(sizes, default=0) > LARGEST:
            self.refuse(place, text, "an expression that is finite")
        for part in value.atoms(sympy.Function, sympy.Pow, sympy.I):
            # SymPy makes abs(a) of sqrt(a**2)
            known = part.is_Pow or part.func in FUNCTIONS.values()
            if not known or (part.is_number and not part.evalf().is_real):
                self.refuse(place, text, "a real expression; abs(a) for sqrt(a**2)")

    def definition(self, name: str) -> sympy.Expr:
        """A named part of the equations."""
        if name in self.open:
            self.refuse("definition", " > ".join([*self.open, name]), "no definition of itself")
        self.open.append(name)
        value = self.expression(f"definition of {name}", self.model.definitions[name])
        self.open.pop()
        return value

    def delayed(self, state: str, lag: sympy.Expr) -> sympy.Symbol:
        """The symbol of a state some time ago, the same for the same time."""
        for one in self.model.delayed:
            if one.state == state and one.lag == lag:
                return one.symbol
        number = len(self.model.delayed) + 1
        symbol = sympy.Symbol(f"{state}_delayed_{number}", real=True)
        moves = bool(lag.free_symbols & self.model.variables)
        self.model.delayed.append(Delayed(state, lag, symbol, moves))
        return symbol

    def side(self, place: str, text: str, value: sympy.Expr) -> sympy.Expr:
        """1 where an expression is > 0, else 0, the same for the same one; 1/2 of the number 0."""
        self.expect_real(place, text, value)
        if value.is_number:
            return (1 + sympy.sign(value)) / 2
        switches = self.model.switches
        for one in switches:
            if value in (one.value, -one.value):
                return one.symbol if value == one.value else 1 - one.symbol
        # no other name of the generated code is like this one
        symbol = sympy.Symbol(f"side_{len(switches) + 1}", real=True)
        switches.append(Switch(value, text, symbol))
        return symbol
