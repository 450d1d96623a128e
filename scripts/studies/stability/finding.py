"""The finding about the equations of real faults."""

from scripts.claims.filters import between, where
from scripts.studies.stability.table import SMALL
from scripts.tables.ranges_of_gamma import FAULTS

PLACE = 3
READS = ("stability",)
CLAIMS = ("real_gamma_left_out", "very_stiff_at_real_gamma")


def describe(tables: dict[str, list[dict]]) -> dict:
    """Whether the equations can be solved at the gamma of real faults."""
    least, most = FAULTS
    runs = between(tables["stability"], "gamma", *FAULTS)
    done = {method: where(runs, method=method, status="ok") for method in ("auto", "explicit")}
    started = len(where(runs, method="auto"))
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
