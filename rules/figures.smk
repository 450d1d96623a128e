# The figures, a rule of its name for each entry of scripts/figures/entries.py.


for figure in FIGURES:

    rule:
        name:
            figure
        input:
            **entries.inputs_of(figure, config),
            code=code_of(f"figures/{figure}.py"),
        output:
            pdf=f"results/figures/{figure}.pdf",
            png=report(
                f"results/figures/{figure}.png",
                caption=Path.cwd() / entries.caption_of(figure),
                category=entries.ENTRIES[figure].category,
                labels={"figure": entries.title_of(figure).rstrip(".")},
            ),
            svg=f"results/figures/{figure}.svg",
        log:
            f"results/logs/figures/{figure}.log",
        priority: OF_PAPER if entries.ENTRIES[figure].category == "Figures" else 0
        params:
            **entries.params_of(figure, config),
            script=figure,
        script:
            "../scripts/figures/{params.script}.py"


rule captions:
    """Captions of all figures, filled with their numbers and the verdicts."""
    input:
        data=[path for figure in FIGURES for path in entries.files_of(figure, config)],
        templates=[entries.template_of(figure) for figure in FIGURES],
        claims="results/tables/claims.json",
        code=code_of("captions/write_captions.py"),
    output:
        [entries.caption_of(figure) for figure in FIGURES],
    log:
        "results/logs/figures/captions.log",
    params:
        figures=to_caption(),
    script:
        "../scripts/captions/write_captions.py"


snakemake_internals.describe(
    workflow, {figure: entries.title_of(figure) for figure in FIGURES}
)
