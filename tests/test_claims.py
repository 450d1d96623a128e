"""The ledger: rows, files, and verdicts that follow the configuration."""

import csv
import json
import re

import pytest
from conftest import SMOKE
from made_up_results import (
    attractor_row,
    hopf_curve,
    results,
    slip_events,
    spectrum,
    stability_row,
)

from scripts.claims import ledger
from scripts.claims.claims_config import checked, files_for, listed
from scripts.claims.claims_results import (
    CORRECTED,
    NOT_REPRODUCED,
    NOT_TESTABLE,
    REPRODUCED,
    VERDICTS,
    Finding,
    read_results,
)
from scripts.files.tsv import write_table

CLAIMS = {
    "moves": {
        "place": "Figure 4b",
        "claim": "The block oscillates.",
        "test": {"attractor_class": {"scene": "mine", "expected": "cycle"}},
        "look_at": "figure_4",
    },
    "exact": {
        "place": "section 5",
        "claim": "The formulas are exact.",
        "test": {"hopf_curves": {"planes": ["plane"], "limit": 1e-10}},
        "look_at": "hopf-points.tsv",
    },
    "real": {"place": "section 5", "claim": "Faults do so.", "not_testable": "No data."},
}
MOVED = """
scenes:
  oscillation:
    epsilon: {epsilon}
    t_transient: 7000.0
    t_end: 10000.0
    exponents: {{ count: 6, t_end: 12000.0 }}
attractors:
  observation: {{ t_observed: 6000.0, t_turning: 3000.0 }}
"""
"""The oscillation as in the full reproduction, at an epsilon."""


def ledger_of(met: str) -> list[dict]:
    """The rows where the scene ends so."""
    made = results(
        curves={"plane": hopf_curve(gamma=1.0, ordinate="xi")},
        attractors=[attractor_row(met)],
        linear_stability=[stability_row()],
    )
    return ledger.rows_of(CLAIMS, made, "results")


def test_a_row_for_every_claim():
    """In order, with what the list says and what the test finds."""
    rows = ledger_of("cycle")
    assert [row["id"] for row in rows] == list(CLAIMS)
    assert [row["verdict"] for row in rows] == [REPRODUCED, REPRODUCED, NOT_TESTABLE]
    assert [row["look_at"] for row in rows] == [
        "results/figures/figure_4.png",
        "results/tables/hopf-points.tsv",
        "",
    ]
    assert rows[2]["evidence"] == "No data."
    for row in rows:
        assert {key: row[key] for key in ("place", "claim")}.items() <= CLAIMS[row["id"]].items()


def test_another_result_is_another_verdict():
    """Of that claim alone."""
    before, after = ledger_of("cycle"), ledger_of("fixed point")
    assert after[0]["verdict"] == NOT_REPRODUCED
    assert before[1:] == after[1:]


@pytest.mark.parametrize(("verdict", "instead"), [(NOT_REPRODUCED, ""), (REPRODUCED, "It rests.")])
def test_what_is_true_instead_is_said_where_a_claim_fails(verdict, instead):
    """A test of claims that leaves it out, or says it of a claim that holds, is an error."""
    with pytest.raises(ValueError, match=verdict):
        Finding(verdict, "The evidence.", instead)


def test_files_are_read_by_name(tmp_path):
    """Planes by the names of their files, tables by the names of results."""
    hopf_curve().to_netcdf(tmp_path / "a_plane.nc")
    hopf_curve(k=2).to_netcdf(tmp_path / "friction.nc")
    spectrum(x1=1.0).to_netcdf(tmp_path / "a_spectrum.nc")
    slip_events().to_netcdf(tmp_path / "some_events.nc")
    names = ["hopf_points", "fault_limit", "linear_stability", "stability", "attractors", "atlas"]
    names += ["routes", "cycle_points", "exponents", "basins"]
    for name in names:
        write_table(tmp_path / name, [{"scene": name}])
    files = {
        "friction": str(tmp_path / "friction.nc"),
        "cycles": [],
        "curves": [str(tmp_path / "a_plane.nc")],
        "spectra": [str(tmp_path / "a_spectrum.nc")],
        "slip_events": [str(tmp_path / "some_events.nc")],
        **{name: str(tmp_path / name) for name in names},
    }
    found = read_results(files)
    assert list(found.curves) == ["a_plane"]
    assert list(found.spectra) == ["a_spectrum"]
    assert list(found.slip_events) == ["some_events"]
    assert (found.friction.branch == 2).all()
    for name in names:
        assert getattr(found, name) == [{"scene": name}]


