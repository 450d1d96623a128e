"""Users' files: all that they add is made in a folder of their own, the paper's stays."""

import json
import re
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
import xarray as xr
from dry_runs import jobs_in

from conftest import ROOT, Project, rules_in
from scripts.files.read_config import ConfigError, merge, parse, read
from scripts.files.tsv import read_table
from scripts.plans.studies import kinds_of_results
from scripts.workflow import plan as plans
from scripts.workflow.plan import Plan, added, name_of, read_plan

SMALL = """
models:
  glass:
    parameters: { beta: { above: 0 }, n: { above: 0 }, rate: { above: 0 }, tau: { at_least: 0 } }
    states: { y: concentration }
    equations: { y: "beta*y(t - tau)/(1 + y(t - tau)**n) - rate*y" }
    steady_state: { near: { y: 1 } }
  phases: &phases
    size: { i: 3 }
    parameters:
      omega: { default: [1.0, 1.1, 1.3] }
      a: { default: [[0, 1, 1], [2, 0, 1], [1, 1, 0]] }
      tau: { at_least: 0, default: 0.5 }
      k: {}
    states: { x: phase }
    equations: { "x[i]": "omega[i] + k*sum(j, a[i, j]*sin(x[j](t - tau[i, j]) - x[i]))" }
  phases_of_files:
    <<: *phases
    parameters: { omega: { csv: omega.csv }, a: { csv: a.csv }, tau: { csv: tau.csv }, k: {} }
scenes:
  phases: &three
    { model: phases, k: 0.4, history: { x: [0, 1, 2] }, t_end: 50.0, exponents: {} }
  phases_of_files: { <<: *three, model: phases_of_files, exponents: { count: 2, t_end: 80.0 } }
  glass:
    { model: glass, beta: 0.2, n: 10.0, rate: 0.1, tau: 7.0, history: { y: 1.2 },
      t_end: 300.0, t_transient: 100.0, exponents: {} }
  my_scene: { t_end: 300.0, t_transient: 100.0, sample_interval: 0.1, exponents: {} }
  my_fault:
    { si: { a: 0.01, b: 0.02, sigma: 50 MPa, D_c: 1 cm, v0: 1e-9 m/s, k: 20 MPa/m, M: 3e6 kg/m^2 },
      tau: 2.2 years, t_end: 100 years, t_transient: 30 years }
hopf_curves:
  my_plane: { cells: 20 }
  glass:
    { model: glass, n: 10.0, rate: 0.1, abscissa: beta, abscissa_window: [0.12, 0.4],
      ordinate: tau, ordinate_window: [0.0, 20.0], cells: 10 }
routes:
  observation: &quick
    t_transient: 100.0
    t_observed: 100.0
    t_lasting: 50.0
    t_turning: 20.0
    doublings: 0
    kept: 20
  lines:
    my_route: { count: 2 }
    glass:
      { model: glass, beta: 0.2, n: 10.0, rate: 0.1, along: tau, window: [6.0, 8.0], count: 2,
        history: { y: 1.2 } }
    my_start:
      { along: v, window: [0.5, 1.5], count: 2, tau: 3.0, epsilon: 0.1, xi: 0.5, gamma: 0.8 }
cycles:
  t_transient: 500.0
  intervals: 20
  most_orbits: 5
  lines:
    glass:
      { model: glass, beta: 0.2, n: 10.0, rate: 0.1, along: tau, window: [4.0, 6.0],
        history: { y: 1.2 } }
    my_cycles: { along: tau, window: [1.0, 2.5], epsilon: 0.7, xi: 0.5, gamma: 0.8 }
atlas:
  abscissa_count: 3
  ordinate_count: 3
  parts: 1
  refinements: 0
  observation: *quick
  planes:
    glass:
      { model: glass, beta: 0.2, rate: 0.1, abscissa: n, abscissa_window: [7.0, 12.0],
        ordinate_window: [4.0, 8.0], history: { y: 1.2 } }
    my_atlas: { xi: 0.5, gamma: 0.8, ordinate_window: [0.0, 10.0] }
exponents: { t_turning: 50.0, batches: 3 }
spectra: { segments: 3 }
attractors:
  observation: *quick
"""
"""Settings over the file that `./reproduce new` writes: small, and with what it does not have."""
TABLES = {"omega": "1.0,1.1,1.3\n", "a": "0,1,1\n2,0,1\n1,1,0\n", "tau": "0.5,0.5,0.5\n" * 3}
"""Files of a network with the numbers that the other one has in lists."""
FIGURES = [
    *("scenes/my_scene", "exponents/my_scene", "planes/my_plane", "routes/my_route"),
    *("routes/my_start", "cycles/my_cycles", "atlas/my_atlas", "scenes/my_fault"),
    *(f"{kind}/phases{end}" for kind in ("scenes", "exponents") for end in ("", "_of_files")),
    *(f"{kind}/glass" for kind in ("scenes", "exponents", "planes", "routes", "cycles", "atlas")),
]


