"""Laws of event sizes and of aftershocks, put to the test of their data.

Sizes: maximum likelihood above a lower cut-off, and ratios of likelihoods (Clauset, Shalizi and
Newman 2009). Aftershocks: the likelihood of a rate that decays as Omori and Utsu say.
"""

import warnings
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import powerlaw
from scipy import stats
from scipy.integrate import cumulative_trapezoid
from scipy.optimize import brentq, minimize, minimize_scalar
from scipy.special import boxcox

from scripts.studies.event_sizes.names_of_laws import CUT_OFF, RIVALS

FEWEST = 100
"""Events that a fit needs."""
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
EXPONENT_RANGE = (0.0, 5.0)
"""Exponents of the law with a cut-off; at 0 it is an exponential law."""
CUT_SAMPLES = 199
"""Samples of the law with a cut-off from which its goodness of fit is found."""
LARGEST = 0.05
"""Share of the events that are main shocks: the largest."""
FIRST = 1.0
"""Time after a main shock in which the first rate is counted."""
WINDOW = 50.0
"""Time after a main shock in which aftershocks are looked for."""
EXPONENTS = (0.3, 3.0)
"""Exponents of the decay that are tried. Those of earthquakes are 0.6 to 2.5 (Utsu, Ogata and
Matsu'ura 1995)."""


@dataclass(frozen=True)
class SizeLaw:
    """A power law of sizes, density size^-exponent above a least size, and its rivals."""

    exponent: float
    error: float
    least: float
    events: int
    """Events with at least the least size."""
    goodness: float
    """Share of samples of the power law that are farther from it than the data (Kolmogorov and
    Smirnov's distance)."""
    ratios: dict[str, tuple[float, float]]
    """Of each rival the logarithm of the likelihoods' ratio over its standard deviation, positive
    in favour of the power law, and the probability that it is as large by chance."""
    cutoff_ratios: dict[str, tuple[float, float]]
    """The same of the power law with a cut-off and the other rivals."""
    cut_off: "CutOff"
    cutoff_goodness: float
    """The same as the goodness, of the law with a cut-off."""


@dataclass(frozen=True)
class CutOff:
    """The power law with a cut-off, density size^-exponent exp(-size/cutoff) above a least size."""

    exponent: float
    size: float
    """Size at which it is cut off."""
    low: float
    high: float
    """Ends of its interval; 0 or infinity where the likelihood bounds it on one side only."""


def fit_cut_off(sizes: np.ndarray, least: float) -> CutOff:
    """The law of the sizes of at least the least one, by maximum likelihood.

    The interval of the cut-off is that of the profile likelihood.
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
    return CutOff(exponent, least * float(np.exp(-best)), float(low), float(high))


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


def fit_definition(sizes: np.ndarray) -> tuple[float, int, CutOff] | None:
    """The least size, the events above it and the law with a cut-off, if events are enough."""
    searched = sizes[:: max(1, sizes.size // MOST_SEARCHED)]
    if searched.size < FEWEST:
        return None
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # sizes at the bounds of the search
        least = float(powerlaw.Fit(searched, verbose=0).xmin)
    above = int(np.count_nonzero(sizes >= least))
    return (least, above, fit_cut_off(sizes, least)) if above >= FEWEST else None


def shuffle_slips(slips: np.ndarray, per_event: np.ndarray) -> np.ndarray:
    """Sizes of events with as many slips as they have, drawn at random from all slips."""
    drawn = np.random.default_rng(SEED).permutation(slips)[: per_event.sum()]
    return np.add.reduceat(drawn, np.concatenate(([0], np.cumsum(per_event)[:-1])))


def fit_sizes(sizes: np.ndarray) -> SizeLaw | None:
    """The law of the sizes, shape (events); none of fewer than `FEWEST` above the least size."""
    if sizes.size < FEWEST:
        return None
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # sizes at the bounds of the search
        fit = powerlaw.Fit(sizes, verbose=0)
        above = sizes[sizes >= fit.xmin]
        if above.size < FEWEST:
            return None
        ratios = {
            rival: compare(fit, "power_law", rival, nested=rival == CUT_OFF) for rival in RIVALS
        }
        cutoff_ratios = {
            rival: compare(fit, CUT_OFF, rival) for rival in RIVALS if rival != CUT_OFF
        }
        test = stats.goodness_of_fit(
            stats.pareto,
            above,
            known_params={"loc": 0.0, "scale": fit.xmin},
            statistic="ks",
            n_mc_samples=SAMPLES,
            rng=np.random.default_rng(SEED),
        )
    return SizeLaw(
        exponent=float(fit.alpha),
        error=float(fit.sigma),
        least=float(fit.xmin),
        events=above.size,
        goodness=float(test.pvalue),
        ratios=ratios,
        cutoff_ratios=cutoff_ratios,
        cut_off=fit_cut_off(sizes, float(fit.xmin)),
        cutoff_goodness=goodness_of_cut_off(sizes, float(fit.xmin)),
    )


def compare(
    fit: powerlaw.Fit, law: str, rival: str, *, nested: bool = False
) -> tuple[float, float]:
    """The logarithm of the likelihoods' ratio over its standard deviation, and its probability."""
    ratio, chance = fit.distribution_compare(law, rival, nested=nested, normalized_ratio=True)
    return float(ratio), float(chance)


