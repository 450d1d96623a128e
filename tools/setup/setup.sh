#!/usr/bin/env bash
# Sets up what is missing: the Debian packages of tools/setup/apt-packages.txt, then
# the Python packages of requirements.lock in .venv. When all is there it does
# nothing and needs no network. An interrupted run is repaired by the next one.
# `tools/setup/setup.sh FOLDER` does the same for those lists that FOLDER has, with FOLDER/.venv; but
# packages of a profile, which work inside Snakemake, are added to .venv.
set -euo pipefail
cd -P "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../.."

list=tools/setup/apt-packages.txt
lock=requirements.lock
venv=.venv
if (($#)); then
    list=$1/apt-packages.txt
    lock=$1/requirements.lock
    venv=$1/.venv
fi
made_from=$venv/made-from
if [[ ${1-} == profiles/* ]]; then
    tools/setup/setup.sh
    venv=.venv
    made_from=.venv/made-from-${1##*/}
fi

say() { printf 'set-up: %s\n' "$*" >&2; }

missing_packages() {
    local wanted
    [[ -e $list ]] || return 0
    wanted=$(sed 's/#.*//' "$list" | xargs -n 1 | sort -u)
    # dpkg-query fails when it knows nothing of a package, and still lists the others
    # shellcheck disable=SC2016,SC2086
    { dpkg-query --show --showformat='${Package} ${db:Status-Status}\n' $wanted 2>/dev/null || true; } |
        sed -n 's/ installed$//p' | sort -u | comm -23 <(printf '%s\n' "$wanted") - | xargs
}

as_root=()
become_root() {
    if ((EUID == 0)); then
        as_root=(env)
    elif sudo -n true 2>/dev/null; then
        as_root=(sudo -n env)
    elif [[ -t 0 ]] && command -v sudo >/dev/null; then
        as_root=(sudo env)
    else
        return 1
    fi
    as_root+=(DEBIAN_FRONTEND=noninteractive)
}

install_packages() {
    say "installing Debian packages: $*"
    # finish what an interrupted installation left half done
    "${as_root[@]}" dpkg --configure -a &&
        { "${as_root[@]}" apt-get update -qq || say "apt-get update failed, trying the lists at hand"; } &&
        "${as_root[@]}" apt-get install -y -qq --no-install-recommends -o DPkg::Lock::Timeout=600 "$@"
}

ask_for_packages() {
    say "Debian packages are missing; install them with this line, then run this again:"
    printf '    sudo apt-get install -y --no-install-recommends %s\n' "$*" >&2
    exit 1
}

# What the virtual environment must have been made from: the locked packages, the interpreter,
# and the folder, since the scripts of a virtual environment hold its path.
venv_source() {
    sha256sum tools/setup/requirements.lock "$lock" tools/setup/setup.sh
    /usr/bin/python3 --version
    pwd
}

venv_is_ready() {
    [[ ! -e $lock ]] || [[ -x $venv/bin/python && $(cat "$made_from" 2>/dev/null) == "$(venv_source)" ]]
}

make_venv() {
    # emptying it would empty the folder that the link names, maybe of another project
    [[ ! -L $venv ]] || refuse "$venv is a link; expected a folder, or nothing: remove the link"
    say "filling $venv with the Python packages of $lock"
    # settings that would send the packages elsewhere or change their versions
    unset PYTHONHOME PYTHONPATH PIP_CONSTRAINT PIP_PREFIX PIP_ROOT PIP_TARGET PIP_USER
    [[ $made_from != "$venv/made-from" ]] || /usr/bin/python3 -m venv --clear "$venv"
    # what comes as source is built by the locked build tool, not by one that pip would look for
    install_locked tools/setup/requirements.lock
    install_locked "$lock" --no-build-isolation --use-pep517
    venv_source >"$made_from"
}

# Most modules are never imported: Python compiles a module when it first is.
install_locked() {
    "$venv/bin/python" -m pip install --quiet --no-input --no-user --no-compile --disable-pip-version-check \
        "${@:2}" --require-hashes -r "$1"
}

# A build, too, holds the path of its folder: drop those made before a move.
drop_moved_builds() {
    local cache source
    for cache in build/*/CMakeCache.txt; do
        [[ -f $cache ]] || continue
        source=$(sed -n 's/^CMAKE_HOME_DIRECTORY:INTERNAL=//p' "$cache")
        [[ $source -ef fortran || $source -ef python ]] || { say "dropping a build of another folder: ${cache%/*}" && rm -r "${cache%/*}"; }
    done
}

refuse() { say "$*" && exit 1; }

# CMake, Make and Snakemake give some characters of a path a meaning of their own, Snakemake does not
# quote the path of its Python (its issue 2645), and : divides paths in PATH.
case $PWD in
    *[]['${};"\|<>: '$'\t\n']*) refuse "cannot work in ${PWD@Q}: a path without blanks, \$ ; \" \\ | < > : [ ] { } and line breaks is expected; move the project" ;;
esac
drop_moved_builds
missing=$(missing_packages)
if [[ -z $missing ]] && venv_is_ready; then
    exit
fi
[[ -z $missing ]] || become_root || ask_for_packages "$missing"

[[ -w . ]] || refuse "nothing can be written in $PWD; see that it is on no read-only disk and belongs to you, then run again"
exec 9>>.setup.lock
flock --nonblock 9 || { say "waiting for another set-up of this folder" && flock 9; }
missing=$(missing_packages)
# shellcheck disable=SC2086
[[ -z $missing ]] || install_packages $missing >/dev/null 9>&- || ask_for_packages "$missing"
venv_is_ready || make_venv >&2
say "done"
