#!/bin/sh
# The office with less to go on:
#   office_sessions.sh OFFICE_FOLDER VARIANT OUT_FOLDER
#     all_on            only the photos and readings with everything on, and nobody says how many luminaires there are
#     quarter_views     every fourth view
#     unfurnished       desks and cabinet missing from the mesh
#     size              no mesh: three lengths, walls alone
#     size_door         the same with the door
#     boxes             no mesh: three lengths, two desks, the cabinet and the door
#     exposures_off     each photo's exposure time off by up to 5 %, evenly (another draw with SEED=2, ...); photos unchanged
#     exposures_apart   the same, and only the states that show one luminaire each: nothing ties their exposures
#     two_cameras       every other view is of a second camera, whose exposures are stated as 0.64 of the true ones; photos unchanged
#     survey_10mm       each tag's centre off by 10 mm (1 sigma) along each axis (another draw with SEED=2, ...)
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
  size | size_door | boxes)
    rewrite session.toml sed -e 's/^mesh = .*/size = [6, 4, 2.8]/'
    rm room.obj room.mtl
    [ "$variant" != boxes ] || cat >> session.toml <<'END'

[[scene.box]]
name = "desk"
min = [0.8, 1.0, 0.7]
max = [2.4, 1.8, 0.74]

[[scene.box]]
name = "desk"
min = [3.4, 2.3, 0.7]
max = [5.0, 3.1, 0.74]

[[scene.box]]
name = "cabinet"
min = [5.5, 0.2, 0.0]
max = [5.98, 1.4, 1.6]
END
    [ "$variant" = size ] || cat >> session.toml <<'END'

[[scene.opening]]
name = "door"
wall = 1
from = 2.6
to = 3.5
high = 2.05
END
    ;;
  exposures_off | exposures_apart)
    # Park and Miller's generator: the same numbers with every awk.
    rewrite photos.csv awk -F, -v OFS=, -v seed="${SEED:-1}" '
      NR == 1 { print; x = seed * 7919 + 17; for (i = 0; i < 9; i++) x = (16807 * x) % 2147483647; next }
      { x = (16807 * x) % 2147483647; $5 = sprintf("%.6g", $5 * (0.95 + 0.1 * x / 2147483647)); print }'
    if [ "$variant" = exposures_apart ]; then
      rewrite photos.csv awk -F, '$4 != "all" && $4 != "evening"'
      rewrite luxmeter.csv awk -F, '$8 != "all" && $8 != "evening"'
      rewrite session.toml sed -e '/^all =/d' -e '/^evening =/d' -e 's/L3@all/L3@A/'
    fi ;;
  two_cameras)
    rewrite photos.csv awk -F, -v OFS=, '
      NR == 1 { print; next }
      !($3 in camera) { camera[$3] = n++ % 2 }
      camera[$3] { $2 = "cam1"; $5 = sprintf("%.6g", 0.64 * $5) } { print }'
    printf '\n[[camera]]\nid = "cam1"\nintrinsics = "cam0.yaml"\nresponse = "linear"\nblack_level = 0\nvignetting = "none"\n' >> session.toml ;;
  survey_10mm)
    # The sum of twelve even draws less 6 is nearly normal, of sigma 1. The file has one number a line.
    rewrite tags.json awk -v seed="${SEED:-1}" '
      function even() { x = (16807 * x) % 2147483647; return x / 2147483647 }
      BEGIN { x = seed * 7919 + 17; for (i = 0; i < 9; i++) even() }
      axes > 0 {
        z = -6; for (i = 0; i < 12; i++) z += even()
        axes--; printf "   %.6f%s\n", $1 + 0.01 * z, (axes > 0 ? "," : ""); next }
      /"center_m"/ { axes = 3 } { print }' ;;
  wrong_photometry)
    for id in A B; do
      printf '\n[[luminaire]]\nid = "%s"\nphotometry = "cosine_power"\ncosine_exponent = 8\nshape = "point"\n' $id
    done >> session.toml
    for id in C D; do
      printf '\n[[luminaire]]\nid = "%s"\nphotometry = "lambertian"\nshape = "point"\n' $id
    done >> session.toml ;;
  *) echo "$0: VARIANT: expected all_on, quarter_views, unfurnished, size, size_door, boxes, exposures_off, exposures_apart, two_cameras, survey_10mm or wrong_photometry, got \"$variant\"" >&2; exit 2 ;;
esac
