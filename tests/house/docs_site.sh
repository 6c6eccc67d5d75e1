#!/bin/sh
# The documentation builds as a site with every link valid, and what it shows needs no network.
#   docs_site.sh SOURCE
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$1/docs/build.sh" "$work/site"
# The C++ reference holds the front door.
grep -q FitRoom "$work/site/api/fit__room_8h.html" || { echo "no reference of FitRoom" >&2; exit 1; }
if grep -rnE '<(script|img|link)[^>]*(src|href)="(https?:)?//' "$work/site" --include='*.html' |
  grep -v 'rel="canonical"'; then
  echo "fetched from elsewhere" >&2
  exit 1
fi
# A link from a page of docs/ to what is not on the site would only break for those who read it there.
pages=$(ls "$work"/site/*.html | wc -l)
[ "$pages" -ge "$(ls "$1"/docs/*.md | wc -l)" ] || { echo "pages are missing" >&2; exit 1; }
