"""What a change makes anew, and that the rest stays."""

import os
import shutil
import time

import pytest
from dry_runs import data_of_jobs, jobs_in

from conftest import ROOT, SMOKE, Project, rules_in
from scripts.plans.studies import files_of
from scripts.workflow.script_imports import modules_of

SCRIPTS = ROOT / "scripts"
STYLE = "drawing/paper.mplstyle"


def change(project: Project, *names: str) -> None:
    """Add an empty line to files, with an old time, as an upgrade that keeps times leaves it."""
    for name in names:
        path = project.folder / name
        path.write_text(path.read_text() + "\n")
        os.utime(path, (1.5e9, 1.5e9))


def of_studies(name: str) -> list[str]:
    return [path.relative_to(SCRIPTS).as_posix() for path in files_of(name)]


def scripts() -> list[str]:
    files = SCRIPTS.glob("**/*.py")
    marks = ("logged(snakemake.log[0])", "\ndef draw(")
    of_rules = [path for path in files if any(mark in path.read_text() for mark in marks)]
    return sorted(path.relative_to(ROOT).as_posix() for path in of_rules)


@pytest.mark.parametrize(
    ("script", "expected"),
    [
        (
            "studies/routes/figure.py",
            ["studies/routes/figure.py", "drawing/class_map.py", "files/outputs.py", STYLE],
        ),
        ("page/write_page.py", of_studies("finding.py")),
    ],
)
def test_results_of_a_script_depend_on_what_it_imports(script, expected):
    """Also on what that imports, and on modules that are found by their name; what draws depends on
    the style, too."""
    found = {*modules_of(script)}
    assert {SCRIPTS / name for name in expected} <= found
    assert (SCRIPTS / STYLE in found) == (STYLE in expected)


def test_results_of_changed_scripts_and_commands_are_stale(scratch):
    """Of every rule, whatever the time of the script is."""
    change(scratch, *scripts(), "scripts/workflow/run_program.sh")
    rules = scratch.folder / "rules" / "programs.smk"
    rules.write_text(rules.read_text().replace("-m generator", "-m  generator"))
    said = scratch.snakemake("--summary", *SMOKE).stdout
    rows = [line.split("\t") for line in said.splitlines() if line.count("\t") == 5]
    statuses = {row[2]: row[4] for row in rows if row[2] not in {"program", "rule"}}
    assert len(statuses) > 30
    command = {"model": "rule implementation changed"}
    stale = {rule: status for rule, status in statuses.items() if status != "params changed"}
    assert stale == command
    run = scratch.snakemake("--dry-run", "build/release/models/slip_delayed_logarithm.so", *SMOKE)
    assert rules_in(run.stdout) == {"model"}


def test_changed_files_of_the_project_make_their_results_anew(scratch):
    """Templates of captions and of tests of claims, functions that these call, tables and what the
    page is made of; a changed style would redraw all figures."""
    change(
        scratch,
        "scripts/studies/paper_scenes/figure_6.rst",
        "scripts/studies/events/claims.jinja",
        "scripts/studies/routes/stretches.py",
        "benchmarks/measured.tsv",
        "scripts/page/templates/style.css",
    )
    run = scratch.snakemake("--dry-run", *SMOKE)
    assert rules_in(run.stdout) == {"all", "page", "captions", "claims", "work_precision"}


def test_results_of_an_older_program_are_computed_again(scratch):
    """A program whose sources have changed is built anew first."""
    result = "results/references/stability/strong.tsv"
    change(scratch, "fortran/src/commands/reference_command.f90")
    run = scratch.snakemake("--dry-run", result, *SMOKE)
    assert rules_in(run.stdout) == {"program", "stability_reference"}


def bring_from_elsewhere(project: Project, age: float) -> None:
    """Leave the results as a copy or an archive does: of one age in s, without .snakemake."""
    changed = time.time() - age
    shutil.rmtree(project.folder / ".snakemake")
    for path in (project.folder / "results").rglob("*"):
        os.utime(path, (changed, changed))


def test_results_from_elsewhere_are_current_with_their_records_alone(scratch):
    """Even older than the whole project. Without a record they are stale, in whole or in part."""
    bring_from_elsewhere(scratch, 1e9)
    shutil.rmtree(scratch.folder / "build")
    run = scratch.snakemake("--dry-run", *SMOKE)
    assert "Nothing to be done" in run.stdout
    namelist = scratch.folder / "results" / "namelists" / "trajectories" / "torus.nml"
    namelist.unlink()
    for name in ("trajectories/torus.nc", "namelists/trajectories/torus.nml"):
        (scratch.folder / "results" / "records" / f"{name}.json").unlink()
    run = scratch.snakemake("--dry-run", "results/trajectories/torus.nc", *SMOKE)
    assert "trajectory" in rules_in(run.stdout)


def test_changed_values_make_anew_only_what_depends_on_them(scratch, tmp_path):
    """A scene's trajectory, spectrum, exponents and figures; a study's runs of one case, its table
    and figure, and a figure that shows less; and the claims. In results from elsewhere, too."""
    (tmp_path / "mine.yaml").write_text(
        "scenes: { torus: { tolerance: 1.0e-8 } }\n"
        "stability: { families: { spring: { t_end: 11.0 } } }\n"
        "figures: { figure_7: { frequency_shown: 0.9 } }"
    )
    bring_from_elsewhere(scratch, 0.0)
    run = scratch.snakemake("--dry-run", *SMOKE, str(tmp_path / "mine.yaml"))
    rules = (
        "all claims captions first_page page"
        " trajectory spectrum exponents_runs exponents_table figure_5 figure_6 true_torus exponents"
        " synchrony_runs synchrony"
        " stability_reference stability_runs stability_table stability figure_7"
    )
    data = (
        "exponents/torus.nc spectra/torus.nc trajectories/torus.nc synchrony/torus.nc"
        " stability/spring.nc"
    )
    assert rules_in(run.stdout) == set(rules.split())
    assert data_of_jobs(set(jobs_in(run.stdout))) == set(data.split())


@pytest.mark.long
def test_results_made_again_are_the_same_bytes(scratch):
    before = scratch.outputs()
    for path in (scratch.folder / "results").iterdir():
        if path.name != "README.md":
            shutil.rmtree(path) if path.is_dir() else path.unlink()
    run = scratch.snakemake(*SMOKE)
    assert run.returncode == 0, run.stdout
    after = scratch.outputs()
    assert set(after) == set(before)
    assert {name for name in after if after[name] != before[name]} == set()
