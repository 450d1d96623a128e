"""Captions: their templates, numbers and verdicts, of the paper's figures and of users' files."""

import math
import re

import pytest
from jinja2 import nodes
from made_up_results import attractor_row

from conftest import ROOT
from scripts.claims.ledger import paper_claims
from scripts.drawing.wording import as_formulas, count, joined, short, shortened
from scripts.drawing.write_captions import ENVIRONMENT, render
from scripts.page import captions
from scripts.plans import studies
from scripts.tables.attractor_tables import same_attractor

FIGURES = studies.paper_figures()


@pytest.mark.parametrize("figure", FIGURES)
def test_caption_is_written_whole(figure, smoke):
    """In sentences that docutils reads, with nothing left of its template."""
    path = smoke.folder / "results" / "figures" / f"{figure}.rst"
    text = path.read_text()
    assert len(text.split()) >= 8
    assert text.rstrip().endswith(".")
    assert not re.search(r"[{}%]{2}|\bnan\b|None", text)
    sentence = captions.first_sentence(captions.as_html(path))
    assert len(sentence.split()) >= 4
    assert sentence.endswith(".")
    assert not re.search(r"[\\<>`:]{2}|\\", sentence)


def test_captions_say_whether_claims_hold():
    """Each claim that a caption names is one of the list."""
    for figure in FIGURES.values():
        template = (ROOT / figure.template).read_text()
        assert {*re.findall(r'verdict\("(\w+)"\)', template)} <= {*paper_claims()}


@pytest.mark.parametrize("study", studies.studies())
def test_captions_of_users_say_nothing_of_the_papers_claims(study):
    """A file of one's own may have no claims: verdicts stand within `if paper` alone."""
    for kind in studies.studies()[study].kinds:
        tree = ENVIRONMENT.parse((studies.FOLDER / study / kind.caption).read_text())
        allowed = [
            call
            for branch in tree.find_all(nodes.If)
            if isinstance(branch.test, nodes.Name) and branch.test.name == "paper"
            for part in branch.body
            for call in part.find_all(nodes.Call)
        ]
        calls = [call for call in tree.find_all(nodes.Call) if call.node.name == "verdict"]
        assert [call for call in calls if call not in allowed] == []


def test_signal_of_a_users_model_is_not_that_of_the_block():
    """One of the name v has a section and a steady state of its own."""
    given = "end unsettled missed exponents lines roots si place motion section".split()
    text = (studies.FOLDER / "scenes" / "caption.rst").read_text()
    for state, level in (("steady sliding", "rises through 1;"), ("the steady state", "its level")):
        words = {**dict.fromkeys(given, ""), "state": state, "signal": "v"}
        caption = render(text, [], **words)
        assert level in caption
        assert ("a cross" in caption) == (state == "steady sliding")


@pytest.mark.parametrize("text", ['{{ verdict("other") }}', "{{ other }}"])
def test_claim_or_number_that_is_not_there_is_an_error(text):
    with pytest.raises(Exception, match="other"):
        render(text, [])


@pytest.mark.parametrize(
    ("words", "expected"),
    [
        (short(0.0984), "0.0984"),
        (short(-0.0112), "\N{MINUS SIGN}0.0112"),
        (short(1e8), ":math:`10^{8}`"),
        (short(2.5e-7), r":math:`2.5 \times 10^{-7}`"),
        (count(1, "branch", "branches"), "one branch"),
        (count(3, "scene"), "three scenes"),
        (count(0), "no"),
        (count(12, "point"), "12 points"),
        (joined(["a"]), "a"),
        (joined(["a", "b", "c"]), "a, b and c"),
        (shortened("abcdefgh"), "a, b, c, d, e, f, g and h"),
        (shortened("abcdefghi"), "a, …, i"),
        (as_formulas(r"$\tau = 2$ or $u$"), r":math:`\tau = 2` or :math:`u`"),
    ],
)
def test_numbers_and_lists_in_sentences(words, expected):
    """True minus signs, powers of ten, counts in words up to ten, formulas of captions."""
    assert words == expected


def test_rows_of_tables_and_of_files_are_compared_alike():
    """A table's empty cell for the problem of a run is no problem."""
    one = attractor_row("cycle", smallest_maximum=2.0, problem=math.nan)
    assert same_attractor(one, one | {"problem": ""})
    assert same_attractor(one | {"problem": ""}, one)
    assert not same_attractor(one | {"problem": "it stopped"}, one)
