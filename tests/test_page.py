"""The page: what it says of made-up results, and the page of the smoke run as a file."""

import base64
import json
import re
from collections import Counter
from html.parser import HTMLParser
from pathlib import Path
from types import SimpleNamespace

import made_up_page
import numpy as np
import pytest
import xarray as xr
from conftest import ROOT, SMOKE, rules_in
from docutils.utils import SystemMessage
from jinja2 import UndefinedError
from made_up_page import attractor, claim, content, figure, run

from scripts.claims.claims_results import CORRECTED, NOT_REPRODUCED, NOT_TESTABLE, VERDICTS
from scripts.claims.ledger import paper_claims
from scripts.figures.registry import FIGURES
from scripts.files.marked_words import to_html
from scripts.page import captions, findings, page_content, page_provenance, page_views, write_page
from scripts.page.mathematics import in_signs


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
        """Values of an attribute in all elements."""
        return [attributes[attribute] for _, attributes in self.found if attribute in attributes]


@pytest.fixture(scope="module")
def page(smoke) -> str:
    """The page of the smoke run."""
    return (smoke.folder / "results" / "index.html").read_text()


def caption_of(smoke, figure: str) -> str:
    """A caption of the smoke run, as HTML."""
    return captions.as_html(smoke.folder / "results" / "figures" / f"{figure}.rst")


@pytest.mark.parametrize("name", FIGURES)
def test_caption_has_a_first_sentence_in_plain_signs(name, smoke):
    """It describes the figure where the figure is not seen."""
    sentence = captions.first_sentence(caption_of(smoke, name))
    assert len(sentence.split()) >= 4
    assert sentence.endswith(".")
    assert not re.search(r"[\\<>`:]{2}|\\", sentence)


def test_caption_with_formulas(tmp_path):
    """Formulas are MathML, in words without spaces; no line ends before % or after ±."""
    (tmp_path / "caption.rst").write_text("Curves :math:`\\tau = 2` & 1 ± 2 %. The rest.")
    markup = captions.as_html(tmp_path / "caption.rst")
    assert "<math" in markup
    assert "1 ±\N{NO-BREAK SPACE}2\N{NO-BREAK SPACE}%" in markup
    assert captions.first_sentence(markup) == "Curves τ=2 & 1 ± 2 %."


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
    shown = page_content.set_equations(made_up_page.EQUATIONS, claims)
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


def tables_of_findings() -> dict[str, list[dict]]:
    """Made-up tables that the findings are taken from."""
    torus = motion("torus", "cycle", [0.0, -0.01, -0.02], np.nan)
    true_torus = motion("true_torus", "torus", [0.002, -0.002, -0.02], 0.3) | {"tau": 12.5}
    kinds = ("a", "hopf_without_delay"), ("b", "generalised_hopf"), ("c", "amplitude_death_begin")
    runs = ((1e4, "auto", "ok"), (1e12, "explicit", "stopped"), (0.8, "auto", "stopped"))
    limit = {"xi": 0.5, "without_delay": 0.25}
    return {
        "attractors": [torus, true_torus],
        "hopf_points": [{"of": of, "kind": kind} for of, kind in kinds],
        "stability": [
            {"gamma": gamma, "method": method, "status": status, "steps": 7.0}
            for gamma, method, status in runs
        ],
        "fault_limit": [
            limit | {"gamma": gamma, "depth": depth}
            for gamma, depth in ((0.8, 0.0481), (1e4, 9.3e-18))
        ],
    }  # fmt: skip


def test_findings_follow_the_tables():
    """Titles and words with their numbers."""
    limit, torus, faults = findings.list_findings([claim("figure_5a")], tables_of_findings())
    assert torus["title"] == "The paper's torus is a limit cycle."
    assert torus["words"] == (
        "At $tau = 10$ it has one zero Lyapunov exponent and the fundamental frequency $f1 = 0.1$."
        " At $tau = 12.5$, with all else the same, the motion is a torus: it has two zero Lyapunov"
        " exponents and the fundamental frequencies $f1 = 0.1$ and $f2 = 0.3$."
    )
    assert [given["id"] for given in torus["claims"]] == ["figure_5a"]
    assert "at $epsilon = 0.25$ for $xi = 0.5$ and $gamma = 0.8$." in limit["words"]
    assert (
        "by 0.048 there, but by 9e-18 only at $gamma = 1e+04$. Along the Hopf curves of 2 planes"
        in (limit["words"])
    )
    assert limit["words"].endswith(" at 1 point.")
    assert "All 1 runs there reach their end, each in at most 7 steps." in faults["words"]
    assert faults["words"].endswith("none do.")


