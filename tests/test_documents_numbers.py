"""Numbers in the documents are those of results/, where the whole workflow has run."""

import csv
import math
import re
from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from itertools import pairwise

import netCDF4
import numpy as np
import pytest
from conftest import ROOT
from expected_rules import settings

from scripts.claims.claims_of_routes import Stretch, stretches_of
from scripts.claims.claims_results import short
from scripts.files.tsv import read_table

RESULTS = ROOT / "results"


@dataclass(frozen=True)
class Said:
    """Words of a document with a field for each number, and the numbers of the results."""

    document: str
    words: str
    values: Callable[[], list]

    def __str__(self) -> str:
        return f"{self.document}: {self.words[:40]}"

    @property
    def expected(self) -> str:
        """The words with the numbers of the results."""
        return self.words.format(*self.values())


@cache
def table(name: str) -> list[dict]:
    """Rows of a table."""
    path = RESULTS / "tables" / name
    if not path.exists():
        pytest.skip(f"{path} is not made")
    with path.open(newline="") as file:
        return list(csv.DictReader(file, delimiter="\t"))


def exponents(scene: str) -> list[dict]:
    """Rows of a scene at its own tolerance and steps, the largest exponent first."""
    return [
        row
        for row in table("exponents.tsv")
        if row["scene"] == scene and row["tolerance"] == "1e-09" and not row["longest_step"]
    ]


def exponent(scene: str, i: int, column: str = "exponent") -> float:
    """Exponent i of a scene, or another column of its row."""
    return float(exponents(scene)[i - 1][column])


def zeros(scene: str) -> list[str]:
    """How many exponents of a scene count as zero, in words."""
    count = sum(row["sign"] == "zero" for row in exponents(scene))
    return [{1: "one exponent is", 2: "two exponents are"}[count]]


def hopf(of: str, kind: str) -> list[dict]:
    """Special points of a plane or scene."""
    return [row for row in table("hopf-points.tsv") if (row["of"], row["kind"]) == (of, kind)]


NUMBERS = "zero one two three four five six seven eight nine ten".split()


def count(of: str, kind: str) -> str:
    """How many special points, in words."""
    return NUMBERS[len(hopf(of, kind))]


def stable_tori(of: str, most_pairs: int) -> str:
    """How many double Hopf points have stable tori beside few unstable pairs, in words."""
    return NUMBERS[
        sum(
            row["torus_1"] == "stable" and int(row["unstable_pairs"]) <= most_pairs
            for row in hopf(of, "double_hopf")
        )
    ]


def turns(of: str, column: str) -> list[float]:
    """Least and largest value of a column at the generalised Hopf points of a plane."""
    found = [float(row[column]) for row in hopf(of, "generalised_hopf")]
    return [min(found), max(found)]


def amplitude_death(scene: str) -> list[float]:
    """Delays at which steady sliding becomes stable, and unstable again."""
    kinds = ("amplitude_death_begin", "amplitude_death_end")
    return [float(hopf(scene, kind)[0]["tau"]) for kind in kinds]


def double_hopf_near(of: str, epsilon: float, columns=("epsilon", "tau")) -> list[float]:
    """Of the double Hopf point of a plane that is nearest in epsilon."""
    points = hopf(of, "double_hopf")
    nearest = min(points, key=lambda row: abs(float(row["epsilon"]) - epsilon))
    return [float(nearest[column]) for column in columns]


def frequencies(scene: str) -> list[float]:
    """Fundamental frequencies of the spectrum of a scene."""
    path = RESULTS / "spectra" / f"{scene}.nc"
    if not path.exists():
        pytest.skip(f"{path} is not made")
    with netCDF4.Dataset(path) as spectrum:
        return [float(value) for value in spectrum["base_frequency"][:].compressed()]


def route(line: str) -> list[dict]:
    """Rows of a route."""
    path = RESULTS / "tables" / "routes" / f"{line}.tsv"
    if not path.exists():
        pytest.skip(f"{path} is not made")
    return read_table(path)


@cache
def routes() -> list[dict]:
    """Rows of all routes."""
    return [row for line in settings("routes", "lines") for row in route(line)]


