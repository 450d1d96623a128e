"""Figure 8: response of friction to an up-step and a down-step of the imposed velocity.

Formulas and sources: (1.1), (1.2) `table.py`.
"""

from scripts.plans.declare import MAIN, PAPER, Figure, Study, Table

STUDY = Study(
    tables=(
        Table(
            *("velocity_step_table", "tables/velocity-step.tsv"),
            params={"step": lambda config: config["velocity_step"]},
            priority=PAPER,
        ),
    ),
    figures=(
        Figure(
            "figure_8",
            category=MAIN,
            place=80,
            inputs=lambda _config: {"response": "<results>/tables/velocity-step.tsv"},
        ),
    ),
)
