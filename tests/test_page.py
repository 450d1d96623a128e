"""The page: what it says of made-up results, and the page of the smoke run as a file."""

import json
import re
from collections import Counter
from html.parser import HTMLParser
from pathlib import Path

import pytest
from docutils.utils import SystemMessage
from jinja2 import UndefinedError
from made_up_page import claim

from conftest import ROOT
from scripts.claims.claims_results import CORRECTED, NOT_REPRODUCED, NOT_TESTABLE, VERDICTS
from scripts.claims.ledger import paper_claims
from scripts.files.marked_words import to_html
from scripts.page import captions, findings, page_content, write_page
from scripts.plans.studies import paper_figures


class Elements(HTMLParser):
    """Elements of a page with their attributes, and its text."""

    def __init__(self, text: str):
        super().__init__()
        self.found, self.text = [], ""
        self.feed(str(text))
        self.close()
        self.text = " ".join(self.text.split())

    def handle_starttag(self, tag, attrs):
        self.found.append((tag, dict(attrs)))

    def handle_data(self, data):
        self.text += data

    def values(self, attribute: str) -> list[str]:
        return [attributes[attribute] for _, attributes in self.found if attribute in attributes]


@pytest.fixture(scope="module")
def page(smoke) -> str:
    return (smoke.folder / "results" / "index.html").read_text()


def caption_of(smoke, figure: str) -> str:
    return captions.as_html(smoke.folder / "results" / "figures" / f"{figure}.rst")


def test_caption_with_formulas(tmp_path):
    """Formulas are MathML, in words without spaces; no line ends before % or after ±."""
    (tmp_path / "caption.rst").write_text("Curves :math:`\\tau = 2` & 1 ± 2 %. The rest.")
    markup = captions.as_html(tmp_path / "caption.rst")
    assert "<math" in markup
    assert "1 ±\N{NO-BREAK SPACE}2\N{NO-BREAK SPACE}%" in markup
    assert captions.first_sentence(markup) == "Curves τ=2 & 1 ± 2 %."


def test_caption_with_a_table(tmp_path):
    """It is below the first paragraph, in a frame that scrolls by keyboard, too."""
    (tmp_path / "caption.rst").write_text("Events.\n\n=  =\nN  c\n=  =\n5  9\n=  =\n\nEnd.")
    markup = captions.as_html(tmp_path / "caption.rst")
    (table,) = re.findall(r'(?s)</p>\s*<div class="scroll" tabindex="0">(.*?)</div>\s*<p', markup)
    assert captions.as_words(table).split() == ["N", "c", "5", "9"]


def test_caption_that_cannot_be_read_is_an_error(tmp_path):
    """docutils would put a red box on the page."""
    (tmp_path / "caption.rst").write_text("A :nonsense:`role`.")
    with pytest.raises(SystemMessage, match="nonsense"):
        captions.as_html(tmp_path / "caption.rst")


@pytest.mark.parametrize(
    ("look_at", "place", "expected"),
    [
        ("results/figures/figure_3.png", "Figure 2", "figure_3"),
        ("results/tables/to-chaos.tsv", "below Figure 2", "to_chaos"),
        ("results/tables/b.tsv", "abstract; below Figure 2", "figure_2"),
        ("results/tables/b.tsv", "Figure 3b", "figure_3"),
        ("results/tables/b.tsv", "Figure 9", ""),
        ("results/mine/figures/scenes/my_scene.png", "my claim", "scenes/my_scene"),
        ("", "section 1", ""),
    ],
)
def test_claim_stands_beside_one_figure(look_at, place, expected):
    """That to look at, that of the table to look at, the one that the paper names, or none."""
    figures = [{"name": n} for n in ("figure_2", "figure_3", "to_chaos", "scenes/my_scene")]
    assert page_content.figure_of({"look_at": look_at, "place": place}, figures) == expected


