"""What a change makes anew, and that the rest stays."""

import ast
import os
import re
import shutil
from collections.abc import Iterator

import pytest
from conftest import BUILT, ROOT, SMOKE, Project, rules_in
from dry_runs import data_of_jobs, jobs_in
from snakemake_records import records_of

from scripts.figures.registry import FIGURES
from scripts.workflow.script_imports import modules_of

COMPUTE = {
    *("attractors_runs", "cycles_runs", "exponents_runs", "hopf_curves", "linear_stability"),
    *("measurement", "reference", "spectrum", "slip_events", "trajectory", "velocity_step"),
    "work_precision_runs",
}
"""Rules that run a program."""
STYLE = "scripts/drawing/paper.mplstyle"
SCRIPT = r"\(draw, snakemake\)|logged\(snakemake"
"""What a script of a rule contains."""


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
    of_rules = [path for path in files if re.search(SCRIPT, path.read_text())]
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
    statuses = {row[2]: row[4] for row in rows if row[2] not in COMPUTE | {"build", "rule"}}
    files = set((ROOT / "rules").glob("*.smk")) - {ROOT / "rules" / "own.smk"}
    written = "".join(path.read_text() for path in files)
    # one text stands for the rules of all figures
    assert len(statuses) == written.count("    script:\n") - 1 + len(FIGURES)
    assert {rule: status for rule, status in statuses.items() if status != "params changed"} == {}


def test_changed_files_of_the_project_make_their_results_anew(scratch):
    """Scripts, templates, tables and what the page is made of, whatever their times are."""
    redrawn = {
        "scripts/figures/figure_5.py": {"figure_5", "captions"},
        "scripts/figures/figure_6.rst": {"captions"},
        "benchmarks/measured.tsv": {"work_precision", "captions"},
        "page/verdicts.html.jinja": {"claims", "captions"},
        "page/equations.yaml": set(),
        "page/style.css": set(),
        "README.md": set(),
    }
    for name, rules in redrawn.items():
        before = (scratch.folder / name).read_text()
        change(scratch, name)
        run = scratch.snakemake("--dry-run", *SMOKE)
        assert rules_in(run.stdout) == {"all", "page", *rules}, name
        (scratch.folder / name).write_text(before)
        os.utime(scratch.folder / name, (1.5e9, 1.5e9))


def test_changed_norm_of_errors_makes_three_tables_anew(scratch):
    """And what is drawn from them; nothing is computed but the runs up to another horizon."""
    change(scratch, "scripts/tables/accuracy.py")
    run = scratch.snakemake("--dry-run", *SMOKE)
    tables = {"stability_table", "trusted_horizons", "work_precision_table"}
    runs = {"work_precision_namelist", "work_precision_runs"}
    shown = {"stability", "work_precision", "claims", "captions", "page", "all"}
    assert rules_in(run.stdout) == tables | runs | shown


def test_results_carry_the_values_that_they_were_made_with(smoke):
    """All that their namelist holds, so that none is taken for current after a change."""
    records = records_of(smoke)
    seen = set()
    for record in records.values():
        for namelist in (path for path in record["input"] if path.endswith(".nml")):
            values = {text for text in records[namelist]["params"] if text.startswith("{")}
            assert values
            assert values <= set(record["params"]), record["rule"]
            seen.add(record["rule"])
    assert seen == COMPUTE


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


def test_what_was_removed_is_made_again(scratch):
    """By a plain run or one for what depends on it, to the same bytes; programs where needed."""
    before = scratch.outputs()
    results = scratch.folder / "results"
    for name in ("spectra/torus.nc", "namelists/trajectories/torus.nml", "tables/claims.json"):
        (results / name).unlink()
    (results / "page" / "style.css").unlink()
    (scratch.folder / "build" / "release" / "bin" / "measure").unlink()
    run = scratch.snakemake("figure_6", *SMOKE)
    assert run.returncode == 0, run.stdout
    assert rules_in(run.stdout) == {"scene_namelist", "trajectory", "spectrum", "figure_6"}
    run = scratch.snakemake(*SMOKE)
    assert run.returncode == 0, run.stdout
    assert {"claims", "page"} <= rules_in(run.stdout)
    assert "build" not in rules_in(run.stdout)
    assert scratch.outputs() == before


def test_changed_scene_reruns_only_what_depends_on_it(scratch):
    """Another tolerance of the torus: its trajectory, spectrum, exponents, figures and claims."""
    (scratch.folder / "mine.yaml").write_text("scenes: { torus: { tolerance: 1.0e-8 } }")
    before = scratch.outputs()
    run = scratch.snakemake(*SMOKE, "mine.yaml")
    assert run.returncode == 0, run.stdout
    expected = {"all", "scene_namelist", "trajectory", "spectrum", "figure_5", "figure_6"}
    expected |= {"true_torus", "claims", "captions", "page"}
    expected |= {"exponents_namelist", "exponents_runs", "exponents_table", "exponents"}
    assert rules_in(run.stdout) == expected
    after = scratch.outputs()
    assert set(after) == set(before)
    changed = {name for name in after if after[name] != before[name]}
    assert {"trajectories/torus.nc", "namelists/trajectories/torus.nml"} <= changed
    assert all(
        "torus" in name
        or name.startswith(("figures/figure_5", "figures/exp", "tables/exp", "tables/claims"))
        for name in changed
        if not name.startswith(("figures/figure_6", "index.html"))
    )


def test_changed_family_computes_no_other(smoke, tmp_path):
    """References of the others are kept."""
    text = "stability: { families: { spring: { t_end: 11.0 } } }"
    (tmp_path / "mine.yaml").write_text(text)
    run = smoke.snakemake("--dry-run", *SMOKE, str(tmp_path / "mine.yaml"))
    expected = {"all", "stability_namelists", "reference", "measurement"}
    assert rules_in(run.stdout) == expected | {
        *("stability_table", "stability", "claims", "captions", "page")
    }
    assert data_of_jobs(set(jobs_in(run.stdout))) == {"stability/spring.nc"}


def test_changed_setting_of_a_figure_redraws_only_that_figure(smoke, tmp_path):
    """Another length of an axis computes nothing."""
    (tmp_path / "mine.yaml").write_text("figures: { figure_7: { frequency_shown: 0.9 } }")
    run = smoke.snakemake("--dry-run", *SMOKE, str(tmp_path / "mine.yaml"))
    assert rules_in(run.stdout) == {"all", "figure_7", "captions", "page"}


def test_changed_style_redraws_and_computes_nothing(scratch):
    """All figures look alike."""
    change(scratch, STYLE)
    run = scratch.snakemake("--dry-run", *SMOKE)
    assert rules_in(run.stdout) == {"all", *FIGURES, "captions", "page"}


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
