# Tables of results, and the verdicts on claims. The plans in scripts/studies/ declare the tables.
from scripts.claims import declare
from scripts.claims.ledger import inputs_for

for path, table in studies.tables():
    outputs = {"table": table.output, **table.more_outputs}

    rule:
        name:
            table.rule
        input:
            unpack(functools.partial(ask, table.inputs)),
        output:
            **{name: f"<results>/{file}" for name, file in outputs.items()},
        log:
            f"<results>/logs/{stem_of(table.output)}.log",
        priority: table.priority
        localrule: True
        params:
            **{
                name: functools.partial(ask, value)
                for name, value in table.params.items()
            },
            script=path,
            code=code_of(path),
        script:
            "../scripts/{params.script}"


rule claims:
    """Verdicts on all claims of the paper, in results/tables/claims.tsv."""
    input:
        **inputs_for(plan.claims, config),
    output:
        tsv=report(
            "<results>/tables/claims.tsv",
            caption="../scripts/claims/ledger.rst",
            category="Claims",
            labels={"content": "Verdicts"},
        ),
        json="<results>/tables/claims.json",
    log:
        "<results>/logs/tables/claims.log",
    localrule: True
    params:
        claims=plan.claims,
        # the paper's claims are about its law
        law=None if plan.is_users else PAPERS_LAW,
        code=code_of(
            "claims/ledger.py",
            *declare.templates(),
            *(
                path
                for script in declare.scripts_used()
                for path in modules_of(script)
            ),
        ),
    script:
        "../scripts/claims/ledger.py"
