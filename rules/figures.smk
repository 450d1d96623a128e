# The figures, a rule of its name for each, and their captions.

for figure in plan.figures.values():

    rule:
        name:
            figure.name
        input:
            **figure.inputs_of(config),
        output:
            pdf=f"<results>/figures/{figure.name}.pdf",
            png=report(
                f"<results>/figures/{figure.name}.png",
                caption=Path.cwd() / fill_in(figure.filled_caption),
                category=figure.category,
                labels={"figure": figure.title.rstrip(".")},
            ),
            svg=f"<results>/figures/{figure.name}.svg",
            numbers=f"<results>/figures/{figure.name}.json",
        log:
            f"<results>/logs/figures/{figure.name}.log",
        priority: PAPER if figure.category == MAIN else 0
        localrule: True
        params:
            **fill_in(figure.params_of(config)),
            module=figure.drawing,
            code=code_of(
                "drawing/make_figure.py",
                *modules_of(drawing_of(figure)),
                *tables_read(figure),
            ),
        script:
            "../scripts/drawing/make_figure.py"


rule captions:
    """Captions of all figures, filled with their numbers and the verdicts."""
    input:
        numbers=[f"<results>/figures/{name}.json" for name in plan.figures],
        claims="<results>/tables/claims.json" if plan.claims else [],
    output:
        [figure.filled_caption for figure in plan.figures.values()],
    log:
        "<results>/logs/figures/captions.log",
    localrule: True
    params:
        templates=[figure.template for figure in plan.figures.values()],
        paper=not plan.is_users,
        code=code_of(
            "drawing/write_captions.py",
            *(figure.template for figure in plan.figures.values()),
        ),
    script:
        "../scripts/drawing/write_captions.py"
