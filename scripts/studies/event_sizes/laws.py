"""Laws of event sizes and of aftershocks, put to the test of their data.

Sizes: maximum likelihood above a lower cut-off, and ratios of likelihoods (Clauset, Shalizi and
Newman 2009). Aftershocks: the likelihood of a rate that decays as Omori and Utsu say. What is found
has the names of columns of the table.
"""

import math
import warnings
from collections.abc import Callable, Sequence

import numpy as np
import powerlaw
from scipy import stats
from scipy.integrate import cumulative_trapezoid
from scipy.optimize import brentq, minimize, minimize_scalar
from scipy.special import boxcox

from scripts.studies.event_sizes.names_of_laws import CUT_OFF, RIVALS

FEWEST = 100
"""Events that a fit needs."""
ANY_EXPONENT = {"alpha": (0.0, None)}
"""Exponents of power laws. By default `powerlaw` has none above 3, and no least size from which on
the exponent is larger."""
SAMPLES = 999
"""Random samples of the power law from which the goodness of fit is found."""
SEED = 1
MOST_SEARCHED = 1000
"""Events, evenly in time, among which the lower cut-off of a definition is searched."""
CONFIDENCE = 0.95
"""Of the interval of a cut-off."""
LOGS = 30.0 * np.linspace(0.0, 1.0, 2001) ** 2
"""ln(size/least) at which the law with a cut-off is integrated, dense near the least size."""
LOG_RATES = (-16.0, 4.0)
"""Between these is the logarithm of least size over cut-off."""
EXPONENT_RANGE = (0.0, 20.0)
"""Exponents of the law with a cut-off; at 0 it is an exponential law."""
CUT_SAMPLES = 199
"""Samples of the law with a cut-off from which its goodness of fit is found."""
LARGEST = 0.05
"""Share of the events that are main shocks: the largest."""
FIRST = 1.0
"""Time after a main shock in which the first rate is counted, over that of the whole run."""
WINDOW = 50.0
"""Time after a main shock in which aftershocks are looked for."""
EXPONENTS = (0.3, 3.0)
"""Exponents of the decay that are tried. Those of earthquakes are 0.6 to 2.5 (Utsu, Ogata and
Matsu'ura 1995)."""


def fit_cut_off(sizes: np.ndarray, least: float) -> dict[str, float]:
    """The law with a cut-off, density size^-exponent exp(-size/cutoff) above a least size.

    By maximum likelihood. The interval of the cut-off is that of the profile likelihood, 0 or
    infinite where this bounds it on one side only, as is the cut-off at an end of `LOG_RATES`.
    """
    y = sizes[sizes >= least] / least
    exponent, best = most_likely(y)
    drop = stats.chi2.ppf(CONFIDENCE, 1) / 2

    def beyond(log_rate: float) -> float:
        profile = minimize_scalar(
            lambda trial: minus_log_likelihood(y, trial, log_rate)[0],
            bounds=EXPONENT_RANGE,
            method="bounded",
        )
        return y.size * (profile.fun - minus_log_likelihood(y, exponent, best)[0]) - drop

    low, high = (
        least * np.exp(-brentq(beyond, best, end, xtol=1e-3)) if beyond(end) > 0 else without
        for end, without in zip(LOG_RATES[::-1], (0.0, np.inf), strict=True)
    )
    (at_end,) = are_at_ends([exponent], [EXPONENT_RANGE])
    ends = dict(zip(LOG_RATES, (math.inf, 0.0), strict=True))
    return {
        "size_cutoff_exponent": math.nan if at_end else exponent,
        "size_at_end": "size_cutoff_exponent" if at_end else "",
        "size_cutoff": ends.get(best, least * float(np.exp(-best))),
        "size_cutoff_low": float(low),
        "size_cutoff_high": float(high),
    }


def are_at_ends(values: Sequence[float], ranges: Sequence[tuple[float, float]]) -> np.ndarray:
    """Whether each value is at an end of its range: the data say no more than that."""
    return np.isclose(np.array(values)[:, np.newaxis], ranges, rtol=0.0, atol=1e-6).any(axis=1)


def minus_log_likelihood(
    y: np.ndarray, exponent: float, log_rate: float
) -> tuple[float, list[float]]:
    """Of the law with a cut-off per event, with its slopes; y = size/least, rate = least/cut-off.

    It depends on the data through the means of y and ln y alone.
    """
    rate, log_mean, above = np.exp(log_rate), np.log(y).mean(), y.mean() - 1.0
    density = density_of(exponent, log_rate)
    whole = np.trapezoid(density, LOGS)
    slopes = [
        log_mean - np.trapezoid(LOGS * density, LOGS) / whole,
        rate * (above - np.trapezoid(np.expm1(LOGS) * density, LOGS) / whole),
    ]
    return float(exponent * log_mean + rate * above + np.log(whole)), slopes


