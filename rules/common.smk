# What rules ask of the configuration, of paths and of the code.
import functools
import hashlib
import os
import re

from scripts.namelists import program_groups, study_cases
from scripts.page import page_assets
from scripts.workflow import git_commit, result_files, script_imports

LINES = "|".join(config["routes"]["lines"])
FAMILIES = list(config["stability"]["families"])
MEASURED = study_cases.measured_study(config)
WORK_SCENES = list(MEASURED["cases"])
LONG_RULES = {
    "attractors_runs",
    "cycles_runs",
    "exponents_runs",
    "reference",
    "work_precision_runs",
}
# Priorities: the paper's figures can be looked at while long runs go on. Long runs start before short
# ones, the longest first, so that no core is idle at the end. Snakemake adds the priorities of jobs
# that fit at the same time: a build, which takes two cores, must have more than two jobs of the paper.
OF_PROGRAMS = 10
OF_PAPER = 3
OF_LONGEST = 2
OF_LONG = 1


wildcard_constraints:
    results="|".join(map(re.escape, CONFIGS)),
    scene="|".join(config["scenes"]),
    plane="|".join(config["hopf_curves"]),
    family="|".join([*FAMILIES, *WORK_SCENES]),
    work_scene="|".join(WORK_SCENES),
    study="stability|trust",
    survey=f"scenes|basins|routes/({LINES})|atlas/({'|'.join(config['atlas']['planes'])})",
    line=LINES,
    cycle_line="|".join(config["cycles"]["lines"]),
    atlas_plane="|".join(config["atlas"]["planes"]),
    part=r"\w+",


def priority_of_survey(wildcards):
    """The paper's figures 4 and 5 show the classes of the scenes."""
    return OF_PAPER if wildcards.survey == "scenes" else OF_LONG


def of_project(path):
    """A file of the project, as a path from the folder in which Snakemake works."""
    return path if Path.cwd() == PROJECT else str(PROJECT / path)


def digest_of_files(paths):
    """A digest of contents: a parameter by which results of older contents are stale.

    Snakemake judges inputs by their times, which an upgrade may keep. Files that are missing count
    as empty: who needs them refuses that.
    """
    contents = [
        path.read_bytes() if path.exists() else b"" for path in map(Path, paths)
    ]
    digests = [hashlib.sha256(content).digest() for content in contents]
    return hashlib.sha256(b"".join(digests)).hexdigest()


def code_of(script, *others):
    """A digest of a script, of the modules that it imports and of other files of the project."""
    files = [PROJECT / path for path in others]
    return digest_of_files([*script_imports.modules_of(script), *files])


def placed(given):
    """Paths, alone or in lists and dictionaries, with a folder in place of `<results>`.

    It is that of the paper's results if both configurations compute the file from the same values.
    """
    if isinstance(given, dict):
        return {key: placed(value) for key, value in given.items()}
    if isinstance(given, list):
        return [placed(value) for value in given]
    if isinstance(given, str) and given.startswith("<results>/"):
        return placed_file(given.removeprefix("<results>/"))
    if isinstance(given, str) and given.startswith("benchmarks/"):
        return of_project(given)
    return given


@functools.cache
def placed_file(path):
    """One file, by its path in the folder of results."""
    for folder, other in CONFIGS.items():
        if program_groups.are_the_same(path, other, config):
            return f"{folder}/{path}"
    return f"{RESULTS}/{path}"


def of_config(values, *names):
    """Values by the configuration of the folder {results}, for the wildcards of these names."""

    def given(wildcards):
        named = [getattr(wildcards, name) for name in names]
        try:
            return values(CONFIGS[wildcards.results], *named)
        except KeyError as unknown:
            raise SystemExit(
                f"error: config/config.yaml has no {unknown}; the results of your own file are in"
                f" {RESULTS}/"
            ) from None

    return given


def files_in(*folders, endings):
    """Files with these endings in folders of the Fortran code, in order."""
    fortran = Path(of_project("fortran"))
    files = [path for folder in folders for path in fortran.joinpath(folder).rglob("*")]
    return sorted(str(path) for path in files if path.suffix in endings)


def sources_of(wildcards):
    """Sources that a program is built from."""
    return sources_of_program(wildcards.program)


@functools.cache
def sources_of_program(program):
    """Its own and all modules."""
    fortran = of_project("fortran")
    modules = files_in("src", "dde/src", "dde/lapack", endings={".f90", ".c", ".in"})
    return [
        f"{fortran}/CMakeLists.txt",
        f"{fortran}/CMakePresets.json",
        f"{fortran}/dde/CMakeLists.txt",
        f"{fortran}/app/{program}.f90",
        *modules,
    ]


