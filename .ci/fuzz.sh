#!/bin/sh
# Fuzzes the photometric readers over the fixtures, each for some seconds; nothing of the repository is changed.
#   .ci/fuzz.sh [SECONDS]        default 20
# What breaks a reader is left in the folder that is named at the end.
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
seconds=${1:-20}
"$root/.ci/setup.sh" clang libclang-rt-14-dev libeigen3-dev cmake ninja-build
work=$(mktemp -d)
cmake -S "$root/tests/fuzz" -B "$work/build" -G Ninja -D CMAKE_CXX_COMPILER=clang++ >"$work/log"
cmake --build "$work/build" --target ies_fuzz ldt_fuzz >>"$work/log" || { cat "$work/log"; exit 1; }
for kind in ies ldt; do
  mkdir "$work/$kind"
  find "$root/fixtures" -name "*.$kind" -size -64k | while read -r file; do
    cp "$file" "$work/$kind/$(echo "$file" | cksum | cut -d ' ' -f 1).$kind"
  done
  if ! (cd "$work" && "build/${kind}_fuzz" -max_total_time="$seconds" -max_len=65536 -rss_limit_mb=512 \
    -timeout=5 -print_final_stats=1 "$kind" >"$kind.log" 2>&1); then
    tail -n 60 "$work/$kind.log"
    echo "$kind: broken; the input is in $work" >&2
    exit 1
  fi
  grep -E 'number_of_executed_units|peak_rss_mb' "$work/$kind.log" | sed "s/^stat::/$kind: /"
done
rm -r "$work"
