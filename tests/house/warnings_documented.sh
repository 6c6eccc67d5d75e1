#!/bin/sh
# Every warning that the program can write stands in docs/warnings.md, and no other.
#   warnings_documented.sh SOURCE
set -eu
cd "$1"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
codes() { tr '\0' '\n' | grep -oE '"[a-z]+(_[a-z]+)*"$' | tr -d '"'; }
{
  # Where one is made: context.warnings, notes of calib (view, tag, code or code, whether it fails), mesh findings.
  grep -Pzoh '(warnings\.(push_back|emplace_back)|AddUndetermined)\(\s*\{?\s*"[a-z_]+"' -r apps inverse --include='*.cc' | codes
  grep -oh 'Warn("[a-z_]*"' -r apps inverse --include='*.cc' | codes
  grep -Pzoh '(-1|\bid),\s*"[a-z_]+"(?=,)' -r calib --include='*.cc' | codes
  grep -Pzoh 'notes\.push_back\(\s*\{"[a-z_]+"' -r calib --include='*.cc' | codes
  sed -n '/^std::string ToString(MeshDefect/,/^}/p' forward/mesh/mesh_check.cc | grep -oE '"[a-z_]+"' | tr -d '"'
} | sort -u >"$work/made"
sed -n 's/^### \([a-z_]*\)$/\1/p' docs/warnings.md | sort -u >"$work/documented"
[ "$(wc -l <"$work/made")" -gt 50 ] || { echo "only $(wc -l <"$work/made") codes found: has their form changed?" >&2; exit 1; }
diff "$work/made" "$work/documented" | sed -n 's/^</not in docs\/warnings.md:/p; s/^>/documented, but nothing writes it:/p' >"$work/differences"
cat "$work/differences" >&2
[ ! -s "$work/differences" ]
