"""What a change makes anew, and that the rest stays."""

import shutil

from conftest import SMOKE, rules_in
from expected_rules import FIGURES, outputs_in


def test_changed_scene_reruns_only_what_depends_on_it(scratch):
    """Another tolerance of the torus: its trajectory, spectrum, exponents and their figures."""
    (scratch.folder / "mine.yaml").write_text("scenes: { torus: { tolerance: 1.0e-8 } }")
    before = scratch.outputs()
    run = scratch.snakemake(*SMOKE, "mine.yaml")
    assert run.returncode == 0, run.stdout
    expected = {"all", "scene_namelist", "trajectory", "spectrum", "figure_5", "figure_6"}
    expected |= {"true_torus", "page"}
    expected |= {"exponents_namelist", "exponents_runs", "exponents_table", "exponents"}
    assert rules_in(run.stdout) == expected
    after = scratch.outputs()
    assert set(after) == set(before)
    changed = {name for name in after if after[name] != before[name]}
    assert {"trajectories/torus.nc", "namelists/trajectories/torus.nml"} <= changed
    assert all(
        "torus" in name or name.startswith(("figures/figure_5", "figures/exp", "tables/exp"))
        for name in changed
        if not name.startswith("figures/figure_6")
    )


def test_changed_family_computes_no_other(smoke, tmp_path):
    """References of the others are kept."""
    text = "stability: { families: { spring: { t_end: 11.0 } } }"
    (tmp_path / "mine.yaml").write_text(text)
    run = smoke.snakemake("--dry-run", *SMOKE, str(tmp_path / "mine.yaml"))
    expected = {"all", "stability_namelists", "reference", "measurement"}
    assert rules_in(run.stdout) == expected | {"stability_table", "stability", "claims", "page"}
    assert outputs_in(run.stdout) == {"stability/spring.nc"}


def test_table_of_other_solvers_is_drawn_where_there_is_one(scratch):
    """It redraws one figure and is needed for none."""
    table = scratch.folder / "results" / "tables" / "benchmarks.tsv"
    table.write_text("scene\tsolver\ttolerance\terror_max\tseconds\ntorus\tother\t1\t1\t1\n")
    run = scratch.snakemake(*SMOKE)
    assert run.returncode == 0, run.stdout
    assert rules_in(run.stdout) == {"all", "work_precision", "page"}


def test_changed_setting_of_a_figure_redraws_only_that_figure(smoke, tmp_path):
    """Another length of an axis computes nothing."""
    (tmp_path / "mine.yaml").write_text("figures: { figure_7: { frequency_shown: 0.9 } }")
    run = smoke.snakemake("--dry-run", *SMOKE, str(tmp_path / "mine.yaml"))
    assert rules_in(run.stdout) == {"all", "figure_7", "page"}


def test_changed_style_redraws_and_computes_nothing(scratch):
    """All figures look alike."""
    with open(scratch.folder / "scripts" / "paper.mplstyle", "a") as style:
        style.write("\nlines.linewidth: 2\n")
    run = scratch.snakemake("--dry-run", *SMOKE)
    assert rules_in(run.stdout) == {"all", *FIGURES, "page"}


def test_results_made_again_are_the_same_bytes(scratch):
    """All but logs and measured times."""
    before = scratch.outputs()
    shutil.rmtree(scratch.folder / "results")
    run = scratch.snakemake(*SMOKE)
    assert run.returncode == 0, run.stdout
    after = scratch.outputs()
    assert set(after) == set(before)
    assert {name for name in after if after[name] != before[name]} == set()
