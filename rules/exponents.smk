# Lyapunov exponents of the scenes that ask for them.


rule exponents_namelist:
    """Input of the Lyapunov exponents of a scene."""
    output:
        "{results}/namelists/exponents/{scene}.nml",
    log:
        "{results}/logs/namelists/exponents/{scene}.log",
    params:
        groups=of_config(program_groups.exponents_groups, "scene"),
        code=code_of("namelists/write_namelist.py"),
    script:
        "../scripts/namelists/write_namelist.py"


rule exponents_runs:
    """Lyapunov exponents of a scene."""
    input:
        program="<build>/release/bin/exponents",
        namelist="{results}/namelists/exponents/{scene}.nml",
    output:
        "{results}/exponents/{scene}.nc",
    log:
        "{results}/logs/exponents/{scene}.log",
    benchmark:
        "{results}/benchmarks/exponents/{scene}.tsv"
    priority: OF_LONG
    params:
        groups=of_config(program_groups.exponents_groups, "scene"),
        sources=digest_of("exponents"),
    shell:
        "{input.program:q} {input.namelist:q} {output:q} 2> {log:q} || {{ grep -v ' %, ' {log:q} >&2; exit 1; }}"


rule exponents_table:
    """Table of the Lyapunov exponents of the scenes."""
    input:
        runs=placed(result_files.exponents_of_scenes(LISTED)),
    output:
        "<results>/tables/exponents.tsv",
    log:
        "<results>/logs/tables/exponents.log",
    params:
        code=code_of("tables/exponents_table.py"),
    script:
        "../scripts/tables/exponents_table.py"
