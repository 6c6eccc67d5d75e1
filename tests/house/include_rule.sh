#!/bin/sh
# The house's boundary: includes go downward only, and public headers show std, Eigen and house types only.
#   include_rule.sh ROOT
set -eu
cd "$1"
status=0
complain() { printf '%s\n' "$1" | sed "s|^|$2: |"; status=1; }
# layer, then what it must not include
check() {
  bad=$(grep -nE "#include \"($2)/" "$1"/*.h "$1"/*.cc "$1"/internal/*.h "$1"/internal/*.cc 2>/dev/null || true)
  [ -z "$bad" ] || complain "$bad" "include against the house's direction"
}
check calib 'forward|inverse|apps|tests'
check forward 'calib|inverse|apps|tests'
check inverse 'apps|tests'
check apps 'tests'
for layer in calib forward inverse; do
  bad=$(grep -nE '#include <[a-z0-9_]+(3)?/|#include <[^>]*\.(h|hpp)>|#include <(Eigen/Sparse|ceres|opencv)' "$layer"/*.h |
        grep -vE '#include <Eigen/' || true)
  [ -z "$bad" ] || complain "$bad" "package shown in a public header"
  bad=$(grep -nE '#include "[^"]*internal/' "$layer"/*.h || true)
  [ -z "$bad" ] || complain "$bad" "internal header shown in a public one"
  # Nobody reaches into another layer's internals.
  bad=$(grep -rnE '#include "(calib|forward|inverse)/internal/' calib forward inverse apps --include=*.h --include=*.cc |
        grep -vE "^(calib)/.*\"calib/|^(forward)/.*\"forward/|^(inverse)/.*\"inverse/" || true)
  [ -z "$bad" ] || complain "$bad" "internals of another layer"
done
exit $status
