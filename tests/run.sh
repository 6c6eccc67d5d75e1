#!/bin/sh
# Builds luxfit and passes every test: installs what is missing, configures, builds, runs ctest. The preset ci compiles several sources at
# once, which takes half the time of a first build; to work on luxfit take the preset release.
#   tests/run.sh [CTEST_OPTION ...]        e.g. tests/run.sh -L fast
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
cd "$root"
.ci/setup.sh
cmake --preset ci >/dev/null
cmake --build build/ci
# Two at a time: no test keeps two cores busy all the time. Those that measure time run alone.
exec ctest --preset ci --parallel 2 "$@"
