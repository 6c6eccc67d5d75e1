#!/bin/sh
# The build of the packages (preset `package`) compiles ten files at a time as one: names that each file has for itself must not
# meet there. Checks every such batch without making code of it.
#   unity.sh SOURCE
set -eu
build=$(mktemp -d)
trap 'rm -rf "$build"' EXIT
cmake -S "$1" --preset package -B "$build" -D LUXFIT_PRECOMPILED_HEADERS=OFF -D CMAKE_CXX_FLAGS_RELEASE=-fsyntax-only >/dev/null
batches=$(ninja -C "$build" -t targets all | sed -n 's|^\([^:]*/Unity/[^:]*\.o\): .*|\1|p')
[ -n "$batches" ] || { echo "the preset package builds no batches" >&2; exit 1; }
# shellcheck disable=SC2086
ninja -C "$build" $batches
