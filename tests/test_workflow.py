"""The workflow in smoke size: everything once, nothing twice, and only what is asked for."""

import re
import shutil
import zipfile

import f90nml
import numpy as np
import pytest
import xarray as xr
import yaml
from conftest import ROOT, SMOKE, rules_in


def data_of(*scenes: str) -> set[str]:
    """Trajectories and spectra of scenes."""
    return {f"{kind}/{scene}.nc" for kind in ("trajectories", "spectra") for scene in scenes}


def settings(*path: str) -> dict:
    """A section of the config as it stands in the file."""
    section = yaml.safe_load((ROOT / "config" / "config.yaml").read_text())
    for key in path:
        section = section[key]
    return section


OPTIONAL = {"atlas", "docs"}
"""Rules that are no part of everything."""
FAMILIES = settings("stability", "families")
WORK_SCENES = settings("work_precision", "scenes")
PLANES = settings("atlas", "planes")
SCENES = ["oscillation", "torus", "chaos", "true_torus"]
"""Scenes that move."""
FIGURES = [*(f"figure_{n}" for n in range(1, 9)), "exponents", "stability", "work_precision"]
FIGURES += ["atlas_coarse", "true_torus", "route_to_chaos"]
HOPF = {"build", "hopf_namelist", "hopf_curves"}
SPECTRA = {"build", "scene_namelist", "trajectory", "spectrum_namelist", "spectrum"}
ATTRACTORS = {"build", "attractors_namelist", "attractors_runs"}
RULES_OF = {
    "figure_1": set(),
    "figure_2": HOPF,
    "figure_3": HOPF,
    "figure_4": {"build", "scene_namelist", "trajectory"},
    "figure_5": SPECTRA,
    "figure_6": SPECTRA,
    "figure_7": SPECTRA,
    "figure_8": {"build", "velocity_step_namelist", "velocity_step"},
    "exponents": {"build", "exponents_namelist", "exponents_runs", "exponents_table"},
    "stability": {"build", "stability_namelists", "reference", "measurement", "stability_table"},
    "work_precision": {
        "build",
        "trust_namelists",
        "reference",
        "measurement",
        "trusted_horizons",
        "work_precision_namelist",
        "work_precision_runs",
        "work_precision_table",
    },
    "atlas_coarse": {*ATTRACTORS, "atlas_table", *HOPF},
    "true_torus": {*ATTRACTORS, "attractors_table", *SPECTRA},
    "route_to_chaos": {*ATTRACTORS, "route_table"},
}
"""Rules that each figure needs besides its own."""
RULES_OF_ATTRACTORS = {
    "attractors_namelist",
    "attractors_runs",
    "attractors_table",
    "route_table",
}
"""Rules that the ledger needs besides."""
OUTPUTS_OF = {
    "figure_1": set(),
    "figure_2": {"bin/hopf", "hopf/tau_of_epsilon.nc"},
    "figure_3": {"bin/hopf", "hopf/xi_of_epsilon.nc"},
    "figure_4": {"bin/trajectory", "trajectories/fixed_point.nc", "trajectories/oscillation.nc"},
    "figure_5": {"bin/trajectory", "bin/spectrum", *data_of("torus", "chaos")},
    "figure_6": {"bin/trajectory", "bin/spectrum", *data_of("oscillation", "torus")},
    "figure_7": {"bin/trajectory", "bin/spectrum", *data_of("chaos")},
    "figure_8": {"bin/velocity_step", "friction/velocity_step.nc"},
    "exponents": {
        "bin/exponents",
        *(f"exponents/{scene}.nc" for scene in SCENES),
    },
    "stability": {
        "bin/measure",
        "bin/reference",
        *(f"stability/{family}.nc" for family in FAMILIES),
    },
    "work_precision": {
        "bin/measure",
        "bin/reference",
        *(f"{study}/{name}.nc" for study in ("trust", "work_precision") for name in WORK_SCENES),
    },
    "atlas_coarse": {
        *("bin/attractors", "bin/hopf", "hopf/tau_of_epsilon.nc", "hopf/tau_of_epsilon_xi_08.nc"),
        *(f"{plane}/{part:04}.nc" for plane in PLANES for part in range(1, 5)),
    },
    "true_torus": {
        *("bin/attractors", "bin/trajectory", "bin/spectrum"),
        *data_of("torus", "true_torus"),
        *(f"scenes/{scene}.nc" for scene in ["fixed_point", *SCENES]),
    },
    "route_to_chaos": {"bin/attractors", "route/0001.nc", "route/0002.nc"},
}
"""Programs and data that figures need."""
OF_OTHERS = {"exponents", "attractors"}
"""Keys of a scene that are not for its trajectory."""
MY_SCENE = """
scenes:
  mine:
    tau: 3.0
    epsilon: 0.6
    xi: 0.7
    gamma: 0.9
    history: { v: 1.2 }
    t_end: 60.0
    sample_interval: 0.5
    tolerance: 1.0e-7
  mine_tight:
    tau: 3.0
    epsilon: 0.6
    xi: 0.7
    gamma: 0.9
    history: { v: 1.2 }
    t_end: 60.0
    sample_interval: 0.5
    tolerance: 1.0e-13
"""


