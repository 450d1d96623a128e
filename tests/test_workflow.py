"""The workflow in smoke size: everything once, nothing twice, and only what is asked for."""

import re
import subprocess

import f90nml
import numpy as np
import pytest
from conftest import ROOT, SMOKE, rules_in
from dry_runs import Job, data_of_jobs, jobs_in, needed_for, rules_of
from expected_rules import (
    CYCLE_LINES,
    FAMILIES,
    OF_OTHERS,
    RULES_OF_ATTRACTORS,
    SCENES,
    WORK_SCENES,
    expected_outputs_of,
    expected_rules_of,
)

from scripts.figures.entries import FIGURES
from scripts.namelists.program_groups import LAW, nested
from scripts.namelists.study_cases import PARAMETERS, measured_study


def test_every_rule_ran(smoke_run):
    """A rule that no figure needs is a rule too many, but for `docs`; each says what it makes."""
    project, log = smoke_run
    said = project.snakemake("--list-rules").stdout
    listed = dict(re.findall(r"^(\w+)(?: \((.*)\))?$", said, flags=re.MULTILINE))
    assert rules_in(log) == set(listed) - {"docs"}
    assert [name for name, docstring in listed.items() if not docstring.endswith(".")] == []


def test_help_names_all_targets(fresh):
    """Those that Snakemake lists, which are rules without wildcards."""
    said = fresh.snakemake("--list-target-rules").stdout
    listed = re.findall(r"^(\w+) \(.*\.\)$", said, flags=re.MULTILINE)
    usage = subprocess.run([ROOT / "reproduce", "--help"], stdout=subprocess.PIPE, text=True).stdout
    targets = usage.partition("\nTargets\n")[2].partition("\n\n")[0]
    kinds = {"figures", "tables", "others"}
    assert sorted(set(targets.split()) - kinds) == sorted(listed)


def test_figures_of_the_paper_come_first(smoke_run):
    """A reader can look at them while the long runs go on."""
    started = re.findall(r"^(?:local)?rule (\w+):", smoke_run[1], flags=re.MULTILINE)
    last = max(started.index(f"figure_{number}") for number in range(1, 9))
    long = {"attractors_runs", "cycles_runs", "exponents_runs", "work_precision_runs"}
    before = [rule for rule in started[:last] if rule in long]
    assert len(before) < sum(rule in long for rule in started) / 5


