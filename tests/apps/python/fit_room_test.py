"""luxfit.fit_room: the example from photos to luminaires against the truth of its renderer; readings alone; errors."""
import json
import os
import pathlib
import re
import subprocess
import sys
import unittest

import numpy as np

import luxfit

FIXTURES = pathlib.Path(os.environ["LUXFIT_FIXTURES"])
OFFICE = FIXTURES / "office"
EXAMPLE = FIXTURES.parent / "apps" / "python" / "from_photos.py"
STATES = {"A": {"A": 1.0}}
READING = {"position_m": [1.2, 1.2, 0.741], "normal": [0, 0, 1], "state": "A", "illuminance_lx": 257.6}


class FromPhotos(unittest.TestCase):
    def test_the_example_finds_the_luminaires(self):
        done = subprocess.run([sys.executable, EXAMPLE, OFFICE], stdout=subprocess.PIPE, check=True, text=True)
        found = {name: ([float(x) for x in place.split()], float(flux))
                 for name, place, flux in re.findall(r"^(\S+) \[(.*)\] (\d+) lm$", done.stdout, re.M)}
        for lamp in json.loads((OFFICE / "truth.json").read_text())["lamps"]:
            position_m, flux_lm = found[lamp["id"]]
            # As tests/inverse/fit/from_photos_test.cc, 1.5 times what it reaches.
            self.assertLess(np.linalg.norm(np.subtract(position_m, lamp["position"])), 0.0065)
            self.assertAlmostEqual(flux_lm / lamp["flux_lm"], 1, delta=0.02)  # the one reading that sets the scale is good to 2 %

    def test_the_example_is_short(self):
        code = EXAMPLE.read_text().split('"""')[2]
        self.assertLessEqual(len([line for line in code.splitlines() if line.strip()]), 18)


class Refusals(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.room = luxfit.Room(OFFICE / "room.obj")

    def refuses(self, text, **given):
        given.setdefault("states", STATES)
        with self.assertRaisesRegex(luxfit.InputError, text):
            luxfit.fit_room(self.room, **given)

    def test_wrong_values_are_named(self):
        photo = {"file": OFFICE / "photos" / "v00_A.png", "view": "v00", "state": "A", "exposure_s": 0.1}
        camera = {"cameras": [OFFICE / "cam0.yaml"], "tags": OFFICE / "tags.json"}
        self.refuses(r"photos\[0\]\.exposure_s: expected > 0 s", photos=[{**photo, "exposure_s": 0}], **camera)
        self.refuses(r"photos\[0\]\.exposure_s: expected a time in s, got 'long'",
                     photos=[{**photo, "exposure_s": "long"}], **camera)
        self.refuses(r"photos\[0\]\.state: expected", photos=[{**photo, "state": "B"}], **camera)
        self.refuses(r"photos\[0\]: key: expected", photos=[{**photo, "exposure": 1}], **camera)
        self.refuses(r"photos\[0\]\.camera: expected an index below 1", photos=[{**photo, "camera": 1}], **camera)
        self.refuses("tags: expected a survey", photos=[photo], cameras=camera["cameras"])
        self.refuses(r"states\[\"A\"\].*expected a dict", states={"A": 1})
        self.refuses(r"states\[\"A\"\]\[\"A\"\]: expected a number in \[0, 1\]", states={"A": {"A": 2}})
        self.refuses(r"readings\[0\]\.illuminance_lx: expected > 0", readings=[{**READING, "illuminance_lx": 0}])
        self.refuses("albedo: expected", readings=[READING], albedo={"nowhere": 0.5})

    def test_too_little_data_is_no_exception(self):
        fit = luxfit.fit_room(self.room, STATES, readings=[READING])
        self.assertEqual(fit.status, "undetermined")
        self.assertTrue(fit.warnings)
        for warning in fit.warnings:
            self.assertEqual(set(warning), {"code", "message", "remedy"})


if __name__ == "__main__":
    unittest.main()
