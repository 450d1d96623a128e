#!/usr/bin/env bash
# Names in one line what a build needs and this machine lacks, with status 1; silent where all is there.
set -euo pipefail
cd -P "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/.."

# Path of the first of these commands that is there.
first_of() {
    local name
    for name; do
        ! command -v "$name" || return 0
    done
    return 1
}

missing=()
first_of cmake >/dev/null || missing+=(cmake)
first_of make >/dev/null || missing+=(make)
first_of "${CC:-cc}" gcc clang >/dev/null || missing+=(gcc)
first_of gfortran >/dev/null || missing+=(gfortran)
if pkg_config=$(first_of pkg-config pkgconf); then
    for library in $(sed -nE 's/.*pkg_check_modules\(.* ([^ )]+)\)$/\1/p' fortran/CMakeLists.txt); do
        "$pkg_config" --exists "$library" || missing+=("$library")
    done
else
    missing+=(pkg-config)
fi
if ((${#missing[@]})); then
    printf 'error: no program can be built without %s; run %s\n' "${missing[*]}" \
        "./reproduce, which sets up what is missing" >&2
    exit 1
fi
