"""The page: what it says of made-up results, and the page of the smoke run as a file."""

import base64
import json
import re
from collections import Counter
from html.parser import HTMLParser

import made_up_page
import numpy as np
import pytest
import xarray as xr
from conftest import ROOT, SMOKE, rules_in
from docutils.utils import SystemMessage
from jinja2 import UndefinedError
from made_up_page import attractor, claim, content, figure, run

from scripts.claims.claims_config import listed
from scripts.claims.claims_results import CORRECTED, NOT_REPRODUCED, NOT_TESTABLE, VERDICTS
from scripts.figures.registry import FIGURES, caption_of
from scripts.page import (
    captions,
    findings,
    mathematics,
    page_content,
    page_provenance,
    page_views,
    write_page,
)


class Elements(HTMLParser):
    """Elements of a page with their attributes, and its text."""

    def __init__(self, text: str):
        super().__init__()
        self.found, self.text = [], ""
        self.feed(str(text))
        self.close()

    def handle_starttag(self, tag, attrs):
        self.found.append((tag, dict(attrs)))

    def handle_data(self, data):
        self.text += data

    def values(self, attribute: str) -> list[str]:
        """Of an attribute, wherever it stands."""
        return [attributes[attribute] for _, attributes in self.found if attribute in attributes]


@pytest.fixture(scope="module")
def smoke_page(smoke) -> Elements:
    """The page of the smoke run."""
    return Elements((smoke.folder / "results" / "index.html").read_text())


@pytest.mark.parametrize("name", FIGURES)
def test_caption_has_a_first_sentence_in_plain_signs(name, smoke):
    """For those who do not see the figure."""
    sentence = captions.first_sentence(
        captions.as_html(smoke.folder / caption_of(name).replace("<results>", "results"))
    )
    assert len(sentence.split()) >= 4
    assert sentence.endswith(".")
    assert not re.search(r"[\\<>`:]{2}|\\", sentence)


def test_caption_with_formulas(tmp_path):
    """Set by the browser, in words without spaces; a line ends neither at % nor after ±."""
    (tmp_path / "caption.rst").write_text("Curves :math:`\\tau = 2` & 1 ± 2 %. The rest.")
    markup = captions.as_html(tmp_path / "caption.rst")
    assert "<math" in markup
    assert "1 ±\N{NO-BREAK SPACE}2\N{NO-BREAK SPACE}%" in markup
    assert captions.first_sentence(markup) == "Curves τ=2 & 1 ± 2 %."


def test_caption_that_cannot_be_read_is_an_error(tmp_path):
    """Not a red box on the page."""
    (tmp_path / "caption.rst").write_text("A :nonsense:`role`.")
    with pytest.raises(SystemMessage, match="nonsense"):
        captions.as_html(tmp_path / "caption.rst")


@pytest.mark.parametrize(
    ("given", "expected"),
    [
        ({"look_at": "results/figures/figure_3.png", "place": "Figure 2"}, "figure_3"),
        ({"look_at": "results/tables/to-chaos.tsv", "place": "below Figure 2"}, "to_chaos"),
        ({"look_at": "results/tables/b.tsv", "place": "abstract; below Figure 2"}, "figure_2"),
        ({"look_at": "results/tables/b.tsv", "place": "Figure 3b"}, "figure_3"),
        ({"look_at": "results/tables/b.tsv", "place": "Figure 9"}, ""),
        ({"look_at": "", "place": "section 1"}, ""),
    ],
)
def test_claim_stands_beside_one_figure(given, expected):
    """The one to look at, that of the table to look at, the paper's own, or none."""
    figures = [figure("figure_2"), figure("figure_3")]
    figures.append(figure("to_chaos", "Supplement"))
    placed = page_content.claims_by_figure(figures, [claim("it", **given)])
    assert [name for name, claims in placed.items() if claims] == [expected]


def test_claims_that_fail_stand_first():
    """In each group, the others in their order."""
    verdicts = [VERDICTS[0], NOT_TESTABLE, CORRECTED, NOT_REPRODUCED, VERDICTS[0]]
    claims = [claim(str(i), verdict) for i, verdict in enumerate(verdicts)]
    assert [one["id"] for one in page_content.failing_first(claims)] == ["3", "2", "0", "1", "4"]


