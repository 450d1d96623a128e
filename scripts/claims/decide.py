"""What a test finds: its template filled with results, the verdict in it, and its words."""

from dataclasses import dataclass
from functools import partial
from importlib import import_module

import numpy as np
from jinja2 import Environment, FileSystemLoader, StrictUndefined

from scripts.claims.claims_results import CORRECTED, NOT_REPRODUCED, REPRODUCED
from scripts.claims.declare import tests
from scripts.claims.filters import FILTERS, short
from scripts.plans import studies

MARK = "\f"
"""What stands before and behind the verdict in a template that is filled in."""


@dataclass
class Finding:
    """What a test says of a claim, and the numbers it rests on, in a sentence."""

    verdict: str
    evidence: str
    instead: str = ""
    """What is true instead, in one sentence, where the claim does not hold as printed."""

    def __post_init__(self) -> None:
        if bool(self.instead) != (self.verdict in (CORRECTED, NOT_REPRODUCED)):
            raise ValueError(f"verdict '{self.verdict}' with this on what is true: {self.instead}")

    @property
    def holds(self) -> bool:
        """Whether the claim holds as printed."""
        return self.verdict == REPRODUCED

    @property
    def partly(self) -> bool:
        """Whether it holds in part or after a correction."""
        return self.verdict == CORRECTED


def verdict(holds, partly=False) -> str:
    """The verdict on a claim that holds as printed, or in part or after a correction, or not."""
    return f"{MARK}{REPRODUCED if holds else CORRECTED if partly else NOT_REPRODUCED}{MARK}"


def in_print(value):
    """What a template writes of a value: of a number four digits, where it asks for no others."""
    return short(value) if isinstance(value, float) else value


ENVIRONMENT = Environment(
    loader=FileSystemLoader(studies.FOLDER.parent), undefined=StrictUndefined, finalize=in_print
)
ENVIRONMENT.filters |= FILTERS
ENVIRONMENT.tests["nan"] = np.isnan
ENVIRONMENT.globals |= {"np": np, "set": set, "verdict": verdict}
SHARED = ENVIRONMENT.get_template("claims/claims.jinja").module
ENVIRONMENT.globals |= {key: macro for key, macro in vars(SHARED).items() if key[0] != "_"}


def find(name: str, results: dict, **parameters) -> Finding:
    """What the test of this name finds in the results, data by name."""
    test = tests()[name]
    known = {"find": partial(find, results=results)}
    for module in test.uses:
        known |= vars(import_module(f"scripts.{module}"))
    template = ENVIRONMENT.get_template(f"studies/{test.study}/claims.jinja")
    macro = getattr(template.make_module(known), name)
    text = macro(**{key: results[key] for key in test.reads}, **parameters)
    evidence, found, instead = (" ".join(part.split()) for part in text.split(MARK))
    return Finding(found, evidence, "" if found == REPRODUCED else instead)
