"""Makes a session of what render.py wrote: photos of every state with noise, tags, mesh, readings, and the truth that scores it.

  python3 make_session.py ROOM FOLDER SESSION_FOLDER
"""
import json
import pathlib
import sys

import cv2
import numpy as np

from denoise import Guides, read
from rooms import ROOMS

KILO = 1e-3
COUNTS_PER_CDM2_S = 0.1  # share of full scale, per cd/m2 and second
FULL_WELL_E, READ_NOISE_E = 24000.0, 4.0
READING_NOISE = 0.01


def corners_of(box):
    c, s = np.cos(box.turn), np.sin(box.turn)
    return [(box.centre[0] + c * x * box.size[0] - s * y * box.size[1], box.centre[1] + s * x * box.size[0] + c * y * box.size[1],
             box.centre[2] + z * box.size[2]) for z in (-0.5, 0.5) for y in (-0.5, 0.5) for x in (-0.5, 0.5)]


def write_mesh(room, path):
    """Writes what the user has measured: the shell and the furniture that a plan shows."""
    lines, count = ["# metres, z up"], 0

    def face(group, material, points):
        nonlocal count
        lines.append(f"g {group}\nusemtl {material}")
        lines.extend("v %.6g %.6g %.6g" % tuple(p) for p in points)
        lines.append("f " + " ".join(str(count + i + 1) for i in range(len(points))))
        count += len(points)

    low = [(x, y, 0.0) for x, y in room.outline]
    high = [(x, y, room.height) for x, y in room.outline]
    face("floor", room.floor, low)
    face("ceiling", room.ceiling, high[::-1])
    for i in range(len(low)):
        j = (i + 1) % len(low)
        face(f"wall_{i + 1}", room.wall, [high[i], high[j], low[j], low[i]])
    for box in room.boxes:
        if not box.in_mesh:
            continue
        p = corners_of(box)
        for quad in ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)):
            face(box.name.replace(" ", "_"), box.material, [p[i] for i in quad])
    path.write_text("\n".join(lines) + "\n")


def luminances(room, folder):
    """Returns by view and luminaire the picture, cd/m2."""
    pictures = {}
    for view in room.views:
        guides = Guides(folder, view.name)
        pictures[view.name] = {l.name: guides.smooth(read(folder / f"{view.name}_{l.name}.exr").mean(axis=2) / KILO) for l in room.luminaires}
    return pictures


def photograph(luminance, rng):
    """Returns 12-bit counts times 16, and the exposure in s: 97 of 100 pixels reach at most half of the full scale."""
    exposure = 0.5 / (COUNTS_PER_CDM2_S * np.percentile(luminance, 97))
    exposure = float("%.3g" % exposure)
    electrons = luminance * exposure * COUNTS_PER_CDM2_S * FULL_WELL_E
    shape = (*luminance.shape, 3)
    noisy = electrons[..., None] + np.sqrt(electrons[..., None] + READ_NOISE_E**2) * rng.standard_normal(shape)
    return (np.clip(np.round(noisy / FULL_WELL_E * 4095), 0, 4095) * 16).astype(np.uint16), exposure


def write_photos(room, pictures, target, rng):
    rows = ["file,camera,view,state,exposure_s"]
    (target / "photos").mkdir(exist_ok=True)
    for view, by_luminaire in pictures.items():
        for state, dimming in room.states.items():
            counts, exposure = photograph(sum(share * by_luminaire[name] for name, share in dimming.items()), rng)
            file = f"photos/{view}_{state}.png"
            cv2.imwrite(str(target / file), counts)
            rows.append(f"{file},cam0,{view},{state},{exposure:g}")
    (target / "photos.csv").write_text("\n".join(rows) + "\n")


def write_camera(room, path):
    path.write_text(f"""%YAML:1.0
---
image_width: {room.width}
image_height: {room.height_px}
camera_matrix: !!opencv-matrix
   rows: 3
   cols: 3
   dt: d
   data: [ {room.focal_px}, 0., {(room.width - 1) / 2}, 0., {room.focal_px}, {(room.height_px - 1) / 2}, 0., 0., 1. ]
distortion_coefficients: !!opencv-matrix
   rows: 1
   cols: 5
   dt: d
   data: [ 0., 0., 0., 0., 0. ]
""")


def write_readings(room, folder, path, rng):
    readings = json.loads((folder / "sensors.json").read_text())
    rows = ["id,x_m,y_m,z_m,nx,ny,nz,state,lux"]
    for sensor in room.sensors:
        for state, dimming in room.states.items():
            lx = sum(share * readings[sensor.name][name] for name, share in dimming.items()) * (1 + READING_NOISE * rng.standard_normal())
            rows.append(",".join(str(v) for v in (sensor.name, *sensor.position, *sensor.normal, state)) + f",{lx:.5g}")
    path.write_text("\n".join(rows) + "\n")


def session_text(room):
    states = "\n".join(f"{state} = {{ " + ", ".join(f"{name} = {share}" for name, share in dimming.items()) + " }"
                       for state, dimming in room.states.items())
    return f"""name = "{room.name}"

[scene]
mesh = "room.obj"
unit = "m"

[tags]
family = "tag36h11"
map = "tags.json"

[[camera]]
id = "cam0"
intrinsics = "cam0.yaml"
response = "linear"
black_level = 0
vignetting = "none"

[photos]
table = "photos.csv"

[states]
{states}

[luxmeter]
readings = "luxmeter.csv"
scale = ["{room.scale}"]
"""


def main(name, folder, target):
    room, folder, target = ROOMS[name](), pathlib.Path(folder), pathlib.Path(target)
    target.mkdir(parents=True, exist_ok=True)
    rng = np.random.default_rng(1)
    write_mesh(room, target / "room.obj")
    write_photos(room, luminances(room, folder), target, rng)
    write_camera(room, target / "cam0.yaml")
    write_readings(room, folder, target / "luxmeter.csv", rng)
    (target / "session.toml").write_text(session_text(room))
    (target / "tags.json").write_text(json.dumps(
        [{"id": t.number, "size_m": t.size, "center_m": t.centre, "normal": t.normal, "up": t.up} for t in room.tags], indent=1))
    truth = {"lamps": [{"id": l.name, "position": l.position, "flux_lm": l.flux_lm, "aim": l.aim} for l in room.luminaires],
             "materials": {m.name: [m.reflectance * (1 - m.gloss)] * 3 for m in room.materials},
             "views": [{"view": v.name, "position_m": v.position} for v in room.views]}
    (target / "truth.json").write_text(json.dumps(truth, indent=1))


main(*sys.argv[1:])
