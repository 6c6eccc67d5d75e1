"""The Python module: values against closed forms and result.json, shapes, errors.

    PYTHONPATH=FOLDER_OF_THE_MODULE LUXFIT_FIXTURES=.../fixtures /usr/bin/python3 python_test.py
"""
import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile
import threading
import unittest

import numpy as np

import luxfit

FIXTURES = pathlib.Path(os.environ["LUXFIT_FIXTURES"])
OFFICE = FIXTURES / "office" / "session.toml"
# A closed box, 3 m x 2 m x 2.5 m, faces wound counter-clockwise seen from inside.
BOX = """v 0 0 0
v 3 0 0
v 3 2 0
v 0 2 0
v 0 0 2.5
v 3 0 2.5
v 3 2 2.5
v 0 2 2.5
usemtl paint
f 1 2 3 4
f 8 7 6 5
f 1 5 6 2
f 2 6 7 3
f 3 7 8 4
f 4 8 5 1
"""


class InFolder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def write(self, name, text):
        (self.folder / name).write_text(text)
        return self.folder / name


class RoomWithoutMeshTest(InFolder):
    def test_three_lengths_are_a_room(self):
        path = self.write("session.toml", "[scene]\nsize = [300, 200, 250]\nunit = \"cm\"\n")
        scene = luxfit.read_session(path).scene
        assert scene and scene["corners_m"] is not None and scene["heights_m"] is not None
        self.assertIsNone(scene["mesh"])
        np.testing.assert_allclose(scene["corners_m"], [[0, 0], [3, 0], [3, 2], [0, 2]])
        np.testing.assert_allclose(scene["heights_m"], [2.5] * 4)
        room = luxfit.Room(path, patch_size_m=1)
        self.assertEqual(room.materials, ["floor", "ceiling", "wall 1", "wall 2", "wall 3", "wall 4"])
        self.assertAlmostEqual(room.patches["area_m2"].sum(), 37)
        with_mesh = luxfit.read_session(OFFICE).scene
        assert with_mesh
        self.assertIsNone(with_mesh["corners_m"])


