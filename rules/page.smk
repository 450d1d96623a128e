# The page that re-tells the paper; with results/ around it, it can be zipped and mailed.


rule page:
    """The page with figures, claims and verdicts: results/index.html."""
    input:
        figures=expand("<results>/figures/{figure}.svg", figure=FIGURES),
        claims="<results>/tables/claims.json",
        attractors="<results>/tables/attractors.tsv",
        fault_limit="<results>/tables/fault-limit.tsv",
        hopf_points="<results>/tables/hopf-points.tsv",
        stability="<results>/tables/stability.tsv",
        trajectories=trajectories_on_page(),
        play="<results>/page/play-data.js",
        captions=[figure["caption"] for figure in on_page()],
        library=library_of_page,
    output:
        page="<results>/index.html",
        times="<results>/times.html",
        assets=expand("<results>/page/{asset}", asset=page_assets.ASSETS),
    log:
        "<results>/logs/page.log",
    params:
        figures=on_page(),
        benchmarks=benchmarks_at_work(),
        commit=commit_at_work(),
        history=config["atlas"]["history"],
        code=code_of("page/write_page.py", *page_assets.files()),
    script:
        "../scripts/page/write_page.py"