def write_new_file(path: Path) -> subprocess.CompletedProcess[str]:
    command = [ROOT / "reproduce", "new", path]
    return subprocess.run(command, capture_output=True, text=True)


def plan_of(folder: Path, text: str) -> Plan:
    """The plan of a user's file with this text."""
    (folder / "mine.yaml").write_text(text)
    return read_plan({"user_file": str(folder / "mine.yaml")})


def state_of(results: Path) -> dict[str, tuple[int, int]]:
    files = [path for path in results.rglob("*") if path.is_file()]
    return {str(path): (path.stat().st_mtime_ns, path.stat().st_size) for path in files}


@pytest.fixture(scope="module")
def made(smoke, tmp_path_factory) -> Project:
    """A copy of the smoke run after a run with the new file, in small."""
    project = smoke.copy_to(tmp_path_factory.mktemp("user") / "project")
    assert write_new_file(project.folder / "mine.yaml").returncode == 0
    path = project.folder / "mine.yaml"
    path.write_text(json.dumps(merge(read(path), parse(SMALL))))
    for name, text in TABLES.items():
        (project.folder / f"{name}.csv").write_text(text)
    before = state_of(project.folder / "results")
    run = project.snakemake("--config", "user_file=mine.yaml")
    assert run.returncode == 0, run.stdout
    after = state_of(project.folder / "results")
    assert {path: state for path, state in after.items() if "/results/mine/" not in path} == before
    return project


def test_everything_that_the_file_adds_is_made(made):
    """Figures, tables with rows of these names alone, the verdict on its claim, captions, page."""
    results = made.folder / "results" / "mine"
    figures = {path.relative_to(results / "figures") for path in results.glob("figures/*/*")}
    endings = ("pdf", "png", "svg", "rst", "json")
    assert figures == {Path(f"{name}.{end}") for name in FIGURES for end in endings}
    tables = {
        "attractors": ("scene", "my_scene", "my_fault", "glass"),
        "linear-stability": ("scene", "my_scene", "my_fault", "glass"),
        "exponents": ("scene", "my_scene", "glass", "phases", "phases_of_files"),
        "routes/my_route": ("route", "my_route"),
        "routes/my_start": ("route", "my_start"),
        "si": ("scene", "my_fault"),
        "claims": ("id", "my_claim"),
    }
    for table, (column, *names) in tables.items():
        rows = read_table(results / "tables" / f"{table}.tsv")
        assert {row[column] for row in rows} == set(names)
    events = pd.read_csv(results / "tables" / "events" / "my_fault.csv")
    assert (events[["duration_s", "slip_m", "stress_drop_Pa"]] > 0).all(axis=None)
    assert len(events) > 1
    assert rows[0]["verdict"] in ("reproduced", "not reproduced")
    assert rows[0]["look_at"] == "results/mine/figures/scenes/my_scene.png"
    assert xr.load_dataset(results / "exponents" / "my_scene.nc").attrs["t_end"] == 300.0
    # the paper's Hopf curves in the same plane are drawn in the atlas
    assert (results / "hopf" / "tau_of_epsilon.nc").exists()
    caption = (results / "figures" / "routes" / "my_start.rst").read_text()
    place = r":math:`\tau = 3`, :math:`\varepsilon = 0.1`, :math:`\xi = 0.5`, :math:`\gamma = 0.8`"
    assert place in caption
    page = (results / "index.html").read_text()
    views = [f'id="{name}"' for name in ("claim-my_claim", "play-view")]
    # figures of one scene have entries of their own
    entries = [f">{kind}: My scene</a>" for kind in ("Scenes", "Exponents")]
    for part in (*views, *entries, *(f'src="figures/{name}.svg"' for name in FIGURES)):
        assert part in page
    # of four verdicts one was reached
    assert len(re.findall(r"<span>\d claims?</span>", page)) == 1


