# Power spectra of v, one a scene.


rule spectrum_namelist:
    """Input of the power spectrum of a scene."""
    output:
        "{results}/namelists/spectra/{scene}.nml",
    log:
        "{results}/logs/namelists/spectra/{scene}.log",
    priority: OF_PAPER
    params:
        groups=spectrum_groups,
        code=code_of("namelists/write_namelist.py"),
    script:
        "../scripts/namelists/write_namelist.py"


rule spectrum:
    """Power spectrum of the velocity of a scene, with its peaks and fundamental frequencies."""
    input:
        program="<build>/release/bin/spectrum",
        namelist="{results}/namelists/spectra/{scene}.nml",
        trajectory=trajectory_of,
    output:
        "{results}/spectra/{scene}.nc",
    log:
        "{results}/logs/spectra/{scene}.log",
    benchmark:
        "{results}/benchmarks/spectra/{scene}.tsv"
    priority: OF_PAPER
    params:
        groups=spectrum_groups,
        sources=digest_of("spectrum"),
    shell:
        "{input.program:q} {input.namelist:q} {output:q} 2> {log:q} || {{ grep -v ' %, ' {log:q} >&2; exit 1; }}"
