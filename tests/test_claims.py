"""The ledger: claims as they are declared, those of a user's file, rows, files and verdicts."""

import copy
import csv
import json
from collections import Counter

import pytest
from made_up_results import NO, PARTLY, YES, attractor_row, hopf_curve, stability_row

from scripts.claims import declare, ledger
from scripts.claims.claims_results import ANSWERS, NOT_TESTABLE, VERDICTS, read_results
from scripts.claims.decide import Finding
from scripts.config.check_config import checked
from scripts.files.marked_words import to_plain
from scripts.files.read_config import ConfigError

CLAIMS = {
    "moves": {
        "place": "Figure 4b",
        "claim": "The block oscillates at $tau < 3$.",
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
TESTED = {"place": "Figure 2", "claim": "Something is so.", "look_at": "figure_2"}
UNTESTED = {"place": "section 5", "claim": "Something is so.", "not_testable": "No data."}
PLANE, ROUTE = {"plane": "tau_of_epsilon"}, {"routes": ["torus_in_tau"]}
BY_10 = {"test": {"equation_10": PLANE}}


def ledger_of(met: str) -> list[dict]:
    """The rows if the scene ends on this class."""
    made = {
        "curves": {"plane": hopf_curve(gamma=1.0, ordinate="xi")},
        "attractors": [attractor_row(met)],
        "linear_stability": [stability_row()],
        "exponents": [],
    }
    return ledger.rows_of(CLAIMS, made, "results")


def test_another_result_is_another_verdict():
    """Of that claim alone; each row has what the claim says and what its test finds."""
    rows, after = ledger_of("cycle"), ledger_of("fixed point")
    assert [row["id"] for row in rows] == list(CLAIMS)
    assert [row["verdict"] for row in rows] == [YES, YES, NOT_TESTABLE]
    assert [row["look_at"] for row in rows] == [
        "results/figures/figure_4.png",
        "results/tables/hopf-points.tsv",
        "",
    ]
    assert rows[2]["evidence"] == "No data."
    assert all(row[key] == CLAIMS[row["id"]][key] for row in rows for key in ("place", "claim"))
    assert after[0]["verdict"] == NO
    assert rows[1:] == after[1:]


@pytest.mark.parametrize(("verdict", "instead"), [(NO, ""), (YES, "It rests.")])
def test_what_is_true_instead_is_said_where_a_claim_fails(verdict, instead):
    """A test of claims that leaves it out, or says it of a claim that holds, is an error."""
    with pytest.raises(ValueError, match=verdict):
        Finding(verdict, "The evidence.", instead)


def test_ledger_is_written(tmp_path):
    """Mathematics is plain in the table and marked in JSON."""
    rows = ledger_of("fixed point")
    paths = [tmp_path / f"claims.{ending}" for ending in ("tsv", "json")]
    ledger.write_ledger(rows, *paths)
    table, data = (path.read_text() for path in paths)
    assert "\tThe block oscillates at tau < 3.\t" in table
    assert json.loads(data) == rows
    assert sorted(tmp_path.iterdir()) == sorted(paths)


def test_claims_of_the_paper_are_those_of_a_good_file(default_config):
    """Each says something else; every test is used; all that they name is there."""
    config, claims = checked(copy.deepcopy(default_config)), ledger.paper_claims()
    shown = {claim["look_at"] for claim in claims.values() if "look_at" in claim}
    # the study with the figure may not be there
    whole = {name: {"look_at": "figure_2"} | claim for name, claim in claims.items()}
    whole = {name: whole[name] if "test" in claim else claim for name, claim in claims.items()}
    assert ledger.check_user_claims(copy.deepcopy(whole), config, {*shown, "figure_2"}) == whole
    assert len({claim["claim"] for claim in claims.values()}) == len(claims)
    numbers = Counter(claim["whose"] for claim in claims.values())
    assert numbers[declare.PAPER] > 10
    assert {*numbers} <= {declare.PAPER, declare.OURS}
    tested = {name for claim in claims.values() for name in claim.get("test", {})}
    assert tested == set(declare.tests())


@pytest.mark.parametrize(
    ("row", "words"),
    [
        ("equation_3\tsection 1\t\tnot_testable: So.\tIt is so.", "name taken by another claim"),
        ("mine\tsection 9\t\tnot_testable: So.\tIt is so.", "place = 'section 9'; expected one"),
        ("mine\tFigure 12\t\tnot_testable: So.\tIt is so.", "place = 'Figure 12'; expected one"),
    ],
)
def test_bad_row_of_the_table_is_refused(monkeypatch, tmp_path, row, words):
    """A name of another claim, and a place that the paper has not."""
    table = tmp_path / "claims.tsv"
    table.write_text(f"{declare.CLAIMS.read_text()}{row}\n")
    monkeypatch.setattr(declare, "CLAIMS", table)
    with pytest.raises(ValueError, match=words):
        declare.declared_claims.__wrapped__()


@pytest.fixture
def accept(default_config):
    """Check the claims of a user's file over the default configuration."""

    def accept(claims) -> dict:
        config = checked({**copy.deepcopy(default_config), "claims": copy.deepcopy(claims)})
        return ledger.check_user_claims(config["claims"], config, {"figure_2"})

    return accept


def test_good_claims_are_accepted(accept):
    """Limits of equations have a default; a claim without a test has a reason."""
    (found,) = accept({"mine": TESTED | BY_10}).values()
    assert found["test"] == {"equation_10": {**PLANE, "limit": 1e-10}}
    assert accept({"mine": UNTESTED}) == {"mine": UNTESTED}
    assert accept({}) == {}
    with pytest.raises(ConfigError, match="look_at expected beside test"):
        accept({"mine": {**{key: TESTED[key] for key in ("place", "claim")}, **BY_10}})


BAD = {
    "place = ''; expected where it stands": {"place": ""},
    "unknown key ['verdict']; allowed: place": {"verdict": "reproduced"},
    "neither given; expected either test or not_testable": {},
    "look_at expected beside test": {"not_testable": "x"},
    "test = {}; expected the name of one test": {"test": {}},
    "unknown key ['magic']; allowed: ": {"test": {"magic": {}}},
    "test and not_testable given": {**BY_10, "not_testable": "x"},
    "look_at = 'figure_9'; expected one of: atlas.tsv": {**BY_10, "look_at": "figure_9"},
    **{
        f"test {test}{words}": {"test": {test: values}}
        for test, values, words in (
            ("equation_10", {}, ": key ['plane'] is missing"),
            ("equation_10", {"scene": "x", **PLANE}, ": unknown key ['scene']; allowed: plane, l"),
            ("equation_10", {"plane": "x"}, ": plane = 'x'; expected name of a plane, one of: tau"),
            ("hopf_curves", {"planes": []}, ": planes = []; expected names of planes, at least o"),
            ("hopf_by_delay", {"scenes": ["torus"] * 2}, ": scenes = ['torus', 'torus']; expecte"),
            ("chaos_by_a_and_b", {"routes": ["x"]}, " routes: 0 = 'x'; expected name of a route"),
            ("equation_10", {**PLANE, "limit": 0.1}, ": limit = 0.1; expected residual"),
            ("route", {**ROUTE, "expected": ["ring"]}, " expected: 0 = 'ring'; expected one of: f"),
            ("route", {**ROUTE, "expected": []}, ": expected = []; expected classes of attracto"),
            (
                "delays_in_turn",
                {"scenes": ["torus", "chaos"], "expected": ["torus"], "route": "torus_in_tau"},
                ": 1 classes for 2 scenes; expected one each",
            ),
        )
    },
}
"""What is wrong of a claim, by words of its refusal."""


@pytest.mark.parametrize("words", BAD)
def test_bad_claim_is_refused(accept, words):
    """The line names claim, test, key, value and what is allowed."""
    with pytest.raises(ConfigError) as caught:
        accept({"mine": {**TESTED, **BAD[words]}})
    _, line = str(caught.value).splitlines()
    assert line.startswith("config claims mine")
    assert words in line


def read_ledger(folder) -> dict[str, dict]:
    with open(folder / "results" / "tables" / "claims.tsv", newline="") as file:
        return {row["id"]: row for row in csv.DictReader(file, delimiter="\t")}


def test_ledger_of_the_workflow(smoke):
    """Every claim has a verdict with evidence, the same in both files; what it shows is there."""
    rows = read_ledger(smoke.folder)
    assert list(rows) == list(ledger.paper_claims())
    data = json.loads((smoke.folder / "results" / "tables" / "claims.json").read_text())
    plain = [{key: to_plain(value) for key, value in row.items()} for row in data]
    assert plain == list(rows.values())
    for row in rows.values():
        assert row["verdict"] in (ANSWERS.values() if row["whose"] == "ours" else VERDICTS)
        assert row["evidence"].endswith(".")
        assert "nan" not in row["evidence"].split()
        assert "$" not in "".join(row.values())
        fails = (PARTLY, NO, ANSWERS[PARTLY], ANSWERS[NO])
        assert row["instead"].endswith(".") == (row["verdict"] in fails)
        assert row["verdict"] == NOT_TESTABLE or (smoke.folder / row["look_at"]).is_file()


def test_a_claim_alone_needs_no_other_files(smoke, smoke_config):
    """Its verdict from the files that its test reads is that of the whole ledger."""
    rows, results = read_ledger(smoke.folder), str(smoke.folder / "results")
    for name, claim in ledger.paper_claims().items():
        files = json.dumps(ledger.inputs_for({name: claim}, smoke_config))
        given = read_results(json.loads(files.replace("<results>", results)))
        found = ledger.found_of(claim, given)
        expected = {key: rows[name][key] for key in ("verdict", "evidence", "instead")}
        assert {key: to_plain(value) for key, value in found.items()} == expected
