# A verdict on every claim of the paper.


rule claims:
    """Verdicts on all claims of the paper, in results/tables/claims.tsv."""
    input:
        **placed(ledger.inputs_for(CLAIMS, LISTED)),
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
        code=code_of("claims/ledger.py", "page/verdicts.html.jinja"),
    script:
        "../scripts/claims/ledger.py"
