# Attractors and their classes: of scenes from several histories, over the plane of epsilon and tau
# (the atlas), along routes, and from random histories (basins). A survey is cut into parts, each a
# job of its own: one core each leaves fewer cores idle than the program's threads
# (--set-threads attractors_runs=2).


rule attractors_namelist:
    """Input of one part of a survey of attractors."""
    output:
        "{results}/namelists/attractors/{survey}/{part}.nml",
    log:
        "{results}/logs/namelists/attractors/{survey}/{part}.log",
    priority: priority_of_survey
    params:
        groups=of_config(program_groups.attractors_groups, "survey", "part"),
        code=code_of("namelists/write_namelist.py"),
    script:
        "../scripts/namelists/write_namelist.py"


rule attractors_runs:
    """Motions at many parameters and their classes: one part of a survey of attractors."""
    input:
        program="<build>/release/bin/attractors",
        namelist="{results}/namelists/attractors/{survey}/{part}.nml",
    output:
        "{results}/attractors/{survey}/{part}.nc",
    log:
        "{results}/logs/attractors/{survey}/{part}.log",
    benchmark:
        "{results}/benchmarks/attractors/{survey}/{part}.tsv"
    priority: priority_of_survey
    params:
        groups=of_config(program_groups.attractors_groups, "survey", "part"),
        sources=digest_of("attractors"),
    shell:
        "OMP_NUM_THREADS={threads} {input.program:q} {input.namelist:q} {output:q}"
        " 2> {log:q} || {{ grep -v ' %, ' {log:q} >&2; exit 1; }}"


rule attractors_table:
    """Table of the attractors of the scenes, with their classes."""
    input:
        runs=placed(result_files.attractors_of_scenes(LISTED)),
    output:
        "<results>/tables/attractors.tsv",
    log:
        "<results>/logs/tables/attractors.log",
    priority: OF_PAPER
    params:
        of="scenes",
        code=code_of("tables/attractor_tables.py"),
    script:
        "../scripts/tables/attractor_tables.py"


rule route_table:
    """Table of the attractors along a route: one parameter changes, all others are fixed."""
    input:
        runs=runs_of_route,
    output:
        "<results>/tables/routes/{line}.tsv",
    log:
        "<results>/logs/tables/routes/{line}.log",
    params:
        of="route",
        code=code_of("tables/attractor_tables.py"),
    script:
        "../scripts/tables/attractor_tables.py"


rule basins_table:
    """Table of the attractors that are reached from random histories."""
    input:
        runs=placed(result_files.runs_of_basins(LISTED)),
        routes=result_files.tables_of_routes(LISTED),
    output:
        "<results>/tables/basins.tsv",
    log:
        "<results>/logs/tables/basins.log",
    params:
        code=code_of("tables/basins_table.py"),
    script:
        "../scripts/tables/basins_table.py"


rule atlas_table:
    """Table of the atlas: the class of motion at points of epsilon and tau."""
    input:
        runs=placed(result_files.parts_of_atlas(LISTED)),
    output:
        "<results>/tables/atlas.tsv",
    log:
        "<results>/logs/tables/atlas.log",
    params:
        of="atlas",
        code=code_of("tables/attractor_tables.py"),
    script:
        "../scripts/tables/attractor_tables.py"