@pytest.mark.parametrize(
    ("words", "expected"),
    [
        ("gamma^2 xi/(xi + gamma^2)", "γ2 ξ/(ξ + γ2)"),
        ("0.0174 +- 0.0029 v0/L", "0.0174 ±\N{NO-BREAK SPACE}0.0029 v0/L"),
        ("38 % of it", "38\N{NO-BREAK SPACE}% of it"),
        (
            "by -8.3e-07, at 1e4 to 1e+12",
            "by −8.3\N{NO-BREAK SPACE}×\N{NO-BREAK SPACE}10−7, at 104 to 1012",
        ),
        ("d theta/dt = -x ln x <= 1", "dθ/dt\N{NO-BREAK SPACE}=\N{NO-BREAK SPACE}−x ln x ≤ 1"),
        (
            "(B - A)/A of a spring-block at A larger mu0",
            "(B − A)/A of a spring-block at A larger μ0",
        ),
        ("tau_of_epsilon and fixed_point", "τ(ε) and fixed point"),
        ("1e-06 m/s, the paper's, 1 < 2", "10−6 m/s, the paper’s, 1 < 2"),
        ("1/s^b", "1/sb"),
    ],
)
def test_words_become_mathematics(words, expected):
    """Greek letters, powers, signs and minus; the article `a` and hyphens stay."""
    assert Elements(mathematics.of_words(words)).text == expected


def test_powers_and_indices_are_raised_and_lowered():
    """As elements, so that they are read as such."""
    assert mathematics.of_words("gamma^2 < v0") == (
        "<var>γ</var><sup>2</sup> &lt; <var>v</var><sub>0</sub>"
    )


def test_equations_mark_what_differs_from_the_print():
    """A boxed part, and what is printed there; the claims beside them exist."""
    shown = page_content.equations(
        made_up_page.EQUATIONS, [claim(name) for name in listed()["claims"]]
    )
    equations = shown["model"] + shown["hopf"]
    assert [one["number"] for one in equations] == ["(4)", "(5)", "(6)", "(7), (8)", "(9)", "(10)"]
    for one in equations:
        assert one["correct"].startswith("<math")
        assert ('class="boxed"' in one["correct"]) == bool(one["printed"])
    beside = {one["id"] for one in shown["model_claims"] + shown["hopf_claims"]}
    assert beside == {f"equation_{number}" for number in (3, 4, 6, 8, 9, 10)}


def motion(scene: str, kind: str, exponents: list[float], f2: float) -> dict:
    """A row of attractors.tsv with errors of 0.001."""
    row = {"scene": scene, "history": 1.0, "tau": 10.0, "class": kind, "f1": 0.1, "f2": f2}
    row |= {f"exponent_{i}": value for i, value in enumerate(exponents, 1)}
    return row | {f"error_{i}": 0.001 for i in (1, 2, 3)}


def test_findings_follow_the_tables():
    """Their titles, too."""
    torus = motion("torus", "cycle", [0.0, -0.01, -0.02], np.nan)
    true_torus = motion("true_torus", "torus", [0.002, -0.002, -0.02], 0.3) | {"tau": 12.5}
    point = {"of": "a", "kind": "hopf_without_delay", "epsilon": 0.25, "xi": 0.5, "gamma": 0.8}
    turn = {"of": "b", "kind": "generalised_hopf"}
    of_a_scene = {"of": "torus", "kind": "amplitude_death_begin"}
    runs = [
        {"gamma": gamma, "method": method, "status": status, "steps": 7.0}
        for gamma, method, status in (
            (1e4, "auto", "ok"),
            (1e12, "explicit", "stopped"),
            (0.8, "auto", "stopped"),
        )
    ]
    limit = [
        {"gamma": gamma, "xi": 0.5, "without_delay": 0.25, "depth": depth}
        for gamma, depth in ((0.8, 0.0481), (1e4, 9.3e-18))
    ]
    tables = {"attractors": [torus, true_torus], "hopf_points": [point, turn, of_a_scene]}
    tables |= {"stability": runs}
    two, one, three = findings.findings([claim("figure_5a")], tables | {"fault_limit": limit})
    assert one["title"] == "The paper's torus is a limit cycle."
    assert (
        "At tau = 10 it has one zero Lyapunov exponent and the fundamental frequency f1 = 0.1."
        in (one["words"])
    )
    assert (
        "a torus: it has two zero Lyapunov exponents and the fundamental frequencies f1 = 0.1 and"
        in (one["words"])
    )
    assert [given["id"] for given in one["claims"]] == ["figure_5a"]
    assert "at epsilon = 0.25 for xi = 0.5 and gamma = 0.8." in two["words"]
    assert (
        "by 0.048 there, but by 9e-18 only at gamma = 1e+04. Along the Hopf curves of 2 planes"
        in (two["words"])
    )
    assert two["words"].endswith(" at 1 point.")
    assert "All 1 runs there reach their end, each in at most 7 steps." in three["words"]
    assert three["words"].endswith("none do.")
    changed = {"attractors": [true_torus | {"scene": "torus"}, true_torus], "hopf_points": []}
    changed |= {"fault_limit": limit, "stability": runs[1:]}
    titles = [found["title"] for found in findings.findings([], changed)]
    assert titles[1:] == [
        "The paper's torus is a torus.",
        "The paper's range of gamma is not accessible.",
    ]


