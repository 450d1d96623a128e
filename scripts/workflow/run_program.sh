#!/usr/bin/env bash
# Writes the namelist of a run, which is complete or absent, and runs the program with it. Snakemake
# sets the arrays. If a run fails, the screen shows its messages, even if the log has no room on disk.
set -euo pipefail
result=${snakemake_output[0]} namelist=${snakemake_output[namelist]} log=${snakemake_log[0]}
printf '%s' "${snakemake_params[namelist]}" >"$namelist.part"
mv "$namelist.part" "$namelist"
export OMP_NUM_THREADS=${snakemake[threads]} MODELS=${snakemake_params[folders]}
if ! said=$("${snakemake_input[program]}" "${snakemake_params[command]}" "$namelist" "$result" 2>&1 |
    { tee "$log" || :; }); then
    grep -v ' %, ' <<<"$said" >&2
    exit 1
fi
