# Cycles followed along lines of one parameter, one file a line, and their special points.


rule cycles_namelist:
    """Input of the cycles along a line."""
    output:
        "{results}/namelists/cycles/{cycle_line}.nml",
    log:
        "{results}/logs/namelists/cycles/{cycle_line}.log",
    priority: OF_LONGEST
    params:
        groups=of_config(program_groups.cycles_groups, "cycle_line"),
        code=code_of("namelists/write_namelist.py"),
    script:
        "../scripts/namelists/write_namelist.py"


rule cycles_runs:
    """Cycles along one parameter, stable and unstable, by continuation."""
    input:
        program="<build>/release/bin/cycles",
        namelist="{results}/namelists/cycles/{cycle_line}.nml",
    output:
        "{results}/cycles/{cycle_line}.nc",
    log:
        "{results}/logs/cycles/{cycle_line}.log",
    benchmark:
        "{results}/benchmarks/cycles/{cycle_line}.tsv"
    priority: OF_LONGEST
    params:
        groups=of_config(program_groups.cycles_groups, "cycle_line"),
        sources=digest_of("cycles"),
    shell:
        "{input.program:q} {input.namelist:q} {output:q} 2> {log:q} || {{ grep -v ' %, ' {log:q} >&2; exit 1; }}"


rule cycle_points:
    """Table of the points where cycles bifurcate."""
    input:
        cycles=placed(result_files.cycles_of_lines(LISTED)),
        routes=result_files.tables_of_routes(LISTED),
    output:
        "<results>/tables/cycle-points.tsv",
    log:
        "<results>/logs/tables/cycle-points.log",
    params:
        code=code_of("tables/cycle_points_table.py"),
    script:
        "../scripts/tables/cycle_points_table.py"