class SessionTest(unittest.TestCase):
    def test_office_as_its_files_say(self):
        session = luxfit.read_session(OFFICE)
        self.assertEqual(session.name, "office")
        self.assertEqual(session.states["evening"], {"A": 0.3, "C": 1.0, "D": 1.0})
        np.testing.assert_allclose(session.dimming[5], [0.3, 0, 1, 1])
        readings = session.readings
        self.assertEqual(readings["position_m"].shape, (48, 3))
        np.testing.assert_allclose(readings["position_m"][0], [1.2, 1.2, 0.741])
        self.assertEqual(readings["illuminance_lx"][0], 257.6)
        self.assertEqual([i for i, role in enumerate(readings["role"]) if role == "scale"],
                         [i for i in range(48) if (readings["id"][i], readings["state"][i]) == ("L3", "all")])
        tags = json.loads((OFFICE.parent / "tags.json").read_text())
        np.testing.assert_allclose([tag["center_m"] for tag in session.tags], [tag["center_m"] for tag in tags])
        self.assertIsNone(session.luminaires[0]["position_m"])
        self.assertEqual(session.photos["exposure_s"][0], 0.119)

    def test_error_names_file_and_line(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "session.toml"
            path.write_text('[scene]\nmesh = "none.obj"\nunti = "m"\n')
            with self.assertRaisesRegex(luxfit.InputError, r"session.toml:\d+: scene"):
                luxfit.read_session(path)
        self.assertTrue(issubclass(luxfit.InputError, ValueError))
        self.assertTrue(issubclass(luxfit.MissingProgramError, RuntimeError))


class RoomTest(InFolder):
    ALBEDO = {"paint": 0.5}

    def room(self, **options):
        return luxfit.Room(self.write("box.obj", BOX), **options)

    def test_form_factors_are_closed_and_reciprocal(self):
        room = self.room(patch_size_m=0.5, element_size_m=0.5)
        factors, area = room.form_factors, room.patches["area_m2"]
        self.assertEqual(factors.shape, (len(area), len(area)))
        self.assertFalse(factors.flags.writeable)
        np.testing.assert_allclose(factors.sum(axis=1), 1, atol=1e-5)
        exchange = area[:, None] * factors
        np.testing.assert_allclose(exchange, exchange.T, atol=2e-3 * exchange.max())

    def test_form_factor_of_opposite_unit_squares(self):
        # Two facing squares one side apart (Hottel): F = 0.1998.
        path = self.write("two.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
                                     "f 1 2 3 4\nf 8 7 6 5\n")
        room = luxfit.Room(path, patch_size_m=1, element_size_m=1)
        np.testing.assert_allclose(room.form_factors, [[0, 0.199825], [0.199825, 0]], atol=1e-4)

    def test_direct_light_of_a_lambertian_point(self):
        # Phi cos(gamma) cos(theta) / (pi r^2)
        lamp = luxfit.Luminaire([1, 1, 2], 1000, "lambertian", id="P")
        places = np.array([[1, 1, 0.5], [2, 1, 0.5], [0.4, 0.2, 0.5]])
        light = self.room().illuminance([lamp], places, np.tile([0, 0, 2.0], (3, 1)), {"paint": 0.0})
        r2 = ((places - lamp.position_m) ** 2).sum(axis=1)
        np.testing.assert_allclose(light["direct_lx"][:, 0], 1000 / math.pi * 1.5**2 / r2**2, rtol=1e-5)
        np.testing.assert_allclose(light["illuminance_lx"], light["direct_lx"], rtol=1e-5)

    def test_energy_is_conserved(self):
        # Received light minus reflected light is what the lamp sends: Phi = sum A E (1 - rho).
        room = self.room()
        lamps = [luxfit.Luminaire([1, 1, 1.2], 500, "isotropic"), luxfit.Luminaire([2, 1, 1.5], 800, "isotropic")]
        light = room.patch_light(lamps, self.ALBEDO)
        received = room.patches["area_m2"] @ light["illuminance_lx"]
        np.testing.assert_allclose(0.5 * received, [500, 800], rtol=0.02)
        np.testing.assert_allclose(light["exitance_lm_m2"], 0.5 * light["illuminance_lx"], rtol=1e-5)

    def test_patches_lie_on_the_box(self):
        patches = self.room().patches
        np.testing.assert_allclose(patches["vertices_m"].mean(axis=1), patches["center_m"], atol=1e-9)
        self.assertAlmostEqual(patches["area_m2"].sum(), 2 * (3 * 2 + 3 * 2.5 + 2 * 2.5), 6)
        inwards = ([1.5, 1, 1.25] - patches["center_m"]) * patches["normal"]
        self.assertTrue((inwards.sum(axis=1) > 0).all())

    def test_wrong_arguments(self):
        room = self.room()
        lamp = luxfit.Luminaire([1, 1, 2], 100)
        for call, words in [
            (lambda: room.illuminance([lamp], [[1, 1, 1]], [[0, 0, 0]], self.ALBEDO), "row 0"),
            (lambda: room.illuminance([lamp], [[1, 1]], [[0, 1]], self.ALBEDO), r"shape \(n, 3\)"),
            (lambda: room.illuminance([lamp], [[1, 1, 1]], [[0, 0, 1]], {}), "paint"),
            (lambda: room.illuminance([lamp], [[1, 1, 1]], [[0, 0, 1]], {"paint": 1.0}), "paint"),
            (lambda: room.patch_light([lamp], {"paint": 0.5, "pant": 0.5}), 'did you mean "paint"'),
            (lambda: self.room(method="halley"), 'did you mean "malley"'),
            (lambda: self.room(unit="yd"), "unit"),
            (lambda: luxfit.Room(self.folder / "none.obj"), "none.obj"),
            (lambda: luxfit.Luminaire([0, 0, 1], 100, "lambertain"), 'did you mean "lambertian"'),
            (lambda: luxfit.Luminaire([0, 0, 1]), "flux_lm"),
            (lambda: luxfit.Luminaire([0, 0, 1], -1), "flux_lm"),
            (lambda: luxfit.Luminaire([0, 0, math.nan], 1), "position_m"),
            (lambda: luxfit.Luminaire([0, 0, 1], 1, aim=[0, 0, 0]), "aim"),
            (lambda: luxfit.Luminaire([0, 0, 1], 1, "cosine_power"), "cosine_exponent"),
            (lambda: luxfit.Luminaire([0, 0, 1], 1, shape="rectangle"), "size_m"),
        ]:
            with self.assertRaisesRegex(luxfit.InputError, words):
                call()
        with self.assertRaises(ValueError):
            self.room(patch_size_m=-1)

    def test_other_threads_run_meanwhile(self):
        beats = []
        stop = threading.Event()

        def beat():
            while not stop.wait(0.002):
                beats.append(1)

        room_file = self.write("box.obj", BOX)
        beating = threading.Thread(target=beat)
        beating.start()
        luxfit.Room(room_file, patch_size_m=0.1, element_size_m=0.1)
        seen = len(beats)
        stop.set()
        beating.join()
        self.assertGreater(seen, 2)


class PhotometryTest(InFolder):
    def test_intensity_of_a_cosine_power_lobe(self):
        lamp = luxfit.Luminaire([0, 0, 0], 100, "cosine_power", cosine_exponent=3, aim=[1, 0, 0])
        gamma = np.array([0.0, 0.4, 1.0])
        directions = np.stack([np.cos(gamma), np.sin(gamma), 0 * gamma], axis=1)
        np.testing.assert_allclose(lamp.intensity_cd(directions), 100 * 4 / (2 * math.pi) * np.cos(gamma) ** 3,
                                   rtol=1e-9)
        np.testing.assert_allclose(lamp.intensity_cd([[-1, 0, 0]]), 0)

    def test_files_come_back(self):
        lamp = luxfit.Luminaire([0, 0, 2], 1234, "lambertian", shape="disc", size_m=[0.3], id="spot")
        for name in ("spot.ies", "spot.ldt"):
            luxfit.write_photometry(self.folder / name, lamp)
            table = luxfit.read_photometry(self.folder / name)
            self.assertAlmostEqual(table["flux_lm"], 1234, delta=0.5)
            self.assertEqual(table["shape"], "disc")
            np.testing.assert_allclose(table["size_m"][0], 0.3)
            self.assertEqual(table["cd_per_klm"].shape, (len(table["c_deg"]), len(table["gamma_deg"])))
            gamma = np.radians(table["gamma_deg"])
            np.testing.assert_allclose(table["cd_per_klm"][0], 1000 / math.pi * np.maximum(np.cos(gamma), 0),
                                       atol=1)
            again = luxfit.Luminaire([0, 0, 2], photometry=str(self.folder / name))
            self.assertAlmostEqual(again.flux_lm, 1234, delta=0.5)
            self.assertEqual(again.shape, "disc")
        with self.assertRaisesRegex(luxfit.InputError, "ies or .ldt"):
            luxfit.write_photometry(self.folder / "spot.txt", lamp)

    def test_errors_in_files_name_the_line(self):
        with self.assertRaisesRegex(luxfit.InputError, r"bad.ies:\d+"):
            luxfit.read_photometry(self.write("bad.ies", "IESNA:LM-63-2002\nTILT=NONE\n1 two 3\n"))


class FitTest(InFolder):
    """An isotropic lamp in the open, read by a meter: E = Phi (n . d) / (4 pi r^2)."""
    LAMP, FLUX = np.array([0.4, -0.2, 2.0]), 900.0

    def session(self):
        rows = ["id,x_m,y_m,z_m,nx,ny,nz,state,lux"]
        for i in range(5):
            for j in range(5):
                x, y = i - 2.0, j - 2.0
                d = self.LAMP - [x, y, 0]
                rows.append(f"G{i}{j},{x},{y},0,0,0,1,on,{self.FLUX * d[2] / (4 * math.pi * np.linalg.norm(d)**3):.9g}")
        self.write("luxmeter.csv", "\n".join(rows) + "\n")
        return self.write("session.toml", """name = "lamp"
[states]
on = { P = 1.0 }
[[luminaire]]
id = "P"
photometry = "isotropic"
shape = "point"
aim = [0, 0, -1]
[luxmeter]
readings = "luxmeter.csv"
fit = ["G*"]
""")

    def test_a_lamp_is_found_and_result_json_says_the_same(self):
        out = self.folder / "out"
        result = luxfit.fit(self.session(), out)
        self.assertEqual(result.status, "done")
        np.testing.assert_allclose(result.position_m, [self.LAMP], atol=1e-3)
        np.testing.assert_allclose(result.flux_lm, [self.FLUX], rtol=1e-3)
        whole = json.loads((out / "result.json").read_text())
        self.assertEqual(result.whole, whole)
        self.assertEqual(result.luminaire_ids, ["P"])
        np.testing.assert_array_equal(result.position_m[0], whole["luminaires"][0]["position_m"])
        np.testing.assert_array_equal(result.measured_lx, [r["measured_lx"] for r in whole["luxmeter"]])
        np.testing.assert_array_equal(result.predicted_lx, [r["predicted_lx"] for r in whole["luxmeter"]])
        self.assertEqual(set(result.reading_roles), {"fit"})
        np.testing.assert_allclose(np.sqrt(np.diag(result.position_covariance_m2("P"))), result.position_sigma_m[0])
        self.assertEqual(result.covariance.shape, 2 * (len(result.parameter_names),))
        self.assertEqual(luxfit.read_result(out).whole, whole)
        self.assertEqual(luxfit.read_result(out / "result.json").parameters.tolist(), result.parameters.tolist())
        with self.assertRaisesRegex(luxfit.InputError, "position z of P"):
            result.position_covariance_m2("Q")

        light = luxfit.simulate(luxfit.read_session(self.folder / "session.toml").with_result(out))
        np.testing.assert_allclose(light.reading_lx, result.predicted_lx, rtol=1e-4)
        np.testing.assert_allclose(light.illuminance_lx[:, 0], result.measured_lx, rtol=2e-3)
        self.assertEqual(light.patches["center_m"].shape, (0, 3))

    def test_nothing_goes_to_standard_output(self):
        session = self.session()
        code = f"import luxfit; luxfit.fit({str(session)!r}, {str(self.folder / 'out')!r})"
        done = subprocess.run([sys.executable, "-c", code], capture_output=True, check=True)
        self.assertEqual(done.stdout, b"")

    def test_what_is_missing_is_said(self):
        with self.assertRaisesRegex(luxfit.InputError, "position_m"):
            luxfit.simulate(luxfit.read_session(self.session()))
        with self.assertRaisesRegex(luxfit.InputError, "result.json"):
            luxfit.read_result(self.folder)
        self.write("result.json", "{}")
        with self.assertRaisesRegex(luxfit.InputError, "luxfit-result-1"):
            luxfit.read_result(self.folder)
        with self.assertRaises(TypeError):
            luxfit.fit()  # type: ignore[call-arg]


class SimulateTest(InFolder):
    def test_closed_box_lit_by_one_lamp(self):
        self.write("box.obj", BOX)
        self.write("luxmeter.csv", "id,x_m,y_m,z_m,nx,ny,nz,state,lux\nL,1.5,1,0,0,0,1,half,\nL,1.5,1,0,0,0,1,full,\n")
        session = luxfit.read_session(self.write("session.toml", """[scene]
mesh = "box.obj"
[scene.albedo]
paint = [0.6, 0.5, 0.4]
[states]
half = { P = 0.5 }
full = { P = 1.0 }
[[luminaire]]
id = "P"
photometry = "isotropic"
position_m = [1.5, 1, 1.25]
flux_lm = 1000
[luxmeter]
readings = "luxmeter.csv"
"""))
        light = luxfit.simulate(session, error_percent=2)
        self.assertEqual(light.illuminance_lx.shape, (1, 1))
        np.testing.assert_allclose(light.direct_lx, [[1000 / (4 * math.pi * 1.25**2)]], rtol=1e-4)
        np.testing.assert_allclose(light.reading_lx, light.illuminance_lx[0, 0] * np.array([0.5, 1]))
        patches = light.patches
        # Of every channel: Phi = sum A E (1 - rho); exitance weighs reflectances by the light of their channel.
        absorbed = (patches["area_m2"][:, None] * (patches["illuminance_lx"] - patches["exitance_lm_m2"])).sum()
        self.assertAlmostEqual(absorbed, 1000, delta=20)
        weights = np.array([0.265, 0.670, 0.065])
        expected = sum(w * 1000 * rho / (1 - rho) for w, rho in zip(weights, [0.6, 0.5, 0.4])) / weights.sum()
        reflected = (patches["area_m2"][:, None] * patches["exitance_lm_m2"]).sum()
        self.assertAlmostEqual(reflected, expected, delta=0.02 * expected)
        with self.assertRaisesRegex(luxfit.InputError, "error_percent"):
            luxfit.simulate(session, error_percent=0)


if __name__ == "__main__":
    unittest.main()
