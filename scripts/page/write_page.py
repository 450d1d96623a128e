"""The page that re-tells the paper: index.html and what it needs beside it, all in results/."""

import json
import shutil
from pathlib import Path

from jinja2 import Environment, FileSystemLoader, StrictUndefined

from scripts.files.inputs import read
from scripts.files.outputs import logged, written
from scripts.files.tsv import read_table
from scripts.page import findings, mathematics, page_content, page_provenance, page_views
from scripts.page.page_assets import ASSETS, PROJECT
from scripts.tables.motion_rows import COLOURS

TEMPLATES = PROJECT / "page"


def rendered(template: str, **values) -> str:
    """The template of this name with the values; a value that is missing is an error."""
    environment = Environment(
        loader=FileSystemLoader(TEMPLATES),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters["mathematics"] = mathematics.of_words
    environment.filters["formula"] = mathematics.of_latex
    return environment.get_template(template).render(**values)


def content(given, params) -> dict:
    """All that the page says, from the files that the rule gives."""
    claims = json.loads(Path(given.claims).read_text())
    equations = page_content.equations(TEMPLATES / "equations.yaml", claims)
    main = [page_content.as_shown(c) for c in claims if c["id"] in findings.MAIN_CLAIMS]
    others = page_content.beside_figures(claims, {**equations, "main_claims": main})
    figures = page_content.sections(params.figures, others)
    names = ("attractors", "fault_limit", "hopf_points", "stability")
    tables = {name: read_table(given[name]) for name in names}
    attractors = tables["attractors"]
    runs = [read(path) for path in given.trajectories]
    data = sorted({path for figure in params.figures for path in figure["data"]})
    return {
        "opening": page_content.opening((PROJECT / "README.md").read_text()),
        "findings": findings.findings(claims, tables),
        "main_claims": main,
        "block": page_content.taken_out(figures, page_content.BLOCK),
        "hero": page_content.taken_out(figures, page_content.HERO),
        "equations": equations,
        "figures": figures,
        "unplaced": page_content.claims_by_figure(params.figures, others)[""],
        "verdicts": page_content.tally(claims),
        "trajectories": [
            page_views.trajectory(run, attractors) for run in runs if page_views.can_be_drawn(run)
        ],
        "history": params.history,
        "colours": COLOURS,
        "commit": params.commit,
        "programs": page_provenance.programs([p for p in data if p.endswith(".nc")]),
        "packages": page_provenance.python_packages(),
        "cited": page_provenance.citation(PROJECT / "CITATION.cff"),
    }


def times(params) -> dict:
    """What was measured on this machine: it has a page of its own, so that two runs give the same
    index.html."""
    figures = page_content.sections(params.figures, [])
    shown = [figure for listed in figures.values() for figure in listed if figure["measured"]]
    return {"figures": shown, "seconds": page_provenance.seconds(params.benchmarks)}


def write_files(texts: dict[str, str], assets: list[str]) -> None:
    """Write pages, by their paths, and what lies beside them."""
    for source, target in zip(ASSETS.values(), assets, strict=True):
        with written(target) as path:
            shutil.copyfile(PROJECT / source, path)
    for target, text in texts.items():
        with written(target) as path:
            path.write_text(text)


if __name__ == "__main__":
    with logged(snakemake.log[0]):
        given, params, output = snakemake.input, snakemake.params, snakemake.output
        page = rendered("index.html.jinja", **content(given, params))
        measured = rendered("times.html.jinja", **times(params))
        write_files({output.page: page, output.times: measured}, output.assets)
