#!/usr/bin/env bash
# cmake 3.31.6 with Unix Makefiles deletes the output of a custom command where it is configured, not built.
#
# Expected: a configure step leaves files of a build folder alone; a changed command makes them anew at the next build.
# Seen: where add_custom_command has another command line for the same OUTPUT, cmake -S -B deletes that file.
# Matters: another tool that keeps its results under the name of such an output loses them by a mere configure step.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv tools
tools/bin/pip install --quiet --disable-pip-version-check cmake==3.31.6
configure() {
    cat >CMakeLists.txt <<END_OF_LISTS
cmake_minimum_required(VERSION 3.25)
project(made NONE)
set(file "\${CMAKE_BINARY_DIR}/made.txt")
add_custom_command(OUTPUT "\${file}" COMMAND \${CMAKE_COMMAND} -E echo $1
    COMMAND \${CMAKE_COMMAND} -E touch "\${file}")
add_custom_target(wanted ALL DEPENDS "\${file}")
END_OF_LISTS
    tools/bin/cmake -G "Unix Makefiles" -S . -B build >log
    [[ -e build/made.txt ]] && echo "$2: there" || echo "$2: gone"
}
configure one "before the build"
tools/bin/cmake --build build >log
{
    configure one "configured again"
    configure two "configured with another command"
} | tee found
diff found <(printf '%s\n' 'configured again: there' 'configured with another command: gone') || exit 1
