#!/bin/sh
# Installs what is missing of a list of Debian packages. Default: those that building the program takes (packages.txt), and those
# of its tests, its documentation, its Python module and its Debian packages (packages_development.txt).
#   .ci/setup.sh [PACKAGE ...]
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
[ $# -gt 0 ] || set -- $(cat "$root/.ci/packages.txt" "$root/.ci/packages_development.txt")
missing=
for package in "$@"; do
  dpkg-query -W -f '${Status}' "$package" 2>/dev/null | grep -q 'ok installed' || missing="$missing $package"
done
[ -n "$missing" ] || exit 0
sudo=
[ "$(id -u)" = 0 ] || sudo=sudo
echo "installing:$missing" >&2
export DEBIAN_FRONTEND=noninteractive
$sudo apt-get update -q >&2
# shellcheck disable=SC2086
$sudo apt-get install -y -q --no-install-recommends $missing >&2
