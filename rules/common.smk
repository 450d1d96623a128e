# The configuration, checked, and what rules ask of it.
import functools
import hashlib
import os
import sys
from pathlib import Path

from snakemake.exceptions import WorkflowError

sys.path.insert(0, str(workflow.basedir))
from scripts.workflow import packages

try:
    packages.refuse_missing()
    packages.let_jobs_import(workflow.basedir)
    from scripts.workflow import snakemake_internals

    snakemake_internals.make_missing_files_again()
    snakemake_internals.start_jobs_at_once(workflow)
    config_sources = snakemake_internals.config_sources(workflow)
except packages.PackageError as problem:
    raise SystemExit(f"error: {problem}") from None

from scripts.claims import claims_config
from scripts.config import check_config, read_config
from scripts.figures import entries
from scripts.figures.entries import FIGURES
from scripts.namelists import attractor_surveys, study_cases
from scripts.page import page_assets
from scripts.workflow import before_run, git_commit, result_files, script_imports

try:
    before_run.refuse_unwritable(Path.cwd())
    before_run.free_folder(Path.cwd())
    config = check_config.checked(read_config.merged(*config_sources))
except (before_run.FolderError, read_config.ConfigError) as problems:
    raise WorkflowError(problems) from None


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
# ones, so that no core is idle at the end. Snakemake adds the priorities of jobs that fit at the same
# time: a build, which takes two cores, must have more than two jobs of the paper.
OF_PROGRAMS = 10
OF_PAPER = 2
OF_LONG = 1
LEDGER_TABLES = {
    "hopf_points": "results/tables/hopf-points.tsv",
    "linear_stability": "results/tables/linear-stability.tsv",
    "stability": "results/tables/stability.tsv",
    "attractors": "results/tables/attractors.tsv",
    "atlas": "results/tables/atlas.tsv",
    "routes": result_files.tables_of_routes(config),
    "cycle_points": "results/tables/cycle-points.tsv",
}


wildcard_constraints:
    scene="|".join(config["scenes"]),
    plane="|".join(config["hopf_curves"]),
    family="|".join([*FAMILIES, *WORK_SCENES]),
    work_scene="|".join(WORK_SCENES),
    study="stability|trust",
    survey=f"scenes|basins|routes/({LINES})|atlas/({'|'.join(config['atlas']['planes'])})",
    line=LINES,
    cycle_line="|".join(config["cycles"]["lines"]),
    part=r"\w+",


def code_of(script):
    """Modules that a script imports, as paths from the project's folder."""
    modules = script_imports.modules_of(script)
    return [os.path.relpath(path, workflow.basedir) for path in modules]


def sources_of(wildcards):
    """Sources that a program is built from."""
    return sources_of_program(wildcards.program)


@functools.cache
def sources_of_program(program):
    """Its own and all modules."""
    modules = glob_wildcards(
        "fortran/{folder,src|dde/src|dde/lapack}/{path}.{ending,f90|c|in}"
    )
    return [
        "fortran/CMakeLists.txt",
        "fortran/CMakePresets.json",
        "fortran/dde/CMakeLists.txt",
        f"fortran/app/{program}.f90",
        *sorted(expand("fortran/{folder}/{path}.{ending}", zip, **modules._asdict())),
    ]


def digest_of(program):
    """A digest of a program's sources: what it computes is stale once they change, built or not."""
    paths = [Path(path) for path in sources_of_program(program)]
    return hashlib.sha256(b"".join(map(Path.read_bytes, paths))).hexdigest()


def documented_sources():
    """Modules and programs that the pages about the code explain."""
    found = glob_wildcards("fortran/{folder,dde/src|src|app}/{path}.f90")
    return sorted(expand("fortran/{folder}/{path}.f90", zip, **found._asdict()))


def scene_values(wildcards):
    """The scene's namelist group."""
    scene = {
        key: value
        for key, value in config["scenes"][wildcards.scene].items()
        if key not in ("exponents", "attractors")
    }
    return {"name": wildcards.scene, **scene}


def exponents_groups(wildcards):
    """The scene and how its exponents are measured, as namelist groups."""
    wanted = config["scenes"][wildcards.scene]["exponents"]
    return {
        "runs": {
            "scene": scene_values(wildcards),
            "exponents": {**wanted, **config["exponents"]},
        }
    }


