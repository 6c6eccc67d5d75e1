#!/bin/sh
# Builds luxfit and passes every test: installs what is missing, configures, builds, runs ctest.
#   tests/run.sh [CTEST_OPTION ...]        e.g. tests/run.sh -L fast
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
cd "$root"
.ci/setup.sh
cmake --preset release >/dev/null
cmake --build build/release
# Fast tests two at a time. Slow ones run alone: each uses all cores itself, and timings in the log mean something.
exec ctest --preset release --parallel 2 "$@"