def test_main_claims_stand_with_the_findings(smoke):
    """Not in an appendix, and not twice."""
    text = (smoke.folder / "results" / "index.html").read_text()
    start, end = text.index('id="findings"'), text.index('id="equations"')
    for name in findings.MAIN_CLAIMS:
        assert start < text.index(f'id="claim-{name}"') < end
        assert text.count(f'id="claim-{name}"') == 1


def test_citation_names_this_work_and_the_paper():
    """By CITATION.cff."""
    cited = page_provenance.citation(ROOT / "CITATION.cff")
    assert cited["licence"] == "GPL-3.0-or-later"
    own, paper = cited["works"]
    assert own.startswith("The maintainers of this reproduction")
    assert paper.startswith("Kostić, Srđan, Vasović, Nebojša, Franović, Igor, Todorović, Kristina")
    assert "Time-delay in spring-block model for aperiodicity in earthquakes" in paper
    assert re.search(r"<https://studylib\.net/doc/18071566/\S+>", paper)


def test_size_of_a_drawing(tmp_path):
    """A point of the drawing is 1.3 pixels of the page."""
    (tmp_path / "a.svg").write_text('<svg viewBox="0 0 100 50.5">')
    assert page_content.size_of(tmp_path / "a.svg") == (130, 66)


def test_figures_of_the_solver_come_last():
    """The others in their order."""
    figures = [figure("a"), figure("b", "Solver"), figure("c", "Atlas"), figure("d")]
    sections = page_content.sections(figures, [])
    assert {name: [one["name"] for one in shown] for name, shown in sections.items()} == {
        "Figures": ["a", "d"],
        "Atlas": ["c"],
        "Solver": ["b"],
    }


def test_opening_is_the_first_paragraph():
    """Without its title and marks."""
    words = page_content.opening("# Title\n\nThe *work*\nof <us>.\n\nMore.\n")
    assert words == "The <cite>work</cite> of &lt;us>."


def test_trajectory_is_thinned_to_its_last_part():
    """Every second sample of the last 1000 units of time, with class and exponents."""
    own = {**attractor(0.5, 10.0), "scene": "my_scene", "history": 1.0}
    other = {**own, "history": 2.0, "class": "chaos"}
    shown = page_views.trajectory(run(), [other, own])
    assert (shown["start"], shown["every"], shown["step"]) == (500.0, 2, 0.1)
    v = np.frombuffer(base64.b64decode(shown["series"][0]["values"]), "<f4")
    np.testing.assert_allclose(v, 1 + 0.5 * np.cos(500 + 0.1 * np.arange(10001)), atol=1e-6)
    assert shown["words"] == (
        "ε = 0.5, τ = 10, ξ = 0.8, γ = 0.8: cycle;"
        " exponents −0.01 ± 0.001, −0.02 ± 0.001, −0.03 ± 0.001"
    )


def test_numbers_of_views_have_signs_of_print():
    """A factor of 1 is left out; digits without an exponent stay."""
    said = mathematics.in_signs("1e+08, -1.1e-05, 21 and 0.1")
    assert said == "10⁸, −1.1 × 10⁻⁵, 21 and 0.1"


