#!/bin/sh
# A new user's first hour, from a phone's photos to the report: what there is to type and to edit is counted, and the answer is checked.
#   first_hour.sh FIXTURES PHOTOS [PROGRAM]
# PHOTOS: what phone_office wrote. Mesh, tags and readings are the office's, as docs/tutorial.md has its reader make them in steps 2, 3 and 5.
# PROGRAM: default luxfit.
set -eu
fixtures=$(realpath "$1") photos=$(realpath "$2") program=${3:-luxfit}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
fail() { echo "$1" >&2; exit 1; }
commands=0 lines=0
# typed HIGHEST_STATUS ARGUMENT ...
typed() {
  highest=$1
  shift
  commands=$((commands + 1))
  echo "\$ luxfit $*"
  status=0
  "$program" "$@" >out.txt 2>&1 || status=$?
  [ "$status" -le "$highest" ] || { tail -n 30 out.txt >&2; fail "luxfit $1 ended with $status"; }
}
# edited PATTERN LINE: one line of the session, which must be there once.
edited() {
  [ "$(grep -c "^$1\$" session.toml)" -eq 1 ] || fail "session.toml: expected one line $1"
  sed -i "s|^$1\$|$2|" session.toml
  lines=$((lines + 1))
  echo "  session.toml: $2"
}

cp -r "$photos" photos
cp "$fixtures/office/room.obj" "$fixtures/office/room.mtl" "$fixtures/office/tags.json" "$fixtures/office/luxmeter.csv" .
typed 0 init --photos photos --mesh room.obj --tags tags.json
edited '# scale = .*' 'scale = ["L3@all"]'
edited '# class = "B"' 'class = "B"'
# One exposure of 8 bits a photo and a camera that tags alone calibrate are warned of: 1.
typed 1 doctor session.toml
typed 1 run session.toml -o out
[ -s out/report.html ] || fail "no report"
typed 1 check out --json
percent=$(sed -n 's/.*"mean_abs_error_percent": *\([0-9.]*\),.*/\1/p' out.txt | tail -n 1)
echo "$commands commands, $lines edited lines; mean error of the luxmeter readings: $percent %"
[ "$commands" -le 6 ] && [ "$lines" -le 5 ] || fail "expected at most 6 commands and 5 edited lines"
awk -v percent="$percent" 'BEGIN { exit !(percent > 0 && percent < 2) }' || fail "expected less than 2 %"
