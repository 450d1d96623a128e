# Pages about the Fortran code, made by FORD from its comments. `rule all` does not list them. Their
# tools are set up by the rule.


# A warning is a failure: the comment that it is about would be missing from the pages. FORD's own
# check for missing comments is off, since it wants one for each local variable and knows neither
# enumerators nor names that a facade passes on; tests/test_documents_made.py checks instead.
rule docs:
    """Pages about the Fortran code, in results/docs/."""
    output:
        directory("results/docs"),
    log:
        "results/logs/docs.log",
    threads: 2
    params:
        digest=digest_of_files(documentation()),
    shell:
        "(setup/setup.sh docs"
        " && docs/.venv/bin/ford --quiet docs/ford.md"
        " && docs/.venv/bin/python docs/offline_pages.py {output:q})"
        " > {log:q} 2>&1 || {{ cat {log:q} >&2; exit 1; }};"
        " ! grep -i warning {log:q} >&2"