def test_claims_that_fail_stand_first(tmp_path):
    """The others keep their order; a claim links to its table from the folder of the page."""
    verdicts = [VERDICTS[0], NOT_TESTABLE, CORRECTED, NOT_REPRODUCED, VERDICTS[0]]
    claims = [claim(str(i), verdict) for i, verdict in enumerate(verdicts)]
    claims[0]["look_at"] = "results/mine/tables/a.tsv"
    (tmp_path / "claims.json").write_text(json.dumps(claims))
    read = page_content.read_claims(tmp_path / "claims.json", Path("results/mine"))
    assert [one["id"] for one in read] == ["3", "2", "0", "1", "4"]
    assert [one["table"] for one in read] == ["", "", "tables/a.tsv", "", ""]


def test_equations_mark_what_differs_from_the_print():
    """A corrected part is boxed and the print stands below; the claims beside them exist."""
    claims = [claim(name) for name in paper_claims()]
    shown = page_content.set_equations(ROOT / "scripts/page/templates/equations.yaml", claims)
    equations = shown["model"] + shown["hopf"]
    assert [one["number"] for one in equations] == ["(4)", "(5)", "(6)", "(7), (8)", "(9)", "(10)"]
    for one in equations:
        assert one["correct"].startswith("<math")
        assert ('class="boxed"' in one["correct"]) == bool(one["printed"])
    beside = {one["id"] for one in shown["model_claims"] + shown["hopf_claims"]}
    assert beside == {f"equation_{number}" for number in (3, 4, 6, 8, 9, 10)}


def test_missing_value_is_an_error():
    """Jinja would leave a hole in the page."""
    with pytest.raises(UndefinedError):
        write_page.render("index.html.jinja", name="mine")


def test_page_loads_nothing_from_elsewhere(page):
    """Its policy: nothing is loaded by default, no base changes its links, no form is sent."""
    found = Elements(page).found
    policies = [a["content"] for tag, a in found if a.get("http-equiv", "").endswith("Policy")]
    (directives,) = [[one.strip() for one in policy.split(";")] for policy in policies]
    assert {"default-src 'none'", "base-uri 'none'", "form-action 'none'"} <= {*directives}


def test_every_claim_stands_in_the_page_once(smoke, page):
    """With its verdict and its evidence; the main ones stand with the findings.

    Our questions have a section and a count of their own.
    """
    claims = json.loads((smoke.folder / "results/tables/claims.json").read_text())
    shown = Elements(page)
    ids = Counter(shown.values("id"))
    assert len(claims) > 40
    for row in claims:
        assert ids[f"claim-{row['id']}"] == 1
        for words in (f"{row['claim']} {row['verdict']}", row["instead"], row["evidence"]):
            assert Elements(to_html(words)).text in shown.text
    for verdict in VERDICTS:
        count = sum(row["verdict"] == verdict for row in claims)
        assert (f"{verdict} {count} claim" in shown.text) is (count > 0)
    questions = page[page.index('id="questions"') : page.index('id="equations"')]
    ours = re.findall(r'id="claim-(\w+)"', questions)
    assert ours == [row["id"] for row in claims if row["whose"] == "ours"]
    assert f"The paper does not ask these {len(ours)}." in questions
    start, end = page.index('id="findings"'), page.index('id="questions"')
    for name in findings.MAIN_CLAIMS:
        assert start < page.index(f'id="claim-{name}"') < end


def test_every_figure_stands_in_the_page(smoke, page):
    shown = Elements(page)
    images = {given["src"]: given["alt"] for tag, given in shown.found if tag == "img"}
    sentences = {name: captions.first_sentence(caption_of(smoke, name)) for name in paper_figures()}
    assert images == {f"figures/{name}.svg": sentences[name] for name in paper_figures()}
    assert all(f"Rule {name}." in shown.text for name in paper_figures())
    # a phone would cut the labels at the right of the Hopf curves
    assert page.count('class="scroll drawn fits"') >= 4


def test_every_link_of_the_page_resolves(smoke, page):
    """To a file beside it or to a place in the page."""
    shown = Elements(page)
    links = shown.values("href") + shown.values("src")
    ids = shown.values("id")
    assert len(ids) == len(set(ids))
    places = [link[1:] for link in links if link.startswith("#")]
    files = [link for link in links if not link.startswith(("#", "data:"))]
    assert (len(places) > 20, len(files) > 40) == (True, True)
    assert set(places) <= set(ids)
    assert [link for link in files if not (smoke.folder / "results" / link).is_file()] == []
    assert not [link for link in files if re.match(r"\w+:|/", link)]
