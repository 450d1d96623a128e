# The page of the run; with the folder of results around it, it can be zipped and mailed.


def figures_on_page():
    """What the page shows of each figure."""
    return [
        {
            "name": figure,
            "category": registry.category_of(figure),
            "caption": f"{plan.results}/figures/{figure}.rst",
            "drawing": f"{plan.results}/figures/{figure}.svg",
            "shows_classes": registry.shows_classes(figure),
            "measured": manifest.is_measured(f"figures/{figure}"),
            "data": [
                path.replace("<results>", plan.results)
                for path in registry.files_of(figure, plan.config)
                if path.startswith("<results>/")
            ],
        }
        for figure in plan.figures
    ]


def trajectories_on_page():
    """Trajectory files that can be zoomed into: those that figures draw."""
    files = [path for figure in figures_on_page() for path in figure["data"]]
    return [path for path in dict.fromkeys(files) if "/trajectories/" in path]


rule play_data:
    """Classes and motions of the atlas, for the view in which a reader moves the parameters."""
    input:
        runs=result_files.parts_of_atlas(plan.config),
        tables=tables_of_atlas(),
    output:
        "<results>/page/play-data.js",
    log:
        "<results>/logs/page/play-data.log",
    params:
        scenes=result_files.places_in_atlas(plan.config),
        code=code_of("page/play_data.py"),
    script:
        "../scripts/page/play_data.py"


rule page:
    """The page with figures, claims and verdicts: index.html in the folder of results."""
    input:
        figures=expand("<results>/figures/{figure}.svg", figure=plan.figures),
        captions=expand("<results>/figures/{figure}.rst", figure=plan.figures),
        claims="<results>/tables/claims.json" if plan.claims else [],
        attractors="<results>/tables/attractors.tsv" if plan.config["scenes"] else [],
        fault_limit=[] if plan.is_users else "<results>/tables/fault-limit.tsv",
        hopf_points=[] if plan.is_users else "<results>/tables/hopf-points.tsv",
        stability=[] if plan.is_users else "<results>/tables/stability.tsv",
        tables=tables_of_run() if plan.is_users else [],
        trajectories=trajectories_on_page(),
        play="<results>/page/play-data.js" if plan.config["atlas"]["planes"] else [],
        library=[path for path in page_assets.ASSETS.values() if path.startswith("/")],
    output:
        page="<results>/index.html",
        times="<results>/times.html",
        assets=expand("<results>/page/{asset}", asset=page_assets.ASSETS),
    log:
        "<results>/logs/page.log",
    params:
        figures=figures_on_page(),
        is_users=plan.is_users,
        history=plan.config["atlas"]["history"],
        commit=git_commit.commit_of(PROJECT),
        packages=packages.versions(),
        code=code_of("page/write_page.py", *page_assets.list_files()),
    script:
        "../scripts/page/write_page.py"
