#!/bin/sh
# Format of every source, then clang-tidy over the libraries and the program, after a configured build.
#   .ci/lint.sh [BUILD_FOLDER [--changed | --analyze]]
# --changed: clang-tidy over what the last fifteen commits touched only; everything takes 12 to 20 minutes. Where the history
#            is not there, or .clang-tidy itself was touched, over everything.
# --analyze adds clang's static analyzer, which takes as long again: run by hand before a release.
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
cd "$root"
.ci/setup.sh clang-format clang-tidy
build=${1:-build/release} mode=${2:-}
git ls-files -z '*.h' '*.cc' | xargs -0 clang-format --dry-run --Werror

analyzer=
[ "$mode" != --analyze ] || analyzer=--checks='clang-analyzer-core.*,clang-analyzer-cplusplus.*,clang-analyzer-deadcode.*'
base=
if [ "$mode" = --changed ] && base=$(git rev-parse --quiet --verify HEAD~15); then
  git diff --quiet "$base" -- .clang-tidy || base=
fi
list() {
  set -- 'calib/*.cc' 'forward/*.cc' 'inverse/*.cc' 'apps/*.cc'
  if [ -n "$base" ]; then git diff -z --name-only --diff-filter=d "$base" -- "$@"; else git ls-files -z "$@"; fi
}
list | xargs -0 -r -n 4 -P 2 clang-tidy --quiet ${analyzer:+"$analyzer"} -p "$build"
