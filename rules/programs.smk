# Programs, each built when a result needs it, and their runs: scripts/results/programs.py lists them.


rule law:
    """The definition of a user's law of friction."""
    output:
        f"{BUILT}/laws/{{law}}.yaml",
    log:
        "<results>/logs/laws/{law}.log",
    priority: BUILD
    localrule: True
    params:
        definition=lambda wildcards: laws.definition(
            wildcards.law, config["laws"][wildcards.law]
        ),
        code=code_of("namelists/write_law.py"),
    script:
        "../scripts/namelists/write_law.py"


rule build:
    """A Fortran program, built from its sources and the user's laws."""

    # by time too: a program built by CMake alone has no record of its digest
    input:
        lambda wildcards: sources_of(wildcards.program),
        users=expand(f"{BUILT}/laws/{{law}}.yaml", law=config["laws"]),
    output:
        f"{BUILT}/bin/{{program}}",
    log:
        "<results>/logs/build/{program}.log",
    priority: BUILD
    localrule: True
    threads: 2
    params:
        digest=lambda wildcards: digest_of(wildcards.program),
        laws=";".join(
            str(Path.cwd() / BUILT / f"laws/{law}.yaml") for law in config["laws"]
        ),
    # two builds must not write one build folder at the same time
    shell:
        "(flock 9"
        " && folder=$(dirname {output:q})/.."
        " && cmake --preset release -S fortran -B $folder -DUSERS_LAWS={params.laws:q}"
        " && cmake --build $folder --parallel {threads} --target {wildcards.program:q}_program)"
        " > {log:q} 2>&1 9> build/lock || {{ cat {log:q} >&2; exit 1; }}"


for run in RUNS:
    if not run.namelist:

        rule:
            name:
                f"{run.rule}_namelist"
            input:
                horizons=f"<results>/{run.horizons}" if run.horizons else [],
            output:
                f"<results>/{run.namelist_path}",
            log:
                f"<results>/logs/namelists/{run.stem}.log",
            priority: run.priority
            localrule: True
            params:
                groups=groups_of(run),
                code=code_of("namelists/write_namelist.py"),
            script:
                "../scripts/namelists/write_namelist.py"

    rule:
        name:
            run.rule
        input:
            **{name: f"<results>/{path}" for name, path in run.needs.items()},
            program=f"{BUILT}/bin/{run.program}",
            namelist=f"<results>/{run.namelist_path}",
        output:
            f"<results>/{run.output}",
        log:
            f"<results>/logs/{run.stem}.log",
        benchmark:
            f"<results>/benchmarks/{run.stem}.tsv"
        priority: run.priority
        localrule: not run.takes_minutes
        params:
            groups=groups_of(run),
            sources=digest_of(run.program),
            laws=laws_of(run),
        shell:
            "OMP_NUM_THREADS={threads} {input.program:q} {input.namelist:q} {output:q}"
            " 2> {log:q} || {{ grep -v ' %, ' {log:q} >&2; exit 1; }}"


ruleorder: scene_attractors > attractors_runs
ruleorder: work_precision_runs > measurement
