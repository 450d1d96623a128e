# The figures, a rule of its name for each entry of scripts/figures/entries.py.


for figure in dict.fromkeys([*FIGURES, *SHOWN]):

    rule:
        name:
            figure
        input:
            **placed(entries.inputs_of(figure, DRAWN)),
        output:
            pdf=f"<results>/figures/{figure}.pdf",
            png=report(
                f"<results>/figures/{figure}.png",
                caption=Path.cwd() / caption_file(figure),
                category=entries.entry_of(figure).category,
                labels={"figure": entries.title_of(figure).rstrip(".")},
            ),
            svg=f"<results>/figures/{figure}.svg",
        log:
            f"<results>/logs/figures/{figure}.log",
        priority: OF_PAPER if entries.entry_of(figure).category == "Figures" else 0
        params:
            **placed(entries.params_of(figure, DRAWN)),
            script=entries.script_of(figure),
            code=code_of(
                f"figures/{entries.script_of(figure)}.py", *tables_read([figure])
            ),
        script:
            "../scripts/figures/{params.script}.py"


rule captions:
    """Captions of all figures, filled with their numbers and the verdicts."""
    input:
        data=[
            path
            for figure in SHOWN
            for path in placed(entries.files_of(figure, DRAWN))
        ],
        claims=[] if OWN else "<results>/tables/claims.json",
    output:
        [caption_file(figure) for figure in SHOWN],
    log:
        "<results>/logs/figures/captions.log",
    params:
        figures=to_caption(),
        code=code_of(
            "captions/write_captions.py",
            *map(entries.template_of, SHOWN),
            *tables_read(SHOWN),
        ),
    script:
        "../scripts/captions/write_captions.py"


snakemake_internals.describe(
    workflow, {figure: entries.title_of(figure) for figure in [*FIGURES, *SHOWN]}
)
