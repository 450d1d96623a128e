"""All that the workflow uses of Snakemake beyond its documented interface; each use fails by name.

docs/workflow-internals.md lists what each is for.
"""

import contextlib
from collections.abc import Iterable, Iterator
from pathlib import Path

import snakemake.api  # first: the workflow and it import each other
import snakemake.workflow
from snakemake.dag import DAG
from snakemake.exceptions import WorkflowError
from snakemake.logging import logger

from scripts.files.outputs import FileError
from scripts.workflow import before_run, known_targets, manifest
from scripts.workflow.packages import PackageError

PROGRAMS = "build"
"""The rule whose outputs are no results: they are made where a result needs them. Results carry a
digest of their program's sources, so that none is left stale."""


class CompleteDAG(DAG):
    """A graph of jobs in which every output of every job is a target.

    Snakemake remakes only the missing files that are targets (its issue 1978, open). A job that
    fails leaves its outputs missing, so that figures made from older ones would pass as current.
    """

    def __init__(self, workflow, rules, *arguments, **options) -> None:
        """Called once all rules and settings are known, those of a workflow around this one too."""
        start_jobs_at_once(workflow)
        super().__init__(workflow, rules, *arguments, **options)
        for name in ("targetfiles", "rules"):
            expect(self, name, "by which unknown targets are refused with a suggestion")
        for holder, name in ((self, "forcefiles"), (workflow, "is_main_process")):
            expect(holder, name, "by which damaged results are made again")
        problem = known_targets.problem_of(self.targetfiles, self.rules)
        if problem:
            raise WorkflowError(problem)

    async def init(self, progress=False) -> None:
        """Called before Snakemake locks the files of this run, if it does."""
        await super().init(progress)
        lock_folder(self.workflow)

    async def check_incomplete(self) -> None:
        """Called when all jobs are known, before it is judged which of them run."""
        await super().check_incomplete()
        jobs = [job for job in self.jobs if job.rule.name != PROGRAMS]
        self.targetjobs.update(jobs)
        self.targetfiles.update(file for job in jobs for file in job.output)
        asked = [str(file) for job in jobs for file in job.output]
        # Snakemake's own messages leave out a record without words
        logger.info(None, extra={"asked_for": asked})
        # jobs of a cluster run while the results change
        if self.workflow.is_main_process:
            damaged = manifest.damaged(asked)
            for path in damaged:
                logger.warning(
                    f"{path}: was changed or damaged since a run made it; it is made again"
                )
            self.forcefiles.update(damaged)


def expect(holder, name: str, use: str) -> None:
    """Raise PackageError where an object of Snakemake's lacks a name."""
    if not hasattr(holder, name):
        kind = holder if isinstance(holder, type) else type(holder)
        raise PackageError(
            f"Snakemake {snakemake.__version__} has no {kind.__name__}.{name}, {use};"
            " run ./reproduce, which sets up a version that has it"
        )


def make_missing_files_again() -> None:
    """Let Snakemake judge by a CompleteDAG which jobs run."""
    use = "by which missing files are made again"
    expect(DAG, "check_incomplete", use)
    expect(DAG, "init", use)
    if getattr(snakemake.workflow, "DAG", None) not in (DAG, CompleteDAG):
        raise PackageError(
            f"Snakemake {snakemake.__version__} has no snakemake.workflow.DAG, {use};"
            " run ./reproduce, which sets up a version that has it"
        )
    snakemake.workflow.DAG = CompleteDAG


def start_jobs_at_once(workflow) -> None:
    """Lift the limit of jobs a second: with it every job that ends wakes the scheduler once more in
    every second that follows. Snakemake has no settings yet while it reads the rules."""
    expect(workflow, "scheduling_settings", "which holds the limit of jobs a second")
    settings = workflow.scheduling_settings
    # a report needs no jobs
    if settings is None:
        return
    expect(settings, "max_jobs_per_timespan", "the limit of jobs a second")
    settings.max_jobs_per_timespan = None


