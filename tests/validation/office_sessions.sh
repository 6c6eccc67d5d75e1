#!/bin/sh
# The office with less to go on:
#   office_sessions.sh OFFICE_FOLDER VARIANT OUT_FOLDER
#     all_on            only the photos and readings with everything on, and nobody says how many luminaires there are
#     quarter_views     every fourth view
#     unfurnished       desks and cabinet missing from the mesh
#     wrong_photometry  the panels given as narrow downlights (cosine power 8), the downlights as Lambertian
# Then: luxfit run OUT_FOLDER/session.toml -o RESULT, and compare_with_truth RESULT/result.json OFFICE/truth.json.
set -eu
office=$(cd "$1" && pwd) variant=$2 out=$3
mkdir -p "$out"
for file in cam0.yaml tags.json room.obj room.mtl luxmeter.csv photos.csv session.toml; do
  cp "$office/$file" "$out/"
done
ln -sfn "$office/photos" "$out/photos"
cd "$out"
# Rewrites a file by a filter.
rewrite() { file=$1; shift; "$@" < "$file" > "$file.new" && mv "$file.new" "$file"; }
case $variant in
  all_on)
    rewrite photos.csv awk -F, 'NR == 1 || $4 == "all"'
    rewrite luxmeter.csv awk -F, 'NR == 1 || $8 == "all"'
    rewrite session.toml awk '/^\[states\]/ { skip = 1; print "[luminaires]\ncount = \"estimate\"\n"; next }
                              /^\[/ { skip = 0 } !skip' ;;
  quarter_views)
    rewrite photos.csv awk -F, 'NR == 1 { print; next } !($3 in seen) { seen[$3] = n++ % 4 == 0 } seen[$3]' ;;
  unfurnished)
    rewrite room.obj awk '/^g / { skip = $2 ~ /^(desk|cabinet)/ } !(skip && /^f /)'
    # Tags on what is missing hang in the air: they stay surveyed.
    ;;
  wrong_photometry)
    for id in A B; do
      printf '\n[[luminaire]]\nid = "%s"\nphotometry = "cosine_power"\ncosine_exponent = 8\nshape = "point"\n' $id
    done >> session.toml
    for id in C D; do
      printf '\n[[luminaire]]\nid = "%s"\nphotometry = "lambertian"\nshape = "point"\n' $id
    done >> session.toml ;;
  *) echo "$0: VARIANT: expected all_on, quarter_views, unfurnished or wrong_photometry, got \"$variant\"" >&2; exit 2 ;;
esac
