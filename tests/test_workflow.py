"""The workflow in smoke size: everything once, nothing twice, only what is asked for; a report."""

import json
import re
import shutil
import subprocess
import sys
import zipfile
from collections.abc import Iterator
from types import SimpleNamespace

import f90nml
import pytest
from dry_runs import data_of_jobs, jobs_in, needed_for

from conftest import ROOT, SMOKE, rules_in
from scripts.plans import studies
from scripts.plans.declare import PAPER as PRIORITY
from scripts.workflow.check_run import problem_of
from scripts.workflow.git_commit import UNKNOWN, commit_of

PAPER = [f"figure_{number}" for number in range(1, 9)]


def test_every_rule_ran(smoke_run):
    """A rule that no figure needs is one too many, but for these five."""
    project, log = smoke_run
    listed = re.findall(r"^(\w+)", project.snakemake("--list-rules").stdout, flags=re.MULTILINE)
    assert set(listed) - rules_in(log) - {"Using", "Assuming"} == {
        "docs",
        "atlas_plane_table",
        "definition",
        "network",
        "single_page",
    }


def test_targets_are_listed(fresh):
    """Figures, tables and what else has no wildcards."""
    said = fresh.snakemake("--list-target-rules").stdout
    listed = set(re.findall(r"^(\w+)(?: \(.*\))?$", said, flags=re.MULTILINE))
    tables = {table.rule for _, table in studies.tables() if "{" not in table.output}
    others = {"all", "captions", "claims", "docs", "first_page", "page", "single_page"}
    assert listed == {*studies.paper_figures(), *tables, *others}


def test_figures_of_the_paper_come_first(smoke_run):
    """A reader can look at them while the long runs go on."""
    started = re.findall(r"^(?:local)?rule (\w+):", smoke_run[1], flags=re.MULTILINE)
    last = max(started.index(figure) for figure in PAPER)
    long = {run.rule for run in studies.runs() if run.minutes and run.priority < PRIORITY}
    before = [rule for rule in started[:last] if rule in long]
    assert len(before) < sum(rule in long for rule in started) / 5


def test_namelists_hold_the_config(smoke, smoke_config):
    """Whatever groups its values are in."""

    def flat(values: dict) -> Iterator[tuple]:
        for key, value in values.items():
            yield from flat(value) if isinstance(value, dict) else [(key, value)]
        yield from zip(values.get("parameters", []), values.get("values", []), strict=True)

    scene = smoke_config["scenes"]["torus"]
    parameters = {key: scene[key] for key in ("tau", "epsilon", "xi", "gamma")}
    trajectory = {"trajectory": "results/trajectories/torus.nc"}
    for path, expected in (
        ("trajectories/torus", parameters | {"t_end": 600.0, "sample_interval": 0.1}),
        ("linear_stability/torus", parameters | {"along": ["tau", "epsilon"]}),
        ("spectra/torus", smoke_config["spectra"] | trajectory),
        ("hopf/xi_of_epsilon", {"along": ["epsilon", "xi"], "tau": 12.0, "cells": 40}),
        ("exponents/torus", {"count": 6}),
        ("cycles/torus_in_tau", {"along": "tau", "intervals": 20, "starts": 10.0}),
    ):
        namelist = f90nml.read(smoke.folder / "results" / "namelists" / f"{path}.nml")
        values = dict(flat(namelist["settings"]))
        assert {key: values[key] for key in expected} == expected


def test_folders_of_results_stand_in_their_readme(smoke):
    """Every folder and the page; the file itself is kept as it is. No picture is too large."""
    readme = (smoke.folder / "results" / "README.md").read_text()
    assert readme == (ROOT / "results" / "README.md").read_text()
    named = set(re.findall(r"`results/([\w.-]+)", readme))
    made = {path.name for path in (smoke.folder / "results").iterdir()}
    assert made <= named | studies.kinds_of_results() | {"README.md"}
    pictures = (smoke.folder / "results" / "figures").glob("*.svg")
    assert max(path.stat().st_size for path in pictures) < 1_500_000


def test_second_run_does_nothing(smoke):
    run = smoke.snakemake(*SMOKE)
    assert run.returncode == 0
    assert "Nothing to be done" in run.stdout


