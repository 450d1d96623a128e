"""Numbers in captions of figures of motions: velocities, spectra, exponents, events, friction."""

import math
from pathlib import Path

import xarray as xr

from scripts.captions.wording import short
from scripts.drawing.trajectory_rows import WORDS
from scripts.figures.events import EVENTS_SHOWN
from scripts.files.inputs import read
from scripts.files.tsv import read_table


def own_rows(table: str) -> dict[str, dict]:
    """Rows of attractors.tsv from the scenes' own histories."""
    return {row["scene"]: row for row in read_table(table) if row["history"] == 1}


def labelled(given: dict, params: dict, kind: str) -> dict[str, tuple[dict, xr.Dataset]]:
    """By the label of each row its settings and its data of one kind."""
    rows = params["settings"]["rows"]
    files = map(read, given[kind])
    return {label: (row, data) for (label, row), data in zip(rows.items(), files, strict=True)}


def of_trajectories(given: dict, params: dict) -> dict:
    """What v does at the end, and the class of the motion."""
    seen = own_rows(given["table"])
    rows = {}
    for label, (row, trajectory) in labelled(given, params, "trajectories").items():
        start = float(trajectory.t[-1]) - params["settings"]["end_shown"]
        v = trajectory.v.sel(t=slice(max(0.0, start), None))
        met = seen.get(row["scene"], {})
        rows[label] = {
            "paper": row["paper"],
            "met": WORDS.get(met.get("class"), met.get("class", "unknown")),
            "end": end_in_words(v, met),
        }
    return {"rows": rows}


def end_in_words(v: xr.DataArray, met: dict) -> str:
    """Between which values v stays; a cycle has a period, too."""
    if met.get("class") == "fixed point":
        return f"{short(abs(v - 1).max(), 2)} or less from steady sliding, :math:`v = 1`"
    words = f"between {short(v.min())} and {short(v.max())}"
    frequency = met.get("f1", math.nan)
    if met.get("class") == "cycle" and not math.isnan(frequency):
        words += f" with a period of {short(1 / frequency)}"
    return words


def with_error(value: float, error: float) -> str:
    """An exponent with its standard error, where it was measured; an exact one has none."""
    if math.isnan(value):
        return "not measured"
    return short(value) if error == 0 else f"{short(value)} ± {short(error, 2)}"


def of_spectra(given: dict, params: dict) -> dict:
    """Frequencies and heights of the highest peaks, the share of broadband power."""
    rows = {}
    for label, (row, spectrum) in labelled(given, params, "spectra").items():
        rows[label] = {"paper": row.get("paper"), **peaks_of(spectrum)}
    return {"rows": rows}


def peaks_of(spectrum: xr.Dataset) -> dict:
    """The two highest peaks, the kind of the spectrum and its fundamental frequencies."""
    peaks = spectrum.isel(peak=(-spectrum.peak_power.values).argsort())
    frequencies = [short(value, 4) for value in peaks.peak_frequency.values]
    ratios = [short(100 * power / peaks.peak_power[0], 2) for power in peaks.peak_power.values]
    kind = spectrum.attrs["spectrum_kind"]
    second = "there is one peak."
    if len(frequencies) > 1:
        multiple = int(peaks.peak_multiple[1])
        place = f", which is {multiple} :math:`f_1`," if kind == "periodic" else ""
        second = f"the second peak at {frequencies[1]}{place} has {ratios[1]} % of its height."
    return {
        "kind": kind,
        "highest": frequencies[0] if frequencies else "no frequency",
        "second_peak": second,
        "bases": [short(value, 4) for value in spectrum.base_frequency.values],
        "off_lines": short(100 * spectrum.attrs["continuum_share"], 2),
    }


def of_friction(given: dict, _params: dict) -> dict:
    """Sizes of both effects, and friction before the step."""
    response = read(given["response"])
    attributes = response.attrs
    return {
        "direct": short(attributes["direct_effect"]),
        "evolution": short(attributes["evolution_effect"]),
        "before": short(response.mu[0], 4),
        "mu0": short(attributes["mu0"]),
        "least": short(1e6 * attributes["v0"]),
        "most": short(1e6 * (attributes["v0"] + attributes["delta_v"])),
    }


def of_exponents(given: dict, _params: dict) -> dict:
    """How many exponents of each scene are positive and zero, their values, the dimension."""
    table = read_table(given["table"])
    scenes = []
    for path in given["runs"]:
        scene = Path(path).stem
        rows = [row for row in table if row["scene"] == scene]
        own = [row for row in rows if row["mean_step"] == rows[0]["mean_step"]]
        signs = [row["sign"] for row in own]
        scenes.append(
            {
                "name": scene.replace("_", " "),
                "positive": signs.count("positive"),
                "zero": signs.count("zero"),
                "largest": with_error(own[0]["exponent"], own[0]["error"]),
                "all": [with_error(row["exponent"], row["error"]) for row in own],
                "dimension": with_error(own[0]["dimension"], own[0]["dimension_error"]),
            }
        )
    return {"scenes": scenes}


def of_events(given: dict, params: dict) -> dict:
    """Counts of events, their recurrence times and how much these differ."""
    rows = {}
    for label, (row, events) in labelled(given, params, "slip_events").items():
        times = events.recurrence_time
        rows[label] = {
            "scene": row["scene"].replace("_", " "),
            "number": events.sizes["event"],
            "mean": short(times.mean()) if events.sizes["event"] else "none",
            "spread": spread_in_words(times) if events.sizes["event"] else "none",
        }
    return {"rows": rows, "shown": EVENTS_SHOWN}


def spread_in_words(times: xr.DataArray) -> str:
    """The coefficient of variation in percent, as long as it can be told from zero."""
    percent = 100 * float(times.std() / times.mean())
    return f"{short(percent, 2)} %" if percent >= 0.01 else "less than 0.01 %"


def of_true_torus(given: dict, params: dict) -> dict:
    """Class, exponents and fundamental frequencies of both scenes."""
    seen = own_rows(given["table"])
    rows = {}
    for label, (row, spectrum) in labelled(given, params, "spectra").items():
        met = seen[row["scene"]]
        rows[label] = {
            "tau": short(met["tau"]),
            "met": WORDS.get(met["class"], met["class"]),
            "second": with_error(met["exponent_2"], met["error_2"]),
            **peaks_of(spectrum),
        }
    return {"rows": rows}


NUMBERS = {
    "figure_4": of_trajectories,
    "figure_5": of_trajectories,
    "figure_6": of_spectra,
    "figure_7": of_spectra,
    "figure_8": of_friction,
    "exponents": of_exponents,
    "events": of_events,
    "true_torus": of_true_torus,
}
