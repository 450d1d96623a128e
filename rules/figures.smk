# The figures, a rule of its name for each entry of scripts/figures/entries.py.


for figure in dict.fromkeys([*FIGURES, *SHOWN]):

    rule:
        name:
            figure
        input:
            **placed(entries.inputs_of(figure, DRAWN)),
            code=code_of(f"figures/{entries.script_of(figure)}.py"),
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
        templates=[of_project(entries.template_of(figure)) for figure in SHOWN],
        claims=[] if OWN else "<results>/tables/claims.json",
        code=code_of("captions/write_captions.py"),
    output:
        [caption_file(figure) for figure in SHOWN],
    log:
        "<results>/logs/figures/captions.log",
    params:
        figures=to_caption(),
    script:
        "../scripts/captions/write_captions.py"


snakemake_internals.describe(
    workflow, {figure: entries.title_of(figure) for figure in [*FIGURES, *SHOWN]}
)
