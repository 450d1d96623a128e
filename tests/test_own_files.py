"""Users' files: all that they add is made in a folder of their own, the paper's stays."""

import csv
import os
import re
import subprocess
from pathlib import Path

import pytest
import xarray as xr
from conftest import ROOT, Project
from dry_runs import jobs_in, needed_for

from scripts.config.check_config import checked
from scripts.config.read_config import ConfigError, merged, read
from scripts.workflow import own_file

SMALL = """
scenes:
  my_scene: { t_end: 300.0, t_transient: 100.0, sample_interval: 0.1, exponents: {} }
hopf_curves:
  my_plane: { cells: 20 }
routes:
  observation: &quick
    t_transient: 100.0
    t_observed: 100.0
    t_lasting: 50.0
    t_turning: 20.0
    doublings: 0
    kept: 20
  lines:
    my_route: { count: 2 }
    my_start:
      { along: v, window: [0.5, 1.5], count: 2, tau: 3.0, epsilon: 0.1, xi: 0.5, gamma: 0.8 }
cycles:
  t_transient: 500.0
  intervals: 20
  most_orbits: 5
  lines:
    my_cycles: { along: tau, window: [1.0, 2.5], epsilon: 0.7, xi: 0.5, gamma: 0.8 }
atlas:
  epsilon_count: 3
  tau_count: 3
  parts: 1
  refinements: 0
  observation: *quick
  planes:
    my_atlas: { xi: 0.7, gamma: 0.8, tau_window: [0.0, 10.0] }
dimensions:
  my_fault: { length: 0.1, v0: 1.0e-9, k: 1.0e+7, a: 1.0e+6, m: 1.0e+6 }
exponents: { t_turning: 50.0, blocks: 3 }
spectra: { segments: 3 }
attractors:
  observation: *quick
"""
"""The file that `./reproduce new` writes, small, and with what it does not have."""
FIGURES = [
    *("scenes/my_scene", "exponents/my_scene", "planes/my_plane", "routes/my_route"),
    *("routes/my_start", "cycles/my_cycles", "atlas/my_atlas"),
]
OWN = ("--configfile", "mine.yaml", "small.yaml")


def state_of(results: Path) -> dict[str, tuple[int, int]]:
    """When each file was written, and its size."""
    files = [path for path in results.rglob("*") if path.is_file()]
    return {str(path): (path.stat().st_mtime_ns, path.stat().st_size) for path in files}


def new_file(path: Path) -> subprocess.CompletedProcess[str]:
    """What `./reproduce new` says."""
    command = [ROOT / "reproduce", "new", path]
    return subprocess.run(command, capture_output=True, text=True)


@pytest.fixture(scope="module")
def made(smoke, tmp_path_factory) -> tuple[Project, dict, dict]:
    """A copy of the smoke run after a run with the new file; the paper's files before and after."""
    project = smoke.copy_to(tmp_path_factory.mktemp("own") / "a project")
    assert new_file(project.folder / "mine.yaml").returncode == 0
    (project.folder / "small.yaml").write_text(SMALL)
    results = project.folder / "results"
    before = state_of(results)
    run = project.snakemake(*OWN)
    assert run.returncode == 0, run.stdout
    after = {path: state for path, state in state_of(results).items() if "/mine-small/" not in path}
    return project, before, after


def test_papers_results_are_not_touched(made):
    """Nothing in results/ is written, removed or added outside of the file's own folder."""
    _, before, after = made
    assert after == before