def test_model_of_a_user_has_its_own_names(made):
    """In tables and captions: no parameter or state of the block is there."""
    results = made.folder / "results" / "mine"
    for name, known in (("routes", {"tau", "y"}), ("atlas", {"n", "y", "abscissa"})):
        rows = read_table(results / "tables" / name / "glass.tsv")
        assert known <= rows[0].keys()
        assert not rows[0].keys() & {"epsilon", "xi", "gamma", "theta", "u", "v"}
        assert all("rate = 0.1" in row["law"] for row in rows)
    for kind, words in (
        ("routes", "maxima of y on the attractor"),
        ("cycles", "the greatest y of a cycle"),
        ("atlas", ":math:`n`"),
        ("planes", r":math:`\beta`"),
        ("scenes", "Maxima of y are"),
    ):
        caption = (results / "figures" / kind / "glass.rst").read_text()
        assert words in " ".join(caption.split())
        assert r"\xi" not in caption


def test_network_of_lists_is_that_of_files(made):
    """At the end the phases turn by their equations. Other numbers make one run anew."""
    runs = made.folder / "results" / "mine" / "trajectories"
    one, other = (xr.load_dataset(runs / f"phases{end}.nc") for end in ("", "_of_files"))
    assert (one.x.values == other.x.values).all()
    assert one.x.dims == ("t", "node")
    assert one.attrs["nodes"] == 3
    assert one.history_x.values.tolist() == [0, 1, 2]
    omega, a = np.array([1.0, 1.1, 1.3]), np.array([[0, 1, 1], [2, 0, 1], [1, 1, 0]])
    at = one.x.values[one.t == 50.0][0]
    slope = (at - one.x.values[-2]) / 0.05
    before = one.x.sel(t=49.5).values
    force = (a * np.sin(before[None, :] - at[:, None])).sum(1)
    assert slope == pytest.approx(omega + 0.4 * force, abs=1e-6)
    (made.folder / "a.csv").write_text("0,1,1\n2,0,1\n1,3,0\n")
    targets = [f"results/mine/trajectories/phases{end}.nc" for end in ("", "_of_files")]
    run = made.snakemake("--dry-run", *targets, "--config", "user_file=mine.yaml")
    assert sorted(job.rule for job in jobs_in(run.stdout)) == ["network", "trajectory"]


def test_one_key_of_a_scene_can_be_changed(tmp_path):
    """The others keep their values; 010 is ten."""
    plan = plan_of(tmp_path, "scenes: { torus: { tau: 010, history: { v: 1.5 } } }")
    scene = plan.config["scenes"]["torus"]
    assert [scene[key] for key in ("tau", "epsilon", "t_end")] == [10, 0.5, 8000.0]
    assert scene["history"] == {"theta": 0.0, "u": 0.0, "v": 1.5}


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("spectra: { segments: 4 }", "the file adds no scene, plane, route"),
        ("scenes: { mine: { tau: 1 } }", "scene 'mine': key"),
        ("pathvars: { results: other }", "pathvars: expected none; the file names its folder"),
    ],
)
def test_bad_file_is_refused(tmp_path, text, words):
    with pytest.raises(ConfigError, match=re.escape(words)):
        plan_of(tmp_path, text)


def test_bad_file_stops_the_workflow_in_words(smoke, tmp_path):
    (tmp_path / "mine.yaml").write_text("scenes: { torus: { tau: -1.0 } }")
    before = state_of(smoke.folder / "results")
    run = smoke.snakemake("--config", f"user_file={tmp_path}/mine.yaml")
    assert run.returncode != 0
    assert "scene 'torus': tau = -1.0; expected " in run.stdout
    assert "Traceback" not in run.stdout
    assert state_of(smoke.folder / "results") == before


def test_build_that_fails_leaves_no_program(project):
    """The compiler's words are on the screen and in the log."""
    with open(project.folder / "fortran" / "dde" / "src" / "base" / "dde_kinds.f90", "a") as source:
        source.write("this is no Fortran\n")
    run = project.snakemake("build/release/bin/spring_block")
    assert run.returncode != 0
    assert "this is no Fortran" in run.stdout
    log = project.folder / "results" / "logs" / "build" / "spring_block.log"
    assert "this is no Fortran" in log.read_text()
    assert not (project.folder / "build" / "release" / "bin" / "spring_block").exists()


