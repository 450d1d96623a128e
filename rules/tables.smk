# Tables of results.
from scripts.claims.ledger import inputs_for
from scripts.namelists.study_cases import measured_study
from scripts.results import paths

MEASURED = measured_study(config)


rule attractors_table:
    """Table of the attractors of the scenes, with their classes."""
    input:
        runs=paths.attractors_of_scenes(config),
    output:
        "<results>/tables/attractors.tsv",
    log:
        "<results>/logs/tables/attractors.log",
    priority: PAPER
    localrule: True
    params:
        of="scenes",
        code=code_of("tables/attractor_tables.py"),
    script:
        "../scripts/tables/attractor_tables.py"


rule route_table:
    """Table of the attractors along a route: one parameter changes, all others are fixed."""
    input:
        runs=lambda wildcards: paths.runs_of_route(config, wildcards.line),
    output:
        "<results>/tables/routes/{line}.tsv",
    log:
        "<results>/logs/tables/routes/{line}.log",
    localrule: True
    params:
        of="route",
        code=code_of("tables/attractor_tables.py"),
    script:
        "../scripts/tables/attractor_tables.py"


rule basins_table:
    """Table of the attractors that are reached from random histories."""
    input:
        runs=paths.runs_of_basins(config),
        routes=paths.tables_of_routes(config),
    output:
        "<results>/tables/basins.tsv",
    log:
        "<results>/logs/tables/basins.log",
    localrule: True
    params:
        code=code_of("tables/basins_table.py"),
    script:
        "../scripts/tables/basins_table.py"


rule atlas_table:
    """Table of the atlas: the class of motion at points of epsilon and tau."""
    input:
        runs=paths.parts_of_atlas(config),
    output:
        "<results>/tables/atlas.tsv",
    log:
        "<results>/logs/tables/atlas.log",
    localrule: True
    params:
        of="atlas",
        code=code_of("tables/attractor_tables.py"),
    script:
        "../scripts/tables/attractor_tables.py"


use rule atlas_table as atlas_plane_table with:
    input:
        runs=lambda wildcards: paths.parts_of_plane(config, wildcards.atlas_plane),
    output:
        "<results>/tables/atlas/{atlas_plane}.tsv",
    log:
        "<results>/logs/tables/atlas/{atlas_plane}.log",


rule hopf_points:
    """Table of the special points on the Hopf curves."""
    input:
        curves=paths.curves_of_planes(config),
        scenes=paths.paths_of_scenes("linear_stability", config["scenes"]),
    output:
        "<results>/tables/hopf-points.tsv",
    log:
        "<results>/logs/tables/hopf-points.log",
    localrule: True
    params:
        code=code_of("tables/hopf_points_table.py"),
    script:
        "../scripts/tables/hopf_points_table.py"


rule fault_limit_table:
    """Table of the least epsilon of all Hopf curves over gamma, at the xi of Figure 2."""
    output:
        "<results>/tables/fault-limit.tsv",
    log:
        "<results>/logs/tables/fault-limit.log",
    localrule: True
    params:
        xi=lambda wildcards: config["hopf_curves"]["tau_of_epsilon"]["fixed"],
        code=code_of("tables/fault_limit_table.py"),
    script:
        "../scripts/tables/fault_limit_table.py"


rule cycle_points:
    """Table of the points where cycles bifurcate."""
    input:
        cycles=paths.cycles_of_lines(config),
        routes=paths.tables_of_routes(config),
    output:
        "<results>/tables/cycle-points.tsv",
    log:
        "<results>/logs/tables/cycle-points.log",
    localrule: True
    params:
        code=code_of("tables/cycle_points_table.py"),
    script:
        "../scripts/tables/cycle_points_table.py"


rule linear_stability_table:
    """Table of the linear stability of steady sliding in the scenes."""
    input:
        scenes=paths.paths_of_scenes("linear_stability", config["scenes"]),
    output:
        "<results>/tables/linear-stability.tsv",
    log:
        "<results>/logs/tables/linear-stability.log",
    localrule: True
    params:
        code=code_of("tables/linear_stability_table.py"),
    script:
        "../scripts/tables/linear_stability_table.py"


rule exponents_table:
    """Table of the Lyapunov exponents of the scenes."""
    input:
        runs=paths.exponents_of_scenes(config),
    output:
        "<results>/tables/exponents.tsv",
    log:
        "<results>/logs/tables/exponents.log",
    localrule: True
    params:
        code=code_of("tables/exponents_table.py"),
    script:
        "../scripts/tables/exponents_table.py"


rule dimensions_table:
    """Table of L/v0, xi, gamma and the paper's delay for a laboratory sample and a fault."""
    output:
        "<results>/tables/dimensions.tsv",
    log:
        "<results>/logs/tables/dimensions.log",
    localrule: True
    params:
        presets=config["dimensions"],
        code=code_of("tables/dimensions_table.py"),
    script:
        "../scripts/tables/dimensions_table.py"


rule stability_table:
    """Table of the errors of the solver on stiff and extreme cases."""
    input:
        measurements=paths.runs_of_families(config),
        references=paths.references_of_families(config),
    output:
        "<results>/tables/stability.tsv",
    log:
        "<results>/logs/tables/stability.log",
    localrule: True
    params:
        references={
            name: family["reference"]
            for name, family in config["stability"]["families"].items()
        },
        code=code_of("tables/stability_table.py"),
    script:
        "../scripts/tables/stability_table.py"


rule trusted_horizons:
    """Table of the times up to which runs of the scenes can be compared."""
    input:
        measurements=expand(
            "<results>/measurements/trust/{case}.nc", case=MEASURED["cases"]
        ),
        references=expand(
            "<results>/references/trust/{case}.tsv", case=MEASURED["cases"]
        ),
    output:
        "<results>/tables/trusted-horizons.tsv",
    log:
        "<results>/logs/tables/trusted-horizons.log",
    localrule: True
    params:
        trusted_error=MEASURED["trusted_error"],
        code=code_of("tables/trusted_horizons.py"),
    script:
        "../scripts/tables/trusted_horizons.py"


rule work_precision_table:
    """Tables of error against run time, and of error against tolerance."""
    input:
        measurements=expand(
            "<results>/measurements/work_precision/{case}.nc", case=MEASURED["cases"]
        ),
        references=expand(
            "<results>/references/trust/{case}.tsv", case=MEASURED["cases"]
        ),
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
        code=code_of("claims/ledger.py"),
    script:
        "../scripts/claims/ledger.py"
