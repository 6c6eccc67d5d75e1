#!/bin/sh
# Builds the documentation as a site that opens from disk, with the C++ reference under api/; installs what is missing.
#   docs/build.sh [FOLDER]        default build/site
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
mkdir -p "${1:-$root/build/site}"
out=$(cd "${1:-$root/build/site}" && pwd)
"$root/.ci/setup.sh" mkdocs doxygen
mkdocs build --quiet --strict -f "$root/.mkdocs.yml" -d "$out"
cd "$root"
{ cat .doxygen; echo "OUTPUT_DIRECTORY = \"$out\""; echo "HTML_OUTPUT = api"; } | doxygen -
