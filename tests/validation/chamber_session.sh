#!/bin/sh
# Turns the readings of the plant chamber (PalmStudio, Zenodo 10.5281/zenodo.12704284; not shipped) into a session that
# fits its lamp to one condition.
#   chamber_session.sh READINGS_CSV CONDITION OUT_FOLDER      CONDITION: BlackFelt or noFelt
# As its authors do: y <= 0.13 m is dropped (probe ends behind the felt), zeros too, and x is shifted by +0.07 m.
# World: z = 0 in the lamp plane, up; readings in umol m-2 s-1 stand in for lx (proportional for a fixed spectrum).
set -eu
readings=$1 condition=$2 out=$3
mkdir -p "$out"
awk -F, -v condition="$condition" '
  BEGIN { print "id,x_m,y_m,z_m,nx,ny,nz,state,lux" }
  $1 == condition && $3 > 0.13 && $5 > 0 {
    printf "d%s_%d,%.4f,%.4f,%.4f,0,0,1,%s,%s\n", $4, ++n, $2 + 0.07, $3, -$4, condition, $5
  }' "$readings" > "$out/luxmeter.csv"
cat > "$out/session.toml" <<TOML
name = "chamber $condition"

[states]
$condition = { LED = 1.0 }

[luxmeter]
readings = "luxmeter.csv"
fit = ["*"]
TOML
