#!/usr/bin/env bash
# Writes the namelist of a run, which is complete or absent, and runs the program with it. Snakemake
# sets the arrays. Of a run that fails the screen shows the log, without the lines on its progress.
set -euo pipefail
result=${snakemake_output[0]} namelist=${snakemake_output[namelist]} log=${snakemake_log[0]}
printf '%s' "${snakemake_params[namelist]}" >"$namelist.part"
mv "$namelist.part" "$namelist"
export OMP_NUM_THREADS=${snakemake[threads]} MODELS=${snakemake_params[folders]}
if ! "${snakemake_input[program]}" "${snakemake_params[command]}" "$namelist" "$result" 2>"$log"; then
    grep -v ' %, ' "$log" >&2
    exit 1
fi
