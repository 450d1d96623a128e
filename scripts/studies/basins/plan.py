"""Basins: the share of random histories that reaches each motion where several coexist."""

from scripts.models.models import model_of
from scripts.plans.declare import LONG_RUN, Run, Study, Table
from scripts.requests.attractor_surveys import drawn_histories, survey_groups


def groups(config: dict, place: str) -> dict:
    """Namelist of a place where motions coexist: random histories."""
    basins = config["basins"]
    settings = basins["places"][place]
    ranges = settings.get("histories", basins["histories"])
    histories = drawn_histories(basins["count"], ranges, model_of(config, settings).history)
    return survey_groups(config, "basins", place, place=settings, histories=histories)


def inputs(config: dict) -> dict:
    """Motions at the places, and along routes, which may show others there."""
    return {
        "runs": [f"<results>/attractors/basins/{name}.nc" for name in config["basins"]["places"]],
        "routes": [f"<results>/tables/routes/{route}.tsv" for route in config["routes"]["lines"]],
    }


STUDY = Study(
    reads=("routes",),
    entries={"place": ("basins", "places")},
    runs=(Run("basin_runs", "attractors", "attractors/basins/{place}.nc", groups, **LONG_RUN),),
    tables=(
        Table(
            *("basins_table", "tables/basins.tsv", inputs),
            wanted=lambda config: bool(config["basins"]["places"]),
        ),
    ),
)
