# Slip events of a scene, by its trajectory's namelist.


rule slip_events:
    """Slip events of a scene: their times, slips and recurrence times."""
    input:
        program="<build>/release/bin/slip_events",
        namelist="{results}/namelists/trajectories/{scene}.nml",
    output:
        "{results}/slip_events/{scene}.nc",
    log:
        "{results}/logs/slip_events/{scene}.log",
    benchmark:
        "{results}/benchmarks/slip_events/{scene}.tsv"
    params:
        groups=of_config(program_groups.scene_groups, "scene"),
        sources=digest_of("slip_events"),
    shell:
        "{input.program:q} {input.namelist:q} {output:q} 2> {log:q} || {{ grep -v ' %, ' {log:q} >&2; exit 1; }}"
