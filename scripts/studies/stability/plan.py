"""Figure of stability: the grid of frequency and delay by two methods, and all other cases."""

import math
from itertools import product

from scripts.models.records import place_of
from scripts.plans.declare import LONG_RUN, Figure, Run, Study, Table
from scripts.requests.program_groups import REFERENCE_STEPS, case_groups


def number_of_cases(config: dict, family: str) -> int:
    """How many combinations a family's lists have."""
    return math.prod(map(len, lists_of(config, family).values()))


def lists_of(config: dict, family: str) -> dict[str, list[float]]:
    """The values of each parameter of a family, and then of each value before the initial time."""
    settings = config["stability"]["families"][family]
    place = place_of(config, settings) | settings["history"]
    del place["law"]
    return {key: one if isinstance(one, list) else [one] for key, one in place.items()}


def cases_of_family(config: dict, family: str) -> list[dict]:
    """All combinations of a family's lists; a name says what differs within the family."""
    settings, lists = config["stability"]["families"][family], lists_of(config, family)
    varied = [key for key, values in lists.items() if len(values) > 1]
    before = settings["history"].keys()
    interval = settings["t_end"] / settings["samples"]
    times = {"t_end": settings["t_end"], "sample_interval": interval}
    cases = []
    for values in product(*lists.values()):
        case = dict(zip(lists, values, strict=True))
        name = " ".join([family, *(f"{key}={case[key]:g}" for key in varied)])
        history = {key: case.pop(key) for key in before}
        cases.append({"name": name, **case, "law": settings["law"], "history": history, **times})
    return cases


def measurement_groups(config: dict, family: str) -> dict[str, dict]:
    """Measured runs of a family."""
    study = config["stability"]
    measure = {
        "methods": study["methods"],
        "tolerances": [study["tolerance"]],
        "most_steps": study["families"][family]["most_steps"],
        **{key: study[key] for key in ("repeats", "least_seconds")},
    }
    return {**case_groups(config, cases_of_family(config, family)), "measure": measure}


def reference_groups(config: dict, family: str) -> dict[str, dict]:
    """References of the same cases."""
    reference = {**config["stability"]["reference"], "most_steps": REFERENCE_STEPS}
    return {**case_groups(config, cases_of_family(config, family)), "reference": reference}


def references(config: dict) -> dict[str, str]:
    """What each family of cases is compared with."""
    return {n: family["reference"] for n, family in config["stability"]["families"].items()}


def inputs(config: dict) -> dict:
    """Measured runs of all families, and the references that they have."""
    families = references(config)
    return {
        "measurements": [f"<results>/measurements/stability/{name}.nc" for name in families],
        "references": [
            f"<results>/references/stability/{name}.tsv"
            for name, reference in families.items()
            if reference == "quadruple"
        ],
    }


STUDY = Study(
    entries={"family": ("stability", "families")},
    runs=(
        Run(
            *("stability_reference", "reference", "references/stability/{family}.tsv"),
            reference_groups,
            quad=True,
            **LONG_RUN,
        ),
        Run(
            *("stability_runs", "measure", "measurements/stability/{family}.nc"),
            measurement_groups,
        ),
    ),
    tables=(
        Table(
            *("stability_table", "tables/stability.tsv", inputs),
            params={"references": references},
            wanted=lambda config: bool(config["stability"]["families"]),
        ),
    ),
    figures=(
        Figure(
            "stability",
            category="Solver",
            place=210,
            inputs=lambda _config: {"table": "<results>/tables/stability.tsv"},
        ),
    ),
    measured=("measurements/stability/",),
)