def lock_folder(workflow) -> None:
    """Remove locks of killed runs; raise WorkflowError where a live run has locked the same files.

    A dry run and a job of a cluster lock nothing.
    """
    use = "by which a run that is alive is known"
    for name in ("dryrun", "execution_settings", "persistence"):
        expect(workflow, name, use)
    settings = workflow.execution_settings
    if workflow.dryrun or settings is None:
        return
    expect(settings, "lock", use)
    if not settings.lock:
        return
    other = before_run.free_folder(Path.cwd())
    expect(workflow.persistence, "locked", use)
    if other and workflow.persistence.locked:
        raise WorkflowError(
            f"another run is active and has locked files of this one: {other}; wait until it has"
            " ended, or end it"
        )


def forget_results(workflow) -> None:
    """Before the first job."""
    with as_warnings():
        manifest.forget(results_made(workflow))


def record_results(workflow, folders: Iterable[str]) -> None:
    """After the last job."""
    with as_warnings():
        manifest.record(folders, results_made(workflow))


@contextlib.contextmanager
def as_warnings() -> Iterator[None]:
    """A list of digests that cannot be written stops no run."""
    try:
        yield
    except FileError as problem:
        logger.warning(str(problem))


def results_made(workflow) -> list[str]:
    """Results that the jobs of a run make."""
    use = "by which the digests of results are recorded"
    expect(workflow, "dag", use)
    expect(workflow.dag, "needrun_jobs", use)
    jobs = workflow.dag.needrun_jobs(exclude_finished=False)
    return [str(file) for job in jobs for file in job.output]


def is_module(workflow) -> bool:
    """Whether another workflow uses the project by `module`."""
    use = "by which a module is known as such"
    expect(workflow, "modifier", use)
    expect(workflow.modifier, "namespace", use)
    return workflow.modifier.namespace is not None


def has_config_of_module(workflow) -> bool:
    """Whether `module` gives a configuration."""
    expect(workflow, "modifier", "by which the configuration of a module is known")
    expect(workflow.modifier, "skip_configfile", "by which a configuration of `module` is known")
    return workflow.modifier.skip_configfile


def folder_of_results(workflow) -> str:
    """What `<results>` stands for in paths."""
    expect(workflow, "pathvars", "which holds the folder of the results")
    return workflow.pathvars.get("results")


def config_sources(workflow) -> tuple[list, list, list[str]]:
    """Configuration files of the workflow and those merged over them, and entries KEY=VALUE."""
    use = "by which the configuration is read again with the line of each problem"
    expect(workflow, "configfiles", use)
    expect(workflow, "config_settings", use)
    given = workflow.config_settings
    for name in ("configfiles", "config_args", "replace_workflow_config"):
        expect(given, name, use)
    overlays = list(given.configfiles)
    defaults = workflow.configfiles[len(overlays) :]
    if given.replace_workflow_config and (overlays or given.config_args):
        defaults = []
    return defaults, overlays, given.config_args or []


def describe(workflow, docstrings: dict[str, str]) -> None:
    """Set docstrings of rules by their names: Snakemake takes only literal ones from a rule."""
    use = "by which rules of figures explain themselves"
    expect(workflow, "rules", use)
    for rule in workflow.rules:
        expect(rule, "docstring", use)
        rule.docstring = docstrings.get(rule.name, rule.docstring)


def run_here_all_but(workflow, long_rules: set[str]) -> None:
    """On a cluster run these rules as its jobs, and all others where Snakemake runs."""
    for name in ("rules", "localrules"):
        expect(workflow, name, "by which short rules stay off the cluster")
    workflow.localrules(*({rule.name for rule in workflow.rules} - long_rules))


def benchmarks_of(rules) -> dict[str, str]:
    """Patterns of benchmark files, by rule, of the rules so far that have them.

    `rules` is the object that a Snakefile has. Its names have no prefix of a module, and its
    patterns hold no constraints of wildcards.
    """
    use = "by which the page finds the seconds of each rule"
    expect(rules, "_rules", use)
    for rule in rules._rules.values():
        expect(rule, "rule", use)
        expect(rule.rule, "benchmark", use)
    return {name: str(rule.benchmark) for name, rule in rules._rules.items() if rule.rule.benchmark}
