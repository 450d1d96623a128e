"""Figure of the true torus beside the paper's: in time, spectrum and section."""

import math
from dataclasses import dataclass

import numpy as np
import xarray as xr
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from scripts.drawing import parameters
from scripts.drawing.spectrum_rows import label_peaks, lines_in_words
from scripts.drawing.style import logged, save
from scripts.drawing.trajectory_rows import draw_velocity
from scripts.files.inputs import read
from scripts.files.tsv import read_table
from scripts.tables.exponents_table import sign

EXPONENTS = (1, 2, 3)
LETTER = 0.0215
"""How wide a letter is, as a share of the axis."""
POINT = 1e-3
"""Maxima that differ by less are one point."""
STYLES = {"point": {"color": "C0", "ms": 5}, "curve": {"color": "C1", "ms": 2}}
"""Of points of the section."""
NUMBERS = {0: "no", 1: "one", 2: "two", 3: "three"}


@dataclass(kw_only=True)
class Scene:
    """What is shown of a scene."""

    trajectory: xr.Dataset
    attractors: xr.Dataset
    spectrum: xr.Dataset
    row: dict
    """Of the table of attractors, from the scene's own history."""


def draw(scenes: dict[str, Scene], end_shown: float, frequency_shown: float) -> Figure:
    """Scenes a, b, ...: v(t) and its spectrum; at the end the section of all.

    One panel a row, so that the figure is as narrow as a telephone.
    """
    figure, panels = plt.subplots(
        2 * len(scenes) + 1,
        1,
        figsize=(3.6, 3.1 * len(scenes) + 2.0),
        height_ratios=[1, 1] * len(scenes) + [1.7],
    )
    section = panels[-1]
    for i, (label, scene) in enumerate(scenes.items()):
        velocity, spectrum = panels[2 * i : 2 * i + 2]
        last = float(scene.trajectory.t[-1])
        draw_velocity(velocity, scene.trajectory, max(0.0, last - end_shown), last)
        velocity.set_title(f"$\\bf{{{label}}}$  {words(scene)}")
        draw_spectrum(spectrum, scene.spectrum, frequency_shown)
        draw_section(section, scene.attractors, label)
        for panel, first in ((velocity, panels[0]), (spectrum, panels[1])):
            if i > 0:
                panel.sharey(first)
    section.set_title("section: successive maxima of $v$")
    section.set(xlabel="maximum of $v$", ylabel="next maximum", aspect="equal")
    section.legend(loc="upper left", bbox_to_anchor=(1, 1))
    return figure


def words(scene: Scene) -> str:
    """Scene, parameters, class, and the leading exponents with their standard errors."""
    row = scene.row
    bounds = scene.attractors.sign_bound.values[0]
    there = [i for i in EXPONENTS if not math.isnan(row[f"exponent_{i}"])]
    pairs = [(row[f"exponent_{i}"], row[f"error_{i}"]) for i in there]
    zeros = sum(sign(row[f"exponent_{i}"], bounds[i - 1]) == "zero" for i in there)
    each = [f"$\\lambda_{i}$ = {with_error(*pair)}" for i, pair in zip(there, pairs, strict=True)]
    name = row["scene"].replace("_", " ")
    return (
        f"scene {name}: {row['class']}, {NUMBERS[zeros]} zero exponent{'' if zeros == 1 else 's'}"
        f"\n{parameters.in_words(scene.trajectory.attrs)}\n{', '.join(each[:2])}"
        f"\n{', '.join(each[2:])}"
    )


def with_error(value: float, error: float) -> str:
    """A number with its error, in the same power of ten, to the first digits of the error.

    The zero exponent of a flow has no error.
    """
    if value == error == 0:
        return "0"
    largest = max(abs(value), error)
    power = math.floor(math.log10(largest)) if largest > 0 else 0
    finest = math.floor(math.log10(error)) if error > 0 else power - 2
    digits = power - finest + (1 if power == finest else 0)
    number, bar = (round(x / 10.0**power, digits) + 0.0 for x in (value, error))
    scaled = parameters.true_minus(f"{number:.{digits}f} ± {bar:.{digits}f}")
    return f"({scaled})$\\times 10^{{{power}}}$" if power else scaled


def draw_spectrum(axes: Axes, spectrum: xr.Dataset, frequency_shown: float) -> None:
    """The power spectral density with its peaks named."""
    shown = spectrum.sel(frequency=slice(spectrum.frequency[1], frequency_shown))
    axes.semilogy(shown.frequency, shown.power, color="C0", lw=0.7)
    label_peaks(axes, spectrum, frequency_shown, LETTER)
    top = float(shown.power.max())
    axes.set(xlim=(0, frequency_shown), ylim=(3e-11 * top, 1e5 * top))
    axes.set(xlabel="frequency (cycles per unit of time)", ylabel="power spectral\ndensity of $v$")
    axes.set_title(lines_in_words(spectrum))


def draw_section(axes: Axes, attractors: xr.Dataset, label: str) -> None:
    """Each maximum of v over the one before: points where dv/dt falls through 0."""
    maxima = attractors.maximum.values[0]
    style = STYLES["point" if np.ptp(maxima[np.isfinite(maxima)]) < POINT else "curve"]
    axes.plot(maxima[:-1], maxima[1:], ls="", marker="o", mew=0, label=f"scene {label}", **style)


if __name__ == "__main__":
    with logged(snakemake.log[0]):
        given = snakemake.input
        own = {row["scene"]: row for row in read_table(given.table) if row["history"] == 1}
        shown = snakemake.params.settings
        scenes = {
            label: Scene(
                trajectory=read(trajectory),
                attractors=read(attractors),
                spectrum=read(spectrum),
                row=own[row["scene"]],
            )
            for (label, row), trajectory, attractors, spectrum in zip(
                shown["rows"].items(),
                given.trajectories,
                given.attractors,
                given.spectra,
                strict=True,
            )
        }
        figure = draw(scenes, shown["end_shown"], shown["frequency_shown"])
        save(figure, snakemake.output)