@functools.cache
def digest_of(program):
    """A digest of a program's sources: what it computes is stale once they change, built or not."""
    return digest_of_files(sources_of_program(program))


def digest_of_sources(wildcards):
    """A digest of the sources of the program that a rule builds."""
    return digest_of(wildcards.program)


def documentation():
    """Modules and programs that the pages about the code explain, and how these are made."""
    made_with = ["ford.md", "offline_pages.py", "apt-packages.txt", "requirements.lock"]
    return [
        *files_in("dde/src", "src", "app", endings={".f90"}),
        *(PROJECT / "docs" / name for name in made_with),
    ]


def trajectory_of(wildcards):
    """The trajectory that a spectrum is computed from."""
    path = f"trajectories/{wildcards.scene}.nc"
    own = wildcards.results == RESULTS
    return placed_file(path) if own else f"{wildcards.results}/{path}"


def spectrum_groups(wildcards):
    """Namelist groups of a spectrum."""
    trajectories = str(Path(trajectory_of(wildcards)).parents[1])
    return program_groups.spectrum_groups(
        CONFIGS[wildcards.results], wildcards.scene, trajectories
    )


def runs_of_route(wildcards):
    """Files of all runs along a route."""
    return placed(result_files.runs_of_route(config, wildcards.line))


def tables_of_atlas():
    """Tables with the planes of the atlas that the run lists."""
    planes = expand("<results>/tables/atlas/{plane}.tsv", plane=NAMES["atlas"])
    return planes if OWN else ["<results>/tables/atlas.tsv"]


def tables_added():
    """Tables of what the user's file adds."""
    sections = {
        "<results>/tables/linear-stability.tsv": "scenes",
        "<results>/tables/attractors.tsv": "scenes",
        "<results>/tables/hopf-points.tsv": "planes",
        "<results>/tables/cycle-points.tsv": "cycles",
        "<results>/tables/basins.tsv": "basins",
        "<results>/tables/stability.tsv": "families",
        "<results>/tables/dimensions.tsv": "dimensions",
    }
    tables = [table for table, section in sections.items() if NAMES[section]]
    return tables + (["<results>/tables/claims.tsv"] if CLAIMS else [])


def everything_added(wildcards):
    """Figures, page and tables of all that the user's file adds."""
    if not (tables_added() or SHOWN):
        raise SystemExit(
            f"error: {RESULTS}: the file adds no scene, plane, route, atlas, cycles or claim; ask"
            " for a figure or a result by its name"
        )
    return [
        *expand(
            "<results>/figures/{figure}.{ending}",
            figure=SHOWN,
            ending=["pdf", "png", "svg"],
        ),
        *tables_added(),
        "<results>/index.html",
    ]


def tables_read(figures):
    """Tables of the project that figures read beside results."""
    files = [path for figure in figures for path in entries.files_of(figure, DRAWN)]
    return [path for path in files if not path.startswith("<results>/")]


def caption_file(figure):
    """The caption of a figure."""
    return placed(entries.caption_of(figure))


def to_caption():
    """What the caption of each figure is filled from."""
    return [
        {
            "name": entries.name_of_caption(name),
            "template": of_project(entries.template_of(name)),
            "inputs": placed(entries.inputs_of(name, DRAWN)),
            "params": placed(entries.params_of(name, DRAWN)),
        }
        for name in SHOWN
    ]


def on_page():
    """What the page shows of each figure beside its files."""
    return [
        {
            "name": name,
            "category": entries.entry_of(name).category,
            "caption": caption_file(name),
            "drawing": f"{RESULTS}/figures/{name}.svg",
            "shows_classes": entries.entry_of(name).shows_classes,
            "data": [
                placed(path)
                for path in entries.files_of(name, DRAWN)
                if path.startswith("<results>/")
            ],
        }
        for name in SHOWN
    ]


def trajectories_on_page():
    """Trajectory files that can be zoomed into: those that figures draw."""
    drawn = [path for name in SHOWN for path in entries.files_of(name, DRAWN)]
    kept = [path for path in drawn if path.startswith("<results>/trajectories/")]
    return placed(list(dict.fromkeys(kept)))


def library_of_page(wildcards):
    """Debian's files for the page; where one is missing, one line says so and ends the run."""
    try:
        return page_assets.library()
    except page_assets.AssetError as problem:
        raise SystemExit(f"error: {problem}") from None


def commit_at_work():
    """The project's commit, as the page names it."""
    return git_commit.commit_of(PROJECT)


def benchmarks_at_work():
    """Patterns of benchmark files, by rule, in the folder of this run."""
    patterns = snakemake_internals.benchmarks_of(rules)
    return {
        name: pattern.replace("{results}", RESULTS)
        for name, pattern in patterns.items()
    }