def outputs_in(log: str) -> set[str]:
    """Programs and data files, each by folder and name, in the log of a dry run."""
    paths = re.findall(r"^ +output: (\S+(?:\.nc|/bin/\w+))$", log, flags=re.MULTILINE)
    return {"/".join(path.split("/")[-2:]) for path in paths}


def test_every_rule_ran(smoke_run):
    """A rule that no figure needs is a rule too many, but for targets of their own."""
    project, run = smoke_run
    listed = re.findall(r"^\w+$", project.snakemake("--list-rules").stdout, flags=re.MULTILINE)
    assert len(listed) > 10
    assert rules_in(run.stdout) == set(listed) - OPTIONAL


def test_every_figure_is_there_three_times(smoke):
    """For print, as picture and for the page, none empty, and for the page none that is slow."""
    figures = {
        path.name: path.read_bytes() for path in (smoke.folder / "results/figures").iterdir()
    }
    begins = {"pdf": b"%PDF", "png": b"\x89PNG", "svg": b"<?xml"}
    assert set(figures) == {f"{name}.{ending}" for name in FIGURES for ending in begins}
    for name, content in figures.items():
        assert content.startswith(begins[name.split(".")[-1]])
        assert 5000 < len(content) < 1_500_000


def test_every_job_has_a_log_and_every_computation_a_benchmark(smoke):
    """Beside the results, by the same path."""
    results = smoke.folder / "results"
    computed = {path.relative_to(results) for path in results.rglob("*.nc")}
    computed |= {path.relative_to(results) for path in (results / "references").rglob("*.tsv")}
    assert len(computed) == 33 + 2 * len(FAMILIES) - 2 + 3 * len(WORK_SCENES)
    for path in computed:
        assert (results / "logs" / path).with_suffix(".log").is_file()
        assert (results / "benchmarks" / path).with_suffix(".tsv").is_file()
    for name in FIGURES:
        assert (results / "logs" / "figures" / f"{name}.log").is_file()


def test_namelists_hold_the_config(smoke, smoke_config):
    """Each value under its key, in the group that its program reads."""
    folder = smoke.folder / "results" / "namelists"
    read = {
        path.relative_to(folder).with_suffix("").as_posix(): f90nml.read(path).todict()
        for path in folder.rglob("*.nml")
        if path.relative_to(folder).parts[0] not in ("attractors", "measurements", "references")
    }
    scenes = {
        name: {"name": name, **{key: scene[key] for key in set(scene) - OF_OTHERS}}
        for name, scene in smoke_config["scenes"].items()
    }
    # a list of one is read as its item
    scenes["true_torus"]["variables"] = "v"
    expected = {
        **{f"trajectories/{name}": {"scene": scene} for name, scene in scenes.items()},
        **{f"hopf/{k}": {"hopf_curves": v} for k, v in smoke_config["hopf_curves"].items()},
        "velocity_step": {"velocity_step": smoke_config["velocity_step"]},
    }
    for name, scene in scenes.items():
        parameters = {key: scene[key] for key in ("tau", "epsilon", "xi", "gamma")}
        asked = {"linear_stability": parameters | smoke_config["linear_stability"]}
        expected[f"linear_stability/{name}"] = asked
    for scene in SCENES:
        source = {"trajectory": f"results/trajectories/{scene}.nc"}
        expected[f"spectra/{scene}"] = {"spectrum": source | smoke_config["spectra"]}
        wanted = smoke_config["scenes"][scene]["exponents"] | smoke_config["exponents"]
        expected[f"exponents/{scene}"] = {"scene": scenes[scene], "exponents": wanted}
    assert read == expected