def test_report_holds_figures_captions_and_verdicts(smoke, tmp_path):
    """In one file."""
    report, figures = tmp_path / "report.zip", studies.paper_figures()
    run = smoke.snakemake(*SMOKE, "--report", str(report))
    assert run.returncode == 0, run.stdout
    with zipfile.ZipFile(report) as parts:
        files = {name.split("/")[-1] for name in parts.namelist()}
        text = parts.read("report/report.html").decode()
    assert {"claims.tsv", *(f"{figure}.png" for figure in figures)} <= files
    for figure in figures.values():
        assert json.dumps({"figure": figure.title.rstrip(".")})[1:-1] in text
    assert '"content": "Verdicts"' in text


TRAJECTORY = {"program", "model", "trajectory"}
SCENES = {"scene_attractors", "attractors_table"}
REFERENCE = {"program", "model", "trust_reference"}
WORK_PRECISION = {"trust_runs", "trusted_horizons", "work_precision_runs", "work_precision_table"}
CHAOS = {"trajectories/chaos.nc", "spectra/chaos.nc"}


@pytest.mark.parametrize(
    ("target", "rules", "data"),
    [
        ("figure_1", set(), set()),
        ("figure_5", TRAJECTORY | SCENES, None),
        (
            "figure_7",
            {*TRAJECTORY, "spectrum"},
            {"bin/spring_block", "models/slip_delayed_logarithm.so", *CHAOS},
        ),
        ("fault_limit", {"fault_limit_table"}, set()),
        ("work_precision", REFERENCE | WORK_PRECISION, None),
        (
            "results/references/stability/strong.tsv",
            {"program", "model", "stability_reference"},
            {"bin/spring_block_quad", "models_quad/slip_delayed_logarithm.so"},
        ),
    ],
)
def test_target_needs_only_its_own_rules(planned, target, rules, data):
    needed = needed_for(target, planned)
    assert {job.rule for job in needed} - {target} == rules
    assert data is None or data_of_jobs(needed) == data


def test_figures_and_files_can_be_made_alone(fresh, planned):
    """The jobs are those that the whole has for them."""
    targets = ("figure_5", "results/references/stability/strong.tsv")
    run = fresh.snakemake("--dry-run", *targets)
    assert run.returncode == 0, run.stdout
    assert set(jobs_in(run.stdout)) == set.union(*(needed_for(one, planned) for one in targets))


@pytest.mark.parametrize(
    ("cores", "nodes", "target", "words"),
    [
        (-2, None, "figure_5", "--cores -2; expected a whole number >= 1"),
        (2, 0, "figure_5", "--jobs 0; expected a whole number >= 1"),
        (2, None, "figure_55", "no target is named figure_55; the nearest one is figure_5 "),
        (2, None, "mine/a.nc", "no target is named mine/a.nc; the nearest one is mine/b.nc "),
        (2, None, "?", "no target is named ? (./reproduce --list-target-rules lists the targets)"),
        (None, 3, "figure_5", ""),
    ],
)
def test_refusals_of_a_run(monkeypatch, cores, nodes, target, words):
    monkeypatch.setattr(sys, "argv", ["snakemake", "--cores", "2", target])
    rule = SimpleNamespace(name="figure_5", is_producer=lambda path: False)
    settings = SimpleNamespace(cores=cores, nodes=nodes)
    workflow = SimpleNamespace(resource_settings=settings, rules=[rule])
    assert problem_of(workflow, "mine", ["<results>/b.nc"]).startswith(words)
    assert bool(problem_of(workflow, "mine", ["<results>/b.nc"])) == bool(words)


@pytest.mark.skipif(not shutil.which("git"), reason="no git")
def test_commit_is_named(tmp_path, monkeypatch):
    """By its full hash, with a word on changes; a repository around a copy is not its own."""

    def git(*words: str) -> str:
        me = ("-c", "user.name=me", "-c", "user.email=me@here")
        run = subprocess.run(["git", *me, *words], cwd=tmp_path, capture_output=True, text=True)
        return run.stdout.strip()

    assert commit_of(tmp_path) == UNKNOWN
    git("init")
    assert commit_of(tmp_path) == UNKNOWN
    (tmp_path / "file").write_text("one")
    git("add", "file")
    git("commit", "-m", "first")
    commit = git("rev-parse", "HEAD")
    assert commit_of(tmp_path) == commit
    (tmp_path / "copy").mkdir()
    assert commit_of(tmp_path / "copy") == UNKNOWN
    (tmp_path / "other").write_text("two")
    assert commit_of(tmp_path) == f"{commit} with changes"
    # a machine without git
    monkeypatch.setenv("PATH", "")
    assert commit_of(tmp_path) == UNKNOWN
