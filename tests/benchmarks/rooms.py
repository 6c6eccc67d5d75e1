#!/usr/bin/python3
"""Runs luxfit over rooms whose truth is known and prints a line for each: how it ended, time, and errors against the truth.

    tests/benchmarks/rooms.py PROGRAM ROOMS_FOLDER [OUT_FOLDER]

A room is a folder with session.toml and truth.json (the form of fixtures/office/README.md). Each run is a fresh one, with the program's
own budget. Times are by the clock: quote them from an idle machine. Luminaires are matched by id.
"""
import json
import math
import pathlib
import subprocess
import sys
import tempfile
import time

LUMINANCE = (0.265, 0.670, 0.065)


def largest(values):
    return max(values, default=math.nan)


def errors(result, truth):
    """Largest errors: position in mm, flux in %, reflectance; luminaires found and true."""
    true = {lamp["id"]: lamp for lamp in truth["lamps"]}
    found = [lamp for lamp in result["luminaires"] if lamp["id"] in true]
    materials = [m for m in result["materials"] if m["name"] in truth["materials"] and m["source"] == "estimated"]
    return {
        "mm": largest(1000 * math.dist(f["position_m"], true[f["id"]]["position"]) for f in found),
        "flux %": largest(100 * abs(f["flux_lm"] / true[f["id"]]["flux_lm"] - 1) for f in found if f["flux_lm"]),
        "albedo": largest(abs(m["albedo"] - sum(w * c for w, c in zip(LUMINANCE, truth["materials"][m["name"]])))
                          for m in materials),
        "found": f"{len(found)} of {len(true)}",
    }


def main(program, rooms, out):
    print(f"{'room':<14}{'status':<14}{'exit':>4}{'s':>8}{'found':>10}{'mm':>9}{'flux %':>8}{'albedo':>8}{'lx %':>7}  warnings")
    for session in sorted(pathlib.Path(rooms).glob("*/session.toml")):
        truth = session.parent / "truth.json"
        if not truth.exists():
            continue
        folder = pathlib.Path(out) / session.parent.name
        start = time.monotonic()
        run = subprocess.run([program, "run", session, "-o", folder, "--fresh"], capture_output=True, text=True)
        seconds = time.monotonic() - start
        name = f"{session.parent.name:<14}"
        if run.returncode not in (0, 1):
            print(f"{name}{'refused':<14}{run.returncode:>4}{seconds:>8.1f}  {run.stderr.strip().splitlines()[-1]}")
            continue
        result = json.loads((folder / "result.json").read_text())
        e = errors(result, json.loads(truth.read_text()))
        readings = result["summary"]["mean_abs_error_percent"]
        warnings = sorted({w["code"] for w in result["warnings"]})
        print(f"{name}{result['status']:<14}{run.returncode:>4}{seconds:>8.1f}{e['found']:>10}{e['mm']:>9.1f}{e['flux %']:>8.2f}"
              f"{e['albedo']:>8.4f}{math.nan if readings is None else readings:>7.2f}  {', '.join(warnings)}", flush=True)


if __name__ == "__main__":
    if len(sys.argv) not in (3, 4):
        sys.exit(__doc__)
    main(sys.argv[1], sys.argv[2], sys.argv[3] if len(sys.argv) == 4 else tempfile.mkdtemp())
