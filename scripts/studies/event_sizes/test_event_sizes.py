"""Slip events of chains: the program against a raster, laws against made-up data."""

import numpy as np
import powerlaw
import pytest
import xarray as xr
from made_up_results import NO, PARTLY, YES, assert_finding, cases
from scipy.ndimage import label

from scripts.requests.program_groups import scene_groups
from scripts.studies.event_sizes import figure as event_sizes
from scripts.studies.event_sizes import laws
from scripts.studies.event_sizes.events_table import event_rows
from scripts.studies.event_sizes.laws import (
    FEWEST,
    fit_aftershocks,
    fit_cut_off,
    fit_definition,
    fit_sizes,
    goodness_of_cut_off,
    shuffle_slips,
)
from scripts.studies.event_sizes.plan import groups
from scripts.studies.event_sizes.table import rows_of_chain

FINE = 0.01
RUN = {"t_end": 120.0, "t_transient": 0.0, "sample_interval": FINE, "tolerance": 1e-9}


@pytest.fixture(autouse=True)
def few_samples(monkeypatch):
    """Of made-up sizes, for the plausibility of a law: its error is then 0.04 at most."""
    monkeypatch.setattr(laws, "SAMPLES", 199)
    monkeypatch.setattr(laws, "CUT_SAMPLES", 99)


@pytest.fixture
def config(own_config) -> dict:
    """One chain is short."""
    own_config["scenes"]["chaos_100"] |= RUN
    return own_config


@pytest.mark.parametrize(("ends", "threshold"), [("free", 1.0), ("ring", 1.0), ("free", 1.05)])
def test_events_are_connected_places_of_the_trajectory(programs, config, ends, threshold):
    """Places above the threshold in a fine raster of blocks and times, by SciPy, are the same."""
    config["scenes"]["chaos_100"] |= {"ends": ends, "blocks": 7}
    config["event_sizes"]["thresholds"] = [threshold, 3.0]
    found = programs.made_of("slip_events", groups(config, "chaos_100"))
    slips = found.isel(event=found.threshold.values == threshold)
    run = programs.made_of("trajectory", scene_groups(config, "chaos_100"))
    v = run.v.values
    labels, _ = label(v > threshold)
    if ends == "ring":
        for left, right in zip(labels[:, 0], labels[:, -1], strict=True):
            if left and right:
                labels[labels == right] = left
    steady = np.flatnonzero(run.t >= 20.0)[0]
    cut = set(labels[:steady].ravel()) | set(labels[-200:].ravel())
    sizes = np.bincount(labels.ravel(), (v * FINE).ravel())
    raster = [size for number, size in enumerate(sizes) if size > 0 and number not in cut]
    end = run.t.values[-200]
    rows = [row for row in event_rows(slips, 20.0) if row["onset"] + row["duration"] < end]
    assert len(rows) == len(raster) > 10
    found = sorted(row["size"] for row in rows)
    np.testing.assert_allclose(found, sorted(raster), atol=0.02, rtol=0.02)
    assert max(row["blocks"] for row in rows) > 1


def test_unfinished_events_are_left_out(programs, config):
    """In a chain that the run ends early no event reaches its end."""
    config["scenes"]["chaos_100"] |= {"t_end": 40.0, "blocks": 3}
    slips = programs.made_of("slip_events", groups(config, "chaos_100"))
    slips = slips.isel(event=slips.threshold.values == 1)
    rows = event_rows(slips, 0.0)
    assert rows
    following = slips.onset + slips.recurrence_time
    last = max(float(following[slips.number_of_block == block].max()) for block in (1, 2, 3))
    assert all(row["onset"] + row["duration"] <= last for row in rows)


def test_block_that_does_not_slip_again_ends_no_event_of_its_neighbour():
    """Block 1 slips at 10, 20, ... up to 90; block 2 slips at 5 and next at 15, block 3 never."""
    onset = [5.0, *np.arange(10.0, 91.0, 10.0)]
    values = {"onset": onset, "duration": [1.0] * 10, "slip": [2.0] * 10}
    values |= {"recurrence_time": [10.0] * 10, "number_of_block": [2, *[1] * 9]}
    slips = xr.Dataset({name: ("event", list_of) for name, list_of in values.items()})
    rows = event_rows(slips.assign_attrs(blocks=3, t_end=101.0, ends="free"), 0.0)
    assert [row["onset"] for row in rows] == onset


def pareto(exponent: float, number: int, seed: int = 1) -> np.ndarray:
    """Sizes with a density that falls with the exponent from 1 on."""
    return (1 - np.random.default_rng(seed).random(number)) ** (-1 / (exponent - 1))


def test_power_law_is_found():
    """Its exponent within three standard errors, plausible, and better than an exponential law."""
    law = fit_sizes(pareto(2.1, 4000))
    assert law["size_exponent"] == pytest.approx(2.1, abs=3 * law["size_error"])
    assert law["size_goodness"] > 0.1
    assert law["exponential_ratio"] > 0 > law["truncated_power_law_ratio"] - 1e-9


