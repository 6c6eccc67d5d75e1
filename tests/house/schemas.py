#!/usr/bin/python3
"""Every JSON file that the program writes is as docs/schema says, and every schema there has a file that it describes.

    schemas.py REPO LUXFIT WORK_FOLDER

Runs the program on the fixtures and on small made sessions, then checks every .json and .jsonl file below WORK_FOLDER/out. What
commands print by --json counts as a file. A file's schema is that of its `format`, else the one of its name.
"""
import concurrent.futures
import json
import math
import pathlib
import random
import shutil
import struct
import subprocess
import sys
import zlib

import jsonschema

REPO, LUXFIT = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
WORK = pathlib.Path(sys.argv[3]).resolve()
IN, OUT = WORK / "in", WORK / "out"
# Schemas that no run below has a file for, with the reason.
UNUSED = {}
ERRORS_SHOWN = 10


def luxfit(command, *arguments, save="", status=0):
    """Runs a command; what it prints by --json is saved as out/printed/SAVE.json."""
    line = [str(LUXFIT), command, *map(str, arguments), *(["--json"] if save else [])]
    run = subprocess.run(line, cwd=WORK, capture_output=True, text=True, check=False)
    if run.returncode != status:
        sys.exit(f"{' '.join(line)}\n{run.stdout}{run.stderr}exit status {run.returncode}, expected {status}")
    if save:
        path = OUT / "printed" / f"{save}.json"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(run.stdout)


def write(path, text):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)


def edit(path, old, new):
    """Replaces what stands once in a file."""
    text = path.read_text()
    if text.count(old) != 1:
        sys.exit(f"{path}: expected {old!r} once")
    path.write_text(text.replace(old, new))


def write_png(path, rows, bits):
    """A grey picture: rows of whole numbers."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    letter = "H" if bits == 16 else "B"
    lines = b"".join(b"\0" + struct.pack(f">{len(row)}{letter}", *row) for row in rows)
    header = struct.pack(">IIBBBBB", len(rows[0]), len(rows), bits, 0, 0, 0, 0)
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(lines)) + chunk(b"IEND", b""))


def run_office():
    """Photos to result and all that reads a result; the same without a scale; albedo in detail."""
    office = IN / "office"
    shutil.copytree(REPO / "fixtures/office", office)
    # A photo whose exposure is not the stated one, a reading that disagrees, and a place that nobody measured.
    edit(office / "photos.csv", "photos/v00_A.png,cam0,v00,A,0.119", "photos/v00_A.png,cam0,v00,A,0.155")
    edit(office / "luxmeter.csv", "L2,2.1,1.6,0.741,0,0,1,A,266.48", "L2,2.1,1.6,0.741,0,0,1,A,366.48\nL9,2.1,1.7,0.741,0,0,1,A,")
    luxfit("doctor", office / "session.toml", save="doctor")
    luxfit("init", "--photos", office / "photos", "--mesh", office / "room.obj", "--tags", office / "tags.json",
           "-o", OUT / "init", save="init")
    luxfit("room", office / "session.toml", "-o", WORK / "plan.svg", save="room")
    out = OUT / "office"
    luxfit("run", office / "session.toml", "-o", out, status=1)  # the reading that disagrees
    shutil.copytree(out, OUT / "albedo")
    shutil.copytree(out, OUT / "relative")
    luxfit("run", office / "session.toml", "-o", out, "--dry-run", save="plan")
    luxfit("check", out, "--subset", "*@all", save="check", status=1)
    luxfit("report", out, save="report")
    luxfit("explain", "scale_undetermined", save="explain")
    luxfit("export", out, "--only", "csv,cameras,luminaires,patches,radiance")
    shutil.copy(office / "photos/v00_evening.png", IN / "evening.png")
    luxfit("luxmap", out, IN / "evening.png", "--view", "v00", "--exposure-s", "0.206")
    luxfit("spot", out, "v00_A:240,180", "v01_A:100,100")
    luxfit("glare", out, "v00_A", "--threshold", "5x", status=1)  # luminaires in view saturate
    luxfit("advise", out, save="advise")
    luxfit("advise", office / "session.toml", "--top", "1", "-o", OUT / "first")
    luxfit("dim", out, "--person", "1.0,1.2,1.2,-1,0,0")
    design = "".join(f"""[[luminaire]]
