# SPDX-License-Identifier: Apache-2.0
# Shared by installer/run, installer/test and installer/fuzz: where the tree is, its packages, how it is built.

top=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$top" || exit 1

say() { printf '\n== %s\n' "$*"; }

# install_packages [LIST...]: installs what is missing of the lists, or of installer/packages.txt; does nothing, and
# needs no network or rights, when all is there.
install_packages() {
    command -v dpkg-query >/dev/null && command -v apt-get >/dev/null || {
        echo "Whorl's installer is for Debian 12 and its relatives; install the packages of installer/packages*.txt by hand." >&2
        exit 1
    }
    [ $# -eq 0 ] && set -- installer/packages.txt
    local missing=() package
    while read -r package; do
        case $package in '' | '#'*) continue ;; esac
        dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null | grep -qx installed || missing+=("$package")
    done < <(cat "$@")
    [ ${#missing[@]} -eq 0 ] && return
    say "Installing ${#missing[@]} packages"
    local as_root=()
    if [ "$(id -u)" -ne 0 ]; then
        command -v sudo >/dev/null || {
            echo "Run this as root, or install sudo: the packages ${missing[*]} are missing." >&2
            exit 1
        }
        as_root=(sudo)
    fi
    "${as_root[@]}" apt-get update -qq || exit 1
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends "${missing[@]}" || exit 1
}

# build PRESET [TARGET...]: configures and builds into build/PRESET; without targets, everything.
build() {
    local preset=$1
    shift
    say "Building (preset $preset)"
    cmake --preset "$preset" || exit 1
    cmake --build --preset "$preset" ${1:+--target "$@"} || exit 1
}
