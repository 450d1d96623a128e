# A verdict on every claim of the paper.


rule claims:
    input:
        **LEDGER_TABLES,
        curves=expand("results/hopf/{plane}.nc", plane=config["hopf_curves"]),
        friction="results/friction/velocity_step.nc",
        code=[
            "scripts/claims_of_attractors.py",
            "scripts/claims_of_bifurcations.py",
            "scripts/claims_of_formulas.py",
            "scripts/claims_of_runs.py",
            "scripts/claims_results.py",
            "scripts/motion_rows.py",
            "scripts/printed_formulas.py",
        ],
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
