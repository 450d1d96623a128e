"""A Snakemake of the user's own: it works, or one line says what is missing and how to get it."""

import os
import shutil
import subprocess
import sys
from importlib.metadata import packages_distributions
from pathlib import Path

import pytest
import snakemake
from conftest import ROOT, Project, rules_in
from test_workflow_changes import names_imported

from scripts.workflow.packages import PACKAGES

INSTALLED = Path(snakemake.__file__).parent.parent
BUILD_NEEDS = ROOT / "setup" / "build_needs.sh"


def python_without(folder: Path, *lacking: str) -> Path:
    """A Python of the user's own with all our packages but some.

    Its Snakemake is not mended, and has no plugins that a profile may have brought.
    """
    subprocess.run([sys.executable, "-m", "venv", "--without-pip", folder], check=True)
    (site,) = folder.glob("lib/python3.*/site-packages")
    for entry in INSTALLED.iterdir():
        if not entry.name.lower().startswith((*lacking, "snakemake")):
            (site / entry.name).symlink_to(entry)
    for entry in INSTALLED.glob("snakemake*"):
        if "executor_plugin_" not in entry.name:
            shutil.copytree(entry, site / entry.name)
    reader = site / "snakemake" / "common" / "configfile.py"
    before, name, rest = reader.read_text().partition("def load_configfile(")
    _, mended, body = rest.partition("def replaced_load_configfile(")
    assert mended
    reader.write_text(before + name + body)
    return folder / "bin" / "python"


def run_with(python: Path, project: Project, *targets: str) -> subprocess.CompletedProcess[str]:
    """Run the workflow by the Snakemake of this Python; all it says is in stdout."""
    return subprocess.run(
        [python, "-m", "snakemake", "--cores", "2", *targets],
        cwd=project.folder,
        env={**os.environ, "PATH": "/usr/bin:/bin"},
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        timeout=120,
    )


def test_packages_are_those_that_scripts_import():
    """And the one by which xarray reads NetCDF; the plugin interface comes with Snakemake."""
    scripts = [path.relative_to(ROOT) for path in (ROOT / "scripts").rglob("*.py")]
    named = {name.partition(".")[0] for script in scripts for name in names_imported(script)}
    outside = named - sys.stdlib_module_names - {"scripts", "snakemake_interface_logger_plugins"}
    found = packages_distributions()
    assert {found[name][0].lower() for name in outside} | {"netcdf4"} == {
        name.lower() for name in PACKAGES
    }


def test_packages_that_are_missing_are_named(project, tmp_path):
    """In one line, with both ways to get them; nothing is made."""
    python = python_without(tmp_path / "own", "numpy", "netcdf4", "f90nml", "ruamel")
    run = run_with(python, project)
    assert run.returncode != 0
    profile, said = run.stdout.splitlines()
    assert profile.startswith("Using workflow specific profile")
    assert said == (
        f"error: {python} lacks ruamel.yaml, f90nml, numpy, netCDF4; run ./reproduce, which sets up"
        " what is missing; if it did so before, run . .venv/bin/activate"
    )
    assert [path.name for path in (project.folder / "results").iterdir()] == ["README.md"]


def test_it_works_where_the_packages_are(project, tmp_path):
    """Also its scripts, beside a package of the same name."""
    python = python_without(tmp_path / "own")
    (site,) = (tmp_path / "own").glob("lib/python3.*/site-packages")
    (site / "scripts").mkdir()
    (site / "scripts" / "__init__.py").touch()
    targets = ["figure_1", "results/namelists/velocity_step.nml"]
    run = run_with(python, project, *targets)
    assert run.returncode == 0, run.stdout
    assert rules_in(run.stdout) == {"figure_1", "velocity_step_namelist"}


def test_missing_compiler_and_libraries_are_named(project, tmp_path, monkeypatch):
    """In one line, in place of CMake's many."""
    tools = tmp_path / "tools"
    tools.mkdir()
    for tool in Path("/usr/bin").iterdir():
        if "gfortran" not in tool.name:
            (tools / tool.name).symlink_to(tool)
    monkeypatch.setenv("PATH", str(tools))
    monkeypatch.setenv("PKG_CONFIG_LIBDIR", "/nowhere")
    run = project.snakemake("build/release/bin/velocity_step")
    assert run.returncode != 0
    assert (
        "error: no program can be built without gfortran gsl fftw3 lapack netcdf-fortran; run"
        " ./reproduce, which sets up what is missing"
    ) in run.stdout.splitlines()
    assert "CMake Error" not in run.stdout


@pytest.mark.parametrize(
    ("lacking", "named"),
    [
        (("cmake", "make"), "cmake make"),
        (("pkg-config", "pkgconf"), "pkg-config"),
        (("cc", "gcc", "clang"), "gcc"),
    ],
)
def test_other_missing_tools_are_named(tmp_path, lacking, named):
    """Each where no stand-in for it is there either."""
    for tool in Path("/usr/bin").iterdir():
        if tool.name not in lacking:
            (tmp_path / tool.name).symlink_to(tool)
    environment = {"PATH": str(tmp_path)}
    run = subprocess.run([BUILD_NEEDS], env=environment, capture_output=True, text=True)
    assert run.returncode == 1
    assert run.stderr == (
        f"error: no program can be built without {named}; run ./reproduce, which sets up what is"
        " missing\n"
    )


def test_nothing_is_missing_here():
    """Where all is set up."""
    run = subprocess.run([BUILD_NEEDS], capture_output=True, text=True)
    assert (run.returncode, run.stdout, run.stderr) == (0, "", "")


def test_missing_library_of_the_page_is_named(project):
    """One line, before anything is computed; figures do not need it."""
    assets = project.folder / "scripts" / "page" / "page_assets.py"
    assets.write_text(assets.read_text().replace("/usr/share/javascript", "/nowhere"))
    run = project.snakemake("--dry-run")
    assert run.returncode != 0
    assert run.stdout.splitlines()[-1] == (
        "error: the page needs /nowhere/dygraphs/dygraph.min.js, /nowhere/dygraphs/dygraph.min.css"
        " (Debian's libjs-dygraphs); run ./reproduce, which sets up what is missing"
    )
    assert project.snakemake("--dry-run", "figure_1").returncode == 0


def test_project_whose_path_snakemake_would_change_is_refused_elsewhere(project, tmp_path):
    """Braces would be wildcards; in the project itself they do no harm."""
    odd = project.folder.rename(tmp_path / "a{x}b")
    other = tmp_path / "other"
    other.mkdir()
    given = ("--dry-run", "--snakefile", str(odd / "Snakefile"), "figure_8")
    run = Project(other).snakemake(*given)
    assert run.returncode == 1
    assert f"the project is in '{odd}'; run it there, or move it" in run.stdout
    run = Project(odd).snakemake(*given)
    assert run.returncode == 0, run.stdout
