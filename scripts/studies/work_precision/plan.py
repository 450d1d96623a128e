"""Figure of work against precision: one panel a scene, one line a solver."""

import re
from pathlib import Path

from scripts.models.records import place_of
from scripts.plans.declare import LONG_RUN, Figure, Run, Study, Table
from scripts.requests.program_groups import REFERENCE_STEPS, case_groups

OTHERS = "benchmarks/measured.tsv"


def cases_of(config: dict) -> dict[str, dict]:
    """Measured cases by name, each up to its t_end: scenes, as they are, and harder ones."""
    study, scenes = config["work_precision"], config["scenes"]
    of_scenes = {
        name: place_of(config, scenes[name]) | {"history": scenes[name]["history"]} | settings
        for name, settings in study["scenes"].items()
    }
    return {name: {"name": name, **case} for name, case in (of_scenes | study["cases"]).items()}


def groups_of(config: dict, case: str) -> dict[str, list[dict]]:
    """A case in full length."""
    return case_groups(config, [cases_of(config)[case]])


def trust_groups(config: dict, case: str) -> dict[str, dict]:
    """A run of the least tolerance, which is compared with the reference."""
    measure = {
        "methods": ["auto"],
        "tolerances": [min(config["work_precision"]["tolerances"])],
        "most_steps": REFERENCE_STEPS,
        "repeats": 0,
        "least_seconds": 0.0,
    }
    return {**groups_of(config, case), "measure": measure}


def reference_groups(config: dict, case: str) -> dict[str, dict]:
    """The reference of a case."""
    reference = {**config["work_precision"]["reference"], "most_steps": REFERENCE_STEPS}
    return {**groups_of(config, case), "reference": reference}


def measurement_groups(config: dict, case: str) -> dict[str, dict]:
    """Measured runs of a case."""
    keys = ["methods", "tolerances", "steps", "most_steps", "repeats", "least_seconds"]
    measure = {key: config["work_precision"][key] for key in keys}
    return {**groups_of(config, case), "measure": measure}


def inputs_of(study: str):
    """What a table of runs of a study is made of, by the configuration."""
    return lambda config: {
        "measurements": [f"<results>/measurements/{study}/{case}.nc" for case in cases_of(config)],
        "references": [f"<results>/references/trust/{case}.tsv" for case in cases_of(config)],
    }


def params(_config: dict) -> dict:
    """The date on which other solvers were measured, from the first lines of their table."""
    measured = Path(__file__).parents[3] / OTHERS
    return {"date": re.search(r"^# date: (\S+)$", measured.read_text(), re.MULTILINE)[1]}


STUDY = Study(
    reads=("scenes",),
    entries={
        "measured_scene": ("work_precision", "scenes"),
        "measured_case": ("work_precision", "cases"),
    },
    wildcards={"case": r"\w+"},
    runs=(
        Run(
            *("trust_reference", "reference", "references/trust/{case}.tsv", reference_groups),
            quad=True,
            **LONG_RUN,
        ),
        Run("trust_runs", "measure", "measurements/trust/{case}.nc", trust_groups),
        Run(  # the methods take turns, so that what else the machine does hits all alike
            *("work_precision_runs", "measure", "measurements/work_precision/{case}.nc"),
            measurement_groups,
            needs={"horizons": "tables/trusted-horizons.tsv"},
            horizons=True,
            **LONG_RUN,
        ),
    ),
    tables=(
        Table(
            *("trusted_horizons", "tables/trusted-horizons.tsv", inputs_of("trust")),
            params={"trusted_error": lambda config: config["work_precision"]["trusted_error"]},
            script="horizons_table.py",
        ),
        Table(
            *("work_precision_table", "tables/work-precision.tsv", inputs_of("work_precision")),
            more_outputs={"proportionality": "tables/tolerance-proportionality.tsv"},
            wanted=lambda config: bool(config["work_precision"]["scenes"]),
        ),
    ),
    figures=(
        Figure(
            "work_precision",
            category="Solver",
            place=220,
            inputs=lambda _config: {
                "table": "<results>/tables/work-precision.tsv",
                "others": OTHERS,
            },
            params=params,
        ),
    ),
    measured=(
        *("measurements/trust/", "measurements/work_precision/"),
        *("figures/work_precision", "tables/work-precision.tsv"),
    ),
    uses=lambda config: {"scene": list(config["work_precision"]["scenes"])},
)
