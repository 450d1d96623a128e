# A verdict on every claim of the paper.


rule claims:
    """Verdicts on all claims of the paper, in results/tables/claims.tsv."""
    input:
        **placed(claims_config.files_for(CLAIMS, LISTED)),
        template=of_project("page/verdicts.html.jinja"),
        code=code_of("claims/ledger.py"),
    output:
        tsv=report(
            "<results>/tables/claims.tsv",
            caption="../scripts/claims/ledger.rst",
            category="Claims",
            labels={"content": "Table"},
        ),
        page=report(
            "<results>/tables/claims.html",
            caption="../scripts/claims/ledger.rst",
            category="Claims",
            labels={"content": "Verdicts"},
        ),
        json="<results>/tables/claims.json",
    log:
        "<results>/logs/tables/claims.log",
    params:
        claims=CLAIMS,
    script:
        "../scripts/claims/ledger.py"
