"""The example script on the office, start to end, against the truth that its renderer was given."""
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

FIXTURES = pathlib.Path(os.environ["LUXFIT_FIXTURES"])
EXAMPLE = FIXTURES.parent / "apps" / "python" / "example.py"


class ExampleTest(unittest.TestCase):
    def test_it_prints_what_is_true(self):
        with tempfile.TemporaryDirectory() as out:
            done = subprocess.run([sys.executable, EXAMPLE, FIXTURES / "office" / "session.toml", out],
                                  stdout=subprocess.PIPE, check=True, text=True)
        truth = json.loads((FIXTURES / "office" / "truth.json").read_text())
        lamps = {lamp["id"]: lamp for lamp in truth["lamps"]}
        schedule = re.findall(r"^([A-D]) +([\d.]+) +([\d.]+) +([\d.]+) +([\d.]+) +(\d+) +(\d+)$", done.stdout, re.M)
        self.assertEqual({row[0] for row in schedule}, set(lamps))
        for name, *numbers in schedule:
            x, y, z, _, flux_lm, _ = map(float, numbers)
            for found, true in zip((x, y, z), lamps[name]["position"]):
                self.assertAlmostEqual(found, true, delta=0.015)  # the target of the fit, m
            self.assertAlmostEqual(flux_lm, lamps[name]["flux_lm"], delta=0.02 * lamps[name]["flux_lm"])

        self.assertLess(float(re.search(r"mean error ([\d.]+) %", done.stdout)[1]), 2)

        # L1 with A at 100 % and at 0 %: the other three together, by the renderer's own light of each.
        rows = [line.split(",") for line in (FIXTURES / "office" / "truth_lux_per_lamp.csv").read_text().split()]
        l1 = {row[0]: float(row[1]) for row in rows[1:]}
        swept = {int(level): float(lux) for level, lux in re.findall(r"^ +(\d+) %  +([\d.]+)", done.stdout, re.M)}
        self.assertAlmostEqual(swept[100], sum(l1.values()), delta=0.05 * sum(l1.values()))
        self.assertAlmostEqual(swept[0], sum(l1.values()) - l1["A"], delta=0.05 * sum(l1.values()))

        # What surfaces keep of the light is what the luminaires send.
        table = re.findall(r"^(\S+) +(\d+) +(\d+)$", done.stdout, re.M)
        absorbed_lm = sum(int(received) - int(reflected) for _, received, reflected in table)
        sent_lm = sum(lamp["flux_lm"] for lamp in truth["lamps"])
        self.assertAlmostEqual(absorbed_lm, sent_lm, delta=0.03 * sent_lm)


if __name__ == "__main__":
    unittest.main()
