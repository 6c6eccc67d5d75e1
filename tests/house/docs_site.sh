#!/bin/sh
# The documentation builds as a site with every link valid, and what it shows needs no network.
#   docs_site.sh SOURCE MKDOCS
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$2" build --quiet --strict -f "$1/.mkdocs.yml" -d "$work/site"
if grep -rnE '<(script|img|link)[^>]*(src|href)="(https?:)?//' "$work/site" --include='*.html' |
  grep -v 'rel="canonical"'; then
  echo "fetched from elsewhere" >&2
  exit 1
fi
# A link from a page of docs/ to what is not on the site would only break for those who read it there.
pages=$(ls "$work"/site/*.html | wc -l)
[ "$pages" -ge "$(ls "$1"/docs/*.md | wc -l)" ] || { echo "pages are missing" >&2; exit 1; }
