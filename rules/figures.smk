# The figures, a rule of its name for each figure of scripts/figures/registry.py.


for figure in dict.fromkeys([*FIGURES, *SHOWN]):

    rule:
        name:
            figure
        input:
            **placed(registry.inputs_of(figure, DRAWN)),
        output:
            pdf=f"<results>/figures/{figure}.pdf",
            png=report(
                f"<results>/figures/{figure}.png",
                caption=Path.cwd() / caption_file(figure),
                category=registry.category_of(figure),
                labels={"figure": registry.title_of(figure).rstrip(".")},
            ),
            svg=f"<results>/figures/{figure}.svg",
        log:
            f"<results>/logs/figures/{figure}.log",
        priority: OF_PAPER if registry.category_of(figure) == "Figures" else 0
        params:
            **placed(registry.params_of(figure, DRAWN)),
            script=registry.script_of(figure),
            code=code_of(registry.script_of(figure), *tables_read([figure])),
        script:
            "../scripts/{params.script}"


rule captions:
    """Captions of all figures, filled with their numbers and the verdicts."""
    input:
        data=[
            path
            for figure in SHOWN
            for path in placed(registry.files_of(figure, DRAWN))
        ],
        claims=[] if OWN else "<results>/tables/claims.json",
    output:
        [caption_file(figure) for figure in SHOWN],
    log:
        "<results>/logs/figures/captions.log",
    params:
        figures=to_caption(),
        code=code_of(
            "figures/write_captions.py",
            *map(registry.template_of, SHOWN),
            *tables_read(SHOWN),
        ),
    script:
        "../scripts/figures/write_captions.py"


snakemake_internals.describe(
    workflow, {figure: registry.title_of(figure) for figure in [*FIGURES, *SHOWN]}
)
