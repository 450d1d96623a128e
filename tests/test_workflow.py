"""The workflow in smoke size: everything once, nothing twice, and only what is asked for."""

import re
import subprocess
from collections.abc import Iterator

import f90nml
import numpy as np
import pytest
from conftest import ROOT, SMOKE, rules_in
from dry_runs import Job, data_of_jobs, jobs_in, needed_for, rules_of

from scripts.namelists.study_cases import measured_study

PAPER = [f"figure_{number}" for number in range(1, 9)]


def test_every_rule_ran(smoke_run):
    """A rule that no figure needs is a rule too many, but for `docs` and users' planes."""
    project, log = smoke_run
    listed = re.findall(r"^(\w+)", project.snakemake("--list-rules").stdout, flags=re.MULTILINE)
    assert set(listed) - rules_in(log) - {"Using", "Assuming"} == {"docs", "atlas_plane_table"}


def test_help_names_all_targets(fresh):
    """Those that Snakemake lists, which are rules without wildcards."""
    said = fresh.snakemake("--list-target-rules").stdout
    listed = set(re.findall(r"^(\w+)(?: \(.*\))?$", said, flags=re.MULTILINE))
    usage = subprocess.run([ROOT / "reproduce", "--help"], stdout=subprocess.PIPE, text=True).stdout
    targets = usage.partition("\nTargets\n")[2].partition("\n\n")[0]
    assert set(targets.split()) - {"figures", "tables", "others"} == listed


def test_figures_of_the_paper_come_first(smoke_run):
    """A reader can look at them while the long runs go on."""
    started = re.findall(r"^(?:local)?rule (\w+):", smoke_run[1], flags=re.MULTILINE)
    last = max(started.index(figure) for figure in PAPER)
    long = {"attractors_runs", "cycles_runs", "exponents_runs", "work_precision_runs"}
    before = [rule for rule in started[:last] if rule in long]
    assert len(before) < sum(rule in long for rule in started) / 5


def test_every_figure_is_there_three_times(smoke):
    """For print, as picture and for the page, none empty, and for the page none that is slow."""
    begins = {"pdf": b"%PDF", "png": b"\x89PNG", "svg": b"<?xml"}
    drawn = {path for path in smoke.folder.glob("results/figures/*") if path.suffix != ".rst"}
    names = {path.stem for path in drawn}
    assert len(drawn) == 3 * len(names)
    assert set(PAPER) | {"atlas", "cycles", "routes", "work_precision"} <= names
    for path in drawn:
        content = path.read_bytes()
        assert content.startswith(begins[path.suffix[1:]])
        assert 5000 < len(content) < 1_500_000


def test_every_job_has_a_log_and_every_computation_a_benchmark(smoke):
    """Beside the results, by the same path."""
    results = smoke.folder / "results"
    computed = {path.relative_to(results) for path in results.rglob("*.nc")}
    computed |= {path.relative_to(results) for path in (results / "references").rglob("*.tsv")}
    assert len(computed) > 100
    for path in computed:
        assert (results / "logs" / path).with_suffix(".log").is_file()
        assert (results / "benchmarks" / path).with_suffix(".tsv").is_file()
    for path in results.glob("figures/*.png"):
        assert (results / "logs" / "figures" / f"{path.stem}.log").is_file()