def test_everything_that_the_file_adds_is_made(made):
    """Figures, tables with rows of these names alone, and the verdict on its claim."""
    results = made[0].folder / "results" / "mine-small"
    figures = {path.relative_to(results / "figures") for path in results.glob("figures/*/*")}
    endings = ("pdf", "png", "svg", "rst")
    assert figures == {Path(f"{name}.{end}") for name in FIGURES for end in endings}
    tables = {
        "attractors": ("scene", "my_scene"),
        "linear-stability": ("scene", "my_scene"),
        "exponents": ("scene", "my_scene"),
        "routes/my_route": ("route", "my_route"),
        "routes/my_start": ("route", "my_start"),
        "dimensions": ("preset", "my_fault"),
        "claims": ("id", "my_claim"),
    }
    for table, (column, name) in tables.items():
        with open(results / "tables" / f"{table}.tsv", newline="") as file:
            rows = list(csv.DictReader(file, delimiter="\t"))
        assert {row[column] for row in rows} == {name}
    assert rows[0]["verdict"] in ("reproduced", "not reproduced")
    assert rows[0]["look_at"] == "results/mine-small/figures/scenes/my_scene.png"
    exponents = xr.load_dataset(results / "exponents" / "my_scene.nc")
    assert exponents.sizes["exponent"] == 3
    assert exponents.attrs["t_end"] == 300.0


def test_page_of_ones_own_shows_all_of_it(made):
    """Every figure, the trajectories, the claim, and no link to a file that is not there."""
    page = made[0].folder / "results" / "mine-small" / "index.html"

    links = re.findall(r'(?:href|src)="([^"#][^"]*)"', page.read_text())
    files = {link for link in links if not link.startswith("data:")}
    assert {f"figures/{name}.svg" for name in FIGURES} <= files
    assert [link for link in files if not (page.parent / link).is_file()] == []
    for part in ('id="trajectory-view"', 'id="claim-my_claim"', 'id="play-view"'):
        assert part in page.read_text()


def test_captions_of_ones_own_have_numbers(made):
    """Of what was computed; along a value of the history there are no sweeps."""
    figures = made[0].folder / "results" / "mine-small" / "figures"
    texts = {name: (figures / f"{name}.rst").read_text() for name in FIGURES}
    assert [name for name, text in texts.items() if re.search(r"[{}]{2}|\bnan\b", text)] == []
    place = r":math:`\tau = 3`, :math:`\varepsilon = 0.1`, :math:`\xi = 0.5`, :math:`\gamma = 0.8`"
    assert texts["routes/my_start"].startswith(
        f"Route along :math:`v` at {place}: 4 points.\nIn runs near and slip each class"
    )


def test_files_that_both_need_are_made_once(made):
    """Hopf curves of the paper in an own plane of the atlas are the paper's file."""
    project, *_ = made
    (project.folder / "plane.yaml").write_text(
        "atlas: { planes: { near: { xi: 0.5, gamma: 0.8, tau_window: [1.0, 2.0] } } }\n"
        "scenes: { torus: { tau: 11.0 } }"
    )
    run = project.snakemake("--dry-run", "--forceall", "--configfile", "plane.yaml")
    assert run.returncode == 0, run.stdout
    made_files = {path for job in jobs_in(run.stdout) for path in job.made}
    assert "results/hopf/tau_of_epsilon.nc" in made_files
    assert "results/plane/hopf/tau_of_epsilon.nc" not in made_files
    assert "results/plane/trajectories/torus.nc" in made_files
    assert "results/trajectories/torus.nc" not in made_files


def test_one_figure_of_the_paper_with_a_changed_scene(made):
    """The changed scene is in the own folder, the other one is the paper's."""
    project, *_ = made
    (project.folder / "moved.yaml").write_text("scenes: { torus: { tau: 11.0 } }")
    run = project.snakemake("--dry-run", "--forceall", "figure_6", "--configfile", "moved.yaml")
    assert run.returncode == 0, run.stdout
    (figure,) = (job for job in jobs_in(run.stdout) if job.rule == "figure_6")
    assert figure in needed_for("results/moved/figures/figure_6.svg", jobs_in(run.stdout))
    assert {"results/moved/spectra/torus.nc", "results/spectra/oscillation.nc"} <= figure.given


