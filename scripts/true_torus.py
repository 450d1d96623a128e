"""Figure of the true torus: beside the paper's torus, in time, in the section, in the spectrum."""

import math
from dataclasses import dataclass

import xarray as xr
from drawing import logged, save
from exponents_table import sign
from inputs import read
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from spectrum_rows import label_peaks, lines_in_words
from tables import read_table
from trajectory_rows import draw_velocity, parameters

EXPONENTS = (1, 2, 3)
LETTER = 0.0195
"""How wide a letter is, as a share of the narrower axis."""
NUMBERS = {0: "no", 1: "one", 2: "two", 3: "three"}


@dataclass
class Scene:
    """What is shown of a scene."""

    trajectory: xr.Dataset
    attractors: xr.Dataset
    spectrum: xr.Dataset
    row: dict
    """Of the table of attractors, from the scene's own history."""


def draw(scenes: dict[str, Scene], end_shown: float, frequency_shown: float) -> Figure:
    """Scenes a, b, ... below each other: v(t), under it the spectrum, beside both the section."""
    places = [
        line
        for label in scenes
        for line in ([f"v{label}", f"s{label}"], [f"p{label}", f"s{label}"])
    ]
    figure, axes = plt.subplot_mosaic(
        places,
        figsize=(6.7, 3.5 * len(scenes)),
        width_ratios=[1.6, 1],
        height_ratios=[1, 1.5] * len(scenes),
    )
    first = next(iter(scenes))
    for label, scene in scenes.items():
        velocity, spectrum, section = (axes[f"{kind}{label}"] for kind in "vps")
        last = float(scene.trajectory.time[-1])
        draw_velocity(velocity, scene.trajectory, max(0.0, last - end_shown), last)
        velocity.set_title(f"$\\bf{{{label}}}$  {words(scene)}")
        draw_spectrum(spectrum, scene.spectrum, frequency_shown)
        draw_section(section, scene.attractors)
        if label != first:
            velocity.sharey(axes[f"v{first}"])
            spectrum.sharey(axes[f"p{first}"])
            section.sharex(axes[f"s{first}"])
            section.sharey(axes[f"s{first}"])
    for label in scenes:
        # a single point is to be seen as such on the scale of the largest section
        axes[f"s{label}"].autoscale()
    return figure


def words(scene: Scene) -> str:
    """Scene, parameters, class, and the leading exponents with their standard errors."""
    row = scene.row
    level = scene.attractors.attrs["zero_level"]
    there = [i for i in EXPONENTS if not math.isnan(row[f"exponent_{i}"])]
    pairs = [(row[f"exponent_{i}"], row[f"error_{i}"]) for i in there]
    zeros = sum(sign(*pair, level) == "zero" for pair in pairs)
    told = [f"$\\lambda_{i}$ = {with_error(*pair)}" for i, pair in zip(there, pairs, strict=True)]
    name = row["scene"].replace("_", " ")
    return (
        f"scene {name} ({parameters(scene.trajectory)}): {row['class']},"
        f" {NUMBERS[zeros]} zero exponent{'' if zeros == 1 else 's'}\n{', '.join(told)}"
    )


def with_error(value: float, error: float) -> str:
    """A number with its error, both to the last digit that the error lets count."""
    largest = max(abs(value), error)
    power = math.floor(math.log10(largest)) if largest > 0 else 0
    finest = math.floor(math.log10(error)) if error > 0 else power - 2
    digits = min(max(power - finest, 0) + 1, 5)
    scaled = f"{value / 10.0**power:.{digits}f} ± {error / 10.0**power:.{digits}f}"
    return f"({scaled})$\\cdot 10^{{{power}}}$" if power else scaled


def draw_spectrum(axes: Axes, spectrum: xr.Dataset, frequency_shown: float) -> None:
    """The power spectral density with its peaks named."""
    shown = spectrum.sel(frequency=slice(spectrum.frequency[1], frequency_shown))
    axes.semilogy(shown.frequency, shown.power, color="C0", lw=0.7)
    label_peaks(axes, spectrum, frequency_shown, LETTER)
    top = float(shown.power.max())
    axes.set(xlim=(0, frequency_shown), ylim=(3e-11 * top, 1e3 * top))
    axes.set(xlabel="frequency (cycles per unit of time)", ylabel="power spectral\ndensity of $v$")
    axes.set_title(lines_in_words(spectrum))


def draw_section(axes: Axes, attractors: xr.Dataset) -> None:
    """Points of the section from the scene's own history."""
    own = attractors.isel(point=0)
    axes.plot(own.section_theta, own.section_u, "o", color="C1", ms=2, mew=0)
    axes.set(xlabel=r"friction state $\theta$", ylabel="displacement $u$")
    axes.set_title("section $v$ = 1, $v$ rising")


if __name__ == "__main__":
    with logged(snakemake.log[0]):
        given = snakemake.input
        own = {row["scene"]: row for row in read_table(given.table) if row["history"] == 1}
        shown = snakemake.params.settings
        scenes = {
            label: Scene(*map(read, paths), own[row["scene"]])
            for (label, row), *paths in zip(
                shown["rows"].items(),
                given.trajectories,
                given.attractors,
                given.spectra,
                strict=True,
            )
        }
        figure = draw(scenes, shown["end_shown"], shown["frequency_shown"])
        save(figure, snakemake.output.pdf, snakemake.output.png)
