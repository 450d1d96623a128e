"""Figure of other laws of friction: classes of motion over epsilon and tau, and fastest slip.

Formulas and sources: `fortran/src/model/laws/`.
"""

from scripts.plans.declare import LONG_RUN, Figure, Run, Study, Table
from scripts.requests.attractor_surveys import survey_groups


def groups(config: dict, friction_law: str, part_of_laws: str) -> dict:
    """Namelist of a plane, or of a scene, under a law of friction.

    Scenes are judged as their attractors are.
    """
    study, section = config["friction_laws"], "friction_laws"
    if part_of_laws in study["planes"]:
        plane = study["planes"][part_of_laws]
        columns = {"window": study["epsilon_window"], "count": study["epsilon_count"]}
        lines = {"window": plane["tau_window"], "count": study["tau_count"]}
        place, histories = {**plane, "epsilon": columns, "tau": lines}, [study["history"]]
    else:
        place, section = config["scenes"][part_of_laws], "attractors"
        histories = [place["history"]]
    return survey_groups(
        config,
        section,
        f"{part_of_laws} with {friction_law}",
        place={**place, "law": friction_law},
        histories=histories,
    )


def parts(config: dict) -> list[str]:
    """Planes and scenes."""
    return [*config["friction_laws"]["planes"], *config["friction_laws"]["scenes"]]


def inputs(config: dict) -> dict:
    """Runs of all laws: a plane or a scene each."""
    laws = config["friction_laws"]["laws"]
    runs = [f"<results>/attractors/laws/{law}/{part}.nc" for law in laws for part in parts(config)]
    return {"runs": runs}


def params(config: dict) -> dict:
    """Quantities in SI by which nondimensional times are those of a fault and a laboratory."""
    return {name: config["scenes"][name]["si"] for name in ("natural_fault", "laboratory")}


STUDY = Study(
    reads=("attractors", "routes", "scenes"),
    wildcards={
        "friction_law": lambda config: config["friction_laws"]["laws"],
        "part_of_laws": parts,
    },
    runs=(
        Run(
            *("law_runs", "attractors", "attractors/laws/{friction_law}/{part_of_laws}.nc"),
            groups,
            **LONG_RUN,
        ),
    ),
    tables=(
        Table(
            *("friction_laws_table", "tables/friction-laws.tsv", inputs),
            params={"scenes": lambda config: config["friction_laws"]["scenes"]},
            of_all_laws=True,
        ),
    ),
    figures=(
        Figure(
            "friction_laws",
            category="Atlas",
            place=350,
            inputs=lambda _config: {"table": "<results>/tables/friction-laws.tsv"},
            params=params,
        ),
    ),
)
