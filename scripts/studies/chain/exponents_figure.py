"""The drawing of exponents of chains, and the numbers of its caption."""

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from scripts.drawing import parameters
from scripts.drawing.style import INK
from scripts.drawing.wording import joined, place_in_words, short
from scripts.models.models import PARAMETERS
from scripts.studies.chain.table import exponents_of

MARKS = ["o", "s", "^", "D", "v", "P"]


def families_of(motions: list[dict]) -> dict[tuple, list[dict]]:
    """Rows of chaotic chains that differ in the number of blocks alone."""
    keys = ("kappa", "ends", *PARAMETERS, "law")
    families: dict[tuple, list[dict]] = {}
    for row in motions:
        families.setdefault(tuple(row[key] for key in keys), []).append(row)
    return {
        place: sorted(rows, key=lambda row: row["blocks"])
        for place, rows in families.items()
        if any(row["positive_exponents"] > 0 for row in rows)
    }


def draw(motions: list[dict]) -> Figure:
    """Exponents over their number divided by that of blocks; positive ones over the blocks."""
    figure, (spectra, counts) = plt.subplots(1, 2, figsize=(6.7, 3.2), width_ratios=[1.3, 1])
    for number, rows in enumerate(families_of(motions).values()):
        colour, mark = f"C{number}", MARKS[number % len(MARKS)]
        shades = np.linspace(1.0, 0.35, len(rows))[::-1]
        for row, shade in zip(rows, shades, strict=True):
            values = exponents_of(row)
            share = (np.arange(len(values)) + 0.5) / row["blocks"]
            spectra.plot(share, values, mark + "-", color=colour, alpha=shade, ms=2.5, lw=0.7)
        words = f"$\\kappa = {parameters.number(rows[0]['kappa'])}$, {parameters.in_words(rows[0])}"
        unclear = [row["unclear_exponents"] for row in rows]
        counts.errorbar(
            [row["blocks"] for row in rows],
            [row["positive_exponents"] for row in rows],
            [[0] * len(rows), unclear],
            fmt=mark + "-",
            color=colour,
            ms=3.5,
            lw=0.7,
            label=words,
        )
    spectra.axhline(0, color=INK, lw=0.5)
    spectra.set(
        xlabel=r"(number of the exponent $-$ 1/2)/blocks", ylabel="exponent (per unit of time)"
    )
    counts.set(xlabel="blocks", ylabel="positive exponents", xlim=(0, None), ylim=(0, None))
    for axis in (counts.xaxis, counts.yaxis):
        axis.set_major_locator(MaxNLocator(5, integer=True))
    for axes, letter in zip((spectra, counts), "ab", strict=True):
        axes.set_title(f"$\\bf{{{letter}}}$")
    figure.legend(loc="outside lower center", ncols=1, fontsize=7)
    return figure


def numbers(motions: list[dict]) -> dict:
    """Motions of all chains, and counts of positive exponents."""
    return {
        "families": [
            {
                "place": place_in_words(rows[0]),
                "kappa": short(rows[0]["kappa"]),
                "counts": joined([count_in_words(row) for row in rows]),
            }
            for rows in families_of(motions).values()
        ],
        "others": [
            f"{name_of(row)} ({row['blocks']:g} blocks, :math:`\\kappa` = {short(row['kappa'])}):"
            f" {row['motion']}"
            for row in motions
            if row["positive_exponents"] == 0
        ],
    }


def count_in_words(row: dict) -> str:
    """Positive exponents, and those that may be by their errors."""
    unclear = f" and {row['unclear_exponents']:g} unclear" if row["unclear_exponents"] else ""
    return f"{row['positive_exponents']:g}{unclear} of {row['blocks']:g} blocks"


def name_of(row: dict) -> str:
    """The name of a chain without the number of its blocks, which stands beside it."""
    return row["chain"].removesuffix(f"_{row['blocks']:g}").replace("_", " ")
