#!/bin/sh
# Checks the house's boundaries: layers and rooms include in the order of docs/architecture.md, public headers show std, Eigen and
# house types only, and no layer reaches into another one's internals.
#   include_rule.sh ROOT
set -eu
cd "$1"
status=0
complain() { [ -z "$1" ] || { printf '%s\n' "$1" | sed "s|^|$2: |"; status=1; }; }
sources() { find "$1" -name '*.h' -o -name '*.cc'; }

# layer, then what it must not include
check() { complain "$(sources "$1" | xargs grep -nE "#include \"($2)/" || true)" "include against the order of the layers"; }
check calib 'forward|inverse|apps|tests'
check forward 'calib|inverse|apps|tests'
check inverse 'apps|tests'
check apps 'tests'

# Rooms: "layer: room room ...", each of which may include those before it.
sed -n '/^```order/,/^```$/p' docs/architecture.md | grep ':' >"${TMPDIR:-/tmp}/rooms.$$"
trap 'rm -f "${TMPDIR:-/tmp}/rooms.$$"' EXIT
while IFS=: read -r layer rooms; do
  known="$(printf '%s\n' $rooms | sort) "
  there="$(find "$layer" -mindepth 1 -maxdepth 1 -type d -exec basename {} \; | sort) "
  [ "$known" = "$there" ] || complain "$layer has the rooms $(echo $there), docs/architecture.md $(echo $known)" "rooms"
  later=$rooms
  for room in $rooms; do
    later=$(printf '%s' "$later" | sed "s/^ *$room *//")
    [ -n "$later" ] || continue
    bad=$(sources "$layer/$room" | xargs grep -nE "#include \"$layer/($(echo $later | tr ' ' '|'))/" || true)
    complain "$bad" "include against the order of the rooms"
  done
  # A file of a layer lies in a room.
  complain "$(find "$layer" -maxdepth 1 -name '*.h' -o -maxdepth 1 -name '*.cc')" "file outside of the rooms"
done <"${TMPDIR:-/tmp}/rooms.$$"
[ "$(wc -l <"${TMPDIR:-/tmp}/rooms.$$")" -eq 4 ] || complain "no order of four layers" "docs/architecture.md"

for layer in calib forward inverse; do
  public=$(find "$layer" -name '*.h' -not -path '*/internal/*')
  bad=$(grep -nE '#include <[a-z0-9_]+(3)?/|#include <[^>]*\.(h|hpp)>|#include <(Eigen/Sparse|ceres|opencv)' $public |
        grep -vE '#include <Eigen/' || true)
  complain "$bad" "package shown in a public header"
  complain "$(grep -nE '#include "[^"]*/internal/' $public || true)" "internal header shown in a public one"
  others=$(printf 'calib\nforward\ninverse\napps\n' | grep -v "$layer")
  complain "$(grep -rnE "#include \"$layer/.*/internal/" $others --include=*.h --include=*.cc || true)" "internals of another layer"
done
exit $status
