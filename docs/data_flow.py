"""The picture of the data flow, made from the rules of the workflow.

    snakemake --filegraph all | docs/data_flow.py >docs/data-flow.svg

Reads the graph of rules and their files and draws it by Graphviz: a column for each stage, a box
for each rule with the first file it writes. `docs/draw` calls it.
"""

import html
import re
import subprocess
import sys
from dataclasses import dataclass

STAGES = {
    "config": ("config", "#f0e442"),
    "namelist": ("namelist", "#fbe9d0"),
    "program": ("program", "#dddddd"),
    "data": ("program's result", "#cfe8f7"),
    "table": ("table", "#cdeee2"),
    "figure": ("figure", "#f6dfec"),
    "page": ("page", "#ffffff"),
}
"""Title and colour of each stage, from left to right."""
TARGET = "all"
"""The rule that only asks for others; not drawn."""


@dataclass(frozen=True)
class Rule:
    """A rule and the files it writes."""

    name: str
    outputs: tuple[str, ...]

    @property
    def stage(self) -> str:
        """Where in the flow its first file stands."""
        first = self.outputs[0]
        if first.endswith(".nml"):
            return "namelist"
        if first.startswith("build/"):
            return "program"
        if first.endswith((".html", ".zip")):
            return "page"
        folder = first.split("/")[1]
        return {"tables": "table", "figures": "figure"}.get(folder, "data")


def read_filegraph(text: str) -> tuple[list[Rule], set[tuple[str, str]]]:
    """Rules but for the target, by name, and the pairs of rules of which one feeds the other."""
    rules = {}
    for number, label in re.findall(r"^(\d+) \[ (.*?)</table>>\]", text, re.DOTALL | re.MULTILINE):
        name = re.search(r'<b><font point-size="18">(\w+)</font></b>', label)[1]
        written = label.partition("output &rarr;")[2]
        files = re.findall(r'<font face="monospace">(.*?)</font>', written)
        # without the patterns that wildcards must match
        plain = (re.sub(r"\{(\w+),[^{}]*\}", r"{\1}", html.unescape(file)) for file in files)
        rules[number] = Rule(name, tuple(plain))
    kept = {number: rule.name for number, rule in rules.items() if rule.name != TARGET}
    edges = re.findall(r"^\s*(\d+) -> (\d+)$", text, re.MULTILINE)
    pairs = {(kept[a], kept[b]) for a, b in edges if a in kept and b in kept}
    return sorted((rules[number] for number in kept), key=lambda rule: rule.name), pairs


def graph(rules: list[Rule], pairs: set[tuple[str, str]]) -> str:
    """The rules for Graphviz; the order of lines depends on names only."""
    font = 'fontname="Helvetica,Arial,sans-serif"'
    lines = [
        "digraph data_flow {",
        f'rankdir=LR; bgcolor="white"; nodesep=0.08; ranksep=0.55; {font};',
        f'node [shape=box, style="filled,rounded", penwidth=0.6, margin="0.08,0.04", {font}];',
        'edge [color="#888888", arrowsize=0.5];',
    ]
    # a row of titles keeps the columns apart and in order
    found = {"config", *(rule.stage for rule in rules)}
    stages = {stage: look for stage, look in STAGES.items() if stage in found}
    for stage, (title, _) in stages.items():
        lines.append(f'title_{stage} [label="{title}", shape=plain, style="", fontsize=15];')
    lines.append(" -> ".join(f"title_{stage}" for stage in stages) + " [style=invis];")
    lines.append(
        f'config [id="config", label="config/config.yaml", fillcolor="{STAGES["config"][1]}"];'
    )
    for rule in rules:
        label = f"<b>{rule.name}</b><br/>" + (
            f'<font point-size="9">{html.escape(rule.outputs[0])}</font>'
        )
        colour = STAGES[rule.stage][1]
        look = f'fillcolor="{colour}", fontsize=11'
        lines.append(f'{rule.name} [id="{rule.name}", label=<{label}>, {look}];')
    for stage in stages:
        column = [f"title_{stage}", *(rule.name for rule in rules if rule.stage == stage)]
        column += ["config"] if stage == "config" else []
        lines.append(f"{{rank=same; {'; '.join(column)};}}")
    lines += [f"config -> {rule.name};" for rule in rules if rule.stage == "namelist"]
    lines += [f'{a} -> {b} [id="{a}.{b}"];' for a, b in sorted(pairs)]
    return "\n".join([*lines, "}"]) + "\n"


def compact(svg: str) -> str:
    """A drawing by Graphviz without comments and titles, a line for each box and arrow."""
    bare = re.sub(r"<!-- .*? -->\n|<title>.*?</title>\n", "", svg, flags=re.DOTALL)
    return re.sub(r'<g id="[^"]+" class="(?:node|edge)">.*?</g>', join_lines, bare, flags=re.DOTALL)


def join_lines(found: re.Match) -> str:
    """The lines that were found, as one."""
    return found[0].replace("\n", "")


if __name__ == "__main__":
    dot = graph(*read_filegraph(sys.stdin.read()))
    run = subprocess.run(["dot", "-Tsvg"], input=dot, stdout=subprocess.PIPE, text=True, check=True)
    sys.stdout.write(compact(run.stdout))
