# What only a user's file has: tables of single planes of the atlas.


rule atlas_plane_table:
    """The table of one plane of the atlas."""
    input:
        runs=lambda wildcards: placed(
            result_files.parts_of_plane(config, wildcards.atlas_plane)
        ),
    output:
        "<results>/tables/atlas/{atlas_plane}.tsv",
    log:
        "<results>/logs/tables/atlas/{atlas_plane}.log",
    params:
        of="atlas",
        code=code_of("tables/attractor_tables.py"),
    script:
        "../scripts/tables/attractor_tables.py"
