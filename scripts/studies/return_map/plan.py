"""Return maps of slip events: slip and the waiting times before and after it.

Slip-predictable and time-predictable events: Shimazaki and Nakata, Geophys. Res. Lett. 7 (1980)
279. Dependence of y on x: Chatterjee, J. Am. Stat. Assoc. 116 (2021) 2009. With n pairs in the
order of x, and r_i the rank of y_i, it is 1 - 3 sum |r_{i+1} - r_i|/(n^2 - 1): 0 if y does not
depend on x, near 1 if y is a function of x.
"""

from scripts.plans.declare import Figure, Study, Table
from scripts.plans.scenes import paths_of_scenes, scenes_of

TABLE = "tables/return-map.tsv"


def inputs(config: dict) -> dict:
    """Slip events of the rows."""
    return {"slip_events": paths_of_scenes("slip_events", scenes_of(config, "return_map"))}


def params(config: dict) -> dict:
    """Labels of the rows."""
    return {"labels": list(config["figures"]["return_map"]["rows"])}


STUDY = Study(
    reads=("events",),
    tables=(Table("return_map_table", TABLE, inputs),),
    figures=(
        Figure(
            "return_map",
            category="Supplement",
            place=135,
            inputs=lambda config: {**inputs(config), "table": f"<results>/{TABLE}"},
            params=params,
        ),
    ),
)
