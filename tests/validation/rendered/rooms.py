"""The rooms: what people have, and what the project's own fixtures lack."""
import math

from room import Box, Luminaire, Material, Room, Sensor, Tag, View, chair, table


def meeting():
    """A meeting room: a pendant that shines up and down, four panels in two groups, two washers aimed at a wall; chairs that the mesh
    lacks, a glossy table, a patterned carpet."""
    materials = [Material("carpet", 0.22, pattern=0.2), Material("wall", 0.68), Material("ceiling", 0.80),
                 Material("table", 0.40, gloss=0.05, roughness=0.08), Material("leg", 0.45), Material("chair", 0.12),
                 Material("cabinet", 0.55)]
    boxes = table(3.2, 2.3, 3.2, 1.2, "table", "leg")
    boxes.append(Box("cabinet", (6.15, 2.3, 0.45), (0.45, 1.8, 0.9), name="cabinet"))
    for x in (2.2, 3.2, 4.2):
        boxes += chair(x, 1.45, math.pi / 2) + chair(x, 3.15, -math.pi / 2)
    panels = [Luminaire(f"D{i + 1}", 3600, (x, y, 2.79), (0.6, 0.6))
              for i, (x, y) in enumerate([(1.4, 1.1), (5.0, 1.1), (1.4, 3.5), (5.0, 3.5)])]
    down = math.radians(35)  # of the washers' aim below the horizontal
    washers = [Luminaire(f"W{i + 1}", 900, (0.9, y, 2.7), (0.08,), (-math.cos(down), 0.0, -math.sin(down)), (0.0, 1.0, 0.0), power=5,
                         shape="disc") for i, y in enumerate((1.5, 3.1))]
    pendant = Luminaire("P", 5200, (3.2, 2.3, 2.1), (2.4, 0.1), both_sides=True, housing_m=0.04)
    states = {"pendant": {"P": 1.0}, "front": {"D1": 1.0, "D2": 1.0}, "back": {"D3": 1.0, "D4": 1.0}, "wash": {"W1": 1.0, "W2": 1.0}}
    states["all"] = {name: 1.0 for state in states.values() for name in state}
    tags = [Tag(0, 0.3, (0.0, 0.5, 1.2), (1, 0, 0)), Tag(1, 0.3, (0.0, 4.1, 1.4), (1, 0, 0)), Tag(2, 0.3, (6.4, 0.7, 1.5), (-1, 0, 0)),
            Tag(3, 0.3, (6.4, 4.0, 1.3), (-1, 0, 0)), Tag(4, 0.3, (1.2, 0.0, 1.3), (0, 1, 0)), Tag(5, 0.3, (4.9, 0.0, 1.4), (0, 1, 0)),
            Tag(6, 0.3, (1.5, 4.6, 1.4), (0, -1, 0)), Tag(7, 0.3, (5.0, 4.6, 1.2), (0, -1, 0))]
    eyes = [((0.4, 0.4, 1.6), (5.0, 3.4, 1.2)), ((6.0, 0.4, 1.6), (1.2, 3.4, 1.2)), ((6.0, 4.2, 1.7), (1.2, 1.0, 1.3)),
            ((0.4, 4.2, 1.6), (5.2, 1.0, 1.3)), ((3.2, 0.3, 1.7), (3.2, 4.6, 1.5)), ((3.2, 4.3, 1.7), (3.2, 0.0, 1.5)),
            ((5.4, 2.3, 1.6), (0.0, 2.3, 1.6)), ((0.5, 2.3, 1.6), (6.4, 2.3, 1.4)), ((1.0, 0.5, 1.2), (4.5, 3.0, 2.8)),
            ((5.6, 4.0, 1.2), (1.8, 1.6, 2.8))]
    places = [("K1", (3.2, 2.3, 0.75)), ("K2", (2.0, 2.3, 0.75)), ("K3", (4.4, 2.3, 0.75)), ("K4", (0.6, 0.9, 0.02)), ("K5", (5.4, 0.9, 0.02)),
              ("K6", (0.6, 3.9, 0.02)), ("K7", (5.4, 3.9, 0.02)), ("K8", (6.15, 2.3, 0.91))]
    return Room("meeting", [(0, 0), (6.4, 0), (6.4, 4.6), (0, 4.6)], 2.8, "carpet", "wall", "ceiling", materials, boxes,
                [pendant] + panels + washers, states, tags, _views(eyes), _sensors(places), "K1@all")


