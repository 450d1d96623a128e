# Wildcards, digests of code by which results of older code are stale, and functions of the rules.
import functools
from os.path import normpath
from pathlib import Path

from scripts.files.digests import digest_of_files
from scripts.files.tsv import read_table
from scripts.models import compiled, networks
from scripts.models.models import PAPER as PAPERS_LAW
from scripts.models.models import models, of_user
from scripts.requests.write_namelist import end_at_horizons, text_of
from scripts.plans import studies
from scripts.plans.declare import BUILD, MAIN, PAPER, stem_of
from scripts.workflow.script_imports import modules_of


wildcard_constraints:
    **studies.wildcards(config),
    defined="|".join(of_user(config)),
    built=r"build/(release|users/[\w-]+)",
    quad="|_quad",
    model=r"\w+",


RUNS = studies.runs()
BUILT = f"build/users/{Path(plan.results).name}"
"""The folder of models with a user's laws."""


def code_of(script, *others):
    """A digest of a script, of the modules that it imports and of other files of the project."""
    return digest_of_files([*modules_of(script), *others])


def files_in(*folders, endings):
    """Files with these endings in folders of the Fortran code, in order."""
    files = [
        path
        for folder in folders
        for path in Path(normpath(f"fortran/{folder}")).rglob("*")
    ]
    return sorted(str(path) for path in files if path.suffix in endings)


SOURCES = [
    *("fortran/CMakeLists.txt", "fortran/CMakePresets.json"),
    *("fortran/dde/CMakeLists.txt", "generator/CMakeLists.txt"),
    *files_in(
        "app",
        "src",
        "dde/src",
        "../generator/fortran",
        endings={".f90", ".c", ".in", ".inc"},
    ),
]
"""Sources of the program in double and in quadruple precision."""
OF_MODELS = [
    "fortran/dde/src/base/dde_kinds.f90",
    *files_in("../generator", endings={".py", ".jinja"}),
    *files_in("../generator/fortran/shared", endings={".f90"}),
]
"""What all models are made with."""


@functools.cache
def digest_of_program(*others):
    """A digest of the program's sources: what it computes is stale once they change, built or not."""
    return digest_of_files([*SOURCES, *others])


@functools.cache
def digest_of_model(model):
    """A digest of what a model is made of; what a user defines is in the configuration."""
    parts = [
        path
        for path in compiled.parts_of(model, config, BUILT)
        if not path.startswith(BUILT)
    ]
    own = of_user(config).get(models(config)[model].name)
    return digest_of_files([*OF_MODELS, *parts]), own


def fill_in(value):
    """Paths of parameters, with the folder in place of `<results>` as Snakemake has it in inputs."""
    if isinstance(value, dict):
        return {key: fill_in(item) for key, item in value.items()}
    if isinstance(value, list):
        return [fill_in(item) for item in value]
    return value.replace("<results>", plan.results) if isinstance(value, str) else value


def made(path):
    """A file for the page; none if it could not be made."""
    return [] if fill_in(path) in unmade else path


# without `input`: Snakemake does not compare parameters that take it with those of the last run
def namelist_of(run, wildcards):
    """The text of a run's namelist."""
    groups = fill_in(run.groups(config, **wildcards))
    if run.horizons:
        table = read_table(fill_in(f"<results>/{run.needs['horizons']}"))
        groups = end_at_horizons(groups, table)
    return text_of(groups)


def namelists_before(run, wildcards):
    """Texts of the namelists of the runs whose results a run reads.

    A result that is missing is no reason for Snakemake to doubt what was made of it.
    """
    before = [other for other in RUNS if other.output in run.needs.values()]
    return [namelist_of(other, wildcards) for other in before]


def models_of(run, wildcards):
    """Models that a run opens."""
    return compiled.models_in(run.groups(config, **wildcards))


def objects_of(run, wildcards):
    """Compiled models that a run opens."""
    return compiled.objects_of(models_of(run, wildcards), config, BUILT, run.quad)


def digests_of_models(run, wildcards):
    """Digests of the models that a run opens."""
    return {
        model: digest_of_model(model) for model in sorted(models_of(run, wildcards))
    }


def ask(function, wildcards):
    """What a function of the configuration and of names says."""
    return fill_in(function(config, **wildcards))


def drawing_of(figure):
    """The module that draws a figure, by its path in scripts/."""
    return f"studies/{figure.drawing.replace('.', '/')}.py"


def tables_read(figure):
    """Tables of the project that a figure reads beside results."""
    return [
        path for path in figure.files_of(config) if not path.startswith("<results>/")
    ]


def figures_on_page():
    """What the page shows of each figure."""
    return [
        {
            "name": name,
            "category": figure.category,
            "caption": fill_in(figure.filled_caption),
            "drawing": f"{plan.results}/figures/{name}.svg",
            "data": fill_in(
                [
                    path
                    for path in figure.files_of(config)
                    if path.startswith("<results>/")
                ]
            ),
        }
        for name, figure in plan.figures.items()
    ]
