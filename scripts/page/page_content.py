"""What the page says: figures, equations and claims, each claim in one place."""

import json
import os
import re
from pathlib import Path

from scripts.claims.claims_results import CORRECTED, NOT_REPRODUCED
from scripts.files.read_config import read as read_yaml
from scripts.page import captions, mathematics
from scripts.plans.studies import is_measured

FIRST = [NOT_REPRODUCED, CORRECTED]
"""Verdicts of claims that stand first in their group."""
PIXELS = 1.3
"""Pixels of the page for a point of a figure: 7 points are 9 pixels."""
PHONE = 346
"""Pixels of a figure that is seen as a whole on a phone."""
LAST = "Solver"
"""The category of the figures that stand last: they are not about the paper."""


def read_claims(path: str | Path, folder: Path) -> list[dict]:
    """Claims with links to the tables they rest on; links begin in the folder.

    Those that do not hold as printed stand before the others.
    """
    claims = json.loads(Path(path).read_text())
    for claim in claims:
        is_table = claim["look_at"].endswith(".tsv")
        claim["table"] = os.path.relpath(claim["look_at"], folder) if is_table else ""
    return sorted(claims, key=lambda claim: (*FIRST, claim["verdict"]).index(claim["verdict"]))


def describe_figure(figure: dict, folder: Path) -> dict:
    """A figure with its caption, size and files; links begin in the folder.

    It is given by its `name`, `category`, `caption`, `drawing` and `data` (files).
    """
    caption = captions.as_html(figure["caption"])
    first, end, more = caption.partition("</p>")
    size = size_of(figure["drawing"])
    return {
        **figure,
        "title": figure["name"].rpartition("/")[2].replace("_", " ").capitalize(),
        "caption": first + end,
        "more": more,
        "alternative": captions.first_sentence(caption),
        "data": [os.path.relpath(path, folder) for path in figure["data"]],
        "size": size,
        "fits": size[0] <= PHONE,
        "measured": is_measured(f"figures/{figure['name']}"),
    }


def group_figures(figures: list[dict]) -> dict[str, list[dict]]:
    """Figures by category, in order, but for the last category."""
    categories = dict.fromkeys(figure["category"] for figure in figures)
    return {
        category: [figure for figure in figures if figure["category"] == category]
        for category in sorted(categories, key=lambda category: category == LAST)
    }


def figure_of(claim: dict, figures: list[dict]) -> str:
    """Name of the figure beside which a claim stands, empty if there is none.

    It is the figure to look at, or that of the table to look at, or the one that the paper names.
    """
    names = {figure["name"] for figure in figures}
    shown = claim["look_at"].partition("/figures/")[2].removesuffix(".png")
    printed = re.search(r"Figure (\d+)", claim["place"])
    candidates = [
        shown or Path(claim["look_at"]).stem.replace("-", "_"),
        f"figure_{printed[1]}" if printed else "",
    ]
    return next((name for name in candidates if name in names), "")


def size_of(drawing: str | Path) -> tuple[int, int]:
    """Width and height of an SVG file on the page, in pixels."""
    found = re.search(r'viewBox="0 0 ([\d.]+) ([\d.]+)"', Path(drawing).read_text())
    return tuple(round(PIXELS * float(points)) for points in found.groups())


def set_equations(path: str | Path, claims: list[dict]) -> dict[str, list[dict]]:
    """Groups of equations as MathML, and under `NAME_claims` the claims about them."""
    found = {}
    for group, equations in read_yaml(path).items():
        about = [name for equation in equations for name in equation.get("claims", [])]
        found[f"{group}_claims"] = [claim for claim in claims if claim["id"] in about]
        found[group] = [
            {
                key: mathematics.render(equation[key], block=True) if key in equation else ""
                for key in ("correct", "printed")
            }
            | {"number": equation["number"]}
            for equation in equations
        ]
    return found


def opening(readme: str) -> str:
    """What the project is about: the paragraph under the title of the README, as HTML."""
    paragraph = re.split(r"\n\s*\n", readme)[1]
    words = " ".join(paragraph.split()).replace("&", "&amp;").replace("<", "&lt;")
    return re.sub(r"\*([^*]+)\*", r"<cite>\1</cite>", words)
