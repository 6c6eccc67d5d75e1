#!/bin/sh
# Formats every source of the repository by clang-format.
#   .ci/format.sh
set -eu
cd "$(dirname "$0")/.."
.ci/setup.sh clang-format
git ls-files -z '*.h' '*.cc' | xargs -0 clang-format -i
