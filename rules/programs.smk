# Programs, each built when a result needs it, and their runs: the plans in scripts/studies/ declare them.
import json


rule definition:
    """The definition of a user's law of friction, or of a user's model."""
    output:
        f"{BUILT}/definitions/{{defined}}.yaml",
    log:
        "<results>/logs/definitions/{defined}.log",
    priority: BUILD
    localrule: True
    params:
        # JSON is YAML, too
        definition=lambda wildcards: json.dumps(
            of_user(config)[wildcards.defined], indent=2
        ),
    shell:
        "printf '%s\\n' {params.definition:q} >{output:q} 2>{log:q}"


rule program:
    """The program, in double or in quadruple precision, built from its sources."""
    output:
        "build/release/bin/spring_block{quad}",
    log:
        "<results>/logs/build/spring_block{quad}.log",
    priority: BUILD
    localrule: True
    threads: 2
    params:
        digest=digest_of_program(),
    # two builds must not write one build folder at the same time
    shell:
        "said=$( (flock 9"
        " && cmake --preset release -S fortran"
        " && cmake --build build/release --parallel {threads} --target spring_block{wildcards.quad:q})"
        ' 2>&1 9> build/lock | tee {log:q}) || {{ echo "$said" >&2; exit 1; }}'


rule model:
    """A model, compiled from its definition: the program opens it by name."""
    input:
        # of the project's files the digest decides: in a fresh clone they are younger than all results
        lambda wildcards: [
            path if path.startswith(BUILT) else ancient(path)
            for path in compiled.parts_of(wildcards.model, config, wildcards.built)
        ],
    output:
        "{built}/models{quad}/{model}.so",
    log:
        "<results>/logs/{built}/models{quad}/{model}.log",
    priority: BUILD
    localrule: True
    params:
        digest=lambda wildcards: digest_of_model(wildcards.model),
    shell:
        "said=$(python -P -m generator {input:q} {output:q}"
        ' 2>&1 | tee {log:q}) || {{ echo "$said" >&2; exit 1; }}'


rule network:
    """Nodes and edges of a user's network, beside its compiled model."""
    input:
        lambda wildcards: networks.files_of(models(config)[wildcards.model].network),
    output:
        "{built}/models{quad}/{model}.network",
    log:
        "<results>/logs/{built}/models{quad}/{model}_network.log",
    priority: BUILD
    localrule: True
    params:
        network=lambda wildcards: models(config)[wildcards.model].network,
        code=code_of("models/network_numbers.py"),
    script:
        "../scripts/models/network_numbers.py"


for run in RUNS:

    rule:
        name:
            run.rule
        input:
            **{name: f"<results>/{path}" for name, path in run.needs.items()},
            program=f"build/release/bin/{run.program}",
            models=functools.partial(objects_of, run),
        output:
            f"<results>/{run.output}",
            namelist=f"<results>/namelists/{stem_of(run.output)}.nml",
        log:
            f"<results>/logs/{stem_of(run.output)}.log",
        benchmark:
            f"<results>/benchmarks/{stem_of(run.output)}.tsv"
        priority: run.priority
        localrule: not run.minutes
        resources:
            mem_mb=1000,
            runtime=run.minutes,
        params:
            namelist=functools.partial(namelist_of, run),
            before=functools.partial(namelists_before, run),
            sources=digest_of_program("scripts/workflow/run_program.sh"),
            models=functools.partial(digests_of_models, run),
            command=run.command,
            folders=":".join(compiled.folders_of(config, BUILT, run.quad)),
        script:
            "../scripts/workflow/run_program.sh"
