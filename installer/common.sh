# SPDX-License-Identifier: Apache-2.0
# Shared by installer/run and installer/test: where the tree is, and its packages.

top=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$top" || exit 1

say() { printf '\n== %s\n' "$*"; }

# Installs what is missing; does nothing, and needs no network or rights, when all is there.
install_packages() {
    command -v dpkg-query >/dev/null && command -v apt-get >/dev/null || {
        echo "Whorl's installer is for Debian 12 and its relatives; install the packages of installer/packages.txt by hand." >&2
        exit 1
    }
    local missing=() package
    while read -r package; do
        case $package in '' | '#'*) continue ;; esac
        dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null | grep -qx installed || missing+=("$package")
    done <installer/packages.txt
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

# build PRESET: configures and builds into build/PRESET.
build() {
    say "Building (preset $1)"
    cmake --preset "$1" || exit 1
    cmake --build --preset "$1" || exit 1
}
