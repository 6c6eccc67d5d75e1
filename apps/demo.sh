#!/bin/sh
# The main job on the office of fixtures/: photos in, luminaires checked against the luxmeter out, beside the truth.
#   apps/demo.sh [OUT_FOLDER]              default: out/office
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
out=$(realpath -m "${1:-$root/out/office}")
cd "$root"
.ci/setup.sh
cmake --preset release >/dev/null
cmake --build build/release --target luxfit compare_with_truth
build/release/apps/luxfit run fixtures/office/session.toml -o "$out"
build/release/tests/compare_with_truth "$out/result.json" fixtures/office/truth.json
echo
echo "results: $out/result.json (stages in $out/stages)"
