# Programs, each built when a result needs it.


rule build:
    """A Fortran program, built from its sources."""

    # by time too: a program built by CMake alone has no record of its digest
    input:
        sources_of,
    output:
        "<build>/release/bin/{program}",
    log:
        "<results>/logs/build/{program}.log",
    priority: OF_PROGRAMS
    threads: 2
    params:
        fortran=of_project("fortran"),
        build=lambda wildcards, output: Path(output[0]).parents[2],
        needs=of_project("setup/build_needs.sh"),
        digest=digest_of_sources,
    # two builds must not write one build folder at the same time
    shell:
        "(flock 9"
        " && cmake --preset release -S {params.fortran:q}"
        " && cmake --build {params.build:q}/release --parallel {threads}"
        " --target {wildcards.program:q}_program)"
        " > {log:q} 2>&1 9> {params.build:q}/lock || {{ {params.needs:q} && cat {log:q} >&2; exit 1; }}"