def density_of(exponent: float, log_rate: float) -> np.ndarray:
    """The law with a cut-off over ln y, not divided by its integral."""
    return np.exp((1.0 - exponent) * LOGS - np.exp(log_rate) * np.expm1(LOGS))


def most_likely(y: np.ndarray) -> tuple[float, float]:
    """Exponent and logarithm of the rate with the largest likelihood."""
    start = [1.0, min(-np.log(y.mean() - 1.0), LOG_RATES[1])]
    found = minimize(
        lambda at: minus_log_likelihood(y, *at),
        start,
        jac=True,
        bounds=[EXPONENT_RANGE, LOG_RATES],
        method="L-BFGS-B",
    ).x
    return float(found[0]), float(found[1])


def goodness_of_cut_off(sizes: np.ndarray, least: float) -> float:
    """Share of samples of the law with a cut-off that are farther from their own fit than the data.

    By Kolmogorov and Smirnov's distance; the lower cut-off is kept.
    """
    y = sizes[sizes >= least] / least
    law, random = most_likely(y), np.random.default_rng(SEED)
    table = below(*law)
    samples = (np.exp(np.interp(random.random(y.size), table, LOGS)) for _ in range(CUT_SAMPLES))
    farther = sum(distance(one, *most_likely(one)) >= distance(y, *law) for one in samples)
    return farther / CUT_SAMPLES


def below(exponent: float, log_rate: float) -> np.ndarray:
    """The share of sizes below those at `LOGS`."""
    share = cumulative_trapezoid(density_of(exponent, log_rate), LOGS, initial=0.0)
    return share / share[-1]


def distance(y: np.ndarray, exponent: float, log_rate: float) -> float:
    """Kolmogorov and Smirnov's distance of sizes from a law."""
    table = below(exponent, log_rate)
    cdf = stats.ks_1samp(np.log(y), lambda logs: np.interp(logs, LOGS, table), method="asymp")
    return float(cdf.statistic)


def fit_power_law(sizes: np.ndarray) -> tuple[powerlaw.Fit | None, dict[str, str]]:
    """The power law above the least size from which on it is closest to the events.

    `FEWEST` events or more stay above this size. If the search ends there, no least size is found,
    and a column says so.
    """
    if sizes.size < FEWEST:
        return None, {}
    searched = sizes.min(), np.sort(sizes)[-FEWEST]
    with warnings.catch_warnings(action="ignore"):  # a search in sizes that are nearly all equal
        fit = powerlaw.Fit(sizes, xmin=searched, parameter_ranges=ANY_EXPONENT, verbose=0)
    if fit.noise_flag:
        return None, {}
    at_end = fit.xmin == fit.xmin_fitting_results["xmins"][-1]
    return (None, {"size_at_end": "size_least"}) if at_end else (fit, {})


