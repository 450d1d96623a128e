"""The ledger: a verdict on every claim of the paper, by tests of files in results/ alone."""

import json
from pathlib import Path

from jinja2 import Environment, StrictUndefined

from scripts.claims import (
    claims_of_attractors,
    claims_of_bifurcations,
    claims_of_cycles,
    claims_of_events,
    claims_of_formulas,
    claims_of_friction,
    claims_of_routes,
    claims_of_runs,
    claims_of_spectra,
)
from scripts.claims.claims_config import FILES, FILES_OF, named_test
from scripts.claims.claims_results import (
    CORRECTED,
    NOT_REPRODUCED,
    NOT_TESTABLE,
    REPRODUCED,
    Finding,
    Results,
    read_results,
)
from scripts.files.outputs import logged, written
from scripts.files.tsv import write_table
from scripts.page import mathematics
from scripts.page.page_assets import PROJECT

TESTS = {
    **claims_of_formulas.TESTS,
    **claims_of_bifurcations.TESTS,
    **claims_of_attractors.TESTS,
    **claims_of_routes.TESTS,
    **claims_of_cycles.TESTS,
    **claims_of_spectra.TESTS,
    **claims_of_events.TESTS,
    **claims_of_runs.TESTS,
    **claims_of_friction.TESTS,
}
"""Each test by its name in config/claims.yaml."""
TEMPLATE = PROJECT / "page" / "verdicts.html.jinja"
SHOWN = [NOT_REPRODUCED, CORRECTED, REPRODUCED, NOT_TESTABLE]
"""Verdicts in the order of the page: failing claims first."""


def rows_of(claims: dict[str, dict], results: Results, folder: str) -> list[dict]:
    """One row a claim, in the order of the list; the results are in the folder."""
    return [row_of(name, claim, results, folder) for name, claim in claims.items()]


def row_of(name: str, claim: dict, results: Results, folder: str) -> dict:
    """Verdict and evidence of one claim."""
    finding = finding_of(claim, results)
    return {
        "id": name,
        "place": claim["place"],
        "claim": claim["claim"],
        "verdict": finding.verdict,
        "evidence": finding.evidence,
        "instead": finding.instead,
        "look_at": path_of(claim.get("look_at", ""), folder),
    }


def finding_of(claim: dict, results: Results) -> Finding:
    """What the claim's test finds; the reason where there is none."""
    if "not_testable" in claim:
        return Finding(NOT_TESTABLE, claim["not_testable"])
    test, parameters = named_test(claim)
    return TESTS[test](results, **parameters)


def path_of(shown: str, folder: str) -> str:
    """Where the figure or table is."""
    if not shown:
        return ""
    is_table = shown.endswith(".tsv")
    return f"{folder}/tables/{shown}" if is_table else f"{folder}/figures/{shown}.png"


def write_json(path: str | Path, rows: list[dict]) -> None:
    """The rows as JSON; the file is whole or absent."""
    with written(path) as unfinished:
        unfinished.write_text(json.dumps(rows, indent=2) + "\n")


def write_page(path: str | Path, rows: list[dict]) -> None:
    """The rows by verdict, as a page of the report; the file is whole or absent."""
    by_verdict = {verdict: [row for row in rows if row["verdict"] == verdict] for verdict in SHOWN}
    environment = Environment(autoescape=True, trim_blocks=True, undefined=StrictUndefined)
    environment.filters["mathematics"] = mathematics.of_words
    page = environment.from_string(TEMPLATE.read_text())
    with written(path) as unfinished:
        unfinished.write_text(page.render(verdicts=by_verdict) + "\n")


if __name__ == "__main__":
    with logged(snakemake.log[0]):
        files = {name: snakemake.input[name] for name in (*FILES, *FILES_OF, "cycles")}
        folder = str(Path(snakemake.output.tsv).parents[1])
        table = rows_of(snakemake.params.claims, read_results(files), folder)
        write_table(snakemake.output.tsv, table)
        write_json(snakemake.output.json, table)
        write_page(snakemake.output.page, table)