def test_paper_can_be_run_with_other_settings_in_another_folder(smoke, tmp_path):
    (tmp_path / "moved.yaml").write_text(
        "{ pathvars: { results: moved }, scenes: { torus: { tau: 11.0 } } }"
    )
    run = smoke.snakemake("--dry-run", "figure_6", "--configfile", str(tmp_path / "moved.yaml"))
    assert run.returncode == 0, run.stdout
    assert "moved/figures/figure_6.svg" in run.stdout
    assert {"trajectory", "spectrum", "figure_6"} <= rules_in(run.stdout)
    assert "results/" not in re.sub("/results/", "", run.stdout)


def test_results_lie_beside_others(tmp_path, monkeypatch):
    """In one folder, but neither in other results nor where anything else lies."""
    monkeypatch.setattr(plans, "PROJECT", tmp_path)
    for name in ("other/one/logs", "mixed/one/logs", "mixed/deeper", "docs"):
        (tmp_path / name).mkdir(parents=True)
    for name in ("other/one/index.html", "mixed/deeper/script.py", "docs/a.md", "README.md"):
        (tmp_path / name).touch()
    (tmp_path / "linked").symlink_to(tmp_path / "other")
    for folder in ("new", "new/one", "other/two", "other/two/three", "other/one"):
        assert plans.checked_folder(folder) == folder
    in_results, in_sources = ("other", "other/one/two", "linked/two"), ("docs/mine", "README.md")
    for folder in (*in_results, "mixed/two", "mixed/deeper/two", *in_sources):
        with pytest.raises(ConfigError, match=f"results = '{folder}': .* expected a new folder"):
            plans.checked_folder(folder)
    with pytest.raises(ConfigError, match="results = 'docs/mine': docs is there, without results"):
        read_plan({"pathvars": {"results": "docs/mine"}})


def test_new_file_overwrites_none(tmp_path):
    """It is named after itself and accepted by the schema; a second one is refused."""
    path = tmp_path / "faults.yaml"
    assert write_new_file(path).returncode == 0
    assert "results/faults/" in path.read_text()
    assert "mine" not in path.read_text()
    plan = read_plan({"user_file": str(path)})
    assert plan.results == "results/faults"
    assert list(plan.figures) == ["scenes/my_scene", "planes/my_plane", "routes/my_route"]
    assert set(plan.config["scenes"]) == {"my_scene"}
    path.write_text("mine")
    again = write_new_file(path)
    assert again.returncode != 0
    assert "there already" in again.stderr
    assert path.read_text() == "mine"


@pytest.mark.parametrize("name", ["my file", "faults.v2", "a&b"])
def test_new_file_promises_only_the_folder_that_it_gets(tmp_path, name):
    run = write_new_file(tmp_path / f"{name}.yaml")
    assert run.returncode == 1
    assert f"the name '{name}'; expected letters, digits, _ and - alone" in run.stderr
    assert list(tmp_path.iterdir()) == []


def test_folder_is_named_after_the_file():
    """No folder of results has this name, and it is none that Snakemake cannot take."""
    assert name_of("/some/where/my-file_2.yaml") == "my-file_2"
    others = {"logs", "benchmarks", "docs", "records"}
    for name in (
        kinds_of_results() | others | {"page", "a" * 20, "mine" + "-1" * 20, "ab" * 51, "a b"}
    ):
        with pytest.raises(ConfigError, match="expected a name of letters"):
            name_of(f"{name}.yaml")


def test_list_of_what_a_file_adds(default_config):
    whole = default_config
    overlay = read(ROOT / "config" / "new.yaml") | {"atlas": {"ordinate_count": 9}, "cycles": 3}
    names = {kind: found for kind, found in added(overlay, whole).items() if found}
    assert names == {
        **{"scene": ["my_scene"], "plane": ["my_plane"], "route": ["my_route"]},
        "atlas_plane": list(whole["atlas"]["planes"]),
    }


def test_curves_in_planes_of_the_atlas_stay(tmp_path):
    """The atlas draws the paper's Hopf curves in planes of the user's file."""
    planes = "my_atlas: { xi: 0.5, gamma: 0.8, ordinate_window: [0.0, 10.0] }"
    config = plan_of(tmp_path, f"atlas: {{ planes: {{ {planes} }} }}").config
    assert list(config["atlas"]["planes"]) == ["my_atlas"]
    assert list(config["hopf_curves"]) == ["tau_of_epsilon"]


