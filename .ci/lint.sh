#!/bin/sh
# Reports what clang-tidy finds in the libraries and the program, and clang-format in every source, after a configured build: one line a
# finding (FILE:LINE: text [check]), worst first, forty at most. Exit status 1 where there is any.
#   .ci/lint.sh [BUILD_FOLDER] [--since REV | --changed] [--analyze] [--seconds N]
# BUILD_FOLDER  default build/release; the whole report is left in its lint.txt
# --since       clang-tidy over what REV..HEAD touched; without it over everything, which takes 12 to 20 minutes
# --changed     the same over the commits of the last twelve hours before HEAD
# --analyze     adds clang's static analyzer, which takes as long again: before a release
# --seconds     stops clang-tidy after N seconds; sources that were touched last come first
set -eu
cd "$(dirname "$0")/.."
build=build/release since='' analyzer='' seconds=7200
while [ $# -gt 0 ]; do
  case $1 in
    --since) since=$2; shift ;;
    --changed) since=$(git rev-list -1 --before="$(($(git log -1 --format=%ct) - 43200))" HEAD) ;;
    --seconds) seconds=$2; shift ;;
    --analyze) analyzer=--checks='clang-analyzer-core.*,clang-analyzer-cplusplus.*,clang-analyzer-deadcode.*' ;;
    -*) echo "lint.sh: $1: expected --since REV, --changed, --analyze or --seconds N" >&2; exit 2 ;;
    *) build=$1 ;;
  esac
  shift
done
[ -f "$build/compile_commands.json" ] || { echo "lint.sh: $build is not configured: cmake --preset release" >&2; exit 2; }
.ci/setup.sh clang-format clang-tidy >&2
raw=$(mktemp)
trap 'rm -f "$raw"' EXIT

# The sources of clang-tidy, those of the newest commits first.
git log --name-only --format= ${since:+"$since..HEAD"} -- 'calib/*.cc' 'forward/*.cc' 'inverse/*.cc' 'apps/*.cc' |
  awk 'NF && !seen[$0]++' | while read -r file; do if [ -f "$file" ]; then echo "$file"; fi; done |
  timeout "$seconds" xargs -r -n 2 -P 2 clang-tidy --quiet ${analyzer:+"$analyzer"} -p "$build" >"$raw" 2>&1 || {
    [ $? -ne 124 ] || echo "clang-tidy was stopped after $seconds s: not every source was looked at" >&2
  }
# One finding a file is enough of what .ci/format.sh mends.
git ls-files -z '*.h' '*.cc' | xargs -0 clang-format --dry-run 2>&1 |
  awk -F: '/Wclang-format-violations/ && !seen[$1]++' >>"$raw" || true

# Compiler errors, then possible bugs, then the rest, then format.
grep -E '^[^ ]+:[0-9]+:[0-9]+: (error|warning): .*\[[a-zA-Z0-9.,-]+\]$' "$raw" |
  sed -E "s#^$PWD/##; s/^([^:]+:[0-9]+):[0-9]+: (error|warning):/\1:/" |
  awk '{ rank = /clang-diagnostic-error/ ? 0 : /\[(bugprone|clang-analyzer)/ ? 1 : /clang-format/ ? 3 : 2; print rank " " $0 }' |
  sort -u | sed 's/^. //' >"$build/lint.txt" || true
head -n 40 "$build/lint.txt"
found=$(wc -l <"$build/lint.txt")
[ "$found" -eq 0 ] || { echo "lints: $found findings, all of them in $build/lint.txt"; exit 1; }
echo "lints: none"
