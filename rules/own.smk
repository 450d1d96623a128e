# What only a user's file has: tables of single planes of the atlas, and its page.


rule atlas_plane_table:
    """The table of one plane of the atlas."""
    input:
        runs=lambda wildcards: placed(
            result_files.parts_of_plane(config, wildcards.atlas_plane)
        ),
    output:
        "<results>/tables/atlas/{atlas_plane}.tsv",
    log:
        "<results>/logs/tables/atlas/{atlas_plane}.log",
    params:
        of="atlas",
        code=code_of("tables/attractor_tables.py"),
    script:
        "../scripts/tables/attractor_tables.py"


rule page:
    """The page of what a user's file adds: index.html in the folder of its results."""
    input:
        figures=expand("<results>/figures/{figure}.svg", figure=SHOWN),
        claims="<results>/tables/claims.json" if CLAIMS else [],
        attractors="<results>/tables/attractors.tsv" if NAMES["scenes"] else [],
        tables=tables_added(),
        trajectories=trajectories_on_page(),
        play="<results>/page/play-data.js" if NAMES["atlas"] else [],
        captions=[figure["caption"] for figure in on_page()],
        library=library_of_page,
    output:
        page="<results>/index.html",
        assets=expand("<results>/page/{asset}", asset=page_assets.ASSETS),
    log:
        "<results>/logs/page.log",
    params:
        figures=on_page(),
        commit=commit_at_work(),
        history=config["atlas"]["history"],
        code=code_of("page/own_page.py", *page_assets.files()),
    script:
        "../scripts/page/own_page.py"
