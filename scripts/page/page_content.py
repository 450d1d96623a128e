"""What the page says: figures, equations and claims, each claim in one place."""

import os
import re
from collections.abc import Iterable
from pathlib import Path

from scripts.claims.claims_results import CORRECTED, NOT_REPRODUCED, VERDICTS
from scripts.config.read_config import read as read_yaml
from scripts.page import captions, mathematics
from scripts.results.manifest import is_measured

BLOCK, HERO = "figure_1", "true_torus"
"""The figures of the model and of the findings, at the top of the page."""
FIRST = [NOT_REPRODUCED, CORRECTED]
"""Verdicts of claims that stand first in their group."""
PIXELS = 1.3
"""Pixels of the page for a point of a figure: 7 points are 9 pixels."""
PHONE = 346
"""Pixels of a figure that is seen as a whole on a phone."""
LAST = "Solver"
"""The category of figures that stands at the end: it is not about the paper."""


def relative(path: str) -> str:
    """A file in results/ as the page links to it."""
    return path.removeprefix("results/")


def title_of(figure: str) -> str:
    """The name of a figure in words."""
    return figure.replace("_", " ").capitalize()


def sections(figures: list[dict], claims: list[dict]) -> dict[str, list[dict]]:
    """Figures by category, in order but for the last, each with all that stands beside it.

    A figure is given by its `name`, `category`, `caption` (a file) and `data` (files), by its
    `drawing` (a file) where its size is to be known, and by `shows_classes` where it does.
    """
    grouped = {}
    placed = claims_by_figure(figures, claims)
    for figure in figures:
        section = {
            **described(figure, title_of(figure["name"]), "results"),
            "claims": placed[figure["name"]],
        }
        grouped.setdefault(figure["category"], []).append(section)
    return dict(sorted(grouped.items(), key=lambda item: item[0] == LAST))


def described(figure: dict, title: str, folder: str) -> dict:
    """A figure with its caption and files; links begin in the folder of the page."""
    caption = captions.as_html(figure["caption"])
    first, end, more = caption.partition("</p>")
    measured = is_measured(f"figures/{figure['name']}")
    size = size_of(figure.get("drawing", ""))
    return {
        "name": figure["name"],
        "title": title,
        "caption": first + end,
        "more": more,
        "measured": measured,
        "alternative": captions.first_sentence(caption),
        "data": [os.path.relpath(path, folder) for path in figure["data"]],
        "size": size,
        "fits": bool(size) and size[0] <= PHONE,
        "shows_classes": figure.get("shows_classes", False),
    }


def taken_out(sections: dict[str, list[dict]], name: str) -> dict | None:
    """The figure of this name, which is no longer in its category."""
    for shown in sections.values():
        for figure in shown:
            if figure["name"] == name and not figure["claims"]:
                shown.remove(figure)
                return figure
    return None


def claims_by_figure(figures: list[dict], claims: list[dict]) -> dict[str, list[dict]]:
    """Each claim beside one figure; those that no figure shows under the empty name."""
    placed = {figure["name"]: [] for figure in figures} | {"": []}
    for claim in failing_first(claims):
        placed[figure_of(claim, figures)].append(as_shown(claim))
    return placed


def failing_first(claims: list[dict]) -> list[dict]:
    """The claims in their order, but those that do not hold as printed before the others."""
    return sorted(claims, key=lambda claim: (*FIRST, claim["verdict"]).index(claim["verdict"]))


def size_of(drawing: str | Path) -> tuple[int, int] | None:
    """Width and height of an SVG file on the page, in pixels."""
    if not drawing:
        return None
    found = re.search(r'viewBox="0 0 ([\d.]+) ([\d.]+)"', Path(drawing).read_text())
    return tuple(round(PIXELS * float(points)) for points in found.groups())


def equations(path: str | Path, claims: list[dict]) -> dict:
    """Groups of equations as MathML, and under `NAME_claims` the claims about them."""
    found = {}
    for group, listed in read_yaml(path).items():
        about = [name for equation in listed for name in equation.get("claims", [])]
        found[f"{group}_claims"] = [
            as_shown(claim) for claim in failing_first(claims) if claim["id"] in about
        ]
        found[group] = [
            {
                "number": equation["number"],
                "correct": mathematics.of_latex(equation["correct"], block=True),
                "printed": mathematics.of_latex(equation["printed"], block=True)
                if "printed" in equation
                else "",
            }
            for equation in listed
        ]
    return found


def beside_figures(claims: list[dict], shown: dict) -> list[dict]:
    """The claims that stand neither beside an equation nor below the findings."""
    placed = {
        claim["id"] for name, ones in shown.items() if name.endswith("_claims") for claim in ones
    }
    return [claim for claim in claims if claim["id"] not in placed]


def figure_of(claim: dict, figures: list[dict]) -> str:
    """The figure to look at, or that of the table to look at, by its name; else the paper's own."""
    names = {figure["name"] for figure in figures}
    own = re.search(r"Figure (\d+)", claim["place"])
    candidates = [
        Path(claim["look_at"]).stem.replace("-", "_"),
        f"figure_{own[1]}" if own else "",
    ]
    return next((name for name in candidates if name in names), "")


def as_shown(claim: dict) -> dict:
    """The claim with a link to what it rests on, where that is a table."""
    table = claim["look_at"] if claim["look_at"].endswith(".tsv") else ""
    return {**claim, "table": relative(table)}


def tally(claims: Iterable[dict]) -> dict[str, list[dict]]:
    """Claims by verdict, every verdict in its order."""
    return {v: [claim for claim in claims if claim["verdict"] == v] for v in VERDICTS}


def opening(readme: str) -> str:
    """What the project is about: the paragraph under the title of the README, as HTML."""
    paragraph = re.split(r"\n\s*\n", readme)[1]
    words = " ".join(paragraph.split()).replace("&", "&amp;").replace("<", "&lt;")
    return re.sub(r"\*([^*]+)\*", r"<cite>\1</cite>", words)
