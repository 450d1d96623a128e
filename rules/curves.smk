# Hopf curves, one file a plane.


rule hopf_namelist:
    """Input of the Hopf curves in a plane."""
    output:
        "{results}/namelists/hopf/{plane}.nml",
    log:
        "{results}/logs/namelists/hopf/{plane}.log",
    priority: OF_PAPER
    params:
        groups=of_config(program_groups.hopf_groups, "plane"),
        code=code_of("namelists/write_namelist.py"),
    script:
        "../scripts/namelists/write_namelist.py"


rule hopf_curves:
    """Hopf curves of steady sliding in a plane of two parameters."""
    input:
        program="<build>/release/bin/hopf",
        namelist="{results}/namelists/hopf/{plane}.nml",
    output:
        "{results}/hopf/{plane}.nc",
    log:
        "{results}/logs/hopf/{plane}.log",
    benchmark:
        "{results}/benchmarks/hopf/{plane}.tsv"
    priority: OF_PAPER
    params:
        groups=of_config(program_groups.hopf_groups, "plane"),
        sources=digest_of("hopf"),
    shell:
        "{input.program:q} {input.namelist:q} {output:q} 2> {log:q} || {{ grep -v ' %, ' {log:q} >&2; exit 1; }}"


rule hopf_points:
    """Table of the special points on the Hopf curves."""
    input:
        curves=placed(result_files.curves_of_planes(LISTED)),
        scenes=placed(
            result_files.paths_of_scenes("linear_stability", LISTED["scenes"])
        ),
    output:
        "<results>/tables/hopf-points.tsv",
    log:
        "<results>/logs/tables/hopf-points.log",
    params:
        code=code_of("tables/hopf_points_table.py"),
    script:
        "../scripts/tables/hopf_points_table.py"


rule fault_limit_table:
    """Table of the least epsilon of all Hopf curves over gamma, at the xi of Figure 2."""
    output:
        "<results>/tables/fault-limit.tsv",
    log:
        "<results>/logs/tables/fault-limit.log",
    params:
        xi=config["hopf_curves"]["tau_of_epsilon"]["fixed"],
        code=code_of("tables/fault_limit_table.py"),
    script:
        "../scripts/tables/fault_limit_table.py"
