"""Scenes of a user's own in the workflow, and what goes wrong there."""

import f90nml
import numpy as np
import pytest
import xarray as xr

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


def test_scene_of_ones_own(scratch):
    """It merges over the default config; v is right to 100 x tolerance against a tighter run.

    What is in results/ is the paper's.
    """
    (scratch.folder / "mine.yaml").write_text(MY_SCENE)
    targets = [f"results/mine/trajectories/{name}.nc" for name in ("mine", "mine_tight")]
    targets += ["results/trajectories/torus.nc"]
    run = scratch.snakemake(*targets, "--configfile", "mine.yaml")
    assert run.returncode == 0, run.stdout
    loose, tight, torus = (xr.load_dataset(scratch.folder / path) for path in targets)
    assert list(loose.data_vars) == ["theta", "u", "v"]
    assert loose.attrs["history_theta"] == 0.0
    assert loose.attrs["history_v"] == 1.2
    for time in (0.5, 3.0, 17.5, 60.0):
        right = float(tight.v.sel(t=time))
        assert float(loose.v.sel(t=time)) == pytest.approx(right, abs=100e-7)
    assert not np.array_equal(loose.v, tight.v)
    assert torus.attrs["t_end"] == 8000.0


def test_one_key_of_a_scene_can_be_changed(smoke, scratch, tmp_path):
    """The others keep their values; numbers are read by YAML 1.2, in files and in `--config`."""
    (tmp_path / "first.yaml").write_text("scenes: { torus: { tau: 7, tolerance: 1e-10 } }")
    (tmp_path / "last.yaml").write_text("scenes: { torus: { tau: 010, history: { v: 1.5 } } }")
    namelist = "results/first-last/namelists/trajectories/torus.nml"
    overlays = ("--configfile", str(tmp_path / "first.yaml"), str(tmp_path / "last.yaml"))
    given = ("--config", "scenes={ torus: { xi: 8e-1, t_end: 09000.5 } }")
    run = scratch.snakemake(namelist, *overlays, *given)
    assert run.returncode == 0, run.stdout
    scene = f90nml.read(scratch.folder / namelist)["settings"]["scene"].todict()
    scene |= scene["parameters"]
    changed = {"tau": 10, "tolerance": 1e-10, "xi": 0.8, "t_end": 9000.5}
    assert {key: scene[key] for key in changed} == changed
    assert scene["history"] == {"theta": 0.0, "u": 0.0, "v": 1.5}
    paper = smoke.folder / "results" / "namelists" / "trajectories" / "torus.nml"
    before = f90nml.read(paper)["settings"]["scene"].todict()
    assert scene["epsilon"] == before["parameters"]["epsilon"]


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("scenes: { torus: { tau: -1.0 } }", "scene 'torus': tau = -1.0; expected "),
        ("scenes:\n  torus:\n    tau: 1\n    tau: 2", "mine.yaml, line 4: found duplicate key"),
        (None, "mine.yaml: cannot be read: No such file or directory"),
    ],
)
def test_bad_file_of_ones_own_is_refused_in_words(smoke, tmp_path, text, words):
    """No traceback, a status other than 0, and nothing made."""
    if text is not None:
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
    run = scratch.snakemake("results/mine/trajectories/mine.nc", "--configfile", "mine.yaml")
    assert run.returncode != 0
    results = scratch.folder / "results" / "mine"
    assert list((results / "trajectories").glob("mine*")) == []
    said = (results / "logs" / "trajectories" / "mine.log").read_text()
    assert said.startswith("error: ")
    assert said.strip() in run.stdout


def test_program_that_dies_leaves_no_output(scratch):
    """Even if it wrote half of it."""
    program = scratch.folder / "build" / "release" / "bin" / "trajectory"
    program.write_text('#!/bin/sh\necho half >"$2"\necho "it died" >&2\nexit 3\n')
    (scratch.folder / "mine.yaml").write_text(MY_SCENE)
    run = scratch.snakemake("results/mine/trajectories/mine.nc", "--configfile", "mine.yaml")
    assert run.returncode != 0
    assert "it died" in run.stdout
    assert not (scratch.folder / "results" / "mine" / "trajectories" / "mine.nc").exists()


def test_build_that_fails_is_told(project):
    """The compiler's words are on the screen and in the log, and there is no program."""
    with open(project.folder / "fortran" / "dde" / "src" / "api" / "dde_kinds.f90", "a") as source:
        source.write("this is no Fortran\n")
    run = project.snakemake("build/release/bin/velocity_step")
    assert run.returncode != 0
    assert "this is no Fortran" in run.stdout
    log = project.folder / "results" / "logs" / "build" / "velocity_step.log"
    assert "this is no Fortran" in log.read_text()
    assert not (project.folder / "build" / "release" / "bin" / "velocity_step").exists()