def thinned(number: int, cut_off: float, seed: int = 1, thinning: int = 2) -> np.ndarray:
    """Sizes with the exponent 1.5, thinned by exp(-size/cut_off)."""
    sizes = pareto(1.5, number, seed)
    return sizes[np.random.default_rng(thinning).random(sizes.size) < np.exp(-sizes / cut_off)]


@pytest.mark.filterwarnings("ignore:Fitted parameters:UserWarning")
def test_cut_off_is_found():
    """And that a pure power law is less likely; another program finds the same."""
    sizes = thinned(40000, 200.0)[:2000]
    law = fit_sizes(sizes)
    assert 100 < law["size_cutoff"] < 400
    assert law["size_cutoff_exponent"] == pytest.approx(1.5, abs=0.15)
    assert law["truncated_power_law_ratio"] < 0
    assert law["truncated_power_law_chance"] < 1e-3
    other = powerlaw.Fit(sizes, xmin=law["size_least"], verbose=0).truncated_power_law
    assert law["size_cutoff_exponent"] == pytest.approx(other.parameter1, abs=0.01)
    assert law["size_cutoff"] == pytest.approx(1 / other.parameter2, rel=0.03)
    with_peak = np.append(sizes[:500], [3.0] * 250)
    assert law["size_cutoff_goodness"] > 0.1 > goodness_of_cut_off(with_peak, 1.0)


def test_interval_of_the_cut_off_holds_the_true_one():
    """In about 95 % of 30 samples; in at least 25 but for a chance of one in 300."""
    fits = [fit_cut_off(thinned(4000, 50.0, seed, 100 + seed), 1.0) for seed in range(30)]
    assert sum(law["size_cutoff_low"] < 50 < law["size_cutoff_high"] for law in fits) >= 25


def test_law_without_cut_off_has_no_upper_end():
    assert fit_cut_off(pareto(2.5, 500), 1.0)["size_cutoff_high"] == np.inf


def test_exponent_at_the_end_of_its_range_is_no_estimate():
    """Of equally likely sizes; a search that ends with the fewest events finds no least size."""
    law = fit_cut_off(np.linspace(1.0, 2.0, 500), 1.0)
    assert np.isnan(law["size_cutoff_exponent"])
    assert law["size_at_end"] == "size_cutoff_exponent"
    assert fit_cut_off(thinned(4000, 50.0), 1.0)["size_at_end"] == ""
    tail = 2 * (1 - np.arange(FEWEST + 2) / (FEWEST + 2)) ** -0.5
    sizes = np.concatenate((np.linspace(1.0, 1.5, 500), tail))
    assert fit_sizes(sizes) == fit_definition(sizes) == {"size_at_end": "size_least"}


def test_shuffled_slips_keep_their_number():
    """Of three slips, one event has two and one has one."""
    sizes = shuffle_slips(np.array([1.0, 10.0, 100.0]), np.array([2, 1]))
    assert sizes.sum() == 111.0
    assert sizes[1] in (1.0, 10.0, 100.0)


def test_few_events_have_no_law():
    few = np.arange(1.0, FEWEST)
    events = [{"onset": one, "duration": one, "size": one} for one in few]
    assert fit_sizes(few) == fit_definition(few) == fit_aftershocks(events, 1.0) == {}
    assert fit_sizes(np.ones(2 * FEWEST)) == {}


def made_up_shocks(decay: str = "") -> tuple[list[dict], float]:
    """Events of which one in 20 is large; 20 follow each of those, by a power or exponentially."""
    random = np.random.default_rng(3)
    time = 24000.0
    main = np.arange(100.0, time - 100.0, 200.0)
    onset = [random.uniform(0.0, time, main.size * (5 if decay else 25)), main]
    if decay == "power":
        onset += [shock + (51 ** random.random(20) - 1) for shock in main]
    if decay == "exponential":
        onset += [shock + random.exponential(1.0, 20) for shock in main]
    onset = np.concatenate(onset)
    sizes = np.where(np.isin(onset, main), 100.0, 1.0) * (1 + random.random(onset.size))
    events = sorted(zip(onset, sizes, strict=True))
    return [{"onset": start, "duration": 0.0, "size": size} for start, size in events], time


def test_decay_after_large_events_is_found():
    """Exponent 1 of the events drawn, an end of the range for an exponential decay, and no decay of
    events at a constant rate."""
    law = fit_aftershocks(*made_up_shocks("power"))
    assert law["aftershock_exponent"] == pytest.approx(1.0, abs=0.3)
    assert law["aftershock_at_end"] == ""
    assert law["aftershock_chance"] < 1e-6
    assert law["aftershock_first"] > 3
    assert law["aftershock_over_exponential"] > 3
    law = fit_aftershocks(*made_up_shocks("exponential"))
    assert law["aftershock_at_end"] == "exponent"
    assert np.isnan([law["aftershock_exponent"], law["aftershock_delay"]]).all()
    law = fit_aftershocks(*made_up_shocks())
    assert law["aftershock_chance"] > 0.01
    error = law["aftershock_first_error"]
    assert law["aftershock_first"] == pytest.approx(1.0, abs=4 * error)