def stretch(line: str, motion: str, number: int = 0, run: str = "up") -> Stretch:
    """A stretch of a class along a route, in the sweep up if nothing else is said."""
    found = stretches_of(route(line))[run]
    return [one for one in found if one.motion == motion][number]


def begins(line: str, *motions: tuple[str, int]) -> list[str]:
    """Where stretches begin."""
    return [short(stretch(line, *motion).first) for motion in motions]


def jump_of_maxima() -> list[float]:
    """Largest maximum of v before and after its largest jump on the way up, before the chaos."""
    rows = [row for row in route("chaos_in_epsilon") if row["run"] == "up"]
    first_chaos = min(row["epsilon"] for row in rows if row["class"] == "chaos")
    before = sorted((row for row in rows if row["epsilon"] < first_chaos), key=by_epsilon)
    values = [row["largest_maximum"] for row in before]
    return list(max(pairwise(values), key=lambda pair: pair[1] - pair[0]))


def by_epsilon(row: dict) -> float:
    """Where a row lies on the route."""
    return row["epsilon"]


def last_small_cycle() -> list[float]:
    """The last epsilon before that jump."""
    small = jump_of_maxima()[0]
    rows = [row for row in route("chaos_in_epsilon") if row["run"] == "up"]
    return [row["epsilon"] for row in rows if row["largest_maximum"] == small]


def special_points(of: str, kind: str) -> list[dict]:
    """The special points of the cycles on a line, ascending along it."""
    along = settings("cycles", "lines", of, "along")
    rows = [row for row in table("cycle-points.tsv") if (row["of"], row["kind"]) == (of, kind)]
    return sorted(rows, key=lambda row: float(row[along]))


def cycle_points(of: str, kind: str, column: str) -> list[float]:
    """A column of these points."""
    return [float(row[column]) for row in special_points(of, kind)]


def torus_starts(of: str, number: int = 0) -> list:
    """A torus bifurcation, the angle of its pair, the first torus of the sweep up, its kind."""
    along = settings("cycles", "lines", of, "along")
    found = special_points(of, "torus")[number]
    place = [float(found[column]) for column in (along, "angle")]
    return [*place, *begins(of, ("torus", number)), found["criticality"]]


def torus_and_kinds(of: str, other: str) -> list:
    """The delay of the torus bifurcation on a line, and the criticality there and on another."""
    kinds = {row["criticality"] for line in (of, other) for row in special_points(line, "torus")}
    return [*cycle_points(of, "torus", "tau"), *kinds]


TORI = (
    ("upper_torus", "0.0028", "0.0110"),
    ("fault_in_tau", "0.0050", "0.0202"),
    ("chaos_in_tau", "0.0009", "0.0037"),
    ("torus_in_tau", "0.0015", "0.0058"),
    ("chaos_in_epsilon", "0.0002"),
)
"""Lines, and distances from their supercritical torus bifurcations."""


def torus_amplitude(of: str, distance: float) -> float:
    """Amplitude of the stable torus at a distance from the torus bifurcation of a line."""
    (found,) = [row for row in special_points(of, "torus") if row["criticality"] == "supercritical"]
    return float(found["amplitude"]) * math.sqrt(distance)


def stable_modulus(claim: str) -> list[str]:
    """The modulus of the largest multiplier but 1 of the stable cycle in a claim's evidence."""
    (row,) = [row for row in table("claims.tsv") if row["id"] == claim]
    return re.findall(r" stable with v up to \S+ \(modulus (\S+)\)", row["evidence"])


def doublings_of_unstable_cycles() -> int:
    """How many period doublings there are; none if one of them is that of a stable cycle."""
    rows = [row for row in table("cycle-points.tsv") if row["kind"] == "period_doubling"]
    unstable = all(row[f"unstable_{side}"] != "0" for row in rows for side in ("before", "behind"))
    return len(rows) if unstable else 0


def basin(place: str, motion: int) -> list[float]:
    """Largest maximum of v, share in per cent and its standard error."""
    (row,) = [
        row for row in table("basins.tsv") if (row["place"], row["motion"]) == (place, str(motion))
    ]
    share, error = (100 * float(row[key]) for key in ("share", "share_error"))
    return [float(row["largest_maximum"]), share, error]


