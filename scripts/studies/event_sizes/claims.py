"""Claims about the sizes of slip events, and about aftershocks."""

import math
from collections.abc import Iterable
from typing import Annotated

from scripts.claims.claims_results import Finding, Results, decided, join, rows_about, short
from scripts.claims.declare import Scenes, claim, number, reads, says, tested_with
from scripts.studies.event_sizes.names_of_laws import (
    PLAUSIBLE,
    RIVALS,
    cut_off_in_words,
    decades_of,
    definition_of,
    exponent_in_words,
    is_usual,
)

LEVEL = 0.01
"""A law is more likely than another one if chance alone has less than this probability."""
MUCH_MORE_LIKELY = 3.0
"""A law is preferred to one that is not nested in it if its log-likelihood is larger by this."""

Decades = Annotated[float, number("decades that a power law spans")]


@claim(56, "gutenberg_richter", "sections 1 and 5", look_at="event_sizes")
@says("The sizes of events in a spring-block model follow the power law of Gutenberg and Richter.")
@tested_with(scenes=["chaos_25", "chaos_50", "chaos_100", "fault_50", "fault_100"], decades=2.0)
@reads("event_sizes")
def power_law_of_sizes(results: Results, *, scenes: Scenes, decades: Decades) -> Finding:
    """Whether sizes follow a power law over this many decades in some chain, and none fits better.

    Only in part if one with a cut-off is plausible over half as many decades, neither an
    exponential law nor a lognormal one is more likely, and all definitions of an event give as many
    decades. They count from the lower cut-off on.
    """
    parts, pure, joined, plausible = [], False, 0.0, 0.0
    for name in scenes:
        row = laws_of(results, name)
        place = f"Chain {name.replace('_', ' ')} has {row['events']:g} events."
        if math.isnan(row["size_exponent"]):
            parts.append(f"{place} They are too few above a lower cut-off to fit a law.")
            continue
        span = math.log10(row["largest"] / row["size_least"])
        better = better_laws(row, RIVALS)
        than_cut_off = better_laws(row, [f"cutoff_over_{rival}" for rival in RIVALS[:-1]])
        pure = pure or (span >= decades and row["size_goodness"] >= PLAUSIBLE and not better)
        if not than_cut_off:
            joined = max(joined, decades_of(row))
            if row["size_cutoff_goodness"] >= PLAUSIBLE:
                plausible = max(plausible, decades_of(row))
        parts.append(
            f"{place} Above a size of {short(row['size_least'], 3)}, over {short(span, 2)} decades"
            f" to the largest, the density falls with the exponent {short(row['size_exponent'], 3)}"
            f" +- {short(row['size_error'], 1)}. The share {short(row['size_goodness'], 2)} of"
            f" samples of this law is farther from it; {PLAUSIBLE:g} is the least of a plausible"
            f" law. More likely laws: {join(better)}. With a cut-off at {cut_off_in_words(row)} the"
            f" exponent is {exponent_in_words(row['size_cutoff_exponent'], 3)}, the share"
            f" {short(row['size_cutoff_goodness'], 2)} of samples is farther, and more likely laws:"
            f" {join(than_cut_off)}."
        )
    others = [row for row in results.event_sizes if row["chain"] in scenes and not is_usual(row)]
    spans = {}
    for definition in dict.fromkeys(map(definition_of, others)):
        rows = [row for row in others if definition_of(row) == definition]
        fitted = [row for row in rows if not math.isnan(row["size_cutoff"])]
        spans[definition] = max(map(decades_of, fitted), default=0.0)
        cut_offs = [
            f"{cut_off_in_words(row)} in {row['chain'].replace('_', ' ')}" for row in fitted
        ]
        parts.append(
            f"With {definition}, the cut-off is {join(cut_offs)}, at most"
            f" {short(spans[definition], 2)} decades above the lower one."
        )
    widest = short(max(spans.values(), default=0.0), 2)
    instead = (
        f"A power law with a cut-off comes closest, over up to {short(joined, 2)} decades with"
        f" v > 1 and overlapping slips as one event, and is plausible over {short(plausible, 2)}."
        f" With other definitions it spans at most {widest} decades."
        if joined >= decades / 2
        else "Sizes of these chains do not follow a power law."
    )
    partly = min([plausible, *spans.values()]) >= decades / 2
    return decided(pure, " ".join(parts), instead, partly=partly)


def better_laws(row: dict, rivals: Iterable[str]) -> list[str]:
    """Names of the laws that are more likely."""
    return [
        rival.removeprefix("cutoff_over_").replace("_", " ")
        for rival in rivals
        if row[f"{rival}_ratio"] < 0 and row[f"{rival}_chance"] < LEVEL
    ]


@claim(57, "omori_utsu", "section 5", look_at="event_sizes")
@says("Spring-block models follow the law of Omori and Utsu.")
@tested_with(scenes=["chaos_25", "chaos_50", "chaos_100", "fault_50", "fault_100"])
@reads("event_sizes")
def decaying_aftershocks(results: Results, *, scenes: Scenes) -> Finding:
    """Whether in some chain events follow large ones at a rate that decays by a power of time.

    An exponential decay must be much less likely, and the power at no end of what is tried.
    """
    parts, power, more = [], False, False
    for name in scenes:
        row = laws_of(results, name)
        place = name.replace("_", " ")
        if math.isnan(row["aftershock_chance"]):
            parts.append(f"Chain {place} has too few events after large ones.")
            continue
        here = row["aftershock_chance"] < LEVEL and row["aftershock_first"] > 1
        more = more or here
        exponent = row["aftershock_exponent"]
        likely = row["aftershock_over_exponential"] > MUCH_MORE_LIKELY
        power = power or (here and likely and not math.isnan(exponent))
        parts.append(
            f"In chain {place} the rate of events in the first unit of time after"
            f" {row['aftershock_main_shocks']:g} large events is"
            f" {short(row['aftershock_first'], 3)} +- {short(row['aftershock_first_error'], 1)} of"
            " its mean. If it were constant, chance alone would make the law of Omori and Utsu as"
            f" much more likely with the probability {short(row['aftershock_chance'], 2)}. That law"
            f" is more likely than an exponential decay by a factor of"
            f" {short(math.exp(row['aftershock_over_exponential']), 2)}. Its exponent is"
            f" {exponent_in_words(exponent, 2)}."
        )
    return decided(
        power,
        " ".join(parts),
        "A few more events follow large ones, for about one unit of time; an exponential decay is"
        " as likely as the law."
        if more
        else "Large events are not followed by more events.",
    )


def laws_of(results: Results, chain: str) -> dict:
    """The laws of the usual events of a chain."""
    rows = rows_about(results.event_sizes, "event-sizes.tsv", "chain", chain)
    return next(row for row in rows if is_usual(row))
