# The page, and the data of the view in which a reader moves the parameters.
from scripts.page import page_assets
from scripts.workflow.git_commit import commit_of


def shown_on_page():
    """What the page shows of each figure beside its files."""
    return [
        {
            "name": name,
            "category": registry.entry_of(name).category,
            "caption": f"{plan.results}/figures/{name}.rst",
            "drawing": f"{plan.results}/figures/{name}.svg",
            "shows_classes": registry.entry_of(name).shows_classes,
            "data": [
                path.replace("<results>", plan.results)
                for path in registry.files_of(name, config)
                if path.startswith("<results>/")
            ],
        }
        for name in plan.figures
    ]


rule play_data:
    """Classes and motions of the atlas, for the view in which a reader moves the parameters."""
    input:
        runs=paths.parts_of_atlas(config),
        tables=(
            expand(
                "<results>/tables/atlas/{plane}.tsv", plane=config["atlas"]["planes"]
            )
            if plan.is_users
            else ["<results>/tables/atlas.tsv"]
        ),
    output:
        "<results>/page/play-data.js",
    log:
        "<results>/logs/page/play-data.log",
    localrule: True
    params:
        scenes=paths.places_in_atlas(config),
        code=code_of("page/play_data.py"),
    script:
        "../scripts/page/play_data.py"


rule page:
    """The page with figures, claims and verdicts: results/index.html."""
    input:
        **(
            {"tables": plan.tables()}
            if plan.is_users
            else {
                "fault_limit": "<results>/tables/fault-limit.tsv",
                "hopf_points": "<results>/tables/hopf-points.tsv",
                "stability": "<results>/tables/stability.tsv",
            }
        ),
        figures=expand("<results>/figures/{figure}.svg", figure=plan.figures),
        claims="<results>/tables/claims.json" if plan.claims else [],
        attractors="<results>/tables/attractors.tsv" if config["scenes"] else [],
        trajectories=plan.trajectories(),
        play="<results>/page/play-data.js" if config["atlas"]["planes"] else [],
        captions=expand("<results>/figures/{figure}.rst", figure=plan.figures),
        library=page_assets.library(),
    output:
        page="<results>/index.html",
        times=[] if plan.is_users else "<results>/times.html",
        assets=expand("<results>/page/{asset}", asset=page_assets.ASSETS),
    log:
        "<results>/logs/page.log",
    localrule: True
    params:
        figures=shown_on_page(),
        benchmarks={
            run.rule: f"{plan.results}/benchmarks/{run.stem}.tsv" for run in RUNS
        },
        commit=commit_of(Path.cwd()),
        history=config["atlas"]["history"],
        code=code_of(
            "page/own_page.py" if plan.is_users else "page/write_page.py",
            *page_assets.files(),
        ),
        script="own_page" if plan.is_users else "write_page",
    script:
        "../scripts/page/{params.script}.py"
