"""What the page says of each figure: its caption, its files, and the claims it is about."""

import re
from collections.abc import Iterable
from pathlib import Path

from scripts.claims.claims_results import VERDICTS
from scripts.page import captions

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

    A figure is given by its `name`, `category`, `caption` (a file) and `data` (files).
    """
    grouped = {}
    placed = claims_by_figure(figures, claims)
    for figure in figures:
        caption = captions.as_html(figure["caption"])
        section = {
            "name": figure["name"],
            "title": title_of(figure["name"]),
            "caption": caption,
            "alternative": captions.first_sentence(caption),
            "claims": placed[figure["name"]],
            "data": [relative(path) for path in figure["data"]],
        }
        grouped.setdefault(figure["category"], []).append(section)
    return dict(sorted(grouped.items(), key=lambda item: item[0] == LAST))


def claims_by_figure(figures: list[dict], claims: list[dict]) -> dict[str, list[dict]]:
    """Each claim beside one figure; those that no figure shows under the empty name."""
    placed = {figure["name"]: [] for figure in figures} | {"": []}
    for claim in claims:
        placed[figure_of(claim, figures)].append(as_shown(claim))
    return placed


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
