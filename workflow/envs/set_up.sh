#!/usr/bin/env bash
# Sets up the virtual environment $SETUP_VENV from the lock file with $SETUP_PYTHON, and the off-screen
# GL library. On failure it prints one line: what is missing, and the command that installs it.
set -euo pipefail

python=$SETUP_PYTHON
venv=$SETUP_VENV
cd "$(dirname "$0")/../.."
ready=$venv/.ready
[ "$ready" -nt requirements.lock ] && [ "$ready" -nt pyproject.toml ] && exit 0

case $PWD in
    *[{}]*)
        echo "error: Snakemake cannot work in '$PWD': it treats braces as wildcards" >&2
        exit 1
        ;;
esac
case $venv in
    *:* | *[[:space:]]*[\"\$\`\\]* | *[\"\$\`\\]*[[:space:]]* | *[$'\t\n']*)
        echo "error: no virtual environment can lie in '$venv': its programs would not start;" \
            "name another place with: make setup VENV=/some/folder" >&2
        exit 1
        ;;
esac

missing() {
    echo "missing: $1; get it with: $2" >&2
    exit 1
}

command -v "$python" >/dev/null || missing "$python" "apt-get install python3 python3-venv"
"$python" -c 'import sys; sys.exit(sys.version_info < (3, 11))' ||
    missing "Python 3.11 or newer ($python is older)" "make setup PYTHON=python3.11"
"$python" -c 'import ensurepip, venv' 2>/dev/null ||
    missing "Python's venv module" "apt-get install python3-venv"

can_load() {
    "$python" -c "import ctypes, sys; ctypes.CDLL(sys.argv[1])" "$1" 2>/dev/null
}

if ! can_load libOSMesa.so.8 && ! can_load libOSMesa.so.6 && ! can_load libEGL.so.1; then
    packages=$(grep -v '^#' workflow/envs/apt.txt | tr '\n' ' ')
    as_root=""
    [ "$(id -u)" = 0 ] || as_root="sudo -n"
    command -v apt-get >/dev/null || missing "OSMesa or EGL, the off-screen GL library" \
        "your system's package of libOSMesa or libEGL"
    echo "installing $packages"
    { $as_root apt-get update -qq && $as_root apt-get install -y -qq --no-install-recommends $packages; } \
        >/dev/null 2>&1 || missing "OSMesa, the off-screen GL library" "sudo apt-get install $packages"
fi

[ -x "$venv/bin/python" ] || "$python" -m venv "$venv"
# With uv, or else with pip, which takes minutes and may know an index that uv does not. On a terminal
# both say how far they are; otherwise only errors are shown.
install_locked() {
    if command -v uv >/dev/null; then
        local quiet=--quiet
        [ ! -t 1 ] || quiet=""
        uv pip install $quiet --compile-bytecode --python "$venv/bin/python" -r requirements.lock && return
    fi
    if [ ! -t 1 ]; then
        "$venv/bin/pip" install -qq --disable-pip-version-check -r requirements.lock
        return
    fi
    "$venv/bin/pip" install --disable-pip-version-check -r requirements.lock 2>&1 | show_progress
}

show_progress() {
    local line found=0
    while read -r line; do
        case $line in
            Collecting* | "Requirement already"*) found=$((found + 1)) ;;
        esac
        case $line in
            Collecting* | Downloading* | "Requirement already"*) printf '\r\033[K  package %d: %.60s' "$found" "$line" ;;
            "Installing collected"*) printf '\r\033[K  unpacking %d packages' "$found" ;;
            ERROR*) printf '\r\033[K%s\n' "$line" ;;
        esac
    done
    printf '\r\033[K'
}

echo "installing the locked packages into $venv (a few minutes the first time)"
install_locked ||
    missing "a package of requirements.lock" "a connection to the package index, then make setup again"
"$venv/bin/pip" install -qq --disable-pip-version-check --no-deps --no-build-isolation -e .
touch "$ready"