@dataclass(frozen=True)
class AftershockLaw:
    """The rate of events after main shocks, background + productivity (1 + t/delay)^-exponent.

    Times count from the end of the main shock.
    """

    main_shocks: int
    rate: float
    """Events per unit of time in the whole run."""
    first: float
    """The rate in the time `FIRST` after main shocks, over that of the whole run."""
    first_error: float
    background: float
    productivity: float
    delay: float
    exponent: float
    chance: float
    """Probability that a constant rate is as much less likely by chance."""
    over_exponential: float
    """Logarithm of the likelihood over that of a rate that decays exponentially."""


def times_after_main_shocks(
    onset: np.ndarray, duration: np.ndarray, sizes: np.ndarray
) -> tuple[int, np.ndarray]:
    """The number of main shocks, and the times from their ends to the onsets of other events.

    Of events, shape (events). Times are up to `WINDOW`, which all main shocks have before them.
    """
    if sizes.size < FEWEST:
        return 0, np.empty(0)
    end = onset + duration
    main = (sizes >= np.quantile(sizes, 1 - LARGEST)) & (end + WINDOW < onset.max())
    after = (onset - end[main, np.newaxis]).ravel()
    return np.count_nonzero(main), after[(after > 0) & (after < WINDOW)]


def fit_aftershocks(
    onset: np.ndarray, duration: np.ndarray, sizes: np.ndarray, time: float
) -> AftershockLaw | None:
    """The law of Omori and Utsu of all events that begin after the end of the largest ones.

    Of events, shape (events), in a run of some time; none if they are too few.
    """
    shocks, after = times_after_main_shocks(onset, duration, sizes)
    if after.size < FEWEST:
        return None
    rate, soon = sizes.size / time, np.count_nonzero(after < FIRST)
    expected = rate * FIRST * shocks
    constant = after.size * (np.log(after.size / (shocks * WINDOW)) - 1)
    best, (background, productivity, delay, exponent) = fit_decay(shocks, after, power_decay)
    exponential, _ = fit_decay(shocks, after, exponential_decay)
    return AftershockLaw(
        main_shocks=shocks,
        rate=rate,
        first=soon / expected,
        first_error=float(np.sqrt(max(soon, 1)) / expected),
        background=background,
        productivity=productivity,
        delay=delay,
        exponent=exponent,
        chance=float(stats.chi2.sf(2 * max(best - constant, 0.0), 3)),
        over_exponential=best - exponential,
    )


def power_decay(t: np.ndarray, delay: float, exponent: float) -> tuple[np.ndarray, float]:
    """(1 + t/delay)^-exponent, and its integral over `WINDOW`."""
    # the integral of x^-p is boxcox(x, 1 - p), of which p = 1 is no exception
    return (1 + t / delay) ** -exponent, delay * boxcox(1 + WINDOW / delay, 1 - exponent)


def exponential_decay(t: np.ndarray, delay: float, _: float) -> tuple[np.ndarray, float]:
    """exp(-t/delay), and its integral over `WINDOW`."""
    return np.exp(-t / delay), -delay * np.expm1(-WINDOW / delay)


def fit_decay(shocks: int, after: np.ndarray, decay: Callable) -> tuple[float, list[float]]:
    """The largest logarithm of the likelihood of a decay with a background.

    Also background, productivity, delay and exponent there.
    """
    constant = after.size / (shocks * WINDOW)

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
            bounds=np.log(np.array([(1e-3, 10.0), (1e-6, 1e3)]) * constant).tolist()
            + np.log([(1e-2, WINDOW), EXPONENTS]).tolist(),
        )
        for excess in (0.01, 1.0)
        for delay in (0.1, 1.0, 10.0)
    ]
    best = min(fits, key=lambda fit: fit.fun)
    return -float(best.fun), np.exp(best.x).tolist()
