# A verdict on every claim of the paper.


rule claims:
    """Verdicts on all claims of the paper, in results/tables/claims.tsv."""
    input:
        **LEDGER_TABLES,
        curves=expand("results/hopf/{plane}.nc", plane=config["hopf_curves"]),
        cycles=result_files.cycles_of_lines(config),
        spectra=data_for_claims("spectra"),
        slip_events=data_for_claims("slip_events"),
        friction="results/friction/velocity_step.nc",
        template="page/verdicts.html.jinja",
        code=code_of("claims/ledger.py"),
    output:
        tsv=report(
            "results/tables/claims.tsv",
            caption="../scripts/claims/ledger.rst",
            category="Claims",
            labels={"content": "Table"},
        ),
        page=report(
            "results/tables/claims.html",
            caption="../scripts/claims/ledger.rst",
            category="Claims",
            labels={"content": "Verdicts"},
        ),
        json="results/tables/claims.json",
    log:
        "results/logs/tables/claims.log",
    params:
        claims=claims_listed(),
    script:
        "../scripts/claims/ledger.py"