def test_short_trajectory_is_shown_whole():
    """Every sample."""
    own = {**attractor(0.5, 10.0), "scene": "my_scene", "history": 1.0}
    shown = page_views.trajectory(run(count=101), [own])
    assert (shown["start"], shown["every"]) == (0.0, 1)
    assert len(base64.b64decode(shown["series"][1]["values"])) == 4 * 101


def test_samples_that_follow_the_motion_keep_their_times():
    """None of the last 12 000 is left out: it may be a maximum."""
    whole = run()
    times = np.sort(np.append(whole.t, whole.t[-200:-1] + 0.01))
    shown = page_views.trajectory(whole.interp(t=times), [])
    assert (shown["start"], shown["every"]) == (times[-12_000], 1)
    sent = np.frombuffer(base64.b64decode(shown["times"]), "<f4")
    np.testing.assert_allclose(sent, times[-12_000:] - times[-12_000], atol=1e-4)


def test_scene_that_keeps_less_is_drawn_as_far_as_it_goes():
    """Without u, v alone; with neither there is nothing to draw."""
    own = {**attractor(0.5, 10.0), "scene": "my_scene", "history": 1.0}
    without_u = run(count=101).drop_vars("u")
    series = page_views.trajectory(without_u, [own])["series"]
    assert [one["name"] for one in series] == ["v"]
    assert page_views.can_be_drawn(without_u)
    assert not page_views.can_be_drawn(without_u.drop_vars("v"))


def test_scene_whose_attractor_is_unknown_says_so():
    """It is still drawn."""
    words = page_views.trajectory(run(count=101), [])["words"]
    assert words.endswith("γ = 0.8: its attractor was not computed")


def test_programs_are_told_by_version_and_compiler(tmp_path):
    """As the files say."""
    for name, compiler in (("a", "one"), ("b", "one"), ("c", "two")):
        made = xr.Dataset(attrs={"program_version": "1.2", "compiler": compiler})
        made.to_netcdf(tmp_path / f"{name}.nc")
    files = [str(tmp_path / f"{name}.nc") for name in "abc"]
    assert page_provenance.programs(files) == [
        {"version": "1.2", "compiler": "one", "files": 2},
        {"version": "1.2", "compiler": "two", "files": 1},
    ]


def test_seconds_are_summed_over_the_jobs_of_a_rule(tmp_path):
    """Memory as far as it was seen; a rule that did not run has no row."""
    for name, line in (("a", "1.5\t-"), ("b/c", "2.5\t30.0"), ("d", "4.0\t20.0")):
        path = tmp_path / f"{name}.tsv"
        path.parent.mkdir(exist_ok=True)
        path.write_text(f"s\tmax_rss\n{line}\n")
    patterns = {"one": f"{tmp_path}/{{x}}.tsv", "two": f"{tmp_path}/none/{{x}}/{{y}}.tsv"}
    (row,) = page_provenance.seconds(patterns)
    assert row == {"rule": "one", "jobs": 3, "seconds": 8.0, "longest": 4.0, "memory": 30.0}


def test_missing_value_is_an_error():
    """Not a hole in the page."""
    given = content()
    del given["commit"]
    with pytest.raises(UndefinedError, match="commit"):
        write_page.rendered("index.html.jinja", **given)


def test_page_lets_nothing_lead_elsewhere():
    """Its policy: nothing is loaded by default, no base changes its links, no form is sent."""
    page = Elements(write_page.rendered("index.html.jinja", **content()))
    policies = [a["content"] for tag, a in page.found if a.get("http-equiv", "").endswith("Policy")]
    (directives,) = [[one.strip() for one in policy.split(";")] for policy in policies]
    assert {"default-src 'none'", "base-uri 'none'", "form-action 'none'"} <= {*directives}


def test_words_of_the_ledger_are_no_markup():
    """What looks like a tag is text."""
    text = write_page.rendered("index.html.jinja", **content())
    assert "0 &lt; 1 &amp; so on" in text
    assert "0 < 1 & so on" in Elements(text).text


@pytest.mark.parametrize("part", ["trajectories", "unplaced"])
def test_page_without_a_part_has_no_trace_of_it(part):
    """The rest stands."""
    text = write_page.rendered("index.html.jinja", **content(**{part: []}))
    assert text.count("<h1") == 1
    assert (part == "trajectories") == ("trajectory-view" not in text)


