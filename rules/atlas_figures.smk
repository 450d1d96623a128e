# Figures of attractors: the atlas on its coarse and on its fine grid, the true torus, the route.


rule atlas_coarse:
    input:
        table="results/tables/atlas-coarse.tsv",
        curves=curves_of_atlas(),
        code=code_of("figures/atlas.py"),
    output:
        pdf="results/figures/atlas_coarse.pdf",
        png=report(
            "results/figures/atlas_coarse.png",
            caption="../scripts/figures/atlas_coarse.rst",
            category="Atlas",
        ),
        svg="results/figures/atlas_coarse.svg",
    log:
        "results/logs/figures/atlas_coarse.log",
    params:
        scenes=places_in_atlas(),
    script:
        "../scripts/figures/atlas.py"


use rule atlas_coarse as atlas with:
    input:
        table="results/tables/atlas-fine.tsv",
        curves=curves_of_atlas(),
        code=code_of("figures/atlas.py"),
    output:
        pdf="results/figures/atlas.pdf",
        png=report(
            "results/figures/atlas.png",
            caption="../scripts/figures/atlas.rst",
            category="Atlas",
        ),
        svg="results/figures/atlas.svg",
    log:
        "results/logs/figures/atlas.log",


rule true_torus:
    input:
        table="results/tables/attractors.tsv",
        trajectories=trajectories_of("true_torus"),
        attractors=attractors_of("true_torus"),
        spectra=spectra_of("true_torus"),
        code=code_of("figures/true_torus.py"),
    output:
        pdf="results/figures/true_torus.pdf",
        png=report(
            "results/figures/true_torus.png",
            caption="../scripts/figures/true_torus.rst",
            category="Atlas",
        ),
        svg="results/figures/true_torus.svg",
    log:
        "results/logs/figures/true_torus.log",
    params:
        settings=config["figures"]["true_torus"],
    script:
        "../scripts/figures/true_torus.py"


rule route_to_chaos:
    input:
        table="results/tables/route-to-chaos.tsv",
        runs=parts_of_route(),
        code=code_of("figures/route_to_chaos.py"),
    output:
        pdf="results/figures/route_to_chaos.pdf",
        png=report(
            "results/figures/route_to_chaos.png",
            caption="../scripts/figures/route_to_chaos.rst",
            category="Atlas",
        ),
        svg="results/figures/route_to_chaos.svg",
    log:
        "results/logs/figures/route_to_chaos.log",
    script:
        "../scripts/figures/route_to_chaos.py"
