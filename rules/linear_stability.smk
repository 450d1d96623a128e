# Linear stability of steady sliding, one file a scene.


rule linear_stability_namelist:
    """Input of the linear stability of steady sliding in a scene."""
    output:
        "{results}/namelists/linear_stability/{scene}.nml",
    log:
        "{results}/logs/namelists/linear_stability/{scene}.log",
    params:
        groups=of_config(program_groups.linear_stability_groups, "scene"),
        code=code_of("namelists/write_namelist.py"),
    script:
        "../scripts/namelists/write_namelist.py"


rule linear_stability:
    """Characteristic roots of steady sliding at the parameters of a scene."""
    input:
        program="<build>/release/bin/linear_stability",
        namelist="{results}/namelists/linear_stability/{scene}.nml",
    output:
        "{results}/linear_stability/{scene}.nc",
    log:
        "{results}/logs/linear_stability/{scene}.log",
    benchmark:
        "{results}/benchmarks/linear_stability/{scene}.tsv"
    params:
        groups=of_config(program_groups.linear_stability_groups, "scene"),
        sources=digest_of("linear_stability"),
    shell:
        "{input.program:q} {input.namelist:q} {output:q} 2> {log:q} || {{ grep -v ' %, ' {log:q} >&2; exit 1; }}"


rule linear_stability_table:
    """Table of the linear stability of steady sliding in the scenes."""
    input:
        scenes=placed(
            result_files.paths_of_scenes("linear_stability", LISTED["scenes"])
        ),
    output:
        "<results>/tables/linear-stability.tsv",
    log:
        "<results>/logs/tables/linear-stability.log",
    params:
        code=code_of("tables/linear_stability_table.py"),
    script:
        "../scripts/tables/linear_stability_table.py"
