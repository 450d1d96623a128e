"""The form of the scripts in findings/; what they find is seen by running them."""

import os
import re

import pytest

from conftest import ROOT, project_files

FINDINGS = [name for name in project_files() if name.startswith("findings/")]
PINNED = r"[\w.-]+==?(\d[\w.+-]*|\$version)"


@pytest.mark.parametrize("name", FINDINGS)
def test_form(name):
    """Name, sentences of the head, a folder that goes, pinned packages, a way to fail, not ours."""
    assert re.fullmatch(r"findings/[a-z0-9]+(_[a-z0-9]+)+\.sh", name)
    assert os.access(ROOT / name, os.X_OK)
    head, _, code = (ROOT / name).read_text().partition("\nset -euo pipefail\n")
    assert re.match(r"#!/usr/bin/env bash\n# [^\n]*\d+\.\d+[^\n]*\.\n#\n", head)
    words = re.findall(r"^# (\w+): .", head, re.MULTILINE)
    assert words in (found := ["Expected", "Seen", "Matters"], [*found, "Needs"])
    assert code.startswith("folder=$(mktemp -d)\ntrap 'rm -rf \"$folder\"' EXIT\n")
    lines = re.findall(r"(?:pip\"? install|apt-get download) (.*)", code)
    packages = [word.strip('"') for line in lines for word in line.split() if word[0] != "-"]
    assert packages
    assert [word for word in packages if not re.fullmatch(PINNED, word)] == []
    assert re.search(r"sys\.exit\(|exit 1|quit\(status = 1", code)
    assert "delaykit" not in code
