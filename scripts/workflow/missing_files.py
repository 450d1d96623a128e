"""Files that are missing are made again, also where what was made from them is still there.

Snakemake remakes only the missing files that are targets (its issue 1978, open). A job that fails
leaves its outputs missing, so that figures made from older ones would pass as current.
"""

import snakemake.api  # first: the workflow and it import each other
import snakemake.workflow
from snakemake.dag import DAG

from scripts.workflow.packages import PackageError

PROGRAMS = "build"
"""The rule whose outputs are no results: they are made where a result needs them. Results carry a
digest of their program's sources, so that none is left stale."""


class CompleteDAG(DAG):
    """A graph of jobs in which every output of every job is a target."""

    async def check_incomplete(self) -> None:
        """Called when all jobs are known, before it is judged which of them run."""
        await super().check_incomplete()
        jobs = [job for job in self.jobs if job.rule.name != PROGRAMS]
        self.targetjobs.update(jobs)
        self.targetfiles.update(file for job in jobs for file in job.output)


def make_again() -> None:
    """Let Snakemake judge by such a graph; raise PackageError where it has no such graph."""
    if snakemake.workflow.DAG not in (DAG, CompleteDAG) or "check_incomplete" not in vars(DAG):
        raise PackageError(
            f"Snakemake {snakemake.__version__} does not judge by DAG.check_incomplete, so that"
            " missing files would stay missing; run ./reproduce, which sets up one that does"
        )
    snakemake.workflow.DAG = CompleteDAG