def basin_histories() -> list[str]:
    """Number of random histories at each place."""
    return sorted({row["histories"] for row in table("basins.tsv")})


def shares(kind: str) -> list[float]:
    """Per cent of the points of the atlas in a class, by plane."""
    found = []
    for plane in settings("atlas", "planes").values():
        at = f"{plane['xi']:g}", f"{plane['gamma']:g}"
        classes = Counter(
            row["class"] for row in table("atlas.tsv") if (row["xi"], row["gamma"]) == at
        )
        found.append(100 * classes[kind] / classes.total())
    return found


def three_tori(plane: str) -> list[float]:
    """How many 3-tori a plane of the atlas has, and the least delay of one."""
    at = {key: f"{settings('atlas', 'planes')[plane][key]:g}" for key in ("xi", "gamma")}
    delays = [
        float(row["tau"])
        for row in table("atlas.tsv")
        if row["class"] == "3-torus" and all(row[key] == value for key, value in at.items())
    ]
    return [len(delays), *([min(delays)] if delays else [])]


def next_in_epsilon(kind: str, plane: str, beside: set[str]) -> int:
    """How many points of a class have these classes as neighbours along epsilon."""
    at = {key: f"{settings('atlas', 'planes')[plane][key]:g}" for key in ("xi", "gamma")}
    rows = [row for row in table("atlas.tsv") if all(row[key] == at[key] for key in at)]
    lines = {tau: [row for row in rows if row["tau"] == tau] for tau in {r["tau"] for r in rows}}
    return sum(
        two["class"] == kind and {one["class"], three["class"]} == beside
        for line in lines.values()
        for one, two, three in zip(line, line[1:], line[2:], strict=False)
    )


def points_of_a_plane() -> int:
    """Points of each plane of the atlas."""
    return settings("atlas")["epsilon_count"] * settings("atlas")["tau_count"]


def cases(method: str) -> list[dict]:
    """Runs of the stability table by a method."""
    return [row for row in table("stability.tsv") if row["method"] == method]


def completed(rows: list[dict]) -> list[dict]:
    """Those that reached their end."""
    return [row for row in rows if row["status"] == "ok"]


def of_faults() -> list[dict]:
    """Runs by `auto` at the gamma of real faults."""
    return [row for row in cases("auto") if 1e4 <= float(row["gamma"]) <= 1e12]


def short_runs() -> list[dict]:
    """Those that end at t = 100 or before."""
    return [row for row in of_faults() if float(row["t_end"]) <= 100]


def near_steady_sliding() -> list[dict]:
    """Those in which v stays within 10 % of 1; rounding apart, it begins at 1.1."""
    return [
        row for row in of_faults()
        if math.exp(float(row["least_ln_v"])) > 0.9 and math.exp(float(row["most_ln_v"])) < 1.1001
    ]  # fmt: skip


def error_over_expected(method: str, *without: str) -> float:
    """Largest error of completed runs over tolerance times amplification, without some families."""
    rows = [row for row in completed(cases(method)) if row["family"] not in ("growth", *without)]
    rows = [row for row in rows if row["error"] and row["error_expected"]]
    return max(float(row["error"]) / float(row["error_expected"]) for row in rows)


def rounded_up(value: float) -> int:
    """To tens."""
    return 10 * math.ceil(value / 10)


def amplifications(family: str) -> list[float]:
    """Least and largest amplification of the cases of a family."""
    found = [float(row["amplification"]) for row in cases("auto") if row["family"] == family]
    return [min(found), max(found)]


def horizon(scene: str) -> list[float]:
    """Up to when a run of a measured scene can be trusted."""
    rows = table("trusted-horizons.tsv")
    return [float(row["horizon"]) for row in rows if row["scene"] == scene]


def events(scene: str, variable: str) -> np.ndarray:
    """A variable of the slip events of a scene."""
    path = RESULTS / "slip_events" / f"{scene}.nc"
    if not path.exists():
        pytest.skip(f"{path} is not made")
    with netCDF4.Dataset(path) as data:
        return data[variable][:].data


def variation(scene: str, variable: str) -> float:
    """Coefficient of variation, in per cent."""
    values = events(scene, variable)
    return 100 * values.std() / values.mean()