def fit_definition(sizes: np.ndarray) -> dict[str, float | str]:
    """The least size, the events above it and the law with a cut-off; nothing of too few events."""
    fit, found = fit_power_law(sizes[:: max(1, sizes.size // MOST_SEARCHED)])
    if fit is None:
        return found
    least = float(fit.xmin)
    found = {"size_least": least, "size_events": int(np.count_nonzero(sizes >= least))}
    return found | fit_cut_off(sizes, least)


def shuffle_slips(slips: np.ndarray, per_event: np.ndarray) -> np.ndarray:
    """Sizes of events with as many slips as they have, drawn at random from all slips."""
    drawn = np.random.default_rng(SEED).permutation(slips)[: per_event.sum()]
    return np.add.reduceat(drawn, np.concatenate(([0], np.cumsum(per_event)[:-1])))


def fit_sizes(sizes: np.ndarray) -> dict[str, float | str]:
    """The power law of the sizes, shape (events), density size^-exponent, and its rivals.

    Goodness of a law is the share of its samples that are farther from it than the data, by
    Kolmogorov and Smirnov's distance.
    """
    fit, found = fit_power_law(sizes)
    if fit is None:
        return found
    least, above = float(fit.xmin), sizes[sizes >= fit.xmin]
    with warnings.catch_warnings(action="ignore"):  # values of rivals at their bounds
        ratios = compare(fit, "power_law", RIVALS) | compare(fit, CUT_OFF, RIVALS[:-1])
        test = stats.goodness_of_fit(
            stats.pareto,
            above,
            known_params={"loc": 0.0, "scale": fit.xmin},
            statistic="ks",
            n_mc_samples=SAMPLES,
            rng=np.random.default_rng(SEED),
        )
    return {
        "size_exponent": float(fit.alpha),
        "size_error": float(fit.sigma),
        "size_least": least,
        "size_events": above.size,
        "size_goodness": float(test.pvalue),
        "size_cutoff_goodness": goodness_of_cut_off(sizes, least),
        **fit_cut_off(sizes, least),
        **ratios,
    }


def compare(fit: powerlaw.Fit, law: str, rivals: tuple[str, ...]) -> dict[str, float]:
    """The logarithms of the ratios of likelihoods, and the probabilities that chance makes them.

    A logarithm is over its standard deviation, positive in favour of the law.
    """
    found, over = {}, "cutoff_over_" * (law == CUT_OFF)
    for rival in rivals:
        ratio, chance = fit.distribution_compare(
            law, rival, nested=rival == CUT_OFF, normalized_ratio=True
        )
        found |= {f"{over}{rival}_ratio": float(ratio), f"{over}{rival}_chance": float(chance)}
    return found


def times_after_main_shocks(events: list[dict]) -> tuple[int, np.ndarray]:
    """The number of main shocks, and the times from their ends to the onsets of other events.

    Times are up to `WINDOW`, which all main shocks have before them.
    """
    if len(events) < FEWEST:
        return 0, np.empty(0)
    onset, duration, sizes = (
        np.array([event[key] for event in events]) for key in ("onset", "duration", "size")
    )
    end = onset + duration
    main = (sizes >= np.quantile(sizes, 1 - LARGEST)) & (end + WINDOW < onset.max())
    after = (onset - end[main, np.newaxis]).ravel()
    return np.count_nonzero(main), after[(after > 0) & (after < WINDOW)]


def fit_aftershocks(events: list[dict], time: float) -> dict[str, float | str]:
    """The rate of events after main shocks, background + productivity (1 + t/delay)^-exponent.

    In a run of some time; nothing of too few events. Times t count from the end of the main shock.
    Values at an end of what is tried are missing, and `at_end` names them; delay and exponent go
    together.
    `chance` is the probability that a constant rate is as much less likely by chance,
    `over_exponential` the logarithm of the likelihood over that of an exponential decay.
    """
    shocks, after = times_after_main_shocks(events)
    if after.size < FEWEST:
        return {}
    rate, soon = len(events) / time, np.count_nonzero(after < FIRST)
    expected = rate * FIRST * shocks
    constant = after.size * (np.log(after.size / (shocks * WINDOW)) - 1)
    best, values, at_ends = fit_decay(shocks, after, power_decay)
    exponential, *_ = fit_decay(shocks, after, exponential_decay)
    names = ("background", "productivity", "delay", "exponent")
    missing = at_ends | np.array([False, False, *[at_ends[2:].any()] * 2])
    found = {
        **{"main_shocks": shocks, "rate": rate, "first": soon / expected},
        "first_error": float(np.sqrt(max(soon, 1)) / expected),
        **dict(zip(names, np.where(missing, math.nan, values).tolist(), strict=True)),
        "at_end": " ".join(name for name, is_there in zip(names, at_ends, strict=True) if is_there),
        "chance": float(stats.chi2.sf(2 * max(best - constant, 0.0), 3)),
        "over_exponential": best - exponential,
    }
    return {f"aftershock_{key}": value for key, value in found.items()}


def power_decay(t: np.ndarray, delay: float, exponent: float) -> tuple[np.ndarray, float]:
    """(1 + t/delay)^-exponent, and its integral over `WINDOW`."""
    # the integral of x^-p is boxcox(x, 1 - p), of which p = 1 is no exception
    return (1 + t / delay) ** -exponent, delay * boxcox(1 + WINDOW / delay, 1 - exponent)


def exponential_decay(t: np.ndarray, delay: float, _: float) -> tuple[np.ndarray, float]:
    """exp(-t/delay), and its integral over `WINDOW`."""
    return np.exp(-t / delay), -delay * np.expm1(-WINDOW / delay)


def fit_decay(
    shocks: int, after: np.ndarray, decay: Callable
) -> tuple[float, np.ndarray, np.ndarray]:
    """The largest logarithm of the likelihood of a decay with a background.

    Also background, productivity, delay and exponent there, and which are at an end of their range.
    """
    constant = after.size / (shocks * WINDOW)
    bounds = np.log(np.array([(1e-3, 10.0), (1e-6, 1e3)]) * constant).tolist()
    bounds += np.log([(1e-2, WINDOW), EXPONENTS]).tolist()

    def minus_log_likelihood(values: np.ndarray) -> float:
        background, productivity, delay, exponent = np.exp(values)
        shape, integral = decay(after, delay, exponent)
        expected = shocks * (background * WINDOW + productivity * integral)
        return expected - np.log(background + productivity * shape).sum()

    fits = [
        minimize(
            minus_log_likelihood,
            np.log([constant, excess * constant, delay, 1.0]),
            method="L-BFGS-B",
            bounds=bounds,
        )
        for excess in (0.01, 1.0)
        for delay in (0.1, 1.0, 10.0)
    ]
    best = min(fits, key=lambda fit: fit.fun)
    return -float(best.fun), np.exp(best.x), are_at_ends(best.x, bounds)