@pytest.mark.parametrize(
    ("text", "target", "words"),
    [
        ("spectra: { segments: 4 }", "all", "the file adds no scene, plane, route"),
        ("scenes: { mine: { tau: 1 } }", "all", "scene 'mine': key"),
        (
            "scenes: { mine: { tau: 1, epsilon: 0.5, xi: 1, gamma: 1, t_end: 10 } }",
            "results/trajectories/mine.nc",
            "error: config/config.yaml has no 'mine'; .* in results/bad/",
        ),
    ],
)
def test_what_cannot_be_made_is_refused_in_words(made, text, target, words):
    """And the paper's results stay."""
    project, *_ = made
    (project.folder / "bad.yaml").write_text(text)
    run = project.snakemake(target, "--dry-run", "--configfile", "bad.yaml")
    assert run.returncode != 0
    assert re.search(words, run.stdout), run.stdout
    assert "Traceback" not in run.stdout


def test_new_file_overwrites_none(tmp_path):
    """It is named after itself and accepted by the schema; a second one is refused."""
    path = tmp_path / "faults.yaml"
    assert new_file(path).returncode == 0
    text = path.read_text()
    assert "results/faults/" in text
    assert "mine" not in text
    config = checked(merged([ROOT / "config" / "config.yaml", path], []), ["my_scene"])
    assert config["scenes"]["my_scene"]["variables"] == ["theta", "u", "v"]
    path.write_text("mine")
    again = new_file(path)
    assert again.returncode != 0
    assert "there already" in again.stderr
    assert path.read_text() == "mine"
    assert new_file(tmp_path / "a folder").returncode != 0


@pytest.mark.parametrize("name", ["my file", "faults.v2", "a&b"])
def test_new_file_promises_only_the_folder_that_it_gets(tmp_path, name):
    """A folder has none of these characters."""
    run = new_file(tmp_path / f"{name}.yaml")
    assert run.returncode == 1
    assert f"the name '{name}'; expected letters, digits, _ and - alone" in run.stderr
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("files", "entries", "folder"),
    [
        ([], [], "results"),
        (["/some/where/mine.yaml"], [], "results/mine"),
        (["a b.v2.yaml"], [], "results/a_b_v2"),
        (["a.yaml", "b.yaml"], ["x=1"], "results/a-b"),
        ([], ["x=1"], "results/config"),
    ],
)
def test_folder_is_named_after_the_file(files, entries, folder):
    """Of several files after all of them."""
    assert own_file.folder_of(files, entries) == folder


def test_no_folder_of_the_paper_is_taken():
    """Each of those in the list of results/README.md; the page's folder, too."""
    named = set(re.findall(r"`results/(\w+)/", (ROOT / "results" / "README.md").read_text()))
    assert own_file.TAKEN == (named - {"mine"}) | {"page"}
    for name in own_file.TAKEN:
        with pytest.raises(ConfigError, match="another name"):
            own_file.folder_of([f"{name}.yaml"], [])


@pytest.mark.parametrize("name", ["a" * 20, "mine" + "-1" * 20, "ab" * 51])
def test_name_that_makes_no_folder_is_refused(name):
    """Snakemake takes the first two for an endless recursion; the last one is too long."""
    with pytest.raises(ConfigError, match=f"results/{name}/; expected at most 100 letters"):
        own_file.folder_of([f"{name}.yaml"], [])


@pytest.mark.parametrize("folders", ["{ results: 'results/$(touch X)' }", "{ results: . }", "5"])
def test_file_that_names_another_folder_does_no_harm(made, folders):
    """It is refused before anything is made or removed."""
    project, *_ = made
    (project.folder / "shared.yaml").write_text(f"pathvars: {folders}")
    before = state_of(project.folder)
    run = project.snakemake("figure_8", "--forceall", "--configfile", "shared.yaml")
    assert run.returncode != 0
    assert "athvars" in run.stdout
    assert "Traceback" not in run.stdout
    new = state_of(project.folder).items() - before.items()
    records = [project.folder / name for name in (".snakemake", "scripts")]
    assert [path for path, _ in new if not any(map(Path(path).is_relative_to, records))] == []
    assert before.keys() <= state_of(project.folder).keys()


