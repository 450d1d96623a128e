# Programs, each built when a result needs it.


rule build:
    """A Fortran program, built from its sources."""
    input:
        sources_of,
    output:
        "build/release/bin/{program}",
    log:
        "results/logs/build/{program}.log",
    priority: OF_PROGRAMS
    threads: 2
    # two builds must not write one build folder at the same time
    shell:
        "(flock 9"
        " && cmake --preset release -S fortran"
        " && cmake --build build/release --parallel {threads} --target {wildcards.program}_program)"
        " > {log} 2>&1 9> build/lock || {{ setup/build_needs.sh && cat {log} >&2; exit 1; }}"
