"""How a claim is declared: decorators of its test, and the types of the test's parameters.

    @claim(36, "figure_4b", "Figure 4b", look_at="figure_4")
    @says("The block oscillates.")
    @tested_with(scene="oscillation", expected="cycle")
    @reads("attractors")
    def attractor_class(results: Results, *, scene: Scene, expected: Class) -> Finding:

A user's file names the same tests. Words may hold mathematics between dollars, in plain letters
such as `$gamma^2 <= 1e-06$`.
"""

import inspect
import re
from collections.abc import Callable
from dataclasses import dataclass
from typing import Annotated, get_type_hints


@dataclass(frozen=True)
class Names:
    """Type of a parameter: the name of a scene, plane or route, or several names."""

    kind: str
    several: bool = False

    def names_in(self, value: str | list[str]) -> list[str]:
        """All names that a value of the parameter has."""
        return value if self.several else [value]

    def schema(self, known: list[str]) -> dict:
        """What the parameter may be, if these names are known."""
        one = among(f"name of a {self.kind}", known)
        if not self.several:
            return one
        words = f"names of {self.kind}s, at least one, each once"
        return {"type": "array", "minItems": 1, "uniqueItems": True, "items": one} | {
            "description": words
        }


def among(words: str, values: list[str]) -> dict:
    """JSON schema of one of these values."""
    return {"enum": values, "description": words}


def some(words: str, values: list[str]) -> dict:
    """JSON schema of a list of these values."""
    described = {"description": f"{words}, some of: {', '.join(values)}"}
    return {"type": "array", "minItems": 1, "items": among("", values)} | described


def number(words: str, above: float = 0, **bounds: float) -> dict:
    """JSON schema of a number in a range."""
    return {"type": "number", "exclusiveMinimum": above, "description": words, **bounds}


CLASSES = ["fixed point", "cycle", "torus", "3-torus", "chaos"]
"""Classes of attractors."""

Scene = Annotated[str, Names("scene")]
Scenes = Annotated[list[str], Names("scene", several=True)]
Plane = Annotated[str, Names("plane")]
Planes = Annotated[list[str], Names("plane", several=True)]
Route = Annotated[str, Names("route")]
Routes = Annotated[list[str], Names("route", several=True)]
Class = Annotated[str, among("class of an attractor", CLASSES)]
Classes = Annotated[list[str], some("classes of attractors in turn", CLASSES)]
Gamma = Annotated[float, number("gamma, nondimensional")]
Residual = Annotated[float, number("residual allowed, over the largest term", maximum=1e-2)]
Spread = Annotated[float, number("spread up to which the critical epsilon counts as the same")]


@dataclass(frozen=True)
class Test:
    """A test of claims: its function, the data of `Results` that it reads, and its parameters."""

    find: Callable
    reads: tuple[str, ...]
    types: dict[str, Names | dict]
    defaults: dict[str, float]

    def names_in(self, kind: str, parameters: dict) -> list[str]:
        """Scenes, planes or routes that the values of the parameters name."""
        return [
            name
            for key, value in parameters.items()
            if isinstance(self.types[key], Names) and self.types[key].kind == kind
            for name in self.types[key].names_in(value)
        ]


PAPER, OURS = "the paper", "ours"
"""Whose a claim is; what the user asks has neither."""
PLACE = re.compile(r"(abstract|sections? [1-5]|Figures? [1-8][ab]?)\b")
"""How a place in the paper begins: a part of its text or a figure that it has."""
TESTS: dict[str, Test] = {}
"""All tests by the names of their functions."""
_CLAIMS: dict[str, tuple[int, dict]] = {}


def reads(*data: str) -> Callable:
    """Make a function a test that reads these data of `Results`."""

    def register(find: Callable) -> Callable:
        hints = get_type_hints(find, include_extras=True)
        parameters = list(inspect.signature(find).parameters.values())[1:]
        types = {each.name: hints[each.name].__metadata__[0] for each in parameters}
        defaults = {p.name: p.default for p in parameters if p.default is not p.empty}
        TESTS[find.__name__] = Test(find, data, types, defaults)
        return find

    return register


def says(words: str) -> Callable:
    """Give the words of the claim above."""
    return _noting("claim", words)


def tested_with(**parameters) -> Callable:
    """Give the parameters with which the function below tests the claim above."""
    return _noting("parameters", parameters)


def _noting(key: str, value: str | dict) -> Callable:
    """A decorator that keeps a value until the claim above takes it."""

    def note(find: Callable) -> Callable:
        find.__dict__.setdefault("noted", {})[key] = value
        return find

    return note


def claim(number: int, name: str, place: str, *, look_at: str) -> Callable:
    """Declare a claim of the paper; its words, parameters and test stand below.

    The number is its place in the ledger.
    """

    def register(find: Callable) -> Callable:
        noted = find.__dict__.pop("noted")
        parameters = {**TESTS[find.__name__].defaults, **noted.get("parameters", {})}
        test = {find.__name__: parameters}
        _add(name, number, place, {"claim": noted["claim"], "test": test, "look_at": look_at})
        return find

    return register


def question(number: int, name: str, *, look_at: str) -> Callable:
    """Declare a question that the paper does not ask, as a claim otherwise."""
    return claim(number, name, "", look_at=look_at)


def not_testable(number: int, name: str, place: str, words: str, reason: str) -> None:
    """Declare a claim of the paper that no test can decide, and why."""
    _add(name, number, place, {"claim": words, "not_testable": reason})


def _add(name: str, number: int, place: str, about: dict) -> None:
    """Add a claim; raise ValueError if its name or number is taken or its place is none."""
    if name in _CLAIMS or number in (taken for taken, _ in _CLAIMS.values()):
        raise ValueError(f"claim {number} '{name}': name or number taken by another claim")
    if place and not PLACE.match(place):
        raise ValueError(f"claim {number} '{name}': place = '{place}'; expected one of the paper")
    whose = {"whose": PAPER if place else OURS, "place": place or "not in the paper"}
    _CLAIMS[name] = number, whose | about


def declared_claims() -> dict[str, dict]:
    """Claims of the paper, and our questions, that are declared, in the order of their numbers.

    In the form of a user's file; beside it, `whose` they are.
    """
    return {
        name: about for name, (_, about) in sorted(_CLAIMS.items(), key=lambda item: item[1][0])
    }
