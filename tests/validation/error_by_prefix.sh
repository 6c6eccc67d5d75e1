#!/bin/sh
# Median absolute error in percent of the luxmeter readings of a run, by the part of their id before "_".
#   luxfit check OUT | error_by_prefix.sh
awk '$NF == "fit" || $NF == "check" {
       split($1, id, "_"); e = $(NF - 2) + 0; print id[1], (e < 0 ? -e : e) }' |
  sort -k1,1 -k2,2n |
  awk '{ if ($1 != key) flush(); key = $1; v[++n] = $2 }
       END { flush() }
       function flush() { if (n) printf "%s: median |error| %.2f %% of %d readings\n", key, v[int((n + 1) / 2)], n; n = 0 }'
