"""The findings at the top of the page, each the file finding.py of a study.

It has its PLACE among the others, the tables that it READS, by the names that claims use, the
CLAIMS that it is about, and a function `describe` that gives its title and a sentence or two.
"""

from types import ModuleType

from scripts.plans import studies

MAIN_CLAIMS = ("delay_alone_makes_chaos", "quasiperiodic_route")
"""Claims of the abstract that stand below the findings."""


def all_findings() -> list[ModuleType]:
    """The findings of all studies in the order of their places."""
    return sorted(studies.load_parts("finding").values(), key=lambda finding: finding.PLACE)


def tables_read() -> dict[str, str]:
    """Paths of the tables that findings read, by name."""
    names = sorted({name for finding in all_findings() for name in finding.READS})
    return {name: f"<results>/{studies.data()[name].output}" for name in names}


def list_findings(claims: list[dict], tables: dict[str, list[dict]]) -> list[dict]:
    """Findings, each with its title, a sentence or two, and the claims that it is about."""
    by_id = {claim["id"]: claim for claim in claims}
    return [
        {
            **finding.describe(tables),
            "claims": [by_id[name] for name in finding.CLAIMS if name in by_id],
        }
        for finding in all_findings()
    ]
