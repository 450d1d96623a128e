"""All captions: templates of scripts/figures/ filled with the numbers of what is drawn."""

import json
from pathlib import Path

from jinja2 import Environment, StrictUndefined

from scripts.captions import (
    numbers_of_motions,
    numbers_of_own_figures,
    numbers_of_planes,
    numbers_of_solver,
)
from scripts.captions.wording import FILTERS
from scripts.claims.claims_results import CORRECTED, NOT_REPRODUCED, NOT_TESTABLE, REPRODUCED
from scripts.files.outputs import logged, written

NUMBERS = {
    **numbers_of_planes.NUMBERS,
    **numbers_of_motions.NUMBERS,
    **numbers_of_solver.NUMBERS,
    **numbers_of_own_figures.NUMBERS,
}
"""For each caption a function of the figure's input files and settings; others have no numbers."""
IN_WORDS = {
    REPRODUCED: "**holds**",
    CORRECTED: "**holds with a correction**",
    NOT_REPRODUCED: "**does not hold**",
    NOT_TESTABLE: "**cannot be tested**",
}


def caption_of(figure: dict, claims: list[dict]) -> str:
    """The caption of a figure, given by the caption's name and template, and inputs and params."""
    verdicts = {claim["id"]: IN_WORDS[claim["verdict"]] for claim in claims}
    environment = Environment(
        undefined=StrictUndefined, trim_blocks=True, lstrip_blocks=True, keep_trailing_newline=True
    )
    environment.filters |= FILTERS
    numbers = NUMBERS.get(figure["name"], lambda *_: {})(figure["inputs"], figure["params"])
    template = environment.from_string(Path(figure["template"]).read_text(encoding="utf-8"))
    return template.render(**numbers, verdict=verdicts.__getitem__)


if __name__ == "__main__":
    with logged(snakemake.log[0]):
        # figures of a user's file say nothing of claims
        path = snakemake.input.claims
        ledger = json.loads(Path(path).read_text()) if path else []
        for shown, target in zip(snakemake.params.figures, snakemake.output, strict=True):
            caption = caption_of(shown, ledger)
            with written(target) as file:
                file.write_text(caption, encoding="utf-8")
