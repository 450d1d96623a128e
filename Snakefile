# The reproduction of "Time-delay in spring-block model for aperiodicity in earthquakes".
# Data flow: config -> namelist -> Fortran program -> NetCDF -> table, figure -> page.
import os
import sys

from snakemake.utils import min_version

min_version("9.27")
# the scripts of jobs import the project's modules, too, by the Python that runs this
folders = [str(workflow.basedir), os.environ.get("PYTHONPATH")]
os.environ.update(PYTHONPATH=os.pathsep.join(filter(None, folders)))
folders = [os.path.dirname(sys.executable), os.environ.get("PATH")]
os.environ.update(PATH=os.pathsep.join(filter(None, folders)))
sys.path.insert(0, str(workflow.basedir))

from scripts.files.read_config import ConfigError, read_overlay
from scripts.workflow import manifest, records, run_times
from scripts.workflow.check_run import problem_of
from scripts.workflow.failed_run import make_page, read_failed_run
from scripts.workflow.plan import read_plan

try:
    given = read_overlay(workflow.config_settings)
    # of a run that failed, whose page is to be made
    failed, unmade = read_failed_run()
    plan = read_plan(given).without(unmade)
except ConfigError as problem:
    sys.exit(f"error: {problem}")
config = plan.config
records.keep_with(plan.results)


pathvars:
    results=plan.results,


report: "scripts/page/report.rst"


include: "rules/common.smk"


rule all:
    """All figures, the tables of results and the page with the verdicts on the paper's claims."""
    default_target: True
    input:
        plan.targets(),


include: "rules/programs.smk"
include: "rules/tables.smk"
include: "rules/figures.smk"
include: "rules/page.smk"
include: "rules/documents.smk"


if problem := problem_of(workflow, plan.results, plan.targets()):
    sys.exit(f"error: {problem}")


onstart:
    manifest.begin_run(plan.results)


onsuccess:
    manifest.record_run(plan.results)
    run_times.record_times(plan.results)
    print(plan.summary(), file=sys.stderr)


onerror:
    if not failed:
        make_page(plan.results, given)
    manifest.record_run(plan.results)