def survey_groups(wildcards):
    """How attractors of a part of a survey are looked for, as namelist groups."""
    if wildcards.survey == "scenes":
        groups = attractor_surveys.scene_groups(config, wildcards.part)
    elif wildcards.survey == "basins":
        groups = attractor_surveys.basin_groups(config, wildcards.part)
    elif wildcards.survey.startswith("routes/"):
        line = wildcards.survey.removeprefix("routes/")
        groups = attractor_surveys.route_groups(config, line, wildcards.part)
    else:
        plane = wildcards.survey.removeprefix("atlas/")
        groups = attractor_surveys.atlas_groups(config, plane, int(wildcards.part))
    return {"runs": groups}


def runs_of_route(wildcards):
    """Files of all runs along a route."""
    return result_files.runs_of_route(config, wildcards.line)


def linear_stability_values(wildcards):
    """The scene's parameters, and what is asked of its linear stability."""
    scene = config["scenes"][wildcards.scene]
    parameters = {key: scene[key] for key in ["tau", "epsilon", "xi", "gamma"]}
    return {**parameters, **config["linear_stability"]}


def plane_values(wildcards):
    """The plane's namelist group."""
    return config["hopf_curves"][wildcards.plane]


def cycles_values(wildcards):
    """The line on which cycles are followed, and how, as namelist group."""
    cycles = config["cycles"]
    line = cycles["lines"][wildcards.cycle_line]
    shared = {
        key: value for key, value in cycles.items() if key not in ("lines", "curves")
    }
    # curves are in planes of epsilon and tau
    if line["along"] in ("epsilon", "tau"):
        shared |= cycles.get("curves", {})
    # a namelist has no empty lists
    return {**shared, **{key: value for key, value in line.items() if value != []}}


def spectrum_values(wildcards):
    """The spectrum's namelist group."""
    return {
        "trajectory": f"results/trajectories/{wildcards.scene}.nc",
        **config["spectra"],
    }


def family_groups(wildcards):
    """Namelists of a family of cases."""
    return study_cases.stability_groups(config["stability"], wildcards.family)


def trust_groups_of(wildcards):
    """Namelists of a scene whose horizon of trust is sought."""
    return study_cases.trust_groups(MEASURED, wildcards.work_scene)


def study_groups(wildcards):
    """Namelists of a study: of a family of cases, or of a scene whose horizon of trust is sought."""
    if wildcards.study == "stability":
        return family_groups(wildcards)
    return study_cases.trust_groups(MEASURED, wildcards.family)


def references_of_families():
    """Reference files of the families that have one."""
    families = config["stability"]["families"].items()
    return [
        f"results/references/stability/{name}.tsv"
        for name, family in families
        if family["reference"] == "quadruple"
    ]


def claims_listed():
    """The paper's claims with their tests, checked."""
    tables = [table for table in LEDGER_TABLES.values() if isinstance(table, str)]
    shown = {*FIGURES, *(Path(table).name for table in tables)}
    try:
        return claims_config.checked(claims_config.listed(), config, shown)
    except read_config.ConfigError as problems:
        raise WorkflowError(problems) from None


def data_for_claims(kind):
    """Data of scenes that claims need, of one kind: the name of their folder."""
    scenes = claims_config.scenes_for(kind, claims_listed())
    return result_files.paths_of_scenes(kind, scenes)


def to_caption():
    """What the caption of each figure is filled from."""
    return [
        {
            "name": name,
            "template": entries.template_of(name),
            "inputs": entries.inputs_of(name, config),
            "params": entries.params_of(name, config),
        }
        for name in FIGURES
    ]


def on_page():
    """What the page shows of each figure beside its files."""
    return [
        {
            "name": name,
            "category": entries.ENTRIES[name].category,
            "caption": entries.caption_of(name),
            "drawing": f"results/figures/{name}.svg",
            "data": [
                path
                for path in entries.files_of(name, config)
                if path.startswith("results/")
            ],
        }
        for name in FIGURES
    ]


def trajectories_on_page():
    """Trajectory files that can be zoomed into: those that figures draw."""
    drawn = (path for name in FIGURES for path in entries.files_of(name, config))
    return list(
        dict.fromkeys(
            path for path in drawn if path.startswith("results/trajectories/")
        )
    )


def assets_of_page(wildcards):
    """What lies beside the page; where some of it is missing, one line says so and ends the run."""
    try:
        return page_assets.sources()
    except page_assets.AssetError as problem:
        raise SystemExit(f"error: {problem}") from None


def commit_at_work():
    """The project's commit, as the page names it."""
    return git_commit.commit_of(Path(workflow.basedir))
