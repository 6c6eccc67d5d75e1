#!/usr/bin/python3
"""From photos to luminaires without a session file.

    python3 from_photos.py [FOLDER]

The folder is that of the office that the package installs. Packages: luxfit.
"""
import csv
import sys

import luxfit

office = sys.argv[1] if len(sys.argv) > 1 else "/usr/share/luxfit/office"
states = {"A": {"A": 1}, "B": {"B": 1}, "C": {"C": 1}, "D": {"D": 1},
          "all": {"A": 1, "B": 1, "C": 1, "D": 1}, "evening": {"A": 0.3, "C": 1, "D": 1}}
with open(f"{office}/photos.csv") as table:
    photos = [{"file": f"{office}/{row['file']}", "view": row["view"], "state": row["state"],
               "exposure_s": float(row["exposure_s"])} for row in csv.DictReader(table)]
reading = {"position_m": [3.7, 2.9, 0.741], "normal": [0, 0, 1], "state": "all", "illuminance_lx": 358.54}
fit = luxfit.fit_room(luxfit.Room(f"{office}/room.obj"), states, photos=photos, cameras=[f"{office}/cam0.yaml"],
                      tags=f"{office}/tags.json", readings=[reading])
for name, position_m, flux_lm in zip(fit.luminaire_ids, fit.position_m, fit.flux_lm):
    print(name, position_m.round(3), f"{flux_lm:.0f} lm")