def test_namelists_of_studies_hold_the_config(smoke, smoke_config):
    """Every family with its references, and every scene up to its horizon."""
    folder = smoke.folder / "results" / "namelists"
    study = smoke_config["stability"]
    for name, family in study["families"].items():
        for kind in ("measurements", "references"):
            cases = f90nml.read(folder / kind / "stability" / f"{name}.nml")["cases_list"]
            assert np.unique(cases["gamma"]).tolist() == family["gamma"]
            assert np.unique(cases["v"]).tolist() == family["v"]
            assert set(np.atleast_1d(cases["t_end"])) == {family["t_end"]}
    study = smoke_config["work_precision"]
    for name, scene in study["scenes"].items():
        groups = f90nml.read(folder / "measurements" / "work_precision" / f"{name}.nml").todict()
        assert groups["cases_list"]["t_end"] <= scene["t_end"]
        assert groups["measure"]["tolerances"] == study["tolerances"]
        trusted = f90nml.read(folder / "references" / "trust" / f"{name}.nml").todict()
        assert trusted["cases_list"]["t_end"] == scene["t_end"]
        assert trusted["reference"].items() >= study["reference"].items()


def test_nothing_unfinished_is_left(smoke):
    """Files are whole or absent."""
    assert list((smoke.folder / "results").rglob("*.part")) == []


def test_second_run_does_nothing(smoke):
    """All is there and up to date."""
    run = smoke.snakemake(*SMOKE)
    assert run.returncode == 0
    assert "Nothing to be done" in run.stdout
    assert rules_in(run.stdout) == set()


def test_full_config_computes_everything_anew(smoke):
    """The overlay was in force: without it no computation is up to date."""
    run = smoke.snakemake("--dry-run")
    assert run.returncode == 0
    assert {"trajectory", "spectrum", "hopf_curves", "velocity_step"} <= rules_in(run.stdout)


@pytest.mark.parametrize("figure", FIGURES)
def test_figure_runs_only_its_own_rules(project, figure):
    """From nothing: its data, their programs, and no other."""
    run = project.snakemake("--dry-run", figure)
    assert run.returncode == 0, run.stdout
    assert rules_in(run.stdout) == RULES_OF[figure] | {figure}
    assert outputs_in(run.stdout) == OUTPUTS_OF[figure]


@pytest.mark.parametrize(
    ("target", "rules"),
    [
        ("results/trajectories/oscillation.nc", {"build", "scene_namelist", "trajectory"}),
        ("results/figures/figure_1.png", {"figure_1"}),
        ("results/hopf/xi_of_epsilon.nc", {"build", "hopf_namelist", "hopf_curves"}),
        ("build/release/bin/spectrum", {"build"}),
        (
            "results/references/stability/strong.tsv",
            {"build", "stability_namelists", "reference"},
        ),
    ],
)
def test_any_file_can_be_asked_for(project, target, rules):
    """By its path."""
    run = project.snakemake("--dry-run", target)
    assert run.returncode == 0, run.stdout
    assert rules_in(run.stdout) == rules


def test_everything_from_one_command(project):
    """Without a target: all figures and no computation that none of them needs."""
    run = project.snakemake("--dry-run")
    tables = {"hopf_points", "linear_stability_namelist", "linear_stability"}
    tables |= {"linear_stability_table", "claims", "page", *RULES_OF_ATTRACTORS}
    everything = set.union({"all", *tables, *FIGURES}, *RULES_OF.values())
    assert rules_in(run.stdout) == everything


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


def test_scene_of_ones_own(scratch):
    """It merges over the default config; v is right to 100 x tolerance against a tighter run."""
    (scratch.folder / "mine.yaml").write_text(MY_SCENE)
    targets = [f"results/trajectories/{name}.nc" for name in ("mine", "mine_tight", "torus")]
    run = scratch.snakemake(*targets, "--configfile", "mine.yaml")
    assert run.returncode == 0, run.stdout
    loose, tight, torus = (xr.load_dataset(scratch.folder / path) for path in targets)
    assert list(loose.data_vars) == ["theta", "u", "v"]
    assert loose.attrs["history_theta"] == 0.0
    assert loose.attrs["history_v"] == 1.2
    for time in (0.5, 3.0, 17.5, 60.0):
        right = float(tight.v.sel(time=time))
        assert float(loose.v.sel(time=time)) == pytest.approx(right, abs=100e-7)
    assert not np.array_equal(loose.v, tight.v)
    assert torus.attrs["t_end"] == 8000.0


