#!/bin/sh
# The main job on the office of fixtures/: photos in, luminaires checked against the luxmeter and the truth, a report out.
#   apps/demo.sh [OUT_FOLDER]              default: out/office
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
out=$(realpath -m "${1:-$root/out/office}")
cd "$root"
# shellcheck disable=SC2046
.ci/setup.sh $(cat .ci/packages.txt)
cmake --preset package >/dev/null
cmake --build build/package --target luxfit
build/package/apps/luxfit demo -o "$out"
echo
echo "report: $out/report.html"
