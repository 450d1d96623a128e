"""The runs of Fortran programs: which results each makes, from which namelist, and in which order.

A new program is an entry here: its rules follow from it (rules/programs.smk).
"""

from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import PurePath

from scripts.namelists import attractor_surveys
from scripts.namelists import program_groups as groups

# Priorities: the paper's figures can be looked at while long runs go on. Long runs start before
# short ones, the longest first, so that no core is idle at the end. Snakemake adds the priorities
# of jobs that fit at the same time: a build, which takes two cores, must have more than two jobs of
# the paper.
BUILD, PAPER, LONGEST, LONG = 10, 3, 2, 1


@dataclass(frozen=True, kw_only=True)
class Run:
    """One kind of run: a program, its namelist and its output (paths in the results)."""

    rule: str
    program: str
    output: str
    """Path of the output, with wildcards."""
    groups: Callable[..., dict]
    """Groups of the namelist by the configuration and the values of the wildcards."""
    namelist: str = ""
    """Path of the namelist if it is another run's."""
    needs: dict[str, str] = field(default_factory=dict)
    """Other results that the program reads."""
    horizons: str = ""
    """The table that ends the run's cases early."""
    priority: int = 0
    takes_minutes: bool = False
    """Whether the run is a job of its own on a cluster."""

    @property
    def stem(self) -> str:
        """Path of the output without its ending; log, benchmark and namelist have the same."""
        return str(PurePath(self.output).with_suffix(""))

    @property
    def namelist_path(self) -> str:
        """Path of the namelist."""
        return self.namelist or f"namelists/{self.stem}.nml"


RUNS = [
    Run(
        rule="trajectory",
        program="trajectory",
        output="trajectories/{scene}.nc",
        groups=groups.scene_groups,
        priority=PAPER,
    ),
    Run(
        rule="slip_events",
        program="slip_events",
        output="slip_events/{scene}.nc",
        namelist="namelists/trajectories/{scene}.nml",
        groups=groups.scene_groups,
    ),
    Run(
        rule="spectrum",
        program="spectrum",
        output="spectra/{scene}.nc",
        groups=groups.spectrum_groups,
        needs={"trajectory": "trajectories/{scene}.nc"},
        priority=PAPER,
    ),
    Run(
        rule="hopf_curves",
        program="hopf",
        output="hopf/{plane}.nc",
        groups=groups.hopf_groups,
        priority=PAPER,
    ),
    Run(
        rule="velocity_step",
        program="velocity_step",
        output="friction/velocity_step.nc",
        groups=groups.velocity_step_groups,
        priority=PAPER,
    ),
    Run(
        rule="linear_stability",
        program="linear_stability",
        output="linear_stability/{scene}.nc",
        groups=groups.linear_stability_groups,
    ),
    Run(
        rule="cycles_runs",
        program="cycles",
        output="cycles/{cycle_line}.nc",
        groups=groups.cycles_groups,
        priority=LONGEST,
        takes_minutes=True,
    ),
    Run(
        rule="exponents_runs",
        program="exponents",
        output="exponents/{scene}.nc",
        groups=groups.exponents_groups,
        priority=LONG,
        takes_minutes=True,
    ),
    Run(  # the paper's figures 4 and 5 show the classes of the scenes
        rule="scene_attractors",
        program="attractors",
        output="attractors/scenes/{scene}.nc",
        groups=attractor_surveys.scene_groups,
        priority=PAPER,
        takes_minutes=True,
    ),
    Run(
        rule="attractors_runs",
        program="attractors",
        output="attractors/{survey}/{part}.nc",
        groups=groups.attractors_groups,
        priority=LONG,
        takes_minutes=True,
    ),
    Run(
        rule="reference",
        program="reference",
        output="references/{study}/{case}.tsv",
        groups=groups.reference_groups,
        priority=LONG,
        takes_minutes=True,
    ),
    Run(
        rule="measurement",
        program="measure",
        output="measurements/{study}/{case}.nc",
        groups=groups.measurement_groups,
    ),
    Run(  # the methods take turns, so that what else the machine does hits all alike
        rule="work_precision_runs",
        program="measure",
        output="measurements/work_precision/{case}.nc",
        groups=groups.work_precision_groups,
        horizons="tables/trusted-horizons.tsv",
        priority=LONG,
        takes_minutes=True,
    ),
]
KINDS = {
    *(PurePath(run.output).parts[0] for run in RUNS),
    *("namelists", "tables", "figures", "page"),
}
"""Folders that hold results."""
