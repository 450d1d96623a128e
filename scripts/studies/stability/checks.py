"""Keys of families that contradict each other."""

from collections.abc import Iterator

from scripts.config.checks import check_constant_delays, check_reference, wrong
from scripts.models.models import model_of
from scripts.studies.stability.plan import cases_of_family, number_of_cases

MOST_CASES = 1000
"""Cases that one namelist holds."""
LONGEST_NAME = 64
"""Letters of a case's name."""
LONG = 1e4
"""Time after which a decaying case counts as stationary."""


def contradictions(config: dict) -> Iterator[str]:
    """Problems of the reference and of the families."""
    study = config["stability"]
    yield from check_reference("config stability reference", study["reference"])
    for name, family in study["families"].items():
        yield from check_family(config, name, family)


def check_family(config: dict, name: str, family: dict) -> Iterator[str]:
    """Problems of the cases of a family."""
    place, count = f"config stability families {name}", number_of_cases(config, name)
    yield from check_constant_delays(config, place, family)
    if count > MOST_CASES:
        yield f"{place}: {count} combinations; expected at most {MOST_CASES}"
        return
    longest = max((case["name"] for case in cases_of_family(config, name)), key=len)
    if len(longest) > LONGEST_NAME:
        yield (
            f"{place}: case '{longest}' of {len(longest)} letters; expected at most {LONGEST_NAME}"
            " (shorten the family's name)"
        )
    if family["reference"] == "stationary" and not model_of(config, family).is_block:
        yield wrong(place, family, "reference", "quadruple or none with a model of one's own")
    elif family["reference"] == "stationary" and family["t_end"] < LONG:
        expected = f"a finite number >= {LONG} where the reference is the stationary state"
        yield wrong(place, family, "t_end", expected)
