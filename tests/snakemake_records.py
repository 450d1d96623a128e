"""What Snakemake has written down of the results of a project."""

import base64
import json

from conftest import Project


def records_of(project: Project) -> dict[str, dict]:
    """For each result: its rule, the input files and the params that it was made with."""
    folder = project.folder / ".snakemake" / "metadata"
    # a long name is cut into folders whose names begin with @
    names = {path: "".join(path.relative_to(folder).parts) for path in folder.rglob("*")}
    return {
        base64.urlsafe_b64decode(name.replace("@", "")).decode(): json.loads(path.read_text())
        for path, name in names.items()
        if path.is_file()
    }
