"""What a change makes anew, and that the rest stays."""

import ast
import os
import shutil
from collections.abc import Iterator

import pytest
from conftest import BUILT, ROOT, SMOKE, Project, rules_in
from dry_runs import data_of_jobs, jobs_in

from scripts.results.programs import RUNS
from scripts.workflow.script_imports import modules_of

STYLE = "scripts/drawing/paper.mplstyle"


def names_imported(script: str) -> Iterator[str]:
    """Modules, and what may be one, that a file of the project names in its imports."""
    for node in ast.walk(ast.parse((ROOT / script).read_text())):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            yield node.module
            yield from (f"{node.module}.{alias.name}" for alias in node.names)


def imports_of(script: str) -> set[str]:
    """Files of the project that one of them imports, directly or not."""
    found, unread = set(), {script}
    while unread:
        files = {f"{name.replace('.', '/')}.py" for name in names_imported(unread.pop())}
        new = {name for name in files - found if (ROOT / name).exists()}
        unread |= new
        found |= new
    return found


def change(project: Project, *names: str) -> None:
    """Add an empty line to files, with an old time, as an upgrade that keeps times leaves it."""
    for name in names:
        path = project.folder / name
        path.write_text(path.read_text() + "\n")
        os.utime(path, (1.5e9, 1.5e9))


def scripts() -> list[str]:
    """All scripts of rules."""
    files = (ROOT / "scripts").glob("*/*.py")
    marks = ("logged(snakemake.log[0])", "\ndef draw(")
    of_rules = [path for path in files if any(mark in path.read_text() for mark in marks)]
    return sorted(path.relative_to(ROOT).as_posix() for path in of_rules)


@pytest.mark.parametrize("script", scripts())
def test_results_of_a_script_depend_on_what_it_imports(script):
    """All of it; what draws depends on the style, too."""
    expected = imports_of(script) | {script}
    expected |= {STYLE} if "scripts/drawing/style.py" in expected else set()
    files = modules_of(script.removeprefix("scripts/"))
    assert expected <= {path.relative_to(ROOT).as_posix() for path in files}


def test_results_of_changed_scripts_are_stale(scratch):
    """Of every rule with a script, whatever the time of the script is."""
    change(scratch, *scripts())
    said = scratch.snakemake("--summary", *SMOKE).stdout
    rows = [line.split("\t") for line in said.splitlines() if line.count("\t") == 5]
    programs = {run.rule for run in RUNS} | {"build", "rule"}
    statuses = {row[2]: row[4] for row in rows if row[2] not in programs}
    assert len(statuses) > 30
    assert {rule: status for rule, status in statuses.items() if status != "params changed"} == {}


def test_changed_files_of_the_project_make_their_results_anew(scratch):
    """Scripts, templates, tables and what the page is made of, whatever their times are."""
    redrawn = {
        "scripts/figures/figure_6.rst": {"captions"},
        "benchmarks/measured.tsv": {"work_precision", "captions"},
        "page/style.css": set(),
    }
    for name, rules in redrawn.items():
        before = (scratch.folder / name).read_text()
        change(scratch, name)
        run = scratch.snakemake("--dry-run", *SMOKE)
        assert rules_in(run.stdout) == {"all", "page", *rules}, name
        (scratch.folder / name).write_text(before)
        os.utime(scratch.folder / name, (1.5e9, 1.5e9))


def test_results_of_an_older_program_are_computed_again(scratch):
    """Also where the build of the new one was interrupted, which leaves no program."""
    result = "results/spectra/torus.nc"
    change(scratch, f"fortran/app/{BUILT}.f90")
    lock = scratch.folder / "build" / "lock"
    lock.unlink()
    lock.mkdir()
    assert scratch.snakemake(result, *SMOKE).returncode != 0
    assert not (scratch.folder / "build" / "release" / "bin" / BUILT).exists()
    lock.rmdir()
    run = scratch.snakemake("--dry-run", result, *SMOKE)
    assert rules_in(run.stdout) == {"build", "spectrum"}


def test_removed_results_are_made_again(scratch):
    """By a run without targets, to the same bytes; programs where needed."""
    before = scratch.outputs()
    results = scratch.folder / "results"
    for name in ("spectra/torus.nc", "trajectories/torus.nc", "tables/claims.json"):
        (results / name).unlink()
    (results / "page" / "style.css").unlink()
    (scratch.folder / "build" / "release" / "bin" / "measure").unlink()
    run = scratch.snakemake(*SMOKE)
    assert run.returncode == 0, run.stdout
    assert {"trajectory", "spectrum", "claims", "page"} <= rules_in(run.stdout)
    assert "build" not in rules_in(run.stdout)
    assert scratch.outputs() == before


def test_changed_scene_reruns_only_what_depends_on_it(scratch):
    """Another tolerance of the torus: its trajectory, spectrum, exponents, figures and claims."""
    (scratch.folder / "mine.yaml").write_text("scenes: { torus: { tolerance: 1.0e-8 } }")
    before = scratch.outputs()
    run = scratch.snakemake(*SMOKE, "mine.yaml")
    assert run.returncode == 0, run.stdout
    expected = {"all", "trajectory_namelist", "trajectory", "spectrum", "figure_5", "figure_6"}
    expected |= {"true_torus", "claims", "captions", "page"}
    expected |= {"exponents_runs_namelist", "exponents_runs", "exponents_table", "exponents"}
    assert rules_in(run.stdout) == expected
    after = scratch.outputs()
    assert set(after) == set(before)
    changed = {name for name in after if after[name] != before[name]}
    assert {"trajectories/torus.nc", "namelists/trajectories/torus.nml"} <= changed
    others = ("figures/figure_5", "figures/figure_6", "figures/exp", "tables/exp", "tables/claims")
    assert [n for n in changed if "torus" not in n and not n.startswith((*others, "index"))] == []


@pytest.mark.parametrize(
    ("text", "rules", "data"),
    [
        (
            "stability: { families: { spring: { t_end: 11.0 } } }",
            {"reference_namelist", "reference", "measurement_namelist", "measurement"}
            | {"stability_table", "stability", "claims", "captions", "page"},
            {"stability/spring.nc"},
        ),
        (
            "figures: { figure_7: { frequency_shown: 0.9 } }",
            {"figure_7", "captions", "page"},
            set(),
        ),
    ],
)
def test_changed_setting_makes_nothing_else_anew(smoke, tmp_path, text, rules, data):
    """A family of cases, and the length of an axis."""
    (tmp_path / "mine.yaml").write_text(text)
    run = smoke.snakemake("--dry-run", *SMOKE, str(tmp_path / "mine.yaml"))
    assert rules_in(run.stdout) == {"all", *rules}
    assert data_of_jobs(set(jobs_in(run.stdout))) == data


def test_changed_style_redraws_and_computes_nothing(scratch):
    """All figures look alike."""
    change(scratch, STYLE)
    run = scratch.snakemake("--dry-run", *SMOKE)
    rules = rules_in(run.stdout)
    assert {"figure_1", "atlas", "captions", "page"} <= rules
    assert rules & {run.rule for run in RUNS} == set()


@pytest.mark.long
def test_results_made_again_are_the_same_bytes(scratch):
    """All but logs and measured times."""
    before = scratch.outputs()
    for path in (scratch.folder / "results").iterdir():
        if path.name != "README.md":
            shutil.rmtree(path) if path.is_dir() else path.unlink()
    run = scratch.snakemake(*SMOKE)
    assert run.returncode == 0, run.stdout
    after = scratch.outputs()
    assert set(after) == set(before)
    assert {name for name in after if after[name] != before[name]} == set()
