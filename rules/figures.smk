# The paper's figures, each with its caption for the report.


rule figure_1:
    input:
        code=code_of("figures/figure_1.py"),
    output:
        pdf="results/figures/figure_1.pdf",
        png=report(
            "results/figures/figure_1.png",
            caption="../scripts/figures/figure_1.rst",
            category="Figures",
        ),
        svg="results/figures/figure_1.svg",
    log:
        "results/logs/figures/figure_1.log",
    script:
        "../scripts/figures/figure_1.py"


rule figure_2:
    input:
        curves="results/hopf/tau_of_epsilon.nc",
        code=code_of("figures/figure_2.py"),
    output:
        pdf="results/figures/figure_2.pdf",
        png=report(
            "results/figures/figure_2.png",
            caption="../scripts/figures/figure_2.rst",
            category="Figures",
        ),
        svg="results/figures/figure_2.svg",
    log:
        "results/logs/figures/figure_2.log",
    params:
        scenes=places_of_scenes(),
    script:
        "../scripts/figures/figure_2.py"


rule figure_3:
    input:
        curves="results/hopf/xi_of_epsilon.nc",
        code=code_of("figures/figure_3.py"),
    output:
        pdf="results/figures/figure_3.pdf",
        png=report(
            "results/figures/figure_3.png",
            caption="../scripts/figures/figure_3.rst",
            category="Figures",
        ),
        svg="results/figures/figure_3.svg",
    log:
        "results/logs/figures/figure_3.log",
    params:
        scenes=places_of_scenes(),
    script:
        "../scripts/figures/figure_3.py"


rule figure_4:
    input:
        trajectories=trajectories_of("figure_4"),
        code=code_of("figures/figure_4.py"),
    output:
        pdf="results/figures/figure_4.pdf",
        png=report(
            "results/figures/figure_4.png",
            caption="../scripts/figures/figure_4.rst",
            category="Figures",
        ),
        svg="results/figures/figure_4.svg",
    log:
        "results/logs/figures/figure_4.log",
    params:
        settings=config["figures"]["figure_4"],
    script:
        "../scripts/figures/figure_4.py"


rule figure_5:
    input:
        trajectories=trajectories_of("figure_5"),
        spectra=spectra_of("figure_5"),
        code=code_of("figures/figure_5.py"),
    output:
        pdf="results/figures/figure_5.pdf",
        png=report(
            "results/figures/figure_5.png",
            caption="../scripts/figures/figure_5.rst",
            category="Figures",
        ),
        svg="results/figures/figure_5.svg",
    log:
        "results/logs/figures/figure_5.log",
    params:
        settings=config["figures"]["figure_5"],
    script:
        "../scripts/figures/figure_5.py"


rule figure_6:
    input:
        spectra=spectra_of("figure_6"),
        code=code_of("figures/figure_6.py"),
    output:
        pdf="results/figures/figure_6.pdf",
        png=report(
            "results/figures/figure_6.png",
            caption="../scripts/figures/figure_6.rst",
            category="Figures",
        ),
        svg="results/figures/figure_6.svg",
    log:
        "results/logs/figures/figure_6.log",
    params:
        settings=config["figures"]["figure_6"],
    script:
        "../scripts/figures/figure_6.py"


rule figure_7:
    input:
        spectra=spectra_of("figure_7"),
        code=code_of("figures/figure_7.py"),
    output:
        pdf="results/figures/figure_7.pdf",
        png=report(
            "results/figures/figure_7.png",
            caption="../scripts/figures/figure_7.rst",
            category="Figures",
        ),
        svg="results/figures/figure_7.svg",
    log:
        "results/logs/figures/figure_7.log",
    params:
        settings=config["figures"]["figure_7"],
    script:
        "../scripts/figures/figure_7.py"


rule figure_8:
    input:
        response="results/friction/velocity_step.nc",
        code=code_of("figures/figure_8.py"),
    output:
        pdf="results/figures/figure_8.pdf",
        png=report(
            "results/figures/figure_8.png",
            caption="../scripts/figures/figure_8.rst",
            category="Figures",
        ),
        svg="results/figures/figure_8.svg",
    log:
        "results/logs/figures/figure_8.log",
    script:
        "../scripts/figures/figure_8.py"