def test_one_key_of_a_scene_can_be_changed(project, tmp_path):
    """The others keep their values."""
    (tmp_path / "mine.yaml").write_text("scenes: { torus: { history: { v: 1.5 } } }")
    run = project.snakemake("--dry-run", "figure_5", "--configfile", str(tmp_path / "mine.yaml"))
    assert run.returncode == 0, run.stdout


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("scenes: { torus: { tau: -1.0 } }", "scene 'torus': tau = -1.0; expected "),
        ("scenes: { torus: { taus: 1.0 } }", "scene 'torus': unknown key ['taus']"),
        ("scenes: { torus: { tolerance: 1e-9 } }", "tolerance = '1e-9'"),
        ("scenes: { mine: { tau: 1.0 } }", "scene 'mine': key ['epsilon'"),
        ("scenes: { Mine: {} }", "config scenes: name 'Mine'"),
        ("scenes: { torus: }", "torus = None"),
        ("stability: { tolerance: 1.0 }", "config stability: tolerance = 1.0; expected "),
        ("scenes: { 5: { tau: 1.0, epsilon: 0.5, xi: 1.0, gamma: 1.0, t_end: 9.0 } }", "name 5"),
        ("threads: 2", "unknown key ['threads']"),
    ],
)
def test_bad_file_of_ones_own_is_refused_in_words(smoke, tmp_path, text, words):
    """No traceback, a status other than 0, and nothing made."""
    (tmp_path / "mine.yaml").write_text(text)
    before = smoke.outputs()
    run = smoke.snakemake(
        "results/trajectories/torus.nc", "--configfile", str(tmp_path / "mine.yaml")
    )
    assert run.returncode != 0
    assert words in run.stdout
    assert "Traceback" not in run.stdout
    assert smoke.outputs() == before


def test_integration_that_fails_is_told_and_leaves_no_output(scratch):
    """What the program says is on the screen and in the log."""
    text = MY_SCENE.replace("v: 1.2", "v: 1.0e-300")
    (scratch.folder / "mine.yaml").write_text(text)
    run = scratch.snakemake("results/trajectories/mine.nc", "--configfile", "mine.yaml")
    assert run.returncode != 0
    results = scratch.folder / "results"
    assert list((results / "trajectories").glob("mine*")) == []
    said = (results / "logs" / "trajectories" / "mine.log").read_text()
    assert said.startswith("error: ")
    assert said.strip() in run.stdout


def test_program_that_dies_leaves_no_output(scratch):
    """Even if it wrote half of it."""
    program = scratch.folder / "build" / "release" / "bin" / "trajectory"
    program.write_text('#!/bin/sh\necho half >"$2"\necho "it died" >&2\nexit 3\n')
    (scratch.folder / "mine.yaml").write_text(MY_SCENE)
    run = scratch.snakemake("results/trajectories/mine.nc", "--configfile", "mine.yaml")
    assert run.returncode != 0
    assert "it died" in run.stdout
    assert not (scratch.folder / "results" / "trajectories" / "mine.nc").exists()


def test_build_that_fails_is_told(project):
    """The compiler's words are on the screen and in the log, and there is no program."""
    with open(project.folder / "fortran" / "src" / "kinds.f90", "a") as source:
        source.write("this is no Fortran\n")
    run = project.snakemake("build/release/bin/velocity_step")
    assert run.returncode != 0
    assert "this is no Fortran" in run.stdout
    log = project.folder / "results" / "logs" / "build" / "velocity_step.log"
    assert "this is no Fortran" in log.read_text()
    assert not (project.folder / "build" / "release" / "bin" / "velocity_step").exists()


def test_unknown_target_is_refused(project):
    """By name."""
    run = project.snakemake("--dry-run", "figure_9")
    assert run.returncode != 0
    assert "figure_9" in run.stdout


@pytest.mark.parametrize("figure", FIGURES)
def test_figure_has_a_caption(figure):
    """At least one whole sentence."""
    caption = (ROOT / "scripts" / f"{figure}.rst").read_text()
    assert len(caption.split()) >= 8
    assert caption.rstrip().endswith(".")


@pytest.mark.parametrize("ending", ["html", "zip"])
def test_report_holds_every_figure_and_caption(smoke, tmp_path, ending):
    """In one file; the longest plain part of each caption stands for the whole."""
    report = tmp_path / f"report.{ending}"
    run = smoke.snakemake(*SMOKE, "--report", str(report))
    assert run.returncode == 0, run.stdout
    if ending == "zip":
        with zipfile.ZipFile(report) as parts:
            pictures = {name.split("/")[-1] for name in parts.namelist()}
            assert {f"{figure}.png" for figure in FIGURES} <= pictures
            text = parts.read("report/report.html").decode()
    else:
        text = report.read_text()
    text = " ".join(text.replace("\\n", " ").split())
    for figure in FIGURES:
        caption = (ROOT / "scripts" / f"{figure}.rst").read_text().replace(":math:", "")
        plain_parts = re.findall(r"[\w ,;:.()-]+", " ".join(caption.split()))
        assert max(plain_parts, key=len).strip() in text
        assert f"{figure}.png" in text