def test_every_claim_stands_in_the_page_once(smoke, smoke_page):
    """With its verdict and its evidence."""
    claims = json.loads((smoke.folder / "results/tables/claims.json").read_text())
    text = " ".join(smoke_page.text.split())
    ids = Counter(smoke_page.values("id"))
    assert len(claims) > 40
    for row in claims:
        assert ids[f"claim-{row['id']}"] == 1
        for words in (f"{row['claim']} {row['verdict']}", row["instead"], row["evidence"]):
            said = Elements(mathematics.of_words(words)).text
            assert " ".join(said.split()) in text
    for verdict in VERDICTS:
        count = sum(row["verdict"] == verdict for row in claims)
        assert f"{verdict} {count} claim" in text


def test_classes_of_motion_keep_their_colours_in_the_dark(smoke):
    """Those of the view in which a reader moves the delay; other figures are light on dark."""
    text = (smoke.folder / "results" / "index.html").read_text()
    kept = re.findall(r'(?s)<figure class="one classes">.*?<img src="figures/(\w+)\.svg"', text)
    assert kept == ["atlas", "routes"]


def test_no_sentence_stands_in_the_page_twice(smoke):
    """Of the captions, of the findings and of what is true instead."""
    text = (smoke.folder / "results" / "index.html").read_text()
    groups = (
        r'(?s)<p class="instead">(.*?)</p>',
        r"(?s)<figcaption>\s*<p>(.*?)</p>",
        r"(?s)</h3>\s*<p>(.*?)</p>",
    )
    found = Counter(words for group in groups for words in re.findall(group, text))
    assert len(found) > 20
    assert [words for words, count in found.items() if count > 1] == []


def test_every_figure_stands_in_the_page(smoke, smoke_page):
    """With its caption, its rule, and words for those who do not see it."""
    images = {given["src"]: given["alt"] for tag, given in smoke_page.found if tag == "img"}
    text = " ".join(smoke_page.text.split())
    assert set(images) == {f"figures/{name}.svg" for name in FIGURES}
    for name in FIGURES:
        markup = captions.as_html(smoke.folder / caption_of(name).replace("<results>", "results"))
        assert images[f"figures/{name}.svg"] == captions.first_sentence(markup)
        assert f"Rule {name}." in text


def test_every_link_of_the_page_resolves(smoke, smoke_page):
    """To a file in results/ or to a place in the page; no address but files beside it."""
    results = smoke.folder / "results"
    links = smoke_page.values("href") + smoke_page.values("src")
    ids = smoke_page.values("id")
    assert len(ids) == len(set(ids))
    places = [link[1:] for link in links if link.startswith("#")]
    files = [link for link in links if not link.startswith(("#", "data:"))]
    assert (len(places) > 20, len(files) > 40) == (True, True)
    assert set(places) <= set(ids)
    assert [link for link in files if not (results / link).is_file()] == []
    assert not [link for link in files if re.match(r"\w+:|/", link)]


def test_provenance_is_told(smoke, smoke_page):
    """The compiler of the programs; a copy without git has no commit."""
    compiler = xr.open_dataset(smoke.folder / "results/trajectories/torus.nc").attrs["compiler"]
    assert f"compiled by {compiler}" in " ".join(smoke_page.text.split())
    assert "Commit unknown." in " ".join(smoke_page.text.split())


def test_page_made_again_is_the_same_bytes(scratch):
    """With other measured seconds, which have a page of their own."""
    results = scratch.folder / "results"
    before = (results / "index.html").read_bytes()
    benchmark = results / "benchmarks" / "hopf" / "xi_of_epsilon.tsv"
    head, run = benchmark.read_text().splitlines()
    benchmark.write_text(f"{head}\n98765.4\t{run.partition(chr(9))[2]}\n")
    made = scratch.snakemake("page", *SMOKE, "--forcerun", "work_precision_runs")
    assert made.returncode == 0, made.stdout
    assert {"captions", "page"} <= rules_in(made.stdout)
    assert (results / "index.html").read_bytes() == before
    times = (results / "times.html").read_text()
    numbers = (results / "figures" / "work_precision.rst").read_text().split("\n\n")[1]
    assert "98765.4" in times
    # behind the level of the error, which is a formula
    words = " ".join(numbers.split()).split("` ")[1]
    assert words in " ".join(Elements(times).text.split())
