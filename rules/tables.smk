# Tables of results.
from scripts.claims.ledger import inputs_for

FAMILIES = {
    name: family["reference"]
    for name, family in config["stability"]["families"].items()
}
"""What each family of cases is compared with."""
SCENES_IN_SI = {n: one for n, one in config["scenes"].items() if "si" in one}

# For each rule its table.
TABLES = {
    "attractors_table": table(
        "attractors.tsv",
        "attractor_tables",
        {"of": "scenes"},
        runs=paths.paths_of_scenes(
            "attractors/scenes", paths.scenes_with(config, "attractors")
        ),
    ),
    "route_table": table(
        "routes/{line}.tsv",
        "attractor_tables",
        {"of": "route"},
        runs=lambda wildcards: paths.runs_of_route(config, wildcards.line),
    ),
    "atlas_table": table(
        "atlas.tsv",
        "attractor_tables",
        {"of": "atlas"},
        runs=paths.parts_of_atlas(config),
    ),
    "atlas_plane_table": table(
        "atlas/{atlas_plane}.tsv",
        "attractor_tables",
        {"of": "atlas"},
        runs=lambda wildcards: paths.parts_of_plane(config, wildcards.atlas_plane),
    ),
    "friction_laws_table": table(
        "friction-laws.tsv",
        "friction_laws_table",
        {"scenes": config["friction_laws"]["scenes"]},
        runs=paths.runs_of_laws(config),
    ),
    "basins_table": table(
        "basins.tsv",
        "basins_table",
        runs=paths.runs_of_basins(config),
        routes=paths.tables_of_routes(config),
    ),
    "hopf_points": table(
        "hopf-points.tsv",
        "hopf_points_table",
        curves=[f"<results>/hopf/{plane}.nc" for plane in config["hopf_curves"]],
        scenes=paths.paths_of_scenes("linear_stability", config["scenes"]),
    ),
    "fault_limit_table": table(
        "fault-limit.tsv",
        "fault_limit_table",
        {"xi": lambda wildcards: config["hopf_curves"]["tau_of_epsilon"]["xi"]},
    ),
    "cycle_points": table(
        "cycle-points.tsv",
        "cycle_points_table",
        cycles=paths.cycles_of_lines(config),
        routes=paths.tables_of_routes(config),
    ),
    "linear_stability_table": table(
        "linear-stability.tsv",
        "linear_stability_table",
        scenes=paths.paths_of_scenes("linear_stability", config["scenes"]),
    ),
    "exponents_table": table(
        "exponents.tsv", "exponents_table", runs=paths.exponents_of_scenes(config)
    ),
    "chain_modes_table": table(
        "chain-modes.tsv",
        "chain_modes_table",
        {
            "planes": list(config["chain_modes"]["planes"]),
            "stiffness": stiffness_of_modes(config["chain_modes"]),
        },
        modes=paths.curves_of_modes(config),
    ),
    "chain_motions_table": table(
        "chain-motions.tsv", "chain_motions_table", **paths.runs_of_motions(config)
    ),
    "chain_events": table(
        "chain-events/{event_chain}.tsv",
        "chain_events_table",
        {
            "t_transient": lambda wildcards: config["event_sizes"]["chains"][
                wildcards.event_chain
            ]["t_transient"]
        },
        slips="<results>/chain_slips/{event_chain}.nc",
    ),
    "event_sizes_table": table(
        "event-sizes.tsv",
        "event_sizes_table",
        {
            "t_transient": [
                chain["t_transient"]
                for chain in config["event_sizes"]["chains"].values()
            ],
            "thresholds": config["event_sizes"]["thresholds"],
        },
        slips=paths.slips_of_chains(config),
        events=paths.events_of_chains(config),
    ),
    "velocity_step_table": table(
        "velocity-step.tsv", "velocity_step_table", {"step": config["velocity_step"]}
    ),
    "si_table": table("si.tsv", "si_table", {"scenes": SCENES_IN_SI}),
    "si_events": table(
        "events/{si_scene}.csv",
        "si_events_table",
        {"si": lambda wildcards: SCENES_IN_SI[wildcards.si_scene]["si"]},
        events="<results>/slip_events/{si_scene}.nc",
    ),
    "stability_table": table(
        "stability.tsv",
        "stability_table",
        {"references": FAMILIES},
        measurements=[
            f"<results>/measurements/stability/{name}.nc" for name in FAMILIES
        ],
        references=[
            f"<results>/references/stability/{name}.tsv"
            for name, reference in FAMILIES.items()
            if reference == "quadruple"
        ],
    ),
    "trusted_horizons": table(
        "trusted-horizons.tsv",
        "trusted_horizons",
        {"trusted_error": config["work_precision"]["trusted_error"]},
        **measured_runs("trust"),
    ),
}

for name, (path, module, parameters, inputs) in TABLES.items():

    rule:
        name:
            name
        input:
            **inputs,
        output:
            f"<results>/tables/{path}",
        log:
            f"<results>/logs/tables/{path.rpartition('.')[0]}.log",
        priority: PAPER if name in ("attractors_table", "velocity_step_table") else 0
        localrule: True
        params:
            **parameters,
            script=module,
            code=code_of(module),
        script:
            "../scripts/{params.script}"


rule work_precision_table:
    """Tables of error against run time, and of error against tolerance."""
    input:
        **measured_runs("work_precision"),
    output:
        errors="<results>/tables/work-precision.tsv",
        proportionality="<results>/tables/tolerance-proportionality.tsv",
    log:
        "<results>/logs/tables/work-precision.log",
    localrule: True
    params:
        code=code_of("tables/work_precision_table.py"),
    script:
        "../scripts/tables/work_precision_table.py"


rule claims:
    """Verdicts on all claims of the paper, in results/tables/claims.tsv."""
    input:
        **inputs_for(plan.claims, config),
    output:
        tsv=report(
            "<results>/tables/claims.tsv",
            caption="../scripts/claims/ledger.rst",
            category="Claims",
            labels={"content": "Verdicts"},
        ),
        json="<results>/tables/claims.json",
    log:
        "<results>/logs/tables/claims.log",
    localrule: True
    params:
        claims=plan.claims,
        # the paper's claims are about its law
        law=None if plan.is_users else laws.PAPER,
        code=code_of("claims/ledger.py"),
    script:
        "../scripts/claims/ledger.py"
