# One trajectory a scene.


rule scene_namelist:
    """Input of the trajectory of a scene."""
    output:
        "{results}/namelists/trajectories/{scene}.nml",
    log:
        "{results}/logs/namelists/trajectories/{scene}.log",
    priority: OF_PAPER
    params:
        groups=of_config(program_groups.scene_groups, "scene"),
        code=code_of("namelists/write_namelist.py"),
    script:
        "../scripts/namelists/write_namelist.py"


rule trajectory:
    """Trajectory of a scene: theta, u and v over time."""
    input:
        program="<build>/release/bin/trajectory",
        namelist="{results}/namelists/trajectories/{scene}.nml",
    output:
        "{results}/trajectories/{scene}.nc",
    log:
        "{results}/logs/trajectories/{scene}.log",
    benchmark:
        "{results}/benchmarks/trajectories/{scene}.tsv"
    priority: OF_PAPER
    params:
        groups=of_config(program_groups.scene_groups, "scene"),
        sources=digest_of("trajectory"),
    shell:
        "{input.program:q} {input.namelist:q} {output:q} 2> {log:q} || {{ grep -v ' %, ' {log:q} >&2; exit 1; }}"