id = "{name}"
photometry = "lambertian"
shape = "rectangle"
size_m = [0.6, 0.6]
position_m = [{x}, {y}, 2.79]
flux_lm = 3600
""" for name, x, y in (("A", 1.5, 2.0), ("B", 4.2, 2.6), ("missing", 0.3, 0.3)))
    write(IN / "design.toml", design + '[[point]]\nid = "L1"\nilluminance_lx = 300\n')
    write(IN / "targets.toml",
          '[[area]]\nid = "desk"\nheight_m = 0.75\nspacing_m = 1.0\naverage_lx = 2000\nuniformity = 0.6\n')
    luxfit("commission", out, "--design", IN / "design.toml", "--targets", IN / "targets.toml", status=1)
    luxfit("albedo", office / "session.toml", "-o", OUT / "albedo", status=1)
    shutil.copy(office / "session.toml", office / "relative.toml")
    edit(office / "relative.toml", 'scale = ["L3@all"]', "")
    edit(office / "relative.toml", "[luxmeter]", """[[luminaire]]
id = "A"
photometry = "table"
gamma_deg = [0, 45, 90]
cd_per_klm = [318, 225, 0]
[[luminaire]]
id = "B"
shape = "rectangle"
size_m = [0.6, 0.6]
[luxmeter]""")
    text = (office / "session.toml").read_text()
    write(office / "unsurveyed.toml", text[text.index("[tags]"):].replace('map = "tags.json"', "size_m = 0.2"))
    luxfit("register", office / "unsurveyed.toml", "-o", OUT / "unsurveyed")
    luxfit("albedo", office / "relative.toml", "-o", OUT / "relative", status=1)


def run_reference():
    """Light of what is given; a fit to readings alone."""
    reference = REPO / "fixtures/forward_reference"
    luxfit("simulate", reference / "spots/session.toml", "-o", OUT / "simulate_spots")
    luxfit("chart", reference / "cube/session.toml", "-o", OUT / "chart", "--budget", "0.5")
    mesh = REPO / "fixtures/office/room.obj"
    luxfit("formfactors", mesh, "-o", OUT / "formfactors/factors.json", "--patch-size", "2", "--rays", "64")
    luxfit("formfactors", mesh, "-o", OUT / "formfactors/factors.csv", "--patch-size", "2", "--rays", "64", save="formfactors")
    cube = IN / "cube"
    shutil.copytree(reference / "cube", cube)
    lux = (cube / "expected_lux_per_lamp.csv").read_text().splitlines()[1].split(",")[1:]
    head, *rows = (cube / "luxmeter.csv").read_text().splitlines()
    # All readings in foot-candles, beside a given flux.
    misread = [f"{row}{float(value) / 10.764}" for row, value in zip(rows, lux)]
    write(cube / "foot_candles.csv", "\n".join([head, *misread]) + "\n")
    write(cube / "foot_candles.toml",
          (cube / "session.toml").read_text().replace("luxmeter.csv", "foot_candles.csv") + 'fit = ["P0_0"]\n')
    luxfit("fit", cube / "foot_candles.toml", "-o", OUT / "foot_candles", status=1)
    # Two sensors; rows of the mesh of places that only check read too much.
    rows = [f"{row}{float(value) * (1.2 if row[1] in '135' else 1)},s{row[1] in '24'}" for row, value in zip(rows, lux)]
    write(cube / "luxmeter.csv", "\n".join([head + ",sensor", *rows]) + "\n")
    luxfit("simulate", cube / "session.toml", "-o", OUT / "simulate_cube")
    start = (cube / "session.toml").read_text()
    open_albedo = start[:start.index("[scene.albedo]")]
    lamp = """[states]
