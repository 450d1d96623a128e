# Response of friction to a velocity step.
rule velocity_step_namelist:
    """Input of the friction after a velocity step."""
    output:
        "<results>/namelists/velocity_step.nml",
    log:
        "<results>/logs/namelists/velocity_step.log",
    priority: OF_PAPER
    params:
        groups=program_groups.velocity_step_groups(config),
        code=code_of("namelists/write_namelist.py"),
    script:
        "../scripts/namelists/write_namelist.py"


rule velocity_step:
    """Friction after a step of the velocity, from (1.1) and (1.2)."""
    input:
        program="<build>/release/bin/velocity_step",
        namelist="<results>/namelists/velocity_step.nml",
    output:
        "<results>/friction/velocity_step.nc",
    log:
        "<results>/logs/friction/velocity_step.log",
    benchmark:
        "<results>/benchmarks/friction/velocity_step.tsv"
    priority: OF_PAPER
    params:
        groups=program_groups.velocity_step_groups(config),
        sources=digest_of("velocity_step"),
    shell:
        "{input.program:q} {input.namelist:q} {output:q} 2> {log:q} || {{ grep -v ' %, ' {log:q} >&2; exit 1; }}"