def test_namelists_hold_the_config(smoke, smoke_config):
    """Each value under its key."""
    folder = smoke.folder / "results" / "namelists"

    def values_in(path: str) -> dict:
        return dict(flat(f90nml.read(folder / f"{path}.nml")["settings"]))

    def flat(values: dict) -> Iterator[tuple]:
        for key, value in values.items():
            if key == "cases":
                rows = [dict(flat(case)) for case in value]
                yield from ((name, [row[name] for row in rows]) for name in rows[0])
            else:
                yield from flat(value) if isinstance(value, dict) else [(key, value)]

    scene = smoke_config["scenes"]["torus"]
    parameters = {key: scene[key] for key in ("tau", "epsilon", "xi", "gamma")}
    for path, expected in (
        ("trajectories/torus", parameters | {"t_end": 600.0, "sample_interval": 0.1}),
        ("linear_stability/torus", parameters | smoke_config["linear_stability"]),
        ("spectra/torus", smoke_config["spectra"]),
    ):
        values = values_in(path)
        assert {key: values[key] for key in expected} == expected
    assert values_in("spectra/torus")["trajectory"] == "results/trajectories/torus.nc"
    plane = smoke_config["hopf_curves"]["xi_of_epsilon"]
    assert values_in("hopf/xi_of_epsilon") == plane
    assert values_in("friction/velocity_step") == smoke_config["velocity_step"]
    assert values_in("exponents/torus")["count"] == 6
    cycles = values_in("cycles/torus_in_tau")
    assert (cycles["along"], cycles["intervals"], cycles["starts"]) == ("tau", 20, 10.0)
    for name, family in smoke_config["stability"]["families"].items():
        kinds = ["measurements"] + ["references"] * (family["reference"] == "quadruple")
        for kind in kinds:
            cases = values_in(f"{kind}/stability/{name}")
            assert np.unique(cases["gamma"]).tolist() == family["gamma"]
            assert set(cases["t_end"]) == {family["t_end"]}
    study = measured_study(smoke_config)
    for name, case in study["cases"].items():
        measured = values_in(f"measurements/work_precision/{name}")
        assert measured["t_end"][0] <= case["t_end"]
        assert measured["tolerances"] == study["tolerances"]
        trusted = values_in(f"references/trust/{name}")
        assert trusted["t_end"] == [case["t_end"]]


def test_nothing_unfinished_is_left(smoke):
    """Files are complete or absent."""
    assert list((smoke.folder / "results").rglob("*.part")) == []


def test_folders_of_results_stand_in_their_readme(smoke):
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


TRAJECTORY = {"build", "trajectory_namelist", "trajectory"}
SPECTRUM = {*TRAJECTORY, "spectrum_namelist", "spectrum"}
SCENES = {"build", "scene_attractors_namelist", "scene_attractors", "attractors_table"}
ROUTES = {"build", "attractors_runs_namelist", "attractors_runs", "route_table"}
HOPF = {"build", "hopf_curves_namelist", "hopf_curves"}


@pytest.mark.parametrize(
    ("target", "rules", "data"),
    [
        ("figure_1", set(), set()),
        ("figure_2", HOPF, {"bin/hopf", "hopf/tau_of_epsilon.nc"}),
        (
            "figure_5",
            TRAJECTORY | SCENES,
            {"bin/trajectory", "trajectories/torus.nc", "trajectories/chaos.nc", "bin/attractors"}
            | {f"scenes/{name}.nc" for name in ("fixed_point", "oscillation", "torus", "chaos")}
            | {"scenes/true_torus.nc"},
        ),
        (
            "figure_7",
            SPECTRUM,
            {"bin/trajectory", "trajectories/chaos.nc", "bin/spectrum", "spectra/chaos.nc"},
        ),
        (
            "figure_8",
            {"build", "velocity_step_namelist", "velocity_step"},
            {"bin/velocity_step", "friction/velocity_step.nc"},
        ),
        ("fault_limit", {"fault_limit_table"}, set()),
        (
            "events",
            {"build", "trajectory_namelist", "slip_events"},
            {"bin/slip_events"}
            | {f"slip_events/{name}.nc" for name in ("oscillation", "chaos", "stick_slip")},
        ),
        ("routes", ROUTES, None),
        (
            "work_precision",
            {
                *("build", "reference_namelist", "reference", "measurement_namelist"),
                *("measurement", "trusted_horizons", "work_precision_runs_namelist"),
                *("work_precision_runs", "work_precision_table"),
            },
            None,
        ),
        (
            "results/references/stability/strong.tsv",
            {"build", "reference_namelist", "reference"},
            {"bin/reference"},
        ),
        ("build/release/bin/spectrum", {"build"}, {"bin/spectrum"}),
    ],
)
def test_target_needs_only_its_own_rules(planned, target, rules, data):
    """From nothing: its data, their programs, and no other."""
    needed = needed_for(target, planned)
    assert rules_of(needed) - {target} == rules
    assert data is None or data_of_jobs(needed) == data


def test_figures_and_files_can_be_made_alone(fresh, planned):
    """The jobs are those that the whole has for them; an unknown target is refused by name."""
    targets = ("figure_5", "results/references/stability/strong.tsv")
    run = fresh.snakemake("--dry-run", *targets)
    assert run.returncode == 0, run.stdout
    assert set(jobs_in(run.stdout)) == set.union(*(needed_for(one, planned) for one in targets))
    run = fresh.snakemake("--dry-run", "figure_9")
    assert run.returncode != 0
    assert "figure_9" in run.stdout