A = { A = 1.0 }
[[luminaire]]
id = "A"
photometry = "isotropic"
shape = "point"
position_m = [2, 2, 2]
position_sigma_m = 0.5
[luxmeter]
readings = "luxmeter.csv"
fit = ["P0_*", "P2_*", "P4_*"]
"""
    write(cube / "open.toml", open_albedo + lamp)
    luxfit("fit", cube / "open.toml", "-o", OUT / "readings", status=1)
    # Charts fit many times: six readings, a known place and reflectance.
    few = [row for row in rows if row[1] in "02" and row[3] in "024"]
    write(cube / "few.csv", "\n".join([head + ",sensor", *few]) + "\n")
    lamp = lamp.replace("sigma_m = 0.5", "sigma_m = 0").replace("luxmeter.csv", "few.csv").replace(', "P4_*"', "")
    write(cube / "given.toml", open_albedo + "[scene.albedo]\nall = 0.7\n" + lamp)
    luxfit("chart", cube / "given.toml", "-o", OUT / "stability", "--stability", "--trials", "1", "--only",
           "noise,luminaires_together,albedo_raised")
    luxfit("chart", cube / "given.toml", "-o", OUT / "fit_chart", "--fit")


def corner_rows(camera_x, tilt, rng):
    """mrcal's table of a board, tilted by up to that angle, before a camera that stands camera_x to the right, twelve times."""
    text = "# filename x y level\n"
    for image in range(12):
        tilt_x, tilt_y = tilt * math.sin(2.1 * image), tilt * math.cos(1.3 * image)
        center = (0.2 * math.sin(3.7 * image), 0.14 * math.cos(2.9 * image), 0.75 + 0.25 * math.sin(1.1 * image))
        for row in range(9):
            for column in range(12):
                x, y = 0.05 * (column - 5.5), 0.05 * (row - 4)
                y, z = y * math.cos(tilt_x), y * math.sin(tilt_x)
                x, z = x * math.cos(tilt_y) + z * math.sin(tilt_y), z * math.cos(tilt_y) - x * math.sin(tilt_y)
                x, y, z = x + center[0] - camera_x, y + center[1], z + center[2]
                u, v = 639.5 + 900 * x / z + rng.gauss(0, 0.1), 479.5 + 900 * y / z + rng.gauss(0, 0.1)
                u += 8 if (image, row, column) == (3, 4, 5) else 0
                seen = 0 <= u <= 1279 and 0 <= v <= 959
                text += f"image{image}.png " + (f"{u:.4f} {v:.4f} 0\n" if seen else "- - -\n")
    return text


def run_calibration():
    """A rig, a lens that so few images do not determine, and a board that was never tilted."""
    rng = random.Random(1)
    session = ""
    for number, camera_x in enumerate((0, 0.1)):
        write(IN / f"rig/cam{number}.vnl", corner_rows(camera_x, 0.5, rng))
        session += f"""[[camera]]
id = "cam{number}"
calibration_corners = "cam{number}.vnl"
image_size = [1280, 960]
board = {{ type = "chessboard", columns = 12, rows = 9, square_size_m = 0.05 }}
"""
    write(IN / "rig/session.toml", session + '[calibration]\nlens = "opencv4"\n')
    luxfit("calibrate", IN / "rig/session.toml", "-o", OUT / "calibrate")
    luxfit("report", OUT / "calibrate", save="calibration_report")
    alone = session[:session.index("[[camera]]", 1)]
    write(IN / "rig/alone.toml", alone + '[calibration]\nlens = "splined8"\n')
    luxfit("calibrate", IN / "rig/alone.toml", "-o", OUT / "calibrate_alone", status=1)
    write(IN / "flat/cam0.vnl", corner_rows(0, 0, rng))
    write(IN / "flat/session.toml", alone + '[calibration]\nlens = "opencv4"\n')
    luxfit("calibrate", IN / "flat/session.toml", "-o", OUT / "calibrate_flat", status=1)


