# Programs, each built when a result needs it.
def sources_of(wildcards):
    """Sources that a program is built from: its own and all modules."""
    modules = glob_wildcards("fortran/src/{path}.{ending,f90|c|in}")
    return [
        "fortran/CMakeLists.txt",
        "fortran/CMakePresets.json",
        f"fortran/app/{wildcards.program}.f90",
        *expand("fortran/src/{path}.{ending}", zip, **modules._asdict()),
    ]


rule build:
    input:
        sources_of,
    output:
        "build/release/bin/{program}",
    log:
        "results/logs/build/{program}.log",
    # two builds must not write one build folder at the same time
    threads: workflow.cores
    shell:
        "(cmake --preset release -S fortran"
        " && cmake --build build/release --parallel {threads} --target {wildcards.program}_program)"
        " > {log} 2>&1 || {{ cat {log} >&2; exit 1; }}"