def test_claims_of_a_user_may_name_scenes_of_the_paper(tmp_path):
    """They are computed, too, in the user's folder; no figure shows them."""
    plan = plan_of(
        tmp_path,
        "claims: { mine: { place: here, claim: It is chaos., look_at: attractors.tsv,"
        " test: { attractor_class: { scene: chaos, expected: chaos } } } }",
    )
    assert list(plan.config["scenes"]) == ["chaos"]
    assert plan.figures == {}
    assert "<results>/tables/claims.tsv" in plan.targets()


def test_one_claim_is_one(tmp_path):
    ledger = tmp_path / "tables" / "claims.json"
    ledger.parent.mkdir()
    ledger.write_text('[{"verdict": "reproduced", "whose": "the user"}]')
    assert Plan({}, str(tmp_path), True, {}, {"mine": {}}).summary().startswith("1 claim: 1 repr")


TWO_LAWS = """
laws:
  mine: { evolution: "-v*(theta + (1 + epsilon)*log(v(t - tau))) - 1e-3*theta" }
  yours: { evolution: "-v*(theta + (1 + epsilon)*log(v(t - tau))) - 2e-3*theta" }
scenes:
  one: { law: mine, tau: 1, epsilon: 0.5, xi: 0.8, gamma: 0.8, t_end: 20 }
  other: { law: yours, tau: 1, epsilon: 0.5, xi: 0.8, gamma: 0.8, t_end: 20 }
"""


def test_changed_law_is_compiled_and_its_results_made_anew_and_no_others(scratch):
    """A law is compiled alone; nothing is linked again. It is seen without .snakemake, too."""
    path = scratch.folder / "laws.yaml"
    path.write_text(TWO_LAWS)
    targets = [f"results/laws/trajectories/{name}.nc" for name in ("one", "other")]
    first = scratch.snakemake(*targets, "--config", "user_file=laws.yaml")
    assert first.returncode == 0, first.stdout
    assert rules_in(first.stdout) == {"definition", "model", "trajectory"}
    made = {path.name for path in scratch.folder.glob("build/users/laws/models/*.so")}
    assert made == {"mine.so", "yours.so"}
    path.write_text(TWO_LAWS.replace("1e-3", "3e-3"))
    shutil.rmtree(scratch.folder / ".snakemake")
    again = scratch.snakemake("--dry-run", *targets, "--config", "user_file=laws.yaml")
    assert again.returncode == 0, again.stdout
    assert rules_in(again.stdout) == {"definition", "model", "trajectory"}
    (made_anew,) = [job.made for job in jobs_in(again.stdout) if job.rule == "trajectory"]
    assert targets[0] in made_anew


HALF_WRONG = """
laws:
  late: { evolution: "-v*(theta(t - tau) + (1 + epsilon)*log(v))" }
scenes:
  good: { law: late, tau: 0.1, epsilon: 0.1, xi: 0.8, gamma: 0.8, t_end: 60 }
  wrong: { law: late, tau: 1, epsilon: 0.5, xi: 0.8, gamma: 0.8, t_end: 300 }
"""


def test_run_that_fails_in_part_has_a_page_of_the_rest(scratch):
    """It names what failed and why, and shows nothing of it, nor of an earlier run."""
    (scratch.folder / "half.yaml").write_text(HALF_WRONG)
    results = scratch.folder / "results" / "half"
    stale = results / "figures" / "scenes" / "wrong.svg"
    stale.parent.mkdir(parents=True)
    stale.touch()
    run = scratch.reproduce("half.yaml")
    assert run.returncode != 0
    reason = "error: integrate: stopped at t = "
    assert f"\nresults/half/trajectories/wrong.nc failed: {reason}" in run.stdout
    assert "Traceback" not in run.stdout
    page = (results / "index.html").read_text()
    assert re.findall(r'<img src="([^"]*)"', page) == ["figures/scenes/good.svg"]
    assert f"<code>results/half/trajectories/wrong.nc</code>: {reason}" in page
    (unmade,) = re.findall(r"<p>Not made for lack of these: (.*)\.</p>", page)
    assert unmade == "results/half/figures/scenes/wrong.svg"