def run_linearization():
    """A bracket of a gamma camera with a flat field."""
    side, folder = 64, IN / "bracket"
    table = "file,camera,view,state,exposure_s\n"
    for k in range(6):
        exposure = 0.01 * 2**k
        def counts(u, v, exposure=exposure):
            light = exposure * 10**(2.5 * (u + side * (v % 8) / 8) / (2 * side) - 1)
            return min(255, round(255 * min(1, light) ** (1 / 2.2)))
        write_png(folder / f"e{k}.png", [[counts(u, v) for u in range(side)] for v in range(side)], 8)
        table += f"e{k}.png,cam0,v0,on,{exposure * (1.2 if k == 2 else 1)}\n"
    write_png(folder / "flat.png", [[200] * side for _ in range(side)], 8)
    write(folder / "photos.csv", table)
    write(folder / "session.toml", f"""[[camera]]
id = "cam0"
intrinsics = "{REPO / 'fixtures/office/cam0.yaml'}"
response = "estimate"
vignetting = "flat.png"
[photos]
table = "photos.csv"
""")
    luxfit("linearize", folder / "session.toml", "-o", OUT / "bracket")
    office = IN / "pictures"
    shutil.copytree(REPO / "fixtures/office", office, ignore=shutil.ignore_patterns("photos.csv"))
    head, *rows = (REPO / "fixtures/office/photos.csv").read_text().splitlines()
    write(office / "photos.csv", "\n".join([head, *(row for row in rows if ",all," in row)][:3]) + "\n")
    luxfit("linearize", office / "session.toml", "--hdr", "-o", OUT / "pictures")


def run_object():
    """Photometric stereo of a sphere, and of one under lights in one plane."""
    side, folder = 48, IN / "sphere"
    def normal(u, v):
        x, y = 2 * (u + 0.5) / side - 1, 1 - 2 * (v + 0.5) / side
        return (x, y, math.sqrt(1 - x * x - y * y)) if x * x + y * y < 0.9 else None
    write_png(folder / "mask.png", [[255 if normal(u, v) else 0 for u in range(side)] for v in range(side)], 8)
    rng = random.Random(2)
    for name, lights in (("space", 8), ("plane", 3)):
        table, directions = "file,camera,view,state,exposure_s\n", "state,x,y,z\n"
        for k in range(lights):
            turn, tilt = 2 * math.pi * k / lights, 0.6 if k % 3 else 0.3
            light = (math.sin(tilt) * math.cos(turn), math.sin(tilt) * math.sin(turn), math.cos(tilt))
            if name == "plane":
                light = (math.sin(0.3 * (k - 1)), 0, math.cos(0.3 * (k - 1)))
            def count(u, v, light=light):
                n = normal(u, v)
                shade = max(0, sum(a * b for a, b in zip(n, light))) if n else 0
                return round(max(0, 20000 * shade + rng.gauss(0, 20)))
            write_png(folder / f"{name}{k}.png", [[count(u, v) for u in range(side)] for v in range(side)], 16)
            table += f"{name}{k}.png,cam0,object,L{k},1\n"
            directions += f"L{k},{light[0]},{light[1]},{light[2]}\n"
        write(folder / f"{name}.csv", table)
        write(folder / f"{name}_lights.csv", directions)
        write(folder / f"{name}.toml", f"""[[camera]]
id = "cam0"
[photos]
table = "{name}.csv"
[lights]
mask = "mask.png"
directions = "{name}_lights.csv"
""")
    luxfit("albedo", folder / "space.toml", "-o", OUT / "object")
    luxfit("albedo", folder / "plane.toml", "-o", OUT / "object_undetermined", status=1)


class Report:
    """What is wrong, told as it is found."""

    def __init__(self):
        self.count = 0

    def add(self, text):
        self.count += 1
        print(text, file=sys.stderr)


