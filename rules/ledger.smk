# A verdict on every claim of the paper.


rule claims:
    input:
        **LEDGER_TABLES,
        curves=expand("results/hopf/{plane}.nc", plane=config["hopf_curves"]),
        spectra=result_files.spectra_of_figures(config),
        slip_events=result_files.slip_events_of_figure(config),
        friction="results/friction/velocity_step.nc",
        code=code_of("claims/ledger.py"),
    output:
        tsv=report(
            "results/tables/claims.tsv",
            caption="../scripts/claims/ledger.rst",
            category="Ledger",
        ),
        json="results/tables/claims.json",
    log:
        "results/logs/tables/claims.log",
    params:
        claims=claims_listed(),
    script:
        "../scripts/claims/ledger.py"
