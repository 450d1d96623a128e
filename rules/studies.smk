# Measured runs and their references in quadruple precision: stability on stiff and extreme cases,
# and work against precision.


rule measurement_namelist:
    """Input of the runs of a family of stiff and extreme cases, or of a scene."""
    output:
        "{results}/namelists/measurements/{study}/{family}.nml",
    log:
        "{results}/logs/namelists/measurements/{study}/{family}.log",
    params:
        groups=of_config(program_groups.measurement_groups, "study", "family"),
        code=code_of("namelists/write_namelist.py"),
    script:
        "../scripts/namelists/write_namelist.py"


rule reference_namelist:
    """Input of the reference of a family of stiff and extreme cases, or of a scene."""
    output:
        "{results}/namelists/references/{study}/{family}.nml",
    log:
        "{results}/logs/namelists/references/{study}/{family}.log",
    params:
        groups=of_config(program_groups.reference_groups, "study", "family"),
        code=code_of("namelists/write_namelist.py"),
    script:
        "../scripts/namelists/write_namelist.py"


rule reference:
    """Solution of the same cases in quadruple precision."""
    input:
        program="<build>/release/bin/reference",
        namelist="{results}/namelists/references/{study}/{family}.nml",
    output:
        "{results}/references/{study}/{family}.tsv",
    log:
        "{results}/logs/references/{study}/{family}.log",
    benchmark:
        "{results}/benchmarks/references/{study}/{family}.tsv"
    priority: OF_LONG
    params:
        groups=of_config(program_groups.reference_groups, "study", "family"),
        sources=digest_of("reference"),
    shell:
        "{input.program:q} {input.namelist:q} {output:q} 2> {log:q} || {{ grep -v ' %, ' {log:q} >&2; exit 1; }}"


rule measurement:
    """Runs of the solver on test cases, by several methods and tolerances."""
    input:
        program="<build>/release/bin/measure",
        namelist="{results}/namelists/measurements/{study}/{family}.nml",
    output:
        "{results}/measurements/{study}/{family}.nc",
    log:
        "{results}/logs/measurements/{study}/{family}.log",
    benchmark:
        "{results}/benchmarks/measurements/{study}/{family}.tsv"
    params:
        groups=of_config(program_groups.measurement_groups, "study", "family"),
        sources=digest_of("measure"),
    shell:
        "{input.program:q} {input.namelist:q} {output:q} 2> {log:q} || {{ grep -v ' %, ' {log:q} >&2; exit 1; }}"


rule stability_table:
    """Table of the errors of the solver on stiff and extreme cases."""
    input:
        measurements=placed(result_files.runs_of_families(LISTED)),
        references=placed(result_files.references_of_families(LISTED)),
    output:
        "<results>/tables/stability.tsv",
    log:
        "<results>/logs/tables/stability.log",
    params:
        references={
            name: family["reference"]
            for name, family in LISTED["stability"]["families"].items()
        },
        code=code_of("tables/stability_table.py"),
    script:
        "../scripts/tables/stability_table.py"


rule trusted_horizons:
    """Table of the times up to which runs of the scenes can be compared."""
    input:
        measurements=placed(
            expand("<results>/measurements/trust/{scene}.nc", scene=WORK_SCENES)
        ),
        references=placed(
            expand("<results>/references/trust/{scene}.tsv", scene=WORK_SCENES)
        ),
    output:
        "<results>/tables/trusted-horizons.tsv",
    log:
        "<results>/logs/tables/trusted-horizons.log",
    params:
        trusted_error=MEASURED["trusted_error"],
        code=code_of("tables/trusted_horizons.py"),
    script:
        "../scripts/tables/trusted_horizons.py"


rule work_precision_namelist:
    """Input of the runs that compare error and run time on a scene."""
    input:
        horizons="<results>/tables/trusted-horizons.tsv",
    output:
        "<results>/namelists/measurements/work_precision/{work_scene}.nml",
    log:
        "<results>/logs/namelists/work_precision/{work_scene}.log",
    params:
        config={key: config[key] for key in ("scenes", "work_precision")},
        code=code_of("namelists/write_measured_scene.py"),
    script:
        "../scripts/namelists/write_measured_scene.py"


# The runs of a scene take turns, so that what else the machine does hits all methods alike.
rule work_precision_runs:
    """Errors and run times of all methods of the solver on a scene."""
    input:
        program="<build>/release/bin/measure",
        namelist="<results>/namelists/measurements/work_precision/{work_scene}.nml",
    output:
        "<results>/measurements/work_precision/{work_scene}.nc",
    log:
        "<results>/logs/measurements/work_precision/{work_scene}.log",
    benchmark:
        "<results>/benchmarks/measurements/work_precision/{work_scene}.tsv"
    priority: OF_LONG
    params:
        study=MEASURED,
        sources=digest_of("measure"),
    shell:
        "{input.program:q} {input.namelist:q} {output:q} 2> {log:q} || {{ grep -v ' %, ' {log:q} >&2; exit 1; }}"


rule work_precision_table:
    """Tables of error against run time, and of error against tolerance."""
    input:
        measurements=expand(
            "<results>/measurements/work_precision/{scene}.nc", scene=WORK_SCENES
        ),
        references=placed(
            expand("<results>/references/trust/{scene}.tsv", scene=WORK_SCENES)
        ),
    output:
        errors="<results>/tables/work-precision.tsv",
        proportionality="<results>/tables/tolerance-proportionality.tsv",
    log:
        "<results>/logs/tables/work-precision.log",
    params:
        code=code_of("tables/work_precision_table.py"),
    script:
        "../scripts/tables/work_precision_table.py"
