# A verdict on every claim of the paper.
import claims_config

LEDGER_TABLES = {
    "hopf_points": "results/tables/hopf-points.tsv",
    "linear_stability": "results/tables/linear-stability.tsv",
    "stability": "results/tables/stability.tsv",
    "attractors": "results/tables/attractors.tsv",
    "route": "results/tables/route-to-chaos.tsv",
}
LEDGER_SHOWS = {*FIGURES, *(Path(table).name for table in LEDGER_TABLES.values())}


def claims_listed():
    """Claims with their tests, checked."""
    try:
        return claims_config.checked(claims_config.listed(), config, LEDGER_SHOWS)
    except check_config.ConfigError as problems:
        raise WorkflowError(problems) from None


rule claims:
    input:
        **LEDGER_TABLES,
        curves=expand("results/hopf/{plane}.nc", plane=config["hopf_curves"]),
        friction="results/friction/velocity_step.nc",
    output:
        tsv=report(
            "results/tables/claims.tsv",
            caption="../scripts/claims.rst",
            category="Ledger",
        ),
        json="results/tables/claims.json",
    log:
        "results/logs/tables/claims.log",
    params:
        claims=claims_listed(),
    script:
        "../scripts/claims.py"
