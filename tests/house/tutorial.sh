#!/bin/sh
# What docs/tutorial.md has its reader type works as it stands there: the files of its room, and every command that
# needs no photos of it.
#   tutorial.sh SOURCE PROGRAM
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
tutorial=$(realpath "$1/docs/tutorial.md")
# The fenced block whose first line matches.
block() { awk -v start="$1" '/^```/ { inside = !inside; first = inside; keep = 0; next }
  first { keep = $0 ~ start; first = 0 } inside && keep' "$tutorial"; }
mkdir "$work/bin"
ln -s "$2" "$work/bin/luxfit"
PATH=$work/bin:$PATH
cd "$work"
block '^# room.obj' >room.obj
block '^.scene.$' >designed.toml
block '^id,x_m' >luxmeter.csv
block '^.$' >tags.json
grep -E '^    luxfit (board|room|simulate) ' "$tutorial" | sed 's/ #.*//' >commands
[ "$(wc -l <commands)" -ge 5 ] || { echo "expected five commands and more" >&2; exit 1; }
while read -r line; do
  echo "$line"
  sh -eu -c "$line" >out 2>err || { cat err >&2; exit 1; }
  if grep -iE '^ *(warning|note|bad) ' err out; then exit 1; fi
done <commands
lines=$(wc -l <designed/illuminance.csv)
[ "$lines" -eq "$(wc -l <luxmeter.csv)" ] || { echo "expected a prediction for every reading" >&2; exit 1; }
