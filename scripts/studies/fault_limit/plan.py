"""Figure of the fault limit: where Hopf bifurcations begin over gamma, with and without delay.

Formulas and sources: `table.py`.
"""

from scripts.plans.declare import Figure, Study, Table

STUDY = Study(
    reads=("hopf",),
    tables=(
        Table(
            *("fault_limit_table", "tables/fault-limit.tsv"),
            params={"xi": lambda config: config["hopf_curves"]["tau_of_epsilon"]["xi"]},
        ),
    ),
    figures=(
        Figure(
            "fault_limit",
            category="Supplement",
            place=120,
            inputs=lambda _config: {"table": "<results>/tables/fault-limit.tsv"},
        ),
    ),
)