ROW = {
    **{"chain": "mine", "blocks": 50.0, "events": 1000, "threshold": 1.0, "joined": "yes"},
    **{"largest": 1e4, "size_least": 10.0, "size_exponent": 1.7, "size_error": 0.03},
    **{"size_goodness": 0.5, "size_cutoff_exponent": 1.5, "size_cutoff_goodness": 0.5},
    **{"size_cutoff": 5000.0, "size_cutoff_low": 4000.0, "size_cutoff_high": 6000.0},
    **{"exponential_ratio": 9.0, "exponential_chance": 0.0, "lognormal_ratio": 0.1},
    **{"lognormal_chance": 0.9, "truncated_power_law_ratio": 0.0},
    **{"cutoff_over_exponential_ratio": 9.0, "cutoff_over_exponential_chance": 0.0},
    **{"cutoff_over_lognormal_ratio": -0.1, "cutoff_over_lognormal_chance": 0.9},
    **{"truncated_power_law_chance": 1.0, "aftershock_main_shocks": 50},
    **{"aftershock_first": 3.0, "aftershock_first_error": 0.1, "aftershock_chance": 1e-6},
    **{"aftershock_over_exponential": 8.0, "aftershock_exponent": 1.0},
}
CUT_OFF = {"truncated_power_law_ratio": -5.0, "truncated_power_law_chance": 1e-7}
LOGNORMAL = {"cutoff_over_lognormal_ratio": -5.0, "cutoff_over_lognormal_chance": 1e-6}


def of_chain(of_others: float = 5000.0, **change) -> dict:
    """Results of a chain, and by another definition of an event with another cut-off."""
    row = {**ROW, **change}
    return {"event_sizes": [row, {**row, "threshold": 2.0, "size_cutoff": of_others}]}


@cases(
    (
        # a pure power law over two decades; one with a cut-off in part; others not
        *("power_law_of_sizes", {"scenes": ["mine"], "decades": 2.0}),
        (of_chain(), YES),
        (of_chain(20.0), YES, "With v > 2, slips joined, the cut-off is 20 (4e+03 to 6e+03) in mi"),
        (of_chain(**CUT_OFF), PARTLY),
        (of_chain(size_goodness=0.01), PARTLY),
        (of_chain(lognormal_ratio=-5.0, lognormal_chance=1e-5), PARTLY),
        # nor one with a cut-off that another definition of an event does not show
        (of_chain(20.0, **CUT_OFF), NO),
        (
            of_chain(size_exponent=np.nan),
            NO,
            "They are too few above a lower cut-off to fit a law.",
        ),
        (of_chain(50.0, largest=500.0, size_cutoff=50.0), NO),
        (of_chain(50.0, size_cutoff=50.0, **CUT_OFF), NO),
        (of_chain(size_cutoff_goodness=0.01, **CUT_OFF), NO),
        (of_chain(**CUT_OFF, **LOGNORMAL), NO),
    ),
    (
        # a decay by a power; one that may be exponential; none; one whose power is no estimate
        *("decaying_aftershocks", {"scenes": ["mine"]}),
        (of_chain(), YES),
        (of_chain(aftershock_over_exponential=1.0), NO),
        (of_chain(aftershock_chance=0.5), NO),
        (of_chain(aftershock_first=0.5), NO),
        (of_chain(aftershock_chance=np.nan), NO, "Chain mine has too few events after large ones."),
        (of_chain(aftershock_exponent=np.nan), NO, "not estimated (at an end of a range)."),
    ),
)
def test_verdicts(case):
    assert_finding(*case)


def test_figure_draws_the_distribution(programs, config):
    """The line falls from 1 to one event's share; a chain with few events has no fitted line."""
    config["scenes"]["chaos_100"] |= {"blocks": 3}
    config["event_sizes"]["thresholds"] = [1.0]
    slips = programs.made_of("slip_events", groups(config, "chaos_100"))
    rows = [{"threshold": 1.0, **row} for row in event_rows(slips, 20.0)]
    given = [rows], [slips], rows_of_chain("mine", slips, rows, 20.0, [1.0, 5.0]), ["mine"]
    figure = event_sizes.draw(*given)
    (line,) = figure.axes[0].lines
    np.testing.assert_allclose(line.get_ydata()[[0, -1]], [1.0, 1 / len(rows)])
    joined, alone, *above_5 = figure.axes[1].lines
    assert len(joined.get_ydata()) == len(rows)
    assert len(alone.get_ydata()) == np.count_nonzero(slips.onset >= 20.0)
    assert [len(line.get_ydata()) for line in above_5] == [0, 0]
    (told,) = event_sizes.numbers(*given)["chains"]
    assert told["cells"][3:6] == [str(len(rows)), "", "too few"]
