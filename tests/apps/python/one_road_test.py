"""luxfit.fit_room against luxfit.fit: from the same photos, states and readings, the same light and the same words."""
import csv
import os
import pathlib
import tempfile
import unittest

import numpy as np

import luxfit

OFFICE = pathlib.Path(os.environ["LUXFIT_FIXTURES"]) / "office"


def rows(name):
    with open(OFFICE / name) as table:
        return list(csv.DictReader(table))


def office_session():
    """Returns the arguments of fit_room that fixtures/office/session.toml stands for."""
    session = luxfit.read_session(OFFICE / "session.toml")
    photos = [{"file": OFFICE / row["file"], "view": row["view"], "state": row["state"], "exposure_s": float(row["exposure_s"])}
              for row in rows("photos.csv")]
    readings = [{"position_m": [float(row[axis]) for axis in ("x_m", "y_m", "z_m")],
                 "normal": [float(row[axis]) for axis in ("nx", "ny", "nz")],
                 "state": row["state"], "illuminance_lx": float(row["illuminance_lx"]), "used": (row["id"], row["state"]) == ("L3", "all")}
                for row in rows("luxmeter.csv")]
    return {"room": luxfit.Room(OFFICE / "session.toml"), "states": session.states, "photos": photos,
            "cameras": [OFFICE / "cam0.yaml"], "tags": OFFICE / "tags.json", "readings": readings}


class OneRoad(unittest.TestCase):
    """fit_room and `luxfit run` are one road: the same photos give the same light, and the same words."""

    @classmethod
    def setUpClass(cls):
        cls.given = office_session()
        cls.found = luxfit.fit_room(**cls.given)
        with tempfile.TemporaryDirectory() as out:
            cls.run_of_session = luxfit.fit(OFFICE / "session.toml", out)

    def test_the_light_is_the_same(self):
        run, found = self.run_of_session, self.found
        self.assertEqual(found.luminaire_ids, run.luminaire_ids)
        # The order of sums over threads may differ; nothing else does.
        np.testing.assert_allclose(found.position_m, run.position_m, rtol=1e-9)
        np.testing.assert_allclose(found.flux_lm, run.flux_lm, rtol=1e-9)
        np.testing.assert_allclose(found.flux_sigma_lm, run.flux_sigma_lm, rtol=1e-9)
        np.testing.assert_allclose([found.albedo[m["name"]] for m in run.materials], [m["albedo"] for m in run.materials], rtol=1e-9)
        np.testing.assert_allclose(found.predicted_lx, run.predicted_lx, rtol=1e-9)

    def test_the_words_are_the_same(self):
        said = {choice["what"]: choice for choice in self.run_of_session.choices}
        for choice in self.found.choices:
            self.assertEqual(choice, said[choice["what"]])
        # What only a session has: methods of registration, and the room as it was read.
        self.assertEqual(set(said) - {choice["what"] for choice in self.found.choices}, {"patches", "lens", "registration"})
        self.assertEqual([warning["code"] for warning in self.found.warnings], [warning["code"] for warning in self.run_of_session.warnings])

    def test_a_photo_of_another_state_is_named_and_left_out(self):
        photos = [dict(photo) for photo in self.given["photos"]]
        wrong = next(photo for photo in photos if photo["view"] == "v00" and photo["state"] == "A")
        other = next(photo for photo in photos if photo["view"] == "v00" and photo["state"] == "B")
        wrong["file"], other["file"] = other["file"], wrong["file"]
        fit = luxfit.fit_room(**{**self.given, "photos": photos})
        named = [warning for warning in fit.warnings if warning["code"] == "photos_as_if"]
        self.assertEqual(len(named), 1)
        self.assertIn(str(wrong["file"]), named[0]["message"])
        np.testing.assert_allclose(fit.flux_lm, self.found.flux_lm, rtol=0.005)  # without two of the photos


if __name__ == "__main__":
    unittest.main()
