# The configuration, read and checked, and the folders of results.
import copy
import sys
from pathlib import Path

from snakemake.exceptions import WorkflowError

PROJECT = Path(str(workflow.current_basedir)).parent.resolve()
sys.path.insert(0, str(PROJECT))
from scripts.workflow import packages

try:
    packages.refuse_missing()
    packages.let_jobs_import(PROJECT)
    from scripts.workflow import snakemake_internals

    IS_MODULE = snakemake_internals.is_module(workflow)
    if IS_MODULE:
        defaults, overlays, entries_given = [PROJECT / "config" / "config.yaml"], [], []
    else:
        snakemake_internals.make_missing_files_again()
        sources = snakemake_internals.config_sources(workflow)
        defaults, overlays, entries_given = sources
except packages.PackageError as problem:
    raise SystemExit(f"error: {problem}") from None

from scripts.claims import claims_config
from scripts.config import check_config, read_config
from scripts.figures import registry
from scripts.figures.registry import FIGURES
from scripts.workflow import before_run, own_file

try:
    before_run.refuse_path(PROJECT, Path.cwd())
    if not IS_MODULE:
        before_run.refuse_unwritable(Path.cwd())
    OVERLAY = read_config.merged(overlays, entries_given)
    if IS_MODULE and snakemake_internals.has_config_of_module(workflow):
        OVERLAY = copy.deepcopy(config)
    folder = own_file.folder_of(overlays, entries_given)
except (before_run.FolderError, read_config.ConfigError) as problems:
    raise WorkflowError(problems) from None


# of a module it is that of the workflow that uses it
if not IS_MODULE:

    pathvars:
        results=folder,


RESULTS = snakemake_internals.folder_of_results(workflow)
OWN = bool(OVERLAY) and (IS_MODULE or RESULTS != own_file.RESULTS)
"""Whether the run is for what a file adds."""
try:
    if IS_MODULE:
        own_file.refuse_active(RESULTS)
    written = read_config.merged(defaults, [])
    NAMES = own_file.added(OVERLAY if OWN else {}, written)
    CONFIGS = {}
    if OWN and not IS_MODULE:
        CONFIGS[own_file.RESULTS] = check_config.checked(copy.deepcopy(written))
    config = check_config.checked(
        read_config.merged_over(written, OVERLAY), NAMES["scenes"]
    )
    CONFIGS[RESULTS] = config
except read_config.ConfigError as problems:
    raise WorkflowError(problems) from None


try:
    # the user's claims are alone in their table
    said = {
        "claims": {
            **({} if OWN else claims_config.listed()["claims"]),
            **config["claims"],
        }
    }
    tables = [
        Path(path).name
        for path in claims_config.FILES.values()
        if path.endswith(".tsv")
    ]
    shown = {*FIGURES, *registry.user_figures(config, NAMES), *tables}
    CLAIMS = claims_config.checked(said, config, shown) if said["claims"] else {}
except read_config.ConfigError as problems:
    raise WorkflowError(problems) from None

if OWN:
    SHOWN = registry.user_figures(config, NAMES)
    LISTED = own_file.listed(config, NAMES, claims_config.names_in(CLAIMS))
else:
    SHOWN, LISTED = FIGURES, config
"""Figures on the page; the configuration without what the run does not list in tables."""
DRAWN = {**LISTED, "hopf_curves": config["hopf_curves"]}
"""The configuration for figures: Hopf curves of all planes can be drawn in an atlas."""


pathvars:
    build="build" if Path.cwd() == PROJECT else str(PROJECT / "build"),