def check_words(node, path, report):
    """Keys are closed and described; what is required is there."""
    if isinstance(node, list):
        for i, item in enumerate(node):
            check_words(item, f"{path}[{i}]", report)
    if not isinstance(node, dict):
        return
    if node.get("type") == "object" and "properties" in node and node.get("additionalProperties") is not False:
        report.add(f"{path}: expected additionalProperties: false")
    for key, value in node.items():
        if key == "properties" and node.get("type") == "object":
            for name, of in value.items():
                words = of.get("description", "")
                if not words.endswith(".") and "$ref" not in of:
                    report.add(f"{path}.{name}: expected a description, one sentence")
                check_words(of, f"{path}.{name}", report)
            for name in set(node.get("required", [])) - set(value):
                report.add(f"{path}: requires {name}, which is no property")
        else:
            check_words(value, f"{path}.{key}", report)


def read_schemas(report):
    """Validators by the name of the kind, and the kind of each format."""
    validators, kinds = {}, {}
    for path in sorted((REPO / "docs/schema").glob("*.schema.json")):
        kind, schema = path.name[:-len(".schema.json")], json.loads(path.read_text())
        try:
            jsonschema.Draft202012Validator.check_schema(schema)
        except jsonschema.SchemaError as error:
            report.add(f"{path}: {error.message}")
            continue
        for key in ("$schema", "title", "description"):
            if key not in schema:
                report.add(f"{path}: expected {key}")
        check_words(schema, path.name, report)
        validators[kind] = jsonschema.Draft202012Validator(schema)
        for part in [schema, *schema.get("$defs", {}).values()]:
            if "format" in part.get("properties", {}):
                kinds[part["properties"]["format"]["const"]] = kind
    return validators, kinds


def refuse_constant(word):
    raise ValueError(f"{word} is no JSON")


def documents(path):
    """What a file holds: one document, or one a line."""
    text = path.read_text()
    return [json.loads(part, parse_constant=refuse_constant) for part in (text.splitlines() if path.suffix == ".jsonl" else [text])]


def check_files(validators, kinds, report):
    """Counts the documents of every kind."""
    used = dict.fromkeys(validators, 0)
    for path in sorted([*OUT.rglob("*.json"), *OUT.rglob("*.jsonl")]):
        shown = path.relative_to(OUT)
        try:
            found = documents(path)
        except ValueError as error:
            report.add(f"{shown}: {error}")
            continue
        for document in found:
            named = {"stability_trials": "stability_trial"}.get(path.stem, path.stem)
            kind = kinds.get(document.get("format"), None if "format" in document else named)
            if kind not in validators:
                report.add(f"{shown}: no schema in docs/schema for format {document.get('format')}")
                continue
            used[kind] += 1
            errors = list(validators[kind].iter_errors(document))
            for error in errors[:ERRORS_SHOWN]:
                report.add(f"{shown}: {error.json_path}: {error.message[:300]} ({kind}.schema.json)")
            if not errors and validators[kind].is_valid({**document, "undocumented": 0}):
                report.add(f"{kind}.schema.json: lets undocumented keys pass")
    return used


def main():
    for folder in (IN, OUT):
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
    report = Report()
    validators, kinds = read_schemas(report)
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        runs = [pool.submit(run) for run in (run_office, run_reference, run_calibration, run_linearization, run_object)]
    for run in runs:
        run.result()
    used = check_files(validators, kinds, report)
    for kind, count in used.items():
        if count == 0 and kind not in UNUSED:
            report.add(f"{kind}.schema.json: nothing that was written is of this kind")
        if count > 0 and kind in UNUSED:
            report.add(f"{kind}.schema.json: used, though UNUSED says: {UNUSED[kind]}")
    print(f"{sum(used.values())} documents, {len(used)} schemas, {report.count} complaints")
    return 1 if report.count else 0


if __name__ == "__main__":
    sys.exit(main())
