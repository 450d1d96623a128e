# The page, and the data of the view in which a reader moves the parameters.
from scripts.page import findings, page_assets
from scripts.workflow.git_commit import commit_of


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


rule first_page:
    """A page with the paper's figures alone, made while the rest is computed."""
    input:
        expand("<results>/figures/{figure}.svg", figure=registry.PAPERS),
    output:
        "<results>/figures.html",
    log:
        "<results>/logs/first-page.log",
    priority: PAPER
    localrule: True
    params:
        figures=[
            {"name": name, "title": registry.title_of(name)}
            for name in registry.PAPERS
        ],
        code=code_of("page/write_first_page.py", "page/figures.html.jinja"),
    script:
        "../scripts/page/write_first_page.py"


rule page:
    """The page with figures, claims and verdicts: index.html in the folder of results."""
    input:
        **{
            name: made(f"<results>/tables/{name.replace('_', '-')}.tsv")
            for name in findings.TABLES
            if not plan.is_users
        },
        figures=expand("<results>/figures/{figure}.svg", figure=plan.figures),
        captions=expand("<results>/figures/{figure}.rst", figure=plan.figures),
        claims="<results>/tables/claims.json" if plan.claims else [],
        attractors=made("<results>/tables/attractors.tsv") if config["scenes"] else [],
        tables=[path for path in plan.tables() if plan.is_users and made(path)],
        trajectories=plan.trajectories(),
        play=made("<results>/page/play-data.js") if config["atlas"]["planes"] else [],
        library=[path for path in page_assets.ASSETS.values() if path.startswith("/")],
    output:
        page="<results>/index.html",
        times="<results>/times.html",
        assets=expand("<results>/page/{asset}", asset=page_assets.ASSETS),
    log:
        "<results>/logs/page.log",
    localrule: True
    params:
        figures=figures_on_page(),
        is_users=plan.is_users,
        failed=failed,
        unmade=unmade,
        history=config["atlas"]["history"],
        commit=commit_of(Path.cwd()),
        code=code_of("page/write_page.py", *page_assets.list_files()),
    script:
        "../scripts/page/write_page.py"


rule single_page:
    """The page as one file, which opens at any place and without network."""
    input:
        rules.page.output.assets,
        page=rules.page.output.page,
    output:
        "<results>/single-page.html",
    log:
        "<results>/logs/single-page.log",
    localrule: True
    params:
        code=code_of("page/write_single_page.py"),
    script:
        "../scripts/page/write_single_page.py"
