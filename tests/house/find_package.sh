#!/bin/sh
# Installs the build into a folder of its own and builds, links and runs an outside project against it, and against each
# library alone.
#   find_package.sh SOURCE BUILD
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
for component in dev program; do
  cmake --install "$2" --prefix "$work/prefix" --component $component >/dev/null
done
cmake -S "$1/tests/house/consumer" -B "$work/build" -G Ninja -DCMAKE_PREFIX_PATH="$work/prefix" >/dev/null
cmake --build "$work/build"
for library in calib forward inverse; do "$work/build/consumer_$library"; done
"$work/prefix/bin/luxfit" --version
