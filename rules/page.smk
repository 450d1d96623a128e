# The page.
from scripts.page import findings, page_assets
from scripts.workflow.git_commit import commit_of

PAPERS = [
    figure for figure in studies.paper_figures().values() if figure.category == MAIN
]
"""Figures 1 to 8."""
PLAY = "<results>/page/play-data.js"
"""Data of the view in which a reader moves the parameters, which the atlas has."""


rule first_page:
    """A page with the paper's figures alone, made while the rest is computed."""
    input:
        [f"<results>/figures/{figure.name}.svg" for figure in PAPERS],
    output:
        "<results>/figures.html",
    log:
        "<results>/logs/first-page.log",
    priority: PAPER
    localrule: True
    params:
        figures=[{"name": figure.name, "title": figure.title} for figure in PAPERS],
        code=code_of(
            "page/write_first_page.py", "scripts/page/templates/figures.html.jinja"
        ),
    script:
        "../scripts/page/write_first_page.py"


rule page:
    """The page with figures, claims and verdicts: index.html in the folder of results."""
    input:
        **{
            name: made(path)
            for name, path in findings.tables_read().items()
            if not plan.is_users
        },
        figures=expand("<results>/figures/{figure}.svg", figure=plan.figures),
        captions=expand("<results>/figures/{figure}.rst", figure=plan.figures),
        claims="<results>/tables/claims.json" if plan.claims else [],
        tables=[path for path in plan.tables() if plan.is_users and made(path)],
        play=made(PLAY) if studies.inside(config, ("atlas", "planes")) else [],
    output:
        page="<results>/index.html",
        assets=expand("<results>/page/{asset}", asset=page_assets.ASSETS),
    log:
        "<results>/logs/page.log",
    localrule: True
    params:
        figures=figures_on_page(),
        is_users=plan.is_users,
        failed=failed,
        unmade=unmade,
        history=studies.inside(config, ("atlas", "history")),
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
