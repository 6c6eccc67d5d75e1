#!/bin/sh
# Format of every source, then clang-tidy over the libraries and the program, after a configured build.
#   .ci/lint.sh [BUILD_FOLDER [--analyze]]
# --analyze adds clang's static analyzer, which takes as long again: run by hand before a release.
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
cd "$root"
.ci/setup.sh clang-format clang-tidy
analyzer=
[ "${2:-}" != --analyze ] || analyzer=--checks='clang-analyzer-core.*,clang-analyzer-cplusplus.*,clang-analyzer-deadcode.*'
git ls-files -z '*.h' '*.cc' | xargs -0 clang-format --dry-run --Werror
git ls-files -z 'calib/*.cc' 'forward/*.cc' 'inverse/*.cc' 'apps/*.cc' |
  xargs -0 -n 4 -P 2 clang-tidy --quiet ${analyzer:+"$analyzer"} -p "${1:-build/release}"
