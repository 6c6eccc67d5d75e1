#!/bin/sh
# Turns the readings of the plant chamber (PalmStudio, Zenodo 10.5281/zenodo.12704284; not shipped) into a session that
# fits its lamp, and for bare walls their reflectances, to one condition.
#   chamber_session.sh READINGS_CSV CONDITION OUT_FOLDER [N]      CONDITION: BlackFelt or noFelt; N: every Nth sensor
# As its authors do: y <= 0.13 m is dropped (probe ends behind the felt), zeros too, and x is shifted by +0.07 m.
# World: z = 0 in the lamp plane, up; readings in umol m-2 s-1 stand in for lx (proportional for a fixed spectrum).
# The bar's sensors, 1.6 cm apart along y, are the same at every x and depth: column sensor.
# noFelt has the chamber as a box, 1.14 x 1.13 x 1.52 m inside. How far the lamp plane is below its ceiling is not
# published: 0.2 m here.
set -eu
readings=$1 condition=$2 out=$3 every=${4:-1}
mkdir -p "$out"
awk -F, -v condition="$condition" -v every="$every" '
  BEGIN { print "id,x_m,y_m,z_m,nx,ny,nz,state,illuminance_lx,sensor" }
  $1 == condition && $3 > 0.13 && $5 > 0 && int($3 / 0.016 + 0.5) % every == int(every / 2) {
    printf "d%s_%d,%.4f,%.4f,%.4f,0,0,1,%s,%s,y%s\n", $4, ++n, $2 + 0.07, $3, -$4, condition, $5, $3
  }' "$readings" > "$out/luxmeter.csv"
cat > "$out/session.toml" <<TOML
name = "chamber $condition"

[states]
$condition = { LED = 1.0 }

[luxmeter]
readings = "luxmeter.csv"
fit = ["*"]
TOML
[ "$condition" = noFelt ] || exit 0
cat > "$out/box.obj" <<OBJ
v 0 0 -1.32
v 1.14 0 -1.32
v 1.14 1.13 -1.32
v 0 1.13 -1.32
v 0 0 0.2
v 1.14 0 0.2
v 1.14 1.13 0.2
v 0 1.13 0.2
usemtl floor
f 1 2 3 4
usemtl ceiling
f 8 7 6 5
usemtl wall
f 1 5 6 2
f 2 6 7 3
f 3 7 8 4
f 4 8 5 1
OBJ
cat >> "$out/session.toml" <<TOML

[scene]
mesh = "box.obj"
TOML
