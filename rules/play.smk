# Data of the view in which a reader moves the parameters.


rule play_data:
    """Classes and motions of the atlas, for the view in which a reader moves the parameters."""
    input:
        runs=placed(result_files.parts_of_atlas(LISTED)),
        tables=tables_of_atlas(),
    output:
        "<results>/page/play-data.js",
    log:
        "<results>/logs/page/play-data.log",
    params:
        scenes=result_files.places_in_atlas(LISTED),
        code=code_of("page/play_data.py"),
    script:
        "../scripts/page/play_data.py"
