# The nondimensional values in seconds and metres.


rule dimensions_table:
    """Table of L/v0, xi, gamma and the paper's delay for a laboratory sample and a fault."""
    output:
        "<results>/tables/dimensions.tsv",
    log:
        "<results>/logs/tables/dimensions.log",
    params:
        presets=LISTED["dimensions"],
        code=code_of("tables/dimensions_table.py"),
    script:
        "../scripts/tables/dimensions_table.py"