def test_titles_of_findings_follow_the_tables():
    """They say the opposite if the results do."""
    tables = tables_of_findings()
    _, true_torus = tables["attractors"]
    tables |= {"attractors": [true_torus | {"scene": "torus"}, true_torus]}
    tables |= {"stability": tables["stability"][1:]}
    assert [found["title"] for found in findings.list_findings([], tables)][1:] == [
        "The paper's torus is a torus.",
        "The paper's range of $gamma$ is not accessible.",
    ]


def test_citation_names_this_work_and_the_paper():
    """From CITATION.cff."""
    cited = page_provenance.citation(ROOT / "CITATION.cff")
    assert cited["licence"] == "GPL-3.0-or-later"
    project, paper = cited["works"]
    assert project.startswith("The maintainers of this reproduction")
    assert paper.startswith("Kostić, Srđan, Vasović, Nebojša, Franović, Igor, Todorović, Kristina")
    assert "Time-delay in spring-block model for aperiodicity in earthquakes" in paper
    assert re.search(r"<https://studylib\.net/doc/18071566/\S+>", paper)


def test_figure_is_described(tmp_path):
    """Title, size (a point of the drawing is 1.3 pixels), and links from the folder of the page."""
    given = figure(tmp_path, "scenes/my_scene", "Scenes", "results/mine/spectra/my_scene.nc")
    described = page_content.describe_figure(given, Path("results/mine"))
    assert described["title"] == "My scene"
    assert (described["size"], described["fits"]) == ((78, 52), True)
    assert described["data"] == ["spectra/my_scene.nc"]


def test_figures_of_the_solver_come_last():
    """The other categories keep their order."""
    names = {"a": "Figures", "b": "Solver", "c": "Atlas", "d": "Figures"}
    figures = [{"name": name, "category": category} for name, category in names.items()]
    groups = page_content.group_figures(figures)
    assert [(key, [one["name"] for one in shown]) for key, shown in groups.items()] == [
        ("Figures", ["a", "d"]),
        ("Atlas", ["c"]),
        ("Solver", ["b"]),
    ]


def test_opening_is_the_first_paragraph():
    """Without the title of the README and without marks."""
    words = page_content.opening("# Title\n\nThe *work*\nof <us>.\n\nMore.\n")
    assert words == "The <cite>work</cite> of &lt;us>."


MOTION = {**attractor(0.5, 10.0), "scene": "my_scene", "history": 1.0}


def sent(values: str) -> np.ndarray:
    """Numbers that the page holds as text."""
    return np.frombuffer(base64.b64decode(values), "<f4")


def test_trajectory_is_thinned_to_its_last_part():
    """Every second sample of the last 1000 units of time, with class and exponents."""
    shown = page_views.describe_run(run(), [{**MOTION, "history": 2.0, "class": "chaos"}, MOTION])
    assert (shown["start"], shown["every"], shown["step"]) == (500.0, 2, 0.1)
    expected = 1 + 0.5 * np.cos(500 + 0.1 * np.arange(10001))
    np.testing.assert_allclose(sent(shown["series"][0]["values"]), expected, atol=1e-6)
    assert shown["words"] == (
        "ε = 0.5, τ = 10, ξ = 0.8, γ = 0.8: cycle;"
        " exponents −0.01 ± 0.001, −0.02 ± 0.001, −0.03 ± 0.001"
    )


def test_numbers_of_views_have_signs_of_print():
    """A factor of 1 is left out; digits without an exponent stay."""
    said = in_signs("1e+08, -1.1e-05, 21 and 0.1")
    assert said == "10⁸, −1.1 × 10⁻⁵, 21 and 0.1"


def test_short_trajectory_is_shown_whole():
    """Every sample; if the attractor was not computed, the words say so."""
    shown = page_views.describe_run(run(count=101), [])
    assert (shown["start"], shown["every"], sent(shown["series"][1]["values"]).size) == (0, 1, 101)
    assert shown["words"].endswith("γ = 0.8: its attractor was not computed")