def lounge():
    """An L: a panel, a batwing strip, a globe, and two spots that are aimed at walls."""
    materials = [Material("floor", 0.30), Material("wall", 0.60), Material("ceiling", 0.78), Material("sofa", 0.25), Material("shelf", 0.50),
                 Material("chair", 0.12)]
    boxes = [Box("sofa", (1.2, 4.3, 0.22), (2.0, 0.85, 0.44), name="sofa"), Box("sofa", (1.2, 4.65, 0.6), (2.0, 0.15, 0.32), name="sofa"),
             Box("shelf", (5.8, 1.0, 0.9), (0.35, 1.4, 1.8), name="shelf")] + table(3.4, 1.2, 1.4, 0.8, "shelf", "shelf")
    boxes += chair(3.1, 2.1, -math.pi / 2) + chair(1.0, 2.6, 0.4)
    tilt = math.radians(40)
    luminaires = [
        Luminaire("panel", 3400, (4.6, 1.3, 2.59), (0.6, 0.6)),
        Luminaire("strip", 4200, (1.3, 1.3, 2.5), (1.2, 0.12), heading=(0.0, 1.0, 0.0), wings=2.5, housing_m=0.05),
        Luminaire("globe", 1200, (1.2, 3.4, 1.9), (0.3,), shape="sphere"),
        Luminaire("spot1", 700, (2.0, 4.0, 2.5), (0.07,), (0.0, math.sin(tilt), -math.cos(tilt)), power=18, shape="disc"),
        Luminaire("spot2", 700, (5.2, 2.0, 2.5), (0.07,), (math.sin(tilt), 0.0, -math.cos(tilt)), power=18, shape="disc"),
    ]
    states = {l.name: {l.name: 1.0} for l in luminaires[:3]}
    states["spots"] = {"spot1": 1.0, "spot2": 1.0}
    states["all"] = {l.name: 1.0 for l in luminaires}
    tags = [Tag(10, 0.3, (0.0, 1.0, 1.3), (1, 0, 0)), Tag(11, 0.3, (0.0, 3.2, 1.4), (1, 0, 0)), Tag(12, 0.3, (6.0, 2.2, 1.4), (-1, 0, 0)),
            Tag(13, 0.3, (1.5, 0.0, 1.4), (0, 1, 0)), Tag(14, 0.3, (4.2, 0.0, 1.3), (0, 1, 0)), Tag(15, 0.3, (4.4, 2.6, 1.4), (0, -1, 0)),
            Tag(16, 0.3, (1.0, 5.0, 1.5), (0, -1, 0)), Tag(17, 0.3, (2.6, 3.9, 1.3), (-1, 0, 0))]
    eyes = [((0.4, 0.4, 1.6), (4.5, 2.0, 1.2)), ((5.4, 0.3, 1.6), (0.5, 2.2, 1.3)), ((0.4, 3.9, 1.6), (2.2, 0.2, 1.3)),
            ((2.3, 4.7, 1.6), (0.6, 0.6, 1.3)), ((2.9, 0.3, 1.6), (1.2, 5.0, 1.4)), ((5.6, 2.4, 1.6), (1.0, 0.3, 1.4)),
            ((2.4, 2.4, 1.5), (6.0, 0.9, 1.5)), ((0.5, 2.2, 1.5), (2.6, 5.0, 1.6)), ((3.8, 2.3, 1.3), (0.8, 1.0, 2.5)),
            ((2.3, 0.5, 1.3), (1.4, 4.2, 2.4))]
    places = [("K1", (3.4, 1.2, 0.75)), ("K2", (1.3, 1.3, 0.02)), ("K3", (2.0, 3.2, 0.02)), ("K4", (5.2, 1.9, 0.02)), ("K5", (4.5, 0.5, 0.02)),
              ("K6", (0.5, 2.9, 0.02)), ("K7", (2.4, 0.5, 0.8))]
    return Room("lounge", [(0, 0), (6, 0), (6, 2.6), (2.6, 2.6), (2.6, 5), (0, 5)], 2.6, "floor", "wall", "ceiling", materials, boxes,
                luminaires, states, tags, _views(eyes), _sensors(places), "K1@all")


def _views(eyes):
    return [View(f"v{i:02d}", position, target) for i, (position, target) in enumerate(eyes)]


def _sensors(places):
    return [Sensor(name, position) for name, position in places]


ROOMS = {"meeting": meeting, "lounge": lounge}