def test_list_of_what_a_file_adds():
    """Names alone; all of a section whose shared settings change; none where it is no section."""
    config = read(ROOT / "config" / "config.yaml")
    overlay = read(ROOT / "config" / "new.yaml") | {"atlas": {"tau_count": 9}, "cycles": 3}
    assert own_file.added(overlay, config) == {
        **{"scenes": ["my_scene"], "planes": ["my_plane"], "routes": ["my_route"]},
        **{"atlas": list(config["atlas"]["planes"]), "cycles": [], "basins": [], "families": []},
        "dimensions": [],
    }


MODULE = """
configfile: "config.yaml"


module delayed_block:
    snakefile: "{snakefile}"
    config: config["block"]
    pathvars:
        results="block",


use rule * from delayed_block as block_*


rule mine:
    default_target: True
    input: "block/trajectories/small.nc"
    output: "mine.txt"
    shell: "basename {{input}} > {{output}}"
"""


@pytest.mark.parametrize("folder", ["block$(touch X)", "a b", "{{block}}"])
def test_folder_of_a_module_is_a_path_alone(smoke, tmp_path, folder):
    """Its author's; no character of it may mean something to a shell or to Snakemake."""
    other = Project(tmp_path / "other")
    other.folder.mkdir()
    text = MODULE.format(snakefile=smoke.folder / "Snakefile")
    changed = text.replace('results="block"', f'results="{folder.format()}"')
    (other.folder / "Snakefile").write_text(changed)
    (other.folder / "config.yaml").write_text("block: {}")
    run = other.snakemake("--dry-run")
    assert run.returncode != 0
    assert f"results = {folder.format()!r}; expected a path of letters, digits" in run.stdout


def test_the_workflow_is_a_module_of_another(smoke, tmp_path):
    """Its rules work in the other's folder, with the programs in its own."""
    other = Project(tmp_path / "other")
    other.folder.mkdir()
    snakefile = smoke.folder / "Snakefile"
    (other.folder / "Snakefile").write_text(MODULE.format(snakefile=snakefile))
    (other.folder / "config.yaml").write_text(
        "block: { scenes: { small: { tau: 1, epsilon: 0.5, xi: 0.8, gamma: 0.8, t_end: 20 } } }"
    )
    before = state_of(smoke.folder / "results")
    everything = other.snakemake("--dry-run", "block_all")
    assert everything.returncode == 0, everything.stdout
    planned = {path for job in jobs_in(everything.stdout) for path in job.made}
    assert {"block/index.html", "block/figures/scenes/small.svg"} <= planned
    run = other.snakemake("--rerun-triggers", "mtime")
    assert run.returncode == 0, run.stdout
    assert (other.folder / "mine.txt").read_text() == "small.nc\n"
    assert sorted(os.listdir(other.folder)) == [
        *(".snakemake", "Snakefile", "block", "config.yaml", "mine.txt")
    ]
    assert state_of(smoke.folder / "results") == before


def test_paper_is_a_module_without_a_configuration(smoke, tmp_path):
    """All rules are used first; then one of them can be changed."""
    other = Project(tmp_path / "other")
    other.folder.mkdir()
    text = MODULE.format(snakefile=smoke.folder / "Snakefile").replace(
        'configfile: "config.yaml"', ""
    )
    changed = "\n\nuse rule figure_2 from delayed_block as block_figure_2 with:\n    priority: 9\n"
    text = text.replace('    config: config["block"]\n', "").replace(
        "\n\nrule mine", changed + "\n\nrule mine"
    )
    (other.folder / "Snakefile").write_text(text)
    run = other.snakemake("--dry-run", "block_figure_2", "block_page")
    assert run.returncode == 0, run.stdout
    planned = {path for job in jobs_in(run.stdout) for path in job.made}
    assert {"block/index.html", "block/hopf/tau_of_epsilon.nc"} <= planned