def test_samples_that_follow_the_motion_keep_their_times():
    """None of the last 12 000 is left out: it may be a maximum."""
    whole = run()
    times = np.sort(np.append(whole.t, whole.t[-200:-1] + 0.01))
    shown = page_views.describe_run(whole.interp(t=times), [])
    assert (shown["start"], shown["every"]) == (times[-12_000], 1)
    np.testing.assert_allclose(sent(shown["times"]), times[-12_000:] - times[-12_000], atol=1e-4)


def test_scene_that_keeps_less_is_drawn_as_far_as_it_goes():
    """Without u, v alone; without both there is nothing to draw."""
    without_u = run(count=101).drop_vars("u")
    series = page_views.describe_run(without_u, [MOTION])["series"]
    assert [one["name"] for one in series] == ["v"]
    assert page_views.can_be_drawn(without_u)
    assert not page_views.can_be_drawn(without_u.drop_vars("v"))


def test_programs_are_named_with_version_and_compiler(tmp_path):
    """From the attributes of the files."""
    files = [tmp_path / f"{name}.nc" for name in "abc"]
    for path, compiler in zip(files, ("one", "one", "two"), strict=True):
        xr.Dataset(attrs={"program_version": "1.2", "compiler": compiler}).to_netcdf(path)
    assert page_provenance.programs(files) == [
        {"version": "1.2", "compiler": "one", "files": 2},
        {"version": "1.2", "compiler": "two", "files": 1},
    ]


def test_seconds_are_summed_over_the_jobs_of_a_kind(tmp_path):
    """Memory is the largest that was measured: Snakemake misses that of short jobs."""
    for name, line in (("hopf/a", "1.5\t-"), ("hopf/b/c", "2.5\t30.0"), ("spectra/d", "4.0\t20.0")):
        path = tmp_path / f"{name}.tsv"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(f"s\tmax_rss\n{line}\n")
    hopf, spectra = page_provenance.seconds(tmp_path)
    assert hopf == {"kind": "hopf", "jobs": 2, "seconds": 4.0, "longest": 2.5, "memory": 30.0}
    assert (spectra["kind"], spectra["jobs"]) == ("spectra", 1)


def test_missing_value_is_an_error(tmp_path):
    """Jinja would leave a hole in the page."""
    given = content(tmp_path)
    del given["commit"]
    with pytest.raises(UndefinedError, match="commit"):
        write_page.render("index.html.jinja", **given)


def test_page_loads_nothing_from_elsewhere(tmp_path):
    """Its policy: nothing is loaded by default, no base changes its links, no form is sent."""
    made = Elements(write_page.render("index.html.jinja", **content(tmp_path)))
    policies = [a["content"] for tag, a in made.found if a.get("http-equiv", "").endswith("Policy")]
    (directives,) = [[one.strip() for one in policy.split(";")] for policy in policies]
    assert {"default-src 'none'", "base-uri 'none'", "form-action 'none'"} <= {*directives}


def test_words_of_the_ledger_are_no_markup(tmp_path):
    """A word that looks like a tag is text."""
    text = write_page.render("index.html.jinja", **content(tmp_path))
    assert "0 &lt; 1 &amp; so on" in text
    assert "0 < 1 & so on" in Elements(text).text


PARTS = {
    "paper": "Equations of the Hopf curves",
    "claims": "Search claims",
    "unplaced": "Claims that no figure shows",
    "appendices": "Appendices",
    "atlas": "Move the delay",
    "trajectories": "Trajectories to zoom into",
}
"""Content of the page, and words that stand in the page only with it."""


@pytest.mark.parametrize("part", PARTS)
def test_page_without_a_part_has_no_trace_of_it(part, tmp_path):
    """All other parts stand in the page."""
    empty = type(content(tmp_path)[part])()
    made = Elements(write_page.render("index.html.jinja", **content(tmp_path, **{part: empty})))
    assert {name for name, words in PARTS.items() if words in made.text} == {*PARTS} - {part}
    places = [link[1:] for link in made.values("href") if link.startswith("#")]
    assert {*places} - {"claim-claim 0", "claim-equation_8", "atlas"} <= {*made.values("id")}


