"""The page of what a user's file adds: index.html in the folder of its results."""

import json
import os
from itertools import groupby
from pathlib import Path

from scripts.files.inputs import read
from scripts.files.outputs import logged
from scripts.files.tsv import read_table
from scripts.page import page_content, page_provenance, page_views
from scripts.page.write_page import rendered, write_files
from scripts.tables.motion_rows import COLOURS


def sections(figures: list[dict], folder: str) -> dict[str, list[dict]]:
    """Figures by category, each with what stands beside it; links begin in the folder.

    A figure is given by its `name`, `category`, `caption` (a file) and `data` (files).
    """
    return {
        category: [section(figure, folder) for figure in of_category]
        for category, of_category in groupby(figures, lambda figure: figure["category"])
    }


def section(figure: dict, folder: str) -> dict:
    """What stands beside one figure."""
    title = figure["name"].partition("/")[2].replace("_", " ")
    described = page_content.described(figure, title, folder)
    return {**described, "alternative": f"{title}: {described['alternative']}", "claims": []}


def judged(path: str | list, folder: str) -> list[dict]:
    """Claims with their verdicts, and links to the tables they rest on."""
    claims = json.loads(Path(path).read_text()) if path else []
    tables = [claim["look_at"] if claim["look_at"].endswith(".tsv") else "" for claim in claims]
    return [
        {**claim, "table": os.path.relpath(table, folder) if table else ""}
        for claim, table in zip(claims, tables, strict=True)
    ]


def content(given, params, folder: str) -> dict:
    """All that the page shows, from the files that the rule gives."""
    claims = judged(given.claims, folder)
    attractors = read_table(given.attractors) if given.attractors else []
    runs = [read(path) for path in given.trajectories]
    data = sorted({path for figure in params.figures for path in figure["data"]})
    return {
        "name": Path(folder).name.replace("_", " "),
        "figures": sections(params.figures, folder),
        "claims": claims,
        "verdicts": page_content.tally(claims),
        "tables": [os.path.relpath(path, folder) for path in given.tables],
        "trajectories": [
            page_views.trajectory(run, attractors) for run in runs if page_views.can_be_drawn(run)
        ],
        "can_play": bool(given.play),
        "colours": COLOURS,
        "history": params.history,
        "commit": params.commit,
        "programs": page_provenance.programs([path for path in data if path.endswith(".nc")]),
        "packages": page_provenance.python_packages(),
    }


if __name__ == "__main__":
    with logged(snakemake.log[0]):
        folder = str(Path(snakemake.output.page).parent)
        text = rendered("own.html.jinja", **content(snakemake.input, snakemake.params, folder))
        write_files({snakemake.output.page: text}, snakemake.output.assets)
