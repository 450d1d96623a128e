"""Figure of slip events: their recurrence times in turn, the distribution of these, and slips."""

from scripts.results.paths import paths_of_scenes, scenes_of


def inputs(config: dict) -> dict:
    """Slip events of the rows."""
    return {"slip_events": paths_of_scenes("slip_events", scenes_of(config, "events"))}


def params(config: dict) -> dict:
    """Labels of the rows."""
    return {"labels": list(config["figures"]["events"]["rows"])}
