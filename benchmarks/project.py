"""What the benchmarks need of the project: its configuration, programs and results."""

from pathlib import Path

from scripts.config.check_config import checked
from scripts.plans.studies import merged

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent
PROGRAM = HERE / "build" / "bin" / "spring_block"
TABLES = ROOT / "results" / "tables"


def configuration() -> dict:
    """The project's configuration, checked and with its defaults."""
    return checked(merged("config.yaml"))
