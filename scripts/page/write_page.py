"""The page that re-tells the paper: index.html and what it needs beside it, all in results/."""

import json
import shutil
from pathlib import Path

from jinja2 import Environment, FileSystemLoader, StrictUndefined

from scripts.files.inputs import read
from scripts.files.outputs import logged, written
from scripts.files.tsv import read_table
from scripts.page import findings, mathematics, page_content, page_provenance, page_views
from scripts.tables.motion_rows import COLOURS


def rendered(template: str | Path, **values) -> str:
    """The template with the values; a value that is missing is an error."""
    environment = Environment(
        loader=FileSystemLoader(Path(template).parent),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters["mathematics"] = mathematics.of_words
    environment.filters["formula"] = mathematics.of_latex
    return environment.get_template(Path(template).name).render(**values)


def content(given, params) -> dict:
    """All that the page says, from the files that the rule gives."""
    claims = json.loads(Path(given.claims).read_text())
    equations = page_content.equations(given.equations, claims)
    others = page_content.beside_figures(claims, equations)
    figures = page_content.sections(params.figures, others)
    tables = {name: read_table(given[name]) for name in ("attractors", "hopf_points", "stability")}
    attractors = tables["attractors"]
    runs = [read(path) for path in given.trajectories]
    data = sorted({path for figure in params.figures for path in figure["data"]})
    return {
        "opening": page_content.opening(Path(given.readme).read_text()),
        "findings": findings.findings(claims, tables),
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
        "cited": page_provenance.citation(given.citation),
        "seconds": page_provenance.seconds(params.benchmarks),
    }


def write_files(text: str, assets: list[str], output) -> None:
    """Write the page and what lies beside it."""
    for source, target in zip(assets, output.assets, strict=True):
        with written(target) as path:
            shutil.copyfile(source, path)
    with written(output.page) as path:
        path.write_text(text)


if __name__ == "__main__":
    with logged(snakemake.log[0]):
        text = rendered(snakemake.input.template, **content(snakemake.input, snakemake.params))
        write_files(text, snakemake.input.assets, snakemake.output)
