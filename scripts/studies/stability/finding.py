"""The finding about the equations of real faults."""

from scripts.studies.stability.claims import SMALL, runs_between
from scripts.tables.ranges_of_gamma import FAULTS

PLACE = 3
READS = ("stability",)
CLAIMS = ("real_gamma_left_out", "very_stiff_at_real_gamma")


def describe(tables: dict[str, list[dict]]) -> dict:
    """Whether the equations can be solved at the gamma of real faults."""
    least, most = FAULTS
    names = ("auto", "explicit")
    runs = {method: runs_between(tables["stability"], method, *FAULTS) for method in names}
    done = {method: [row for row in rows if row["status"] == "ok"] for method, rows in runs.items()}
    started = len(runs["auto"])
    steps = max((row["steps"] for row in done["auto"]), default=0)
    large = sum(row["error"] > SMALL for row in done["auto"])
    magnified = f" In {large} of them the problem magnifies errors beyond {SMALL:g}." * (large > 0)
    share = "All" if len(done["auto"]) == started else f"{len(done['auto'])} of"
    return {
        "title": "The paper's range of $gamma$ is accessible."
        if done["auto"]
        else "The paper's range of $gamma$ is not accessible.",
        "words": f"The paper leaves out $gamma = {least:.0e}$ to {most:.0e}. {share} {started} runs"
        f" there reach their end, each in at most {steps:.0f} steps. With explicit steps alone"
        f" {len(done['explicit']) or 'none'} do.{magnified}",
    }
