"""Describes a room for the renderer and for the session that is made of its pictures. Metres, z up, world frame; numbers only."""
import dataclasses
import math


@dataclasses.dataclass
class Material:
    name: str
    reflectance: float
    gloss: float = 0.0  # share of light that is mirrored, whatever the angle
    roughness: float = 0.1
    pattern: float = 0.0  # relative amplitude of a fine pattern (carpet)


@dataclasses.dataclass
class Box:
    """An upright box, turned about z by `turn` (rad)."""

    material: str
    centre: tuple
    size: tuple
    turn: float = 0.0
    in_mesh: bool = True  # whether the user's mesh has it
    name: str = "box"


@dataclasses.dataclass
class Luminaire:
    """An opening that shines along `aim` with the luminance L0 cos^power (1 + wings sin^2), or a sphere of one luminance.

    flux = pi A L0 (1 + wings / 2) where power = 0;   2 pi A L0 / (power + 2) where wings = 0.   both_sides: half of it each way.
    """

    name: str
    flux_lm: float
    position: tuple
    size: tuple  # along heading, across; a disc or a sphere has its diameter alone
    aim: tuple = (0.0, 0.0, -1.0)
    heading: tuple = (1.0, 0.0, 0.0)
    power: float = 0.0
    wings: float = 0.0
    both_sides: bool = False
    shape: str = "rectangle"  # rectangle, disc, sphere
    housing_m: float = 0.0  # thickness of an opaque body between or behind the openings

    def area_m2(self):
        if self.shape == "rectangle":
            return self.size[0] * self.size[1]
        return math.pi * self.size[0] ** 2 / (1 if self.shape == "sphere" else 4)

    def luminance(self):
        """Returns L0, cd/m2."""
        share = 0.5 if self.both_sides else 1.0
        if self.power > 0:
            return share * self.flux_lm * (self.power + 2) / (2 * math.pi * self.area_m2())
        return share * self.flux_lm / (math.pi * self.area_m2() * (1 + self.wings / 2))


@dataclasses.dataclass
class Tag:
    number: int
    size: float
    centre: tuple
    normal: tuple
    up: tuple = (0.0, 0.0, 1.0)


@dataclasses.dataclass
class View:
    name: str
    position: tuple
    target: tuple


@dataclasses.dataclass
class Sensor:
    name: str
    position: tuple
    normal: tuple = (0.0, 0.0, 1.0)


@dataclasses.dataclass
class Room:
    name: str
    outline: list  # corners of the floor, counter-clockwise seen from above
    height: float
    floor: str
    wall: str
    ceiling: str
    materials: list
    boxes: list
    luminaires: list
    states: dict  # name: {luminaire: dimming}
    tags: list
    views: list
    sensors: list
    scale: str  # the reading that sets the scale: SENSOR@STATE
    width: int = 720
    height_px: int = 540
    focal_px: float = 450.0


def chair(x, y, turn, material="chair"):
    """Returns an office chair that the mesh lacks: a seat, a back, four legs."""
    c, s = math.cos(turn), math.sin(turn)

    def at(dx, dy, z):
        return (x + c * dx - s * dy, y + s * dx + c * dy, z)

    parts = [Box(material, at(0, 0, 0.45), (0.44, 0.44, 0.05), turn, False, "chair"),
             Box(material, at(-0.21, 0, 0.72), (0.03, 0.42, 0.36), turn, False, "chair")]
    for dx in (-0.19, 0.19):
        for dy in (-0.19, 0.19):
            parts.append(Box(material, at(dx, dy, 0.215), (0.03, 0.03, 0.43), turn, False, "chair"))
    return parts


def table(x, y, length, width, top, leg, height=0.74):
    """Returns a table: a top of 3 cm and two panels under its ends."""
    boxes = [Box(top, (x, y, height - 0.015), (length, width, 0.03), name="table")]
    for dx in (-0.4 * length, 0.4 * length):
        boxes.append(Box(leg, (x + dx, y, (height - 0.03) / 2), (0.05, 0.7 * width, height - 0.03), name="table leg"))
    return boxes