BLOCK = 20
"""Events in a row that are drawn together."""


def powers_of_slip(scene: str) -> list[float]:
    """Slope of N(>= s) in logarithms, between shares of 95 and 50 % and of 25 and 5 % of events.

    With standard errors by the bootstrap of blocks of events, which are longer than a repetition.
    """
    slip, draw = events(scene, "slip"), np.random.default_rng(1)
    starts = draw.integers(slip.size, size=(1000, slip.size // BLOCK, 1))
    drawn = slip[(starts + np.arange(BLOCK)) % slip.size].reshape(len(starts), -1)
    found = []
    for more, less in ((0.95, 0.5), (0.25, 0.05)):
        shares = [1 - less, 1 - more]
        ends = [np.log(np.quantile(each, shares, axis=-1)) for each in (slip, drawn)]
        own, others = (math.log(more / less) / (high - low) for high, low in ends)
        found += [own, others.std()]
    return found


def slower_than_the_plate(scene: str) -> float:
    """Share of the time, in per cent."""
    return 100 * (1 - events(scene, "duration").sum() / events(scene, "recurrence_time").sum())


def least_span(scene: str) -> float:
    """Least factor that v spans in an event."""
    return (events(scene, "peak_velocity") / events(scene, "least_velocity")).min()


def at_gamma(gamma: str) -> list[float]:
    """epsilon without delay, the least one with a delay, and their difference."""
    (row,) = [row for row in table("fault-limit.tsv") if row["gamma"] == gamma]
    return [float(row[column]) for column in ("without_delay", "least", "depth")]


def in_seconds(column: str, fault_unit: float = 1.0) -> list[float]:
    """A column of the laboratory sample and of the fault, the latter in a unit."""
    lab, fault = (float(row[column]) for row in table("dimensions.tsv"))
    return [lab, fault / fault_unit]


DAY = 86400.0
YEAR = 365.25 * DAY


def scales(preset: int, day: float = 1.0, year: float = 1.0) -> list:
    """Unit of time, delay, xi and gamma of a preset."""
    row = table("dimensions.tsv")[preset]
    unit, delay, xi, gamma = (float(row[key]) for key in ("time_unit", "delay", "xi", "gamma"))
    return [unit / day, delay / year, xi, exponential(gamma)]


def lacking_mass() -> float:
    """Mass of the fault at the paper's gamma over its own."""
    return (in_seconds("inertial_period_of_paper")[1] / in_seconds("inertial_period")[1]) ** 2


def peaks(kind: str) -> list[float]:
    """Peak velocities of a class in the plane of real faults of the atlas."""
    rows = [row for row in table("atlas.tsv") if row["gamma"] == "1e+08" and row["class"] == kind]
    return [float(row["largest_maximum"]) for row in rows if row["largest_maximum"]]


def exponential(value: float) -> str:
    """Two digits and a power of ten."""
    digits, power = f"{value:.1e}".split("e")
    return f"{digits}e{int(power)}"


def spread_without_delay() -> str:
    """A power of ten above the differences of recurrence times, over their mean, of all scenes."""
    scenes = ("no_delay", "no_delay_stuck", "no_delay_fast"), ("no_delay_less",), ("no_delay_more",)
    spread = 0.0
    for alike in scenes:
        times = np.concatenate([events(scene, "recurrence_time") for scene in alike])
        spread = max(spread, np.ptp(times) / times.mean())
    return f"1e{math.ceil(math.log10(spread))}"


def difference_of_mu0() -> float:
    """Steady friction at v0 less mu0."""
    path = RESULTS / "friction" / "velocity_step.nc"
    if not path.exists():
        pytest.skip(f"{path} is not made")
    with netCDF4.Dataset(path) as response:
        return float(response["mu"][0]) - response.mu0


SAID = [
    Said(
        "README.md", "for that by {:.3f} at gamma = 0.8, but by {:.0e} at",
        lambda: [at_gamma("0.8")[2], at_gamma("10000")[2]],
    ),
    Said(
        "README.md", "| laboratory sample | {:.0f} s | {:.0f} s | {:.1f}, {} |",
        lambda: scales(0),
    ),
    Said(
        "README.md", "| fault | {:.0f} days | {:.1f} years | {:.1f}, {} |",
        lambda: scales(1, DAY, YEAR),
    ),
    Said("docs/findings.md", "| 0.8 | {:.4f} | {:.4f} | {:.3f} |", lambda: at_gamma("0.8")),
    *(
        Said(
            "docs/findings.md", f"| {gamma} | {{:.4g}} | {{:.4g}} | {{}} |",
            lambda row=row: [*at_gamma(row)[:2], exponential(at_gamma(row)[2])],
        )
        for gamma, row in (("10", "10"), ("1e4", "10000"))
    ),
    Said(
        "docs/findings.md", "| L/v0 | {:.0f} s | {:.0f} days |",
        lambda: in_seconds("time_unit", DAY),
    ),
    Said("docs/findings.md", "| xi | {:.1f} | {:.1f} |", lambda: in_seconds("xi")),
    Said("docs/findings.md", "| gamma | {} | {} |", lambda: map(exponential, in_seconds("gamma"))),
    Said(
        "docs/findings.md", "| tau = 7 | {:.0f} s | {:.1f} years |",
        lambda: in_seconds("delay", YEAR),
    ),
    Said(
        "docs/findings.md", "| inertial period 2 pi sqrt(M/k) | {:.4f} s | {:.1f} s |",
        lambda: in_seconds("inertial_period"),
    ),
    Said(
        "docs/findings.md", "| the same if gamma were 0.8 | {:.0f} s | {:.1f} years |",
        lambda: in_seconds("inertial_period_of_paper", YEAR),
    ),
    Said("docs/findings.md", "and a mass {} times as large", lambda: [exponential(lacking_mass())]),
    Said(
        "docs/findings.md", "the median {:.1f} v0 in cycles, {:.1f} v0 in tori and {} v0 in chaos."
        " With v0 = 1e-9 m/s the last is {} m/s",
        lambda: [
            *(np.median(peaks(kind)) for kind in ("cycle", "torus")),
            exponential(np.median(peaks("chaos"))),
            exponential(1e-9 * np.median(peaks("chaos"))),
        ],
    ),
    Said(
        "docs/findings.md", "peak in this plane is {} v0, which is {:.0f} mm/s",
        lambda: [exponential(max(peaks("chaos"))), 1e-6 * max(peaks("chaos"))],
    ),
    Said(
        "docs/findings.md", "has a mean of {:.2f} L/v0 and a coefficient of variation of {:.0f} %",
        lambda: [
            events("chaos", "recurrence_time").mean(), variation("chaos", "recurrence_time")
        ],
    ),
    Said(
        "docs/findings.md", "The slip has a coefficient of variation of {:.0f} %",
        lambda: [variation("chaos", "slip")],
    ),
    Said(
        "docs/findings.md", "both coefficients are below {} %",
        lambda: [0.001 if max(
            variation("oscillation", name) for name in ("slip", "recurrence_time")
        ) < 0.001 else "more"],
    ),
    Said(
        "docs/findings.md", "p = {:.2f} ± {:.2f} among small events and p = {:.1f} ± {:.1f} among",
        lambda: powers_of_slip("chaos"),
    ),
    Said(
        "docs/findings.md", "In `oscillation` v stays between {:.2f} and {:.2f}",
        lambda: [
            events("oscillation", "least_velocity").min(),
            events("oscillation", "peak_velocity").max(),
        ],
    ),
    Said(
        "docs/findings.md", "slower than the plate for {:.1f} % of the time, and v spans a factor"
        " of {}",
        lambda: [
            slower_than_the_plate("stick_slip"),
            exponential(least_span("stick_slip")),
        ],
    ),
    Said(
        "docs/findings.md", "the block is slower than the plate for {:.0f} % of the time, and v"
        " spans a factor of {} in each",
        lambda: [
            slower_than_the_plate("no_delay_less"),
            f"{least_span('no_delay_less'):.0e}".replace("e+0", "e"),
        ],
    ),
    Said(
        "docs/findings.md", "all events come after the same time, {:.1f} L/v0, within {}.",
        lambda: [events("no_delay", "recurrence_time").mean(), spread_without_delay()],
    ),
    Said(
        "docs/findings.md", "At epsilon = 11 v spans a factor of {}.",
        lambda: [f"{least_span('no_delay'):.0e}".replace("e+", "e")],
    ),
    Said("docs/findings.md", "the difference is {:.4f}", lambda: [difference_of_mu0()]),
    Said("README.md", "f1 = {:.4f}, with weak", lambda: frequencies("oscillation")),
    Said("README.md", "**limit cycle**, f1 = {:.4f};", lambda: frequencies("torus")),
    Said(
        "README.md", "All {} runs in `stability.tsv` with these values are completed, each in at"
        " most {} steps",
        lambda: [len(of_faults()), max(int(row["steps"]) for row in completed(of_faults()))],
    ),
    Said(
        "README.md", "{} end at t = 100 or before, and in {} v stays within 10 %",
        lambda: [len(short_runs()), len(near_steady_sliding())],
    ),
    Said(
        "docs/findings.md", "one exponent is zero, the second is {:.4f} and {:.4f}",
        lambda: [exponent("oscillation", 2), exponent("torus", 2)],
    ),
    Said("docs/findings.md", "are cycles: {} zero", lambda: zeros("oscillation")),
    Said("docs/findings.md", "are cycles: {} zero", lambda: zeros("torus")),
    Said(
        "docs/findings.md", "the first exponent is {:.3f} ± {:.3f}, the Kaplan-Yorke dimension"
        " {:.2f} ± {:.2f}",
        lambda: [
            float(exponents("chaos")[0][column])
            for column in ("exponent", "error", "dimension", "dimension_error")
        ],
    ),
    Said("docs/findings.md", "is a torus: {} zero", lambda: zeros("true_torus")),
    Said("docs/findings.md", "zero, the third is {:.5f}", lambda: [exponent("true_torus", 3)]),
    Said(
        "docs/findings.md", "k = 1 to {} becomes subcritical at an epsilon between {:.3f} and"
        " {:.3f}",
        lambda: [
            len(hopf("tau_of_epsilon", "generalised_hopf")), *turns("tau_of_epsilon", "epsilon")
        ],
    ),
    Said(
        "docs/findings.md", "{} in Figure 2, {} in Figure 3",
        lambda: [count(of, "double_hopf") for of in ("tau_of_epsilon", "xi_of_epsilon")],
    ),
    Said(
        "docs/findings.md", "the tori are stable at {} points of Figure 2 and {} of Figure 3",
        lambda: [stable_tori(of, 9) for of in ("tau_of_epsilon", "xi_of_epsilon")],
    ),
    Said(
        "docs/findings.md", "is unstable: at {} points of Figure 2 and {} of Figure 3",
        lambda: [stable_tori(of, 0) for of in ("tau_of_epsilon", "xi_of_epsilon")],
    ),
    Said(
        "docs/findings.md", "start at the double Hopf point ({:.3f}, {:.2f}) of xi = 0.8",
        lambda: double_hopf_near("tau_of_epsilon_xi_08", 0.464),
    ),
    Said(
        "docs/findings.md", "the angle of its multipliers is {:.3f}",
        lambda: double_hopf_near("tau_of_epsilon_xi_08", 0.464, ["angle_1"]),
    ),
    Said(
        "docs/findings.md", "l2 is negative at all {} points",
        lambda: [
            NUMBERS[sum(float(row["l2"]) < 0 for row in hopf("tau_of_epsilon", "generalised_hopf"))]
        ],
    ),
    Said("docs/findings.md", "tau from {:.3f} to {:.3f}, at", lambda: amplitude_death("torus")),
    Said(
        "docs/findings.md", "those of `chaos` from {:.3f} to {:.3f}",
        lambda: amplitude_death("chaos"),
    ),
    Said(
        "docs/findings.md", "fundamental frequencies are {:.4f} and {:.4f}",
        lambda: frequencies("true_torus"),
    ),
    Said(
        "docs/findings.md", "tau = {} | {} | {} | {} | | `torus_in_tau` | epsilon",
        lambda: [
            short(stretch("chaos_in_tau", "fixed point").last),
            *begins("chaos_in_tau", ("cycle", 1), ("torus", 0), ("chaos", 0)),
        ],
    ),
    Said(
        "docs/findings.md", "tau = {} | {} | {} | {} | | `torus_in_tau`, again",
        lambda: [
            short(stretch("torus_in_tau", "fixed point").last),
            *begins("torus_in_tau", ("cycle", 1), ("torus", 0), ("chaos", 0)),
        ],
    ),
    Said(
        "docs/findings.md", "again | | | {} | {} | {} |",
        lambda: begins("torus_in_tau", ("cycle", 2), ("torus", 1), ("chaos", 1)),
    ),
    Said(
        "docs/findings.md", "xi = {} | {} | {} |",
        lambda: begins("chaos_in_xi", ("cycle", 0), ("torus", 0), ("chaos", 0)),
    ),
    Said(
        "docs/findings.md", "| epsilon = {} | {} | {} | {} |",
        lambda: [
            short(stretch("chaos_in_epsilon", "fixed point").last),
            *begins("chaos_in_epsilon", ("cycle", 0), ("torus", 0), ("chaos", 0)),
        ],
    ),
    Said(
        "docs/findings.md", "Up to tau = {} and {} there is a cycle even",
        lambda: [short(stretch(line, "cycle").last) for line in ("chaos_in_tau", "torus_in_tau")],
    ),
    Said(
        "docs/findings.md", "{} of the {} points are undecided",
        lambda: [sum(row["class"] == "undecided" for row in routes()), len(routes())],
    ),
    Said(
        "docs/findings.md", "in a fold at epsilon = {:.4f}, where it meets",
        lambda: cycle_points("torus_in_epsilon", "fold", "epsilon")[:1],
    ),
    Said(
        "docs/findings.md", "the cycle has {} torus bifurcation. It becomes unstable",
        lambda: [len(cycle_points("torus_in_epsilon", "torus", "tau")) or "no"],
    ),
    Said(
        "docs/findings.md", "| `chaos_in_tau` | tau = {:.3f} | {:.3f} | {} | {} |",
        lambda: torus_starts("chaos_in_tau"),
    ),
    *(
        Said(
            "docs/findings.md",
            f"| `torus_in_tau`{again} | tau = {{:.3f}} | {{:.3f}} | {{}} | {{}} |",
            lambda number=number: torus_starts("torus_in_tau", number),
        )
        for number, again in enumerate(("", ", again"))
    ),
    Said(
        "docs/findings.md", "| `chaos_in_epsilon` | epsilon = {:.4f} | {:.3f} | {} | {} |",
        lambda: torus_starts("chaos_in_epsilon"),
    ),
    *(
        Said(
            "docs/method.md", f"| {distance} | {{:.4f}} |",
            lambda of=of, distance=distance: [torus_amplitude(of, float(distance))],
        )
        for of, *distances in TORI
        for distance in distances
    ),
    Said(
        "docs/findings.md", "a torus bifurcation at tau = {:.3f} leads",
        lambda: cycle_points("upper_torus", "torus", "tau"),
    ),
    Said(
        "docs/findings.md", "bifurcation at tau = {:.3f}. Both are {}.",
        lambda: torus_and_kinds("fault_in_tau", "upper_torus"),
    ),
    Said(
        "docs/findings.md", "multiplier but 1 has the modulus {}. So",
        lambda: stable_modulus("figure_5a"),
    ),
    Said(
        "docs/findings.md", "fold at epsilon = {1:.4f}, the large one at epsilon = {0:.4f}",
        lambda: cycle_points("chaos_in_epsilon", "fold", "epsilon"),
    ),
    Said(
        "docs/findings.md", "The {} period doublings found are those of unstable cycles",
        lambda: [doublings_of_unstable_cycles()],
    ),
    Said("docs/findings.md", "small cycle to epsilon = {:g}. Beyond", last_small_cycle),
    Said("docs/findings.md", "maxima of v jump from {:.1f} to {:.1f}", jump_of_maxima),
    Said(
        "docs/findings.md", "large cycle to epsilon = {:g}, where steady sliding is stable",
        lambda: [stretch("chaos_in_epsilon", "cycle", run="down").first],
    ),
    Said(
        "docs/findings.md", "small cycle, v up to {:.1f} | {:.0f} ± {:.0f} %",
        lambda: basin("three_cycles", 1),
    ),
    Said(
        "docs/findings.md", "large cycle, v up to {:.1f} | {:.0f} ± {:.0f} %",
        lambda: basin("three_cycles", 2),
    ),
    Said(
        "docs/findings.md", "another cycle, v up to {:.1f} | {:.0f} ± {:.0f} %",
        lambda: basin("rest_and_cycle", 1),
    ),
    Said("docs/findings.md", "share of {} random histories", lambda: basin_histories()),
    Said("docs/findings.md", "the {} points of each plane", lambda: [points_of_a_plane()]),
    *(
        Said(
            "docs/findings.md", f"| {kind} | {{:.0f}} | {{:.0f}} | {{:.0f}} |",
            lambda kind=kind: shares(kind),
        )
        for kind in ("fixed point", "cycle", "torus", "3-torus", "chaos", "undecided")
    ),
    Said(
        "docs/findings.md", "gamma = 0.8 there are {} of them, from tau = {:.1f} on.",
        lambda: three_tori("xi_08"),
    ),
    Said(
        "docs/findings.md", "{} of the 7 have chaos and a torus as their neighbours in epsilon.",
        lambda: [
            ("Four", "Five", "Six")[next_in_epsilon("3-torus", "xi_08", {"torus", "chaos"}) - 4]
        ],
    ),
    Said(
        "docs/findings.md", "gamma = 1e8 there are {} of them, from tau = {:.1f} on.",
        lambda: three_tori("fault"),
    ),
    Said(
        "docs/findings.md", "gamma = 0.8 there are {} of them on this grid",
        lambda: three_tori("xi_05"),
    ),
    Said(
        "docs/findings.md", "double Hopf point ({:.3f}, {:.2f}) and contains `true_torus`",
        lambda: double_hopf_near("tau_of_epsilon_xi_08", 0.464),
    ),
    Said(
        "docs/findings.md", "begins at the double Hopf point ({:.3f}, {:.2f}). Cycles",
        lambda: double_hopf_near("tau_of_epsilon", 0.336),
    ),
    Said(
        "docs/verification.md", "| {} stiff and extreme cases by `auto` and `explicit`",
        lambda: [len(cases("auto"))],
    ),
    Said(
        "docs/verification.md", "`auto` completes {} of {} cases, `explicit` {} within",
        lambda: [
            len(completed(cases("auto"))), len(cases("auto")), len(completed(cases("explicit")))
        ],
    ),
    Said(
        "docs/verification.md", "Errors of `auto` are below {} times tolerance",
        lambda: [math.ceil(error_over_expected("auto"))],
    ),
    Said(
        "docs/verification.md", "Those of `explicit` are below {} times",
        lambda: [rounded_up(error_over_expected("explicit", "history_u", "history_v"))],
    ),
    Said(
        "docs/verification.md", "and `history_v` (up to {} times)",
        lambda: [rounded_up(error_over_expected("explicit"))],
    ),
    Said(
        "docs/verification.md", "the problem magnifies errors by 1e{:.0f} to 1e{:.0f}.",
        lambda: [math.log10(value) for value in amplifications("growth")],
    ),
    Said("docs/verification.md", "to t = {:.0f}, and", lambda: horizon("chaos")),
    Said("docs/verification.md", "`stick` to {:.0f}", lambda: horizon("stick")),
]  # fmt: skip


@pytest.mark.parametrize("said", SAID, ids=str)
def test_number_is_that_of_the_results(said):
    """If a result has changed, write the new number into the document."""
    text = " ".join((ROOT / said.document).read_text().split())
    assert said.expected in text


@pytest.mark.parametrize(("tau", "between"), [(12.5, True), (10.0, False)])
def test_tori_lie_between_the_curves_that_start(tau, between):
    """As docs/findings.md says of `true_torus` and `torus`: epsilon = 0.5, xi = 0.8."""
    keys = ("epsilon", "tau")
    columns = [*keys, *(f"start_{key}_{number}" for number in (1, 2) for key in keys)]
    point = double_hopf_near("tau_of_epsilon_xi_08", 0.464, columns)
    shares = np.linalg.solve(np.array(point[2:]).reshape(2, 2).T, [0.5 - point[0], tau - point[1]])
    assert bool(min(shares) > 0) is between
