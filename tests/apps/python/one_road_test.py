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


def arguments_of(path):
    """Returns the arguments of fit_room that a session of the office stands for."""
    session = luxfit.read_session(path)
    photos = [{"file": OFFICE / row["file"], "view": row["view"], "state": row["state"], "exposure_s": float(row["exposure_s"])}
              for row in rows("photos.csv")]
    readings = [{"position_m": [float(row[axis]) for axis in ("x_m", "y_m", "z_m")],
                 "normal": [float(row[axis]) for axis in ("nx", "ny", "nz")],
                 "state": row["state"], "illuminance_lx": float(row["illuminance_lx"]), "used": (row["id"], row["state"]) == ("L3", "all")}
                for row in rows("luxmeter.csv")]
    return {"room": luxfit.Room(path), "states": session.states, "photos": photos,
            "cameras": [OFFICE / "cam0.yaml"], "tags": OFFICE / "tags.json", "readings": readings}


def without_group(name, obj):
    """Returns the OBJ without the faces of groups of that name."""
    kept, is_in = [], False
    for line in obj.splitlines():
        if line.startswith("g "):
            is_in = line.startswith(f"g {name}_")
        if not (is_in and line[:2] in ("f ", "us", "g ")):
            kept.append(line)
    return "\n".join(kept) + "\n"


class OneRoad(unittest.TestCase):
    """fit_room and `luxfit run` are one road: the same photos give the same light, and the same words."""

    @classmethod
    def setUpClass(cls):
        cls.given = arguments_of(OFFICE / "session.toml")
        cls.found = luxfit.fit_room(**cls.given)
        with tempfile.TemporaryDirectory() as out:
            cls.run_of_session = luxfit.fit(OFFICE / "session.toml", out)
            cls.places = [[reading[key] for reading in cls.given["readings"]] for key in ("position_m", "normal")]
            cls.light_of_run = cls.light_by_state(cls.run_of_session)

    @classmethod
    def light_by_state(cls, fit):
        return {state: fit.illuminance(*cls.places, dimming) for state, dimming in cls.given["states"].items()}

    def test_light_at_the_readings_places_is_what_was_predicted_there(self):
        states = [reading["state"] for reading in self.given["readings"]]
        for fit, light in (self.found, self.light_by_state(self.found)), (self.run_of_session, self.light_of_run):
            np.testing.assert_allclose([light[s][i] for i, s in enumerate(states)], fit.predicted_lx, rtol=1e-6)
        with self.assertRaisesRegex(luxfit.InputError, "dimming"):
            self.found.illuminance(*self.places, {"Z": 1})

    def expect_one_light(self, found, run):
        self.assertEqual(found.luminaire_ids, run.luminaire_ids)
        # They are equal to the last digit; a library may sum in another order some day.
        np.testing.assert_allclose(found.position_m, run.position_m, rtol=1e-9)
        np.testing.assert_allclose(found.flux_lm, run.flux_lm, rtol=1e-9)
        np.testing.assert_allclose(found.flux_sigma_lm, run.flux_sigma_lm, rtol=1e-9)
        np.testing.assert_allclose([found.albedo[m["name"]] for m in run.materials], [m["albedo"] for m in run.materials], rtol=1e-9)
        np.testing.assert_allclose(found.predicted_lx, run.predicted_lx, rtol=1e-9)

    def test_the_light_is_the_same(self):
        self.expect_one_light(self.found, self.run_of_session)

    def test_so_it_is_with_furniture_that_the_mesh_lacks(self):
        with tempfile.TemporaryDirectory() as folder:
            office = pathlib.Path(folder) / "office"
            office.mkdir()
            for file in OFFICE.iterdir():
                (office / file.name).symlink_to(file)
            (office / "room.obj").unlink()
            (office / "room.obj").write_text(without_group("cabinet", (OFFICE / "room.obj").read_text()))
            run = luxfit.fit(office / "session.toml", pathlib.Path(folder) / "out")
            found = luxfit.fit_room(**arguments_of(office / "session.toml"))
            as_given = luxfit.fit_room(**arguments_of(office / "session.toml"), furniture="given")
        codes = [warning["code"] for warning in found.warnings]
        self.assertIn("furniture_found", codes)
        self.assertEqual(codes, [warning["code"] for warning in run.warnings])
        self.assertIn("found 1", found.albedo)
        self.expect_one_light(found, run)
        self.assertNotIn("furniture_found", [warning["code"] for warning in as_given.warnings])
        self.assertNotIn("found 1", as_given.albedo)

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
