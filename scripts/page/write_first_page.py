"""A first page of a run, with the paper's figures; the page with the verdicts comes at the end."""

import sys

from scripts.files.outputs import logged
from scripts.page.write_page import render, write_text

if __name__ == "__main__":
    page = snakemake.output[0]
    with logged(snakemake.log[0]):
        write_text(page, render("figures.html.jinja", figures=snakemake.params.figures))
    print(f"Figures 1 to 8 are drawn: open {page}; the verdicts follow", file=sys.stderr)
