"""Captions of figures: their templates filled with numbers and verdicts."""

import json
from pathlib import Path

from jinja2 import Environment, StrictUndefined

from scripts.claims.claims_results import (
    ANSWERS,
    CORRECTED,
    NOT_REPRODUCED,
    NOT_TESTABLE,
    REPRODUCED,
)
from scripts.drawing.wording import FILTERS
from scripts.files.outputs import logged, written

IN_WORDS = {
    REPRODUCED: "**holds**",
    CORRECTED: "**holds with a correction**",
    NOT_REPRODUCED: "**does not hold**",
    NOT_TESTABLE: "**cannot be tested**",
    **{answer: f"**{answer}**" for answer in ANSWERS.values()},
}
ENVIRONMENT = Environment(
    undefined=StrictUndefined, trim_blocks=True, lstrip_blocks=True, keep_trailing_newline=True
)
ENVIRONMENT.filters |= FILTERS


def render(text: str, claims: list[dict] | None, **numbers) -> str:
    """A template filled in; a number or a claim that is missing is an error.

    `paper` says whether it is a figure of the project's own configuration.
    """
    verdicts = {claim["id"]: IN_WORDS[claim["verdict"]] for claim in claims or []}
    # a run that failed may have no ledger of claims
    verdict = "**was not tested in this run**".format if claims is None else verdicts.__getitem__
    template = ENVIRONMENT.from_string(text)
    return template.render(verdict=verdict, verdicts=verdicts, **numbers)


if __name__ == "__main__":
    with logged(snakemake.log[0]):
        # a user's file may have no claims, and its figures say nothing of them
        path = snakemake.input.claims
        ledger = json.loads(Path(path).read_text()) if path else None
        templates, paper = snakemake.params.templates, snakemake.params.paper
        files = zip(templates, snakemake.input.numbers, snakemake.output, strict=True)
        for template, numbers, target in files:
            text, values = (Path(name).read_text(encoding="utf-8") for name in (template, numbers))
            caption = render(text, ledger, paper=paper, **json.loads(values))
            with written(target) as file:
                file.write_text(caption, encoding="utf-8")
