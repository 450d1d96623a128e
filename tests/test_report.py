"""The report of Snakemake and its captions."""

import json
import re
import zipfile

from conftest import SMOKE
from scripts.plans.studies import paper_figures


def test_report_holds_figures_captions_and_verdicts(smoke, tmp_path):
    """In one file; the longest plain part of each caption stands for the whole."""
    report, figures = tmp_path / "report.zip", paper_figures()
    run = smoke.snakemake(*SMOKE, "--report", str(report))
    assert run.returncode == 0, run.stdout
    with zipfile.ZipFile(report) as parts:
        files = {name.split("/")[-1] for name in parts.namelist()}
        text = parts.read("report/report.html").decode()
    assert {"claims.tsv", *(f"{figure}.png" for figure in figures)} <= files
    text = " ".join(text.replace("\\n", " ").split())
    for figure in figures.values():
        caption = (smoke.folder / f"results/figures/{figure.name}.rst").read_text()
        paragraphs = [" ".join(one.split()) for one in caption.replace(":math:", "").split("\n\n")]
        plain = [part for one in paragraphs for part in re.findall(r"[\w ,;:.()-]+", one)]
        assert max(plain, key=len).strip() in text
        assert f"{figure.name}.png" in text
        assert json.dumps({"figure": figure.title.rstrip(".")})[1:-1] in text
    assert '"content": "Verdicts"' in text
