# Pages about the Fortran code, made by FORD from its comments; not among all results. The packages
# that they need are installed by this rule.


# A warning is a failure: the comment that it is about would be missing from the pages. FORD's own
# check for missing comments is off, since it wants one for each local variable and knows neither
# enumerators nor names that a facade passes on; tests/test_documents_made.py checks instead.
rule docs:
    """Pages about the Fortran code, in results/docs/."""
    output:
        directory("results/docs"),
    log:
        "results/logs/docs.log",
    localrule: True
    threads: 2
    params:
        digest=digest_of_files(
            [
                *files_in("dde/src", "src", "app", endings={".f90"}),
                *("docs/ford.md", "docs/offline_pages.py"),
                *("docs/apt-packages.txt", "docs/requirements.lock"),
            ]
        ),
    shell:
        "said=$( (tools/setup/setup.sh docs"
        " && docs/.venv/bin/ford --quiet docs/ford.md"
        " && docs/.venv/bin/python docs/offline_pages.py {output:q})"
        ' 2>&1 | tee {log:q}) || {{ echo "$said" >&2; exit 1; }};'
        " ! grep -i warning {log:q} >&2"
