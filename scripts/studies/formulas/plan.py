"""The paper's formulas (3) to (10) as printed and corrected, on the Hopf curves of the program."""

from scripts.plans.declare import Study

STUDY = Study(reads=("hopf",))
