"""The runs of the program: which results each makes, from which namelist, and in which order.

A new command is an entry here: its rules follow from it (rules/programs.smk).
"""

from collections.abc import Callable
from dataclasses import KW_ONLY, dataclass, field
from pathlib import PurePath

from scripts.namelists import attractor_surveys, chains
from scripts.namelists import program_groups as groups

# Priorities: the paper's figures can be looked at while long runs go on. Long runs start before
# short ones, the longest first, so that no core is idle at the end. Snakemake adds the priorities
# of jobs that fit at the same time: a build, which takes two cores, must have more than two jobs of
# the paper.
BUILD, PAPER, LONGEST, LONG = 10, 3, 2, 1


@dataclass(frozen=True)
class Run:
    """One kind of run: a command, its namelist and its output (paths in the results)."""

    rule: str
    command: str
    output: str
    """Path of the output, with wildcards."""
    groups: Callable[..., dict]
    """Groups of the namelist by the configuration and the values of the wildcards."""
    _: KW_ONLY
    needs: dict[str, str] = field(default_factory=dict)
    """Other results that the program reads."""
    horizons: bool = False
    """Whether the table `horizons` of what it needs ends its cases early."""
    priority: int = 0
    takes_minutes: bool = False
    """Whether the run is a job of its own on a cluster."""
    quad: bool = False
    """Whether it is computed in quadruple precision."""

    @property
    def program(self) -> str:
        """Name of the program that has the command."""
        return "spring_block_quad" if self.quad else "spring_block"

    @property
    def stem(self) -> str:
        """Path of the output without its ending; log, benchmark and namelist have the same."""
        return str(PurePath(self.output).with_suffix(""))


LONG_RUN = {"priority": LONG, "takes_minutes": True}
RUNS = [
    Run("trajectory", "trajectory", "trajectories/{scene}.nc", groups.scene_groups, priority=PAPER),
    Run("slip_events", "slip_events", "slip_events/{scene}.nc", groups.scene_groups),
    Run(
        *("spectrum", "spectrum", "spectra/{scene}.nc", groups.spectrum_groups),
        needs={"trajectory": "trajectories/{scene}.nc"},
        priority=PAPER,
    ),
    Run("hopf_curves", "hopf", "hopf/{plane}.nc", groups.hopf_groups, priority=PAPER),
    Run(
        *("linear_stability", "linear_stability", "linear_stability/{scene}.nc"),
        groups.linear_stability_groups,
    ),
    Run(
        *("cycles_runs", "cycles", "cycles/{cycle_line}.nc", groups.cycles_groups),
        priority=LONGEST,
        takes_minutes=True,
    ),
    Run("exponents_runs", "exponents", "exponents/{scene}.nc", groups.exponents_groups, **LONG_RUN),
    Run(  # the paper's figures 4 and 5 show the classes of the scenes
        *("scene_attractors", "attractors", "attractors/scenes/{scene}.nc"),
        attractor_surveys.scene_groups,
        priority=PAPER,
        takes_minutes=True,
    ),
    Run(
        *("attractors_runs", "attractors", "attractors/{survey}/{part}.nc"),
        groups.attractors_groups,
        **LONG_RUN,
    ),
    Run("chain_trajectory", "trajectory", "chains/{chain}.nc", chains.chain_groups),
    Run("motion_trajectory", "trajectory", "chain_motions/{motion}.nc", chains.motion_groups),
    Run(
        *("motion_exponents", "exponents", "chain_exponents/{motion}.nc"),
        chains.motion_exponents_groups,
        priority=LONGEST,
        takes_minutes=True,
    ),
    Run(
        *("chain_slips", "slip_events", "chain_slips/{event_chain}.nc"),
        chains.event_chain_groups,
        **LONG_RUN,
    ),
    Run("mode_curves", "hopf", "modes/{mode_plane}/{mode}.nc", chains.mode_groups),
    Run("synchrony_runs", "synchrony", "synchrony/{scene}.nc", chains.synchrony_groups, **LONG_RUN),
    Run(
        *("reference", "reference", "references/{study}/{case}.tsv", groups.reference_groups),
        quad=True,
        **LONG_RUN,
    ),
    Run("measurement", "measure", "measurements/{study}/{case}.nc", groups.measurement_groups),
    Run(  # the methods take turns, so that what else the machine does hits all alike
        *("work_precision_runs", "measure", "measurements/work_precision/{case}.nc"),
        groups.work_precision_groups,
        needs={"horizons": "tables/trusted-horizons.tsv"},
        horizons=True,
        **LONG_RUN,
    ),
]
KINDS = {
    *(PurePath(run.output).parts[0] for run in RUNS),
    *("namelists", "tables", "figures", "page"),
}
"""Folders that hold results."""
