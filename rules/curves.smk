# Hopf curves, one file a plane.


rule hopf_namelist:
    output:
        "results/namelists/hopf/{plane}.nml",
    log:
        "results/logs/namelists/hopf/{plane}.log",
    params:
        group="hopf_curves",
        values=plane_values,
    script:
        "../scripts/write_namelist.py"


rule hopf_curves:
    input:
        program="build/release/bin/hopf",
        namelist="results/namelists/hopf/{plane}.nml",
    output:
        "results/hopf/{plane}.nc",
    log:
        "results/logs/hopf/{plane}.log",
    benchmark:
        "results/benchmarks/hopf/{plane}.tsv"
    shell:
        "{input.program} {input.namelist} {output} 2> {log} || {{ cat {log} >&2; exit 1; }}"