def test_every_figure_is_there_three_times(smoke):
    """For print, as picture and for the page, none empty, and for the page none that is slow."""
    figures = {
        path.name: path.read_bytes()
        for path in (smoke.folder / "results/figures").iterdir()
        if path.suffix != ".rst"
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
    assert len(computed) == 70 + len(CYCLE_LINES) + 2 * len(FAMILIES) - 2 + 3 * len(WORK_SCENES)
    for path in computed:
        assert (results / "logs" / path).with_suffix(".log").is_file()
        assert (results / "benchmarks" / path).with_suffix(".tsv").is_file()
    for name in FIGURES:
        assert (results / "logs" / "figures" / f"{name}.log").is_file()


def test_namelists_hold_the_config(smoke, smoke_config):
    """Each value under its key, in the group that its program reads."""
    folder = smoke.folder / "results" / "namelists"
    read = {
        path.relative_to(folder).with_suffix("").as_posix(): f90nml.read(path).todict()["settings"]
        for path in folder.rglob("*.nml")
        if path.relative_to(folder).parts[0] not in ("attractors", "measurements", "references")
    }
    scenes = {
        name: nested(
            {"name": name, **{key: scene[key] for key in set(scene) - OF_OTHERS}},
            "parameters",
            PARAMETERS,
        )
        for name, scene in smoke_config["scenes"].items()
    }
    # a list of one is read as its item
    scenes["true_torus"]["variables"] = "v"
    expected = {
        **{f"trajectories/{name}": {"scene": scene} for name, scene in scenes.items()},
        **{f"hopf/{k}": {"hopf_curves": v} for k, v in smoke_config["hopf_curves"].items()},
        "velocity_step": {"velocity_step": nested(smoke_config["velocity_step"], "law", LAW)},
    }
    cycles = smoke_config["cycles"]
    shared = {key: value for key, value in cycles.items() if key not in ("lines", "curves")}
    shared |= cycles["curves"]
    for name, line in cycles["lines"].items():
        given = {key: value for key, value in line.items() if value != []}
        # a list of one is read as its item
        given |= {"starts": line["starts"][0]} if len(line["starts"]) == 1 else {}
        expected[f"cycles/{name}"] = {"cycles": nested(shared | given, "parameters", PARAMETERS)}
    for name, scene in scenes.items():
        parameters = {"parameters": scene["parameters"]}
        asked = {"linear_stability": parameters | smoke_config["linear_stability"]}
        expected[f"linear_stability/{name}"] = asked
    for scene in SCENES:
        source = {"trajectory": f"results/trajectories/{scene}.nc"}
        expected[f"spectra/{scene}"] = source | {"spectrum": smoke_config["spectra"]}
        wanted = smoke_config["exponents"] | smoke_config["scenes"][scene]["exponents"]
        (wanted["check_steps"],) = wanted["check_steps"]
        expected[f"exponents/{scene}"] = {"scene": scenes[scene], "exponents": wanted}
    assert read == expected


def test_namelists_of_studies_hold_the_config(smoke, smoke_config):
    """Every family with its references, and every scene up to its horizon."""
    folder = smoke.folder / "results" / "namelists"
    study = smoke_config["stability"]
    for name, family in study["families"].items():
        for kind in ("measurements", "references"):
            groups = f90nml.read(folder / kind / "stability" / f"{name}.nml")["settings"]
            assert np.unique(groups["parameters"]["gamma"]).tolist() == family["gamma"]
            assert np.unique(groups["histories"]["v"]).tolist() == family["v"]
            assert set(np.atleast_1d(groups["cases"]["t_end"])) == {family["t_end"]}
    study = measured_study(smoke_config)
    for name, scene in study["cases"].items():
        groups = f90nml.read(folder / "measurements" / "work_precision" / f"{name}.nml")["settings"]
        assert groups["cases"]["t_end"] <= scene["t_end"]
        assert groups["measure"]["tolerances"] == study["tolerances"]
        trusted = f90nml.read(folder / "references" / "trust" / f"{name}.nml")["settings"]
        assert trusted["cases"]["t_end"] == scene["t_end"]
        assert trusted["reference"].items() >= study["reference"].items()


def test_nothing_unfinished_is_left(smoke):
    """Files are whole or absent."""
    assert list((smoke.folder / "results").rglob("*.part")) == []


def test_what_is_in_results_stands_in_its_readme(smoke):
    """Every folder and the page; the file itself is kept as it is."""
    readme = (smoke.folder / "results" / "README.md").read_text()
    assert readme == (ROOT / "results" / "README.md").read_text()
    named = set(re.findall(r"`results/([\w.]+)", readme))
    made = {path.name for path in (smoke.folder / "results").iterdir()}
    assert named == (made | {"docs", "mine"}) - {"page", "README.md"}


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


@pytest.fixture(scope="module")
def planned(fresh) -> list[Job]:
    """All jobs of a fresh copy."""
    run = fresh.snakemake("--dry-run")
    assert run.returncode == 0, run.stdout
    return jobs_in(run.stdout)


@pytest.mark.parametrize("figure", FIGURES)
def test_figure_needs_only_its_own_rules(planned, figure):
    """From nothing: its data, their programs, and no other."""
    needed = needed_for(figure, planned)
    assert rules_of(needed) == expected_rules_of(figure) | {figure}
    assert data_of_jobs(needed) == expected_outputs_of(figure)


@pytest.mark.parametrize(
    ("target", "rules"),
    [
        ("results/trajectories/oscillation.nc", {"build", "scene_namelist", "trajectory"}),
        ("results/figures/figure_1.png", {"figure_1"}),
        ("results/hopf/xi_of_epsilon.nc", {"build", "hopf_namelist", "hopf_curves"}),
        ("build/release/bin/spectrum", {"build"}),
        (
            "results/references/stability/strong.tsv",
            {"build", "reference_namelist", "reference"},
        ),
    ],
)
def test_file_needs_only_its_own_rules(planned, target, rules):
    """By its path."""
    assert rules_of(needed_for(target, planned)) == rules


def test_figures_and_files_can_be_asked_for(fresh, planned):
    """What is asked for is what needs it in the whole; an unknown target is refused by name."""
    targets = ("figure_5", "results/references/stability/strong.tsv")
    run = fresh.snakemake("--dry-run", *targets)
    assert run.returncode == 0, run.stdout
    assert set(jobs_in(run.stdout)) == set.union(*(needed_for(one, planned) for one in targets))
    run = fresh.snakemake("--dry-run", "figure_9")
    assert run.returncode != 0
    assert "figure_9" in run.stdout


def test_everything_from_one_command(planned):
    """Without a target: all figures and no computation that none of them needs."""
    tables = {"cycle_points", "hopf_points", "linear_stability_namelist", "linear_stability"}
    tables |= {"linear_stability_table", "claims", "captions", "page", "play_data"}
    tables |= {"dimensions_table"} | RULES_OF_ATTRACTORS
    everything = set.union({"all", *tables, *FIGURES}, *map(expected_rules_of, FIGURES))
    assert rules_of(planned) == everything
