"""Whether a delay matters at the gamma of real faults: the least epsilon of all Hopf curves.

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
            "Figure of the fault limit: where Hopf bifurcations begin over gamma, with and without"
            " delay.",
            category="Supplement",
            place=120,
            inputs=lambda _config: {"table": "<results>/tables/fault-limit.tsv"},
        ),
    ),
)