def test_page_of_a_users_file(tmp_path):
    """Its figures by category, each with its claims; other claims below; links from its folder."""
    results = tmp_path / "mine"
    (results / "tables").mkdir(parents=True)
    look_at = f"{results}/figures/scenes/small.png"
    claims = [claim("of_scene", look_at=look_at), claim("of_nothing")]
    (results / "tables" / "claims.json").write_text(json.dumps(claims))
    run(count=101).to_netcdf(results / "small.nc")
    given = SimpleNamespace(
        claims=results / "tables" / "claims.json", attractors=[], play=[],
        tables=[results / "tables" / "basins.tsv"], trajectories=[results / "small.nc"],
    )  # fmt: skip
    figures = [
        figure(tmp_path, "planes/a", "Hopf curves"),
        figure(tmp_path, "scenes/small", "Scenes"),
    ]
    history = {"theta": 0.0, "u": 0.0, "v": 1.1}
    params = SimpleNamespace(is_users=True, figures=figures, history=history, commit="unknown")
    shown = write_page.content(given, params, results)
    assert [(key, [one["name"] for one in some]) for key, some in shown["sections"].items()] == [
        ("Hopf curves", ["planes/a"]),
        ("Scenes", ["scenes/small"]),
    ]
    assert [one["id"] for one in shown["sections"]["Scenes"][0]["claims"]] == ["of_scene"]
    assert [one["id"] for one in shown["unplaced"]] == ["of_nothing"]
    made = Elements(write_page.render("index.html.jinja", **shown))
    assert {"figures/scenes/small.svg", "tables/basins.tsv"} <= {*made.values("href")}
    assert "my scene" in made.text


def test_every_claim_stands_in_the_page_once(smoke, page):
    """With its verdict and its evidence; the main ones stand with the findings."""
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
        assert f"{verdict} {count} claim" in shown.text
    start, end = page.index('id="findings"'), page.index('id="equations"')
    for name in findings.MAIN_CLAIMS:
        assert start < page.index(f'id="claim-{name}"') < end


def test_classes_of_motion_keep_their_colours_in_the_dark(page):
    """They are those of the view in which a reader moves the delay; other figures are inverted."""
    kept = re.findall(r'(?s)<figure class="one classes">.*?<img src="figures/(\w+)\.svg"', page)
    assert kept == ["atlas", "routes"]


def test_no_sentence_stands_in_the_page_twice(page):
    """Sentences of the captions, of the findings and of what is true instead."""
    groups = (
        r'(?s)<p class="instead">(.*?)</p>',
        r"(?s)<figcaption>\s*<p>(.*?)</p>",
        r"(?s)</h3>\s*<p>(.*?)</p>",
    )
    found = Counter(words for group in groups for words in re.findall(group, page))
    assert len(found) > 20
    assert [words for words, count in found.items() if count > 1] == []


def test_every_figure_stands_in_the_page(smoke, page):
    """With its rule and the first sentence of its caption."""
    shown = Elements(page)
    images = {given["src"]: given["alt"] for tag, given in shown.found if tag == "img"}
    sentences = {name: captions.first_sentence(caption_of(smoke, name)) for name in FIGURES}
    assert images == {f"figures/{name}.svg": sentences[name] for name in FIGURES}
    assert all(f"Rule {name}." in shown.text for name in FIGURES)


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


def test_provenance_is_shown(smoke, page):
    """The compiler of the programs; a copy without git has no commit."""
    compiler = xr.open_dataset(smoke.folder / "results/trajectories/torus.nc").attrs["compiler"]
    text = Elements(page).text
    assert f"compiled by {compiler}" in text
    assert "Commit unknown." in text


def test_page_made_again_is_the_same_bytes(scratch):
    """Other measured seconds change times.html only."""
    results = scratch.folder / "results"
    before = (results / "index.html").read_bytes()
    benchmark = results / "benchmarks" / "hopf" / "xi_of_epsilon.tsv"
    head, run = benchmark.read_text().splitlines()
    benchmark.write_text(f"{head}\n98765.4\t{run.partition(chr(9))[2]}\n")
    made = scratch.snakemake("page", *SMOKE, "--forcerun", "work_precision_runs")
    assert made.returncode == 0, made.stdout
    assert {"captions", "page"} <= rules_in(made.stdout)
    assert (results / "index.html").read_bytes() == before
    page = (results / "times.html").read_text()
    row = r'<th scope="row">hopf</th><td>\d+</td><td>9876\d\.\d</td><td>98765\.4</td>'
    assert re.search(row, page)
    times = Elements(page).text
    numbers = (results / "figures" / "work_precision.rst").read_text().split("\n\n")[1]
    # behind the level of the error, which is a formula
    assert " ".join(numbers.split()).split("` ")[1] in times
