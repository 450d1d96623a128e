"""Write the definition of a user's law of friction, or of a user's model."""

import json
from pathlib import Path

from scripts.files.outputs import logged, written


def write_definition(path: Path, definition: dict) -> None:
    """Write a definition as JSON, which is YAML, too; the file is complete or absent."""
    with written(path) as unfinished:
        unfinished.write_text(json.dumps(definition, indent=2) + "\n", encoding="utf-8")


if __name__ == "__main__":
    with logged(snakemake.log[0]):
        write_definition(Path(snakemake.output[0]), snakemake.params.definition)