def test_json_is_whole_or_absent(tmp_path):
    """And holds the rows."""
    rows = ledger_of("cycle")
    ledger.write_json(tmp_path / "claims.json", rows)
    assert json.loads((tmp_path / "claims.json").read_text()) == rows
    assert [path.name for path in tmp_path.iterdir()] == ["claims.json"]


def test_page_has_failing_claims_first(tmp_path):
    """Each claim with its result, beside how many have its verdict; no tag comes from a claim."""
    rows = ledger_of("fixed point")
    rows[1]["evidence"] = "1 < 2 & 3"
    ledger.write_page(tmp_path / "claims.html", rows)
    text = (tmp_path / "claims.html").read_text()
    headings = re.findall("<h2>(.*)</h2>", text)
    assert headings == ["Not reproduced", "Reproduced", "Not testable"]
    assert re.findall("<li>(.*)</li>", text)[1] == "reproduced with a correction: 0"
    claims = re.findall(r'<tr><th scope="row">.*</th><td>(.*)</td><td>(.*)</td></tr>', text)
    assert [claim for claim, _ in claims] == [row["claim"] for row in rows]
    assert claims[1][1] == "1 &lt; 2 &amp; 3"


def read_ledger(folder) -> dict[str, dict]:
    """Rows of claims.tsv by id."""
    with open(folder / "results" / "tables" / "claims.tsv", newline="") as file:
        return {row["id"]: row for row in csv.DictReader(file, delimiter="\t")}


def test_ledger_of_the_workflow(smoke):
    """Every claim has a verdict with evidence, the same in both files; what it shows is there."""
    rows = read_ledger(smoke.folder)
    assert list(rows) == list(listed()["claims"])
    tables = smoke.folder / "results" / "tables"
    assert json.loads((tables / "claims.json").read_text()) == list(rows.values())
    for row in rows.values():
        assert row["verdict"] in VERDICTS
        assert row["evidence"].endswith(".")
        assert "nan" not in row["evidence"].split()
        assert row["instead"].endswith(".") == (row["verdict"] in (CORRECTED, NOT_REPRODUCED))
        assert row["verdict"] == NOT_TESTABLE or (smoke.folder / row["look_at"]).is_file()


def test_a_claim_alone_needs_no_other_files(smoke, smoke_config):
    """Its verdict from the files that its test reads is that of the whole ledger."""
    rows, said = read_ledger(smoke.folder), listed()
    shown = {claim["look_at"] for claim in said["claims"].values() if "look_at" in claim}
    results = str(smoke.folder / "results")
    for name, claim in checked(said, smoke_config, shown).items():
        files = json.loads(
            json.dumps(files_for({name: claim}, smoke_config)).replace("<results>", results)
        )
        found = ledger.finding_of(claim, read_results(files))
        assert vars(found) == {key: rows[name][key] for key in ("verdict", "evidence", "instead")}


@pytest.mark.parametrize(
    ("epsilon", "verdict"),
    [pytest.param(0.35, REPRODUCED, marks=pytest.mark.long), (0.2, NOT_REPRODUCED)],
)
def test_scene_below_the_hopf_curve_oscillates_no_more(scratch, epsilon, verdict):
    """From the configuration to the verdict, through the whole workflow."""
    (scratch.folder / "mine.yaml").write_text(MOVED.format(epsilon=epsilon))
    run = scratch.snakemake("claims", *SMOKE, "mine.yaml")
    assert run.returncode == 0, run.stdout
    row = read_ledger(scratch.folder)["figure_4b"]
    assert row["verdict"] == verdict, row["evidence"]
    assert f"epsilon = {epsilon}" in row["evidence"]


def test_bad_list_of_claims_is_refused_in_words(scratch):
    """Before anything runs, without a traceback of Python."""
    path = scratch.folder / "config" / "claims.yaml"
    path.write_text(path.read_text().replace("expected: chaos }", "expected: ring }", 1))
    before = scratch.outputs()
    run = scratch.snakemake(*SMOKE)
    assert run.returncode != 0
    assert "expected = 'ring'; expected class of an attractor, one of: fixed point" in run.stdout
    assert "Traceback" not in run.stdout
    assert scratch.outputs() == before
