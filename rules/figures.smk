# The figures, a rule of its name for each, and their captions.

for figure in plan.figures:

    rule:
        name:
            figure
        input:
            **registry.inputs_of(figure, config),
        output:
            pdf=f"<results>/figures/{figure}.pdf",
            png=report(
                f"<results>/figures/{figure}.png",
                caption=Path.cwd() / fill_in(registry.caption_of(figure)),
                category=registry.find(figure).category,
                labels={"figure": registry.title_of(figure).rstrip(".")},
            ),
            svg=f"<results>/figures/{figure}.svg",
        log:
            f"<results>/logs/figures/{figure}.log",
        priority: PAPER if registry.find(figure).category == "Figures" else 0
        localrule: True
        params:
            **fill_in(registry.params_of(figure, config)),
            module=registry.module_name(figure),
            code=code_of(
                "figures/make_figure.py", *drawings_of([figure]), *tables_read(figure)
            ),
        script:
            "../scripts/figures/make_figure.py"


rule captions:
    """Captions of all figures, filled with their numbers and the verdicts."""
    input:
        data=[
            path
            for figure in plan.figures
            for path in registry.files_of(figure, config)
        ],
        claims="<results>/tables/claims.json" if plan.claims else [],
    output:
        [registry.caption_of(figure) for figure in plan.figures],
    log:
        "<results>/logs/figures/captions.log",
    localrule: True
    params:
        figures=fill_in(
            [
                {
                    "name": name,
                    "inputs": registry.inputs_of(name, config),
                    "params": registry.params_of(name, config),
                }
                for name in plan.figures
            ]
        ),
        code=code_of(
            "figures/write_captions.py",
            *drawings_of(plan.figures),
            *map(registry.template_of, plan.figures),
            *(path for figure in plan.figures for path in tables_read(figure)),
        ),
    script:
        "../scripts/figures/write_captions.py"
