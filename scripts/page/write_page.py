"""The page of a run: index.html and the files beside it, in its folder of results."""

import platform
import shutil
from pathlib import Path

from jinja2 import Environment, FileSystemLoader, StrictUndefined

from scripts.claims.claims_results import VERDICTS
from scripts.claims.declare import OURS
from scripts.files import marked_words
from scripts.files.outputs import logged, written
from scripts.files.tsv import read_table
from scripts.page import findings, mathematics, page_content, page_provenance
from scripts.page.page_assets import ASSETS, PROJECT, TEMPLATES
from scripts.plans.declare import MAIN
from scripts.tables.motion_rows import COLOURS

BLOCK, HERO = "figure_1", "true_torus"
"""The paper's figures of the model and of the findings, at the top of the page."""


def render(template: str, **values) -> str:
    """The template of this name with the values; a value that is missing is an error."""
    environment = Environment(
        loader=FileSystemLoader(TEMPLATES),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters["mathematics"] = marked_words.to_html
    environment.filters["formula"] = mathematics.render
    return environment.get_template(template).render(**values)


def content(given, params, folder: Path) -> dict:
    """All that the page says, from the files that the rule gives; links begin in the folder."""
    claims = page_content.read_claims(given.claims, folder) if given.claims else []
    paper = {} if params.is_users else content_of_paper(given, claims)
    placed = {claim["id"] for key in paper if key.endswith("_claims") for claim in paper[key]}
    questions = [claim for claim in claims if claim["whose"] == OURS]
    for claim in questions:
        claim["figure"] = page_content.figure_of(claim, params.figures)
    claims = [claim for claim in claims if claim["whose"] != OURS]
    others = [claim for claim in claims if claim["id"] not in placed]
    figures = [page_content.describe_figure(figure, folder) for figure in params.figures]
    beside = {claim["id"]: page_content.figure_of(claim, figures) for claim in others}
    for figure in figures:
        figure["claims"] = [claim for claim in others if beside[claim["id"]] == figure["name"]]
    top = {figure["name"]: figure for figure in figures if paper and not figure["claims"]}
    if paper:
        paper |= {"block": top.get(BLOCK), "hero": top.get(HERO)}
    at_top = [paper.get("block"), paper.get("hero")]
    groups = page_content.group_figures([one for one in figures if one not in at_top])
    sections = {"The paper in its order": groups.pop(MAIN, [])} if paper else groups
    data = {path for figure in params.figures for path in figure["data"] if path.endswith(".nc")}
    return {
        "name": folder.name.replace("_", " "),
        "failed": params.failed,
        "unmade": [path for path in params.unmade if path.endswith((".svg", ".tsv"))],
        "paper": paper,
        "sections": sections,
        "appendices": groups if paper else {},
        "claims": claims,
        "questions": questions,
        "verdicts": {v: sum(claim["verdict"] == v for claim in claims) for v in VERDICTS},
        "unplaced": [claim for claim in others if not beside[claim["id"]]],
        "tables": [str(Path(path).relative_to(folder)) for path in given.tables],
        "atlas": groups["Atlas"][0]["name"] if given.play and "Atlas" in groups else "",
        "history": params.history,
        "colours": COLOURS,
        "commit": params.commit,
        "programs": page_provenance.programs(sorted(data)),
        "packages": {"Python": platform.python_version(), **page_provenance.packages()},
    }


def content_of_paper(given, claims: list[dict]) -> dict:
    """What only the page of the paper has: opening, equations and findings."""
    names = findings.tables_read()
    # a run that failed lacks some
    complete = claims and all(given[name] for name in names)
    tables = {name: read_table(given[name]) for name in names if complete}
    by_id = {claim["id"]: claim for claim in claims}
    return {
        **page_content.set_equations(TEMPLATES / "equations.yaml", claims),
        "opening": page_content.opening((PROJECT / "README.md").read_text()),
        "findings": findings.list_findings(claims, tables) if tables else [],
        "main_claims": [by_id[name] for name in findings.MAIN_CLAIMS if name in by_id],
    }


def write_text(target: str, text: str) -> None:
    """Write a page; it appears only when complete."""
    with written(target) as path:
        path.write_text(text)


if __name__ == "__main__":
    with logged(snakemake.log[0]):
        output = snakemake.output
        shown = content(snakemake.input, snakemake.params, Path(output.page).parent)
        for source, target in zip(ASSETS.values(), output.assets, strict=True):
            with written(target) as path:
                shutil.copyfile(PROJECT / source, path)
        write_text(output.page, render("index.html.jinja", **shown))
