# The reproduction of "Time-delay in spring-block model for aperiodicity in earthquakes".
# Data flow: config -> namelist -> Fortran program -> NetCDF -> figure.
from snakemake.utils import min_version

min_version("9.27")


configfile: os.path.relpath(f"{workflow.current_basedir}/config/config.yaml")


report: "scripts/page/report.rst"


include: "rules/configuration.smk"
include: "rules/common.smk"


rule all:
    """All figures, the tables of results and the page with the verdicts on the paper's claims."""
    default_target: True
    input:
        (
            everything_added
            if OWN
            else [
                *expand(
                    "<results>/figures/{figure}.{ending}",
                    figure=FIGURES,
                    ending=["pdf", "png", "svg"],
                ),
                "<results>/index.html",
                "<results>/tables/tolerance-proportionality.tsv",
                "<results>/tables/hopf-points.tsv",
                "<results>/tables/cycle-points.tsv",
                "<results>/tables/linear-stability.tsv",
                "<results>/tables/basins.tsv",
                "<results>/tables/dimensions.tsv",
                "<results>/tables/claims.tsv",
            ]
        ),


include: "rules/build.smk"
include: "rules/trajectories.smk"
include: "rules/slip_events.smk"
include: "rules/curves.smk"
include: "rules/cycles.smk"
include: "rules/linear_stability.smk"
include: "rules/spectra.smk"
include: "rules/friction.smk"
include: "rules/dimensions.smk"
include: "rules/figures.smk"
include: "rules/exponents.smk"
include: "rules/attractors.smk"
include: "rules/studies.smk"
include: "rules/ledger.smk"
include: "rules/own.smk"
include: "rules/page.smk"
include: "rules/documents.smk"


# A module has none of these: they are those of the workflow that uses it.
onstart:
    snakemake_internals.forget_results(workflow)


onsuccess:
    snakemake_internals.record_results(workflow, CONFIGS)


onerror:
    snakemake_internals.record_results(workflow, CONFIGS)


# All but the long rules take seconds.
if not IS_MODULE:
    snakemake_internals.run_here_all_but(workflow, LONG_RULES)
