"""The report of Snakemake and its captions."""

import json
import re
import zipfile

from conftest import SMOKE

from scripts.plans.registry import FIGURES, title_of


def test_report_holds_figures_captions_and_verdicts(smoke, tmp_path):
    """In one file; the longest plain part of each caption stands for the whole."""
    report = tmp_path / "report.zip"
    run = smoke.snakemake(*SMOKE, "--report", str(report))
    assert run.returncode == 0, run.stdout
    with zipfile.ZipFile(report) as parts:
        files = {name.split("/")[-1] for name in parts.namelist()}
        assert {"claims.tsv", *(f"{figure}.png" for figure in FIGURES)} <= files
        text = parts.read("report/report.html").decode()
    text = " ".join(text.replace("\\n", " ").split())
    for figure in FIGURES:
        caption = (smoke.folder / f"results/figures/{figure}.rst").read_text()
        plain_parts = re.findall(
            r"(?:[\w ,;:.()-]|(?<!\n)\n(?!\n))+", caption.replace(":math:", "")
        )
        assert " ".join(max(plain_parts, key=len).split()) in text
        assert f"{figure}.png" in text
        assert json.dumps({"figure": title_of(figure).rstrip(".")})[1:-1] in text
    assert '"content": "Verdicts"' in text
