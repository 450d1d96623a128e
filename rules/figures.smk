# The figures, a rule of its name for each, and their captions.
from scripts.figures import entries as registry


def tables_read(figure):
    """Tables of the project that a figure reads beside results."""
    return [
        path
        for path in registry.files_of(figure, config)
        if not path.startswith("<results>/")
    ]


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
                caption=Path.cwd() / plan.results / "figures" / f"{figure}.rst",
                category=registry.entry_of(figure).category,
                labels={"figure": registry.title_of(figure).rstrip(".")},
            ),
            svg=f"<results>/figures/{figure}.svg",
        log:
            f"<results>/logs/figures/{figure}.log",
        priority: PAPER if registry.entry_of(figure).category == "Figures" else 0
        localrule: True
        params:
            **fill_in(registry.params_of(figure, config)),
            script=registry.script_of(figure),
            code=code_of(
                f"figures/{registry.script_of(figure)}.py", *tables_read(figure)
            ),
        script:
            "../scripts/figures/{params.script}.py"


rule captions:
    """Captions of all figures, filled with their numbers and the verdicts."""
    input:
        data=[
            path
            for figure in plan.figures
            for path in registry.files_of(figure, config)
        ],
        claims=[] if plan.is_users else "<results>/tables/claims.json",
    output:
        expand("<results>/figures/{figure}.rst", figure=plan.figures),
    log:
        "<results>/logs/figures/captions.log",
    localrule: True
    params:
        figures=fill_in(
            [
                {
                    "name": registry.name_of_caption(name),
                    "template": registry.template_of(name),
                    "inputs": registry.inputs_of(name, config),
                    "params": registry.params_of(name, config),
                }
                for name in plan.figures
            ]
        ),
        code=code_of(
            "captions/write_captions.py",
            *map(registry.template_of, plan.figures),
            *(path for figure in plan.figures for path in tables_read(figure)),
        ),
    script:
        "../scripts/captions/write_captions.py"
