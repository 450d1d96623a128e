# The page that re-tells the paper; with results/ around it, it can be zipped and mailed.


rule play_data:
    """Classes and motions of the atlas, for the view in which a reader moves the parameters."""
    input:
        runs=result_files.parts_of_atlas(config),
        tables=[LEDGER_TABLES["atlas"]],
        code=code_of("page/play_data.py"),
    output:
        "results/page/play-data.js",
    log:
        "results/logs/page/play-data.log",
    params:
        scenes=result_files.places_in_atlas(config),
    script:
        "../scripts/page/play_data.py"


rule page:
    """The page with figures, claims and verdicts: results/index.html."""
    input:
        figures=expand("results/figures/{figure}.svg", figure=FIGURES),
        claims="results/tables/claims.json",
        attractors=LEDGER_TABLES["attractors"],
        hopf_points=LEDGER_TABLES["hopf_points"],
        stability=LEDGER_TABLES["stability"],
        trajectories=trajectories_on_page(),
        play="results/page/play-data.js",
        captions=[figure["caption"] for figure in on_page()],
        readme="README.md",
        citation="CITATION.cff",
        equations="page/equations.yaml",
        template="page/index.html.jinja",
        parts=page_assets.PARTS,
        assets=assets_of_page,
        code=code_of("page/write_page.py"),
    output:
        page="results/index.html",
        assets=expand("results/page/{asset}", asset=page_assets.ASSETS),
    log:
        "results/logs/page.log",
    params:
        figures=on_page(),
        benchmarks=snakemake_internals.benchmarks_of(workflow, rules),
        commit=commit_at_work(),
        history=config["atlas"]["history"],
    script:
        "../scripts/page/write_page.py"
