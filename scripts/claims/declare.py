"""Claims, a table in this folder, and their tests, templates in `claims.jinja` of studies.

A row of `claims.tsv` has the keys of a claim of a user's file; a question that the paper does not
ask has no place. A test is a macro of Jinja:

    {#
    uses: [studies.mine.table]
    expected: class
    #}
    {% macro attractor_class(attractors, scene, expected) %}
    {% set own = attractors | of(scene=scene) | first %}
    Scene {{ scene }} ends on the class {{ own.class }}. {{ verdict(own.class == expected) }}
    The motion is of the class {{ own.class }}.
    {% endmacro %}

Its arguments are named as the data that it reads, or as its parameters. Before the verdict stands
the evidence, behind it what is true where the claim does not hold. `verdict(holds, partly=...)` has
a second condition for a claim that holds in part or after a correction. Mathematics stands between
dollars, in plain letters. The comment above all tests is in YAML. It has the modules whose
functions they call, and the kind of each parameter that is not named as its kind: a JSON schema, a
key of `kinds.yaml`, or a section with entries: one `scene`, or several `scenes`.
"""

import csv
import re
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from scripts.files.read_config import parse
from scripts.plans import studies

PAPER, OURS = "the paper", "ours"
"""Whose a claim is; what the user asks has neither."""
PLACE = re.compile(r"(abstract|sections? [1-5]|Figures? [1-8][ab]?)\b")
"""How a place in the paper begins: a part of its text or a figure that it has."""
CLAIMS, KINDS = (Path(__file__).with_name(name) for name in ("claims.tsv", "kinds.yaml"))
HEAD = re.compile(r"{#(.*?)#}", re.DOTALL)
MACRO = re.compile(r"{% macro ([a-z]\w*)\((.*?)\) %}")
"""A test; macros of a name that begins with _ are parts of tests."""


@dataclass(frozen=True)
class Test:
    """A test of claims: its study, modules that it uses, data that it reads, and parameters."""

    study: str
    uses: list[str]
    reads: list[str]
    kinds: dict[str, str | dict]
    """Of each parameter a JSON schema, or the wildcard of a section, with an s for several names"""
    defaults: dict[str, float]

    def names_in(self, kind: str, parameters: dict) -> list[str]:
        """Scenes, planes or routes that the values of the parameters name."""
        found = []
        for key, value in parameters.items():
            if self.kinds[key] in (kind, f"{kind}s"):
                found += [value] if self.kinds[key] == kind else value
        return found


@cache
def tests() -> dict[str, Test]:
    """All tests by name."""
    found = {}
    for path in studies.files_of("claims.jinja"):
        text = path.read_text(encoding="utf-8")
        head = parse(HEAD.match(text)[1], str(path)) if HEAD.match(text) else {}
        head = studies.with_methods(head)
        kinds = studies.values_in(KINDS) | head
        for name, listed in MACRO.findall(text):
            arguments = dict(re.findall(r"(\w+)(?:=([^,]+))?", listed))
            reads = [key for key in arguments if key in studies.data()]
            own = {key: kind_of(key, kinds) for key in arguments if key not in reads}
            defaults = {key: float(value) for key, value in arguments.items() if value}
            found[name] = Test(path.parent.name, head.get("uses", []), reads, own, defaults)
    return found


def kind_of(name: str, kinds: dict[str, str | dict]) -> str | dict:
    """The JSON schema of a kind, or the name of a section, by what stands for what."""
    kind = kinds.get(name, name)
    return kind if isinstance(kind, dict) or kind == name else kind_of(kind, kinds)


def templates() -> list[Path]:
    """Templates of tests, and of what they share."""
    return [CLAIMS.with_name("claims.jinja"), *studies.files_of("claims.jinja")]


def scripts_used() -> list[str]:
    """Scripts whose functions tests call, by their paths in the folder of scripts."""
    modules = {module for test in tests().values() for module in test.uses}
    return [f"{module.replace('.', '/')}.py" for module in sorted(modules)]


@cache
def declared_claims() -> dict[str, dict]:
    """Claims of the paper, and our questions, in the form of a user's file; beside it, `whose`.

    A claim whose test is that of a study that is not there is left out.
    """
    with open(CLAIMS, newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file, delimiter="\t", quoting=csv.QUOTE_NONE))
    tested = parse("\n".join(f"- {row['test']}" for row in rows), str(CLAIMS))
    found = {}
    for row, about in zip(rows, tested, strict=True):
        name, place = row["name"], row["place"]
        if name in found:
            raise ValueError(f"claim '{name}': name taken by another claim")
        if place and not PLACE.match(place):
            raise ValueError(f"claim '{name}': place = '{place}'; expected one of the paper")
        whose = {"whose": PAPER if place else OURS, "place": place or "not in the paper"}
        ((test, given),) = about.items()
        if test == "not_testable":
            found[name] = {**whose, "claim": row["claim"], **about}
        elif test in tests():
            test = {test: {**tests()[test].defaults, **given}}
            found[name] = {**whose, "claim": row["claim"], "test": test, "look_at": row["look_at"]}
    return found
