"""The plan of the level. North is -Z; the great hall's south door is at the origin.

west rooms  x -22.8 .. -10.8   store rooms and a corridor, the library above them
great hall  x -10.2 ..  10.2   z -34 .. 0, aisles with galleries above, the grand stair
courtyard   x  10.8 ..  26.8   z -26 .. -6, a cloister with a walk above, open to the sky
"""

from __future__ import annotations

import math

import numpy as np

from . import architecture as arch
from . import furniture as fit
from . import play
from .architecture import Opening
from .mesh import (
    MIRROR_X,
    Mesh,
    Model,
    box,
    ceiling,
    drop_degenerate,
    floor,
    hewn_box,
    normalized,
    place,
    polygon,
    rotation_y,
    scaling,
    translation,
)
from .scene import FIRE, MOON, NEON, WARM, Scene

BAY = 4.0
ARCADE = 6.2  # the middle of the nave's arcades
NAVE = 5.85  # half the clear width of the nave
AISLE = 10.2  # the aisles' outer walls
OUTER = 10.8
NORTH, SOUTH = -34.0, 0.0
LAST_COLUMN = -28.0
IMPOST = 3.1  # where the lower arches spring
UPPER_IMPOST = 8.6
SLAB, GALLERY = 5.1, 5.4
EAVES = 10.8  # the vault's spring and the galleries' ceiling
RISE, GOING, FLIGHT = 0.18, 0.30, 15
LANDING = FLIGHT * RISE

COURT_EAST, COURT_NORTH, COURT_SOUTH, COURT_WALL = 26.8, -26.0, -6.0, 8.0
WEST, LIBRARY_CEILING = -22.8, 9.6
HOLE = (WEST, -24.4, -21.0, -15.4)  # the service stair's well: x0, z0, x1, z1

EAST_FACING = 90.0  # yaw of a wall that faces +X
WEST_FACING = -90.0
SOUTH_FACING = 0.0  # faces +Z
NORTH_FACING = 180.0


def build() -> Scene:
    scene = Scene()
    add_prefabs(scene)
    great_hall(scene)
    grand_stair(scene)
    entrance_bridge(scene)
    hall_fittings(scene)
    courtyard(scene)
    west_rooms(scene)
    play.add(scene)
    viewpoints(scene)
    return scene


def add_prefabs(scene: Scene) -> None:
    scene.prefabs = {
        "column": arch.column(IMPOST, 0.30),
        "gallery_column": arch.column(
            UPPER_IMPOST - GALLERY - 1.0, 0.23, plinth=0.34, fluted=False
        ),
        "pedestal": arch.pedestal(1.0),
        "newel": arch.newel(),
        "balustrade": arch.balustrade(BAY - 0.8),
        "archivolt": Model().add("trim", arch.archivolt(1.6)),
        "sconce": fit.sconce(),
        "chandelier": fit.chandelier(EAVES + NAVE - 8.6, *fit.CHANDELIER),
        "small_chandelier": fit.chandelier(LIBRARY_CEILING - 7.55, *fit.SMALL_CHANDELIER),
        "brazier": fit.brazier(),
        "torchere": fit.torchere(),
        "lantern": fit.lantern(),
        "banner_red": fit.banner("banner_red"),
        "banner_blue": fit.banner("banner_blue"),
        "crate": fit.crate(),
        "barrel": fit.barrel(),
        "table": fit.table(),
        "bench": fit.bench(),
        "bookcase": fit.bookcase(),
        "shield": fit.shield(),
        "candle": fit.candle(0.2, 0.03),
        "fountain": fit.fountain(),
        "armillary": fit.armillary(),
        **play.prefabs(),
    }


# ------------------------------------------------------------------------------------- the hall


def great_hall(scene: Scene) -> None:
    room = scene.room("great_hall")
    room.add("marble", floor(-OUTER, NORTH, OUTER, SOUTH + 0.6, 0.0))  # on under the south door
    ground_doors = [Opening(z - 0.9, z + 0.9, 0.0, 2.1) for z in (-22.0, -10.0)]
    east = ground_doors + [Opening(-14.9, -13.1, GALLERY, GALLERY + 2.1)]
    windows = [
        Opening(z - 0.8, z + 0.8, GALLERY + 1.2, GALLERY + 3.0) for z in (-22.0, -18.0, -10.0)
    ]
    west = ground_doors + [
        Opening(z - 0.9, z + 0.9, GALLERY, GALLERY + 2.1) for z in (-22.0, -10.0)
    ]
    room.add_model(hall_side(east + windows))
    room.add_model(hall_side(west), MIRROR_X)
    gallery_windows(room, windows)
    end_walls(room)
    vault = arch.coffered_vault(NAVE, SOUTH - NORTH, 9, 17)
    room.add_model(vault, translation(0, EAVES, SOUTH))
    for z in [-BAY * k for k in range(9)] + [NORTH + 0.2]:
        room.add("trim", arch.rib(NAVE, 0.5, 0.2).transformed(translation(0, EAVES, z)))
    crest = translation(0, 14.1, NORTH) @ scaling(2.4, 2.4, 2.4)
    room.add_model(fit.shield(), crest)
    room.add_model(
        fit.shield(), translation(0, 14.1, SOUTH) @ rotation_y(180) @ scaling(2.4, 2.4, 2.4)
    )
    columns(scene)


def hall_side(openings: list[Opening]) -> Model:
    """The east side; the openings are given by their z. The west side is its mirror image."""
    side = Model()
    local = [Opening(o.x0 - NORTH, o.x1 - NORTH, o.y0, o.spring, o.arched) for o in openings]
    side.add_model(arch.wall(SOUTH - NORTH, 11.6, 0.6, local), place(AISLE, 0, NORTH, WEST_FACING))
    for o in openings:
        surround(side, o)
    start = LAST_COLUMN - 0.4
    piers = [Opening(-BAY * k + 0.4 - BAY - start, -BAY * k - 0.4 - start, 0, 0) for k in range(7)]
    for foot, top in ((IMPOST, GALLERY), (UPPER_IMPOST, EAVES)):
        arcade = arch.wall(-start, top - foot, 0.7, piers)
        side.add_model(arcade, place(NAVE, foot, start, WEST_FACING))
        side.add("trim", arch.cornice(-start).transformed(place(NAVE, top, start, WEST_FACING)))
        end = arch.wall(0.7, top - foot, 0.1, back=None)
        side.add_model(end, place(ARCADE + 0.35, foot, start, NORTH_FACING))
    # a lintel carries the vault past the stair
    side.add("trim", box(NAVE, 10.0, NORTH, ARCADE + 0.35, EAVES, start, 0.03, "+y -z"))
    side.add(
        "trim", arch.cornice(start - NORTH).transformed(place(NAVE, EAVES, NORTH, WEST_FACING))
    )
    side.add("trim", box(NAVE, 9.5, NORTH, ARCADE + 0.35, 10.0, NORTH + 0.5, 0.04, "+y -z"))
    side.add("planks", floor(NAVE, start, AISLE, SOUTH, GALLERY))
    side.add("planks", floor(6.5, NORTH, AISLE, start, GALLERY))
    for z0, x0 in ((NORTH, 6.5), (start, ARCADE + 0.35)):
        z1 = start if z0 == NORTH else SOUTH
        side.add("planks", ceiling(x0, z0, AISLE, z1, SLAB))
    side.add("planks", ceiling(ARCADE + 0.35, NORTH, AISLE, SOUTH, EAVES))
    for k in range(1, 8):
        for top in (SLAB, EAVES):
            side.add(
                "timber",
                box(
                    ARCADE + 0.35,
                    top - 0.3,
                    -BAY * k - 0.15,
                    AISLE,
                    top,
                    -BAY * k + 0.15,
                    0.02,
                    "+y",
                ),
            )
            bracket(side, AISLE, top - 0.3, -BAY * k)
    doors = [o for o in openings if o.y0 in (0.0, GALLERY)]
    for base in (0.0, GALLERY):
        cuts = sorted((o.x0, o.x1) for o in doors if o.y0 == base)
        skirt(side, [NORTH] + [x for cut in cuts for x in cut] + [SOUTH], base)
    return side


def skirt(side: Model, cuts: list[float], base: float) -> None:
    for z0, z1 in zip(cuts[::2], cuts[1::2]):
        mesh = arch.skirting(z1 - z0, 0.32)
        side.add("trim", mesh.transformed(place(AISLE, base, z0, WEST_FACING)))


def bracket(side: Model, x: float, y: float, z: float) -> None:
    side.add("timber", box(x - 0.14, y - 0.55, z - 0.09, x, y, z + 0.09, 0.015, "+x +y").grain_up())
    side.add("trim", box(x - 0.2, y - 0.72, z - 0.14, x, y - 0.55, z + 0.14, 0.03, "+x"))


def surround(side: Model, o: Opening) -> None:
    """Voussoirs and jamb stones about an opening of the aisle wall, on both faces."""
    middle = (o.x0 + o.x1) / 2
    for x, yaw in ((AISLE, WEST_FACING), (OUTER, EAST_FACING)):
        ring = arch.archivolt(o.radius, 0.24, 0.05, 9)
        side.add("trim", ring.transformed(place(x, o.spring, middle, yaw)))
        count = max(2, round((o.spring - o.y0) / 0.55))
        for k in range(count):
            y0 = o.y0 + (o.spring - o.y0) * k / count
            y1 = o.y0 + (o.spring - o.y0) * (k + 1) / count
            wide = 0.30 if k % 2 else 0.22
            for s in (-1, 1):
                x0, x1 = sorted((s * o.radius, s * (o.radius + wide)))
                stone = hewn_box(x0, y0, 0.0, x1, y1, 0.05, 0.018)
                side.add("trim", stone.transformed(place(x, 0, middle, yaw)))


def gallery_windows(room: Model, windows: list[Opening]) -> None:
    for o in windows:
        local = Opening(0, o.x1 - o.x0, o.y0, o.spring)
        inside = arch.arched_pane(local, 0.28, False)
        room.add("leaded_glass", inside.transformed(place(AISLE, 0, o.x0, WEST_FACING)))
        outside = arch.arched_pane(local, 0.28, False)
        room.add("warm_glass", outside.transformed(place(OUTER, 0, o.x1, EAST_FACING)))


def end_walls(room: Model) -> None:
    centre = OUTER
    north = [
        Opening(centre - 1.7, centre + 1.7, 5.2, 10.2),
        Opening(centre - 4.6, centre - 2.8, 6.4, 9.6),
        Opening(centre + 2.8, centre + 4.6, 6.4, 9.6),
    ]
    under = Opening(centre - NAVE - 0.35, centre + NAVE + 0.35, 0.0, EAVES)
    wall = arch.wall(2 * OUTER, EAVES, 0.6, north, back=None, vault=under)
    room.add_model(wall, place(-OUTER, 0, NORTH, SOUTH_FACING))
    south = [
        Opening(centre - 1.5, centre + 1.5, 0.0, 2.7),
        Opening(centre - 1.5, centre + 1.5, 7.4, 10.6),
    ]
    wall = arch.wall(2 * OUTER, EAVES, 0.6, south, back=None, vault=under)
    room.add_model(wall, place(OUTER, 0, SOUTH, NORTH_FACING))
    for o, x, z, yaw in [(o, -OUTER, NORTH, 0) for o in north] + [(south[1], OUTER, SOUTH, 180)]:
        pane = arch.arched_pane(o, 0.4, True)
        room.add("stained_glass", pane.transformed(place(x, 0, z, yaw)))
        frame(room, o, place(x, 0, z, yaw))
    frame(room, south[0], place(OUTER, 0, SOUTH, NORTH_FACING))
    for s, matrix in (
        (1, place(1.5, 0, 0.3, NORTH_FACING)),
        (-1, place(-1.5, 0, 0.3, NORTH_FACING) @ MIRROR_X),
    ):
        room.add_model(fit.door_leaf(1.5, 4.2, True), matrix)


def frame(room: Model, o: Opening, matrix: np.ndarray) -> None:
    middle = (o.x0 + o.x1) / 2
    room.add(
        "trim",
        arch.archivolt(o.radius, 0.34, 0.10, 13).transformed(
            matrix @ translation(middle, o.spring, 0)
        ),
    )
    for x in (o.x0 - 0.30, o.x1):
        room.add("trim", box(x, o.y0, 0, x + 0.30, o.spring, 0.10, 0.025, "-z").transformed(matrix))
    if o.y0 > 0:
        sill = box(o.x0 - 0.42, o.y0 - 0.22, -0.3, o.x1 + 0.42, o.y0, 0.22, 0.03, "-z")
        room.add("trim", sill.transformed(matrix))


def columns(scene: Scene) -> None:
    for side in (-1, 1):
        for k in range(8):
            z = -BAY * k
            scene.put("column", side * ARCADE, 0, z)
            scene.put("pedestal", side * ARCADE, GALLERY, z)
            scene.put("gallery_column", side * ARCADE, GALLERY + 1.0, z)
        for k in range(7):
            z = -BAY * (k + 0.5)
            yaw = -side * 90.0
            scene.put("archivolt", side * NAVE, IMPOST, z, yaw)
            scene.put("archivolt", side * NAVE, UPPER_IMPOST, z, yaw)
            if k:
                scene.put("balustrade", side * ARCADE, GALLERY, z - (BAY - 0.8) / 2, -90)


# ------------------------------------------------------------------------------------ the stair


def grand_stair(scene: Scene) -> None:
    room = scene.room("grand_stair")
    foot, run = -26.0, FLIGHT * GOING
    edge = foot - run  # the landing's front
    side_front = -31.0
    room.add_model(arch.stair(FLIGHT, RISE, GOING, 4.0), place(2.0, 0, foot, 90))
    room.add("marble", floor(-2.0, NORTH, 2.0, edge, LANDING))
    path = arch.stair_path(FLIGHT, RISE, GOING, -foot - 1.2, 1.1)
    room.add("carpet", arch.runner(path, 1.9).transformed(place(0, 0, foot, 90)))
    east = Model()
    east.add(
        "ashlar",
        polygon(
            [(2.0, 0, edge), (2.0, 0, side_front), (2.0, LANDING, side_front), (2.0, LANDING, edge)]
        ),
    )
    east.add(
        "ashlar",
        polygon(
            [
                (2.0, 0, side_front),
                (6.5, 0, side_front),
                (6.5, LANDING, side_front),
                (2.0, LANDING, side_front),
            ]
        ),
    )
    east.add(
        "ashlar",
        polygon(
            [(6.5, 0, side_front), (6.5, 0, NORTH), (6.5, SLAB, NORTH), (6.5, SLAB, side_front)]
        ),
    )
    flight = arch.stair(FLIGHT, RISE, GOING, side_front - NORTH)
    east.add_model(flight, place(2.0, LANDING, side_front, 0))
    slope = RISE / GOING
    east.add_model(
        arch.balustrade(4.1, 4.1 * slope), place(2.2, LANDING + 0.27, side_front - 0.12, 0)
    )
    east.add_model(arch.balustrade(4.2, 4.2 * slope), place(1.88, 0.27, foot - 0.2, 90))
    east.add("trim", box(6.5, SLAB, side_front, 6.78, GALLERY, LAST_COLUMN - 0.4, 0.02, "-z +z"))
    east.add_model(arch.balustrade(2.3), place(6.64, GALLERY, side_front + 0.1, -90))
    east.add(
        "trim", arch.cornice(side_front - NORTH, 0.6).transformed(place(6.5, SLAB, side_front, 90))
    )
    room.add_model(east).add_model(east, MIRROR_X)
    for s in (-1, 1):
        for k in range(FLIGHT):
            votive(scene, s * 1.62, (k + 1) * RISE, foot - (k + 0.55) * GOING)
            votive(scene, s * (2.0 + (k + 0.55) * GOING), LANDING + (k + 1) * RISE, NORTH + 0.22)
        scene.put("newel", s * 1.88, 0, foot + 0.05)
        scene.put("newel", s * 1.88, LANDING, edge - 0.28)
        scene.put("newel", s * 6.62, GALLERY, side_front - 0.12)
        scene.put("brazier", s * 3.5, 0, foot + 0.2)
        scene.light("brazier", s * 3.5, 1.62, foot + 0.2, FIRE, 28, 11)
        scene.put("banner_red", s * 3.7, 6.1, NORTH)
    scene.put("armillary", 0, LANDING, -32.6)
    for x, candela in ((0.0, 28.0), (-3.7, 12.5), (3.7, 12.5)):
        scene.light("stained_window", x, 8.4, NORTH + 1.6, MOON, candela, 13)
    scene.light("ruby_glass", -1.5, 6.4, NORTH + 0.9, (1.0, 0.30, 0.20), 8.5, 6)
    scene.light("amber_glass", 1.5, 6.4, NORTH + 0.9, (1.0, 0.72, 0.25), 8.5, 6)
    scene.light("armillary", 0.0, LANDING + 0.5, -31.2, WARM, 10, 6)


def entrance_bridge(scene: Scene) -> None:
    room = scene.room("entrance")
    front = -BAY - 0.35
    piers = [Opening(3.9 * k + 0.4, 3.9 * k + 3.5, 0, 0) for k in range(3)]
    room.add_model(
        arch.wall(2 * NAVE, GALLERY - IMPOST, 0.7, piers), place(NAVE, IMPOST, front, NORTH_FACING)
    )
    room.add("trim", arch.cornice(2 * NAVE).transformed(place(NAVE, GALLERY, front, NORTH_FACING)))
    room.add("planks", floor(-NAVE, front, NAVE, SOUTH, GALLERY))
    room.add("planks", ceiling(-NAVE, front + 0.7, NAVE, SOUTH, SLAB))
    room.add_model(arch.balustrade(3.54), place(-1.77, GALLERY, -BAY, 0))
    for s in (-1, 1):
        scene.put("column", s * 1.95, 0, -BAY)
        scene.put("pedestal", s * 1.95, GALLERY, -BAY)
        room.add_model(arch.balustrade(3.48), place(s * 4.08 - 1.74, GALLERY, -BAY, 0))
        room.add(
            "timber",
            box(s * 1.95 - 0.15, SLAB - 0.3, front + 0.7, s * 1.95 + 0.15, SLAB, SOUTH, 0.02, "+y"),
        )
    for k in range(3):
        ring = arch.archivolt(1.55).transformed(place(3.9 * (k - 1), IMPOST, front, NORTH_FACING))
        room.add("trim", ring)
    scene.put("lantern", 0, SLAB, -2.0)
    scene.light("entrance", 0, SLAB - 0.62, -2.0, WARM, 12.5, 8)
    scene.light("rose_window", 0, 9.6, -1.3, MOON, 14, 10)


def sconce(scene: Scene, x: float, y: float, z: float, yaw: float, candela=11.5, reach=7.5) -> None:
    scene.put("sconce", x, y, z, yaw)
    a = math.radians(yaw)
    scene.light(
        "sconce", x + 0.36 * math.sin(a), y + 0.42, z + 0.36 * math.cos(a), WARM, candela, reach
    )


def ring_of_candles(scene: Scene, x, y, z, ring: tuple, yaw: float = 0.0) -> None:
    """The lamps of a chandelier's candles."""
    radius, count = ring
    for k in range(count):
        a = 2 * math.pi * (k + 0.5) / count - math.radians(yaw)
        at = (x + radius * math.cos(a), y + 0.42, z + radius * math.sin(a))
        scene.light("candle", *at, WARM, 0.5, 2.5)


def votive(scene: Scene, x: float, y: float, z: float) -> None:
    scene.put("candle", x, y, z, 37.0 * (x + z))
    scene.light("candle", x, y + 0.33, z, FIRE, 0.45, 2.0)


def hall_fittings(scene: Scene) -> None:
    for z in (-8.0, -15.0, -22.0):
        scene.put("chandelier", 0, 8.6, z, 15)
        scene.light("chandelier", 0, 9.2, z, WARM, 23, 14)
        ring_of_candles(scene, 0, 8.6, z, fit.CHANDELIER, 15)
    for s in (-1, 1):
        for z in (-11.0, -15.0, -19.0, -23.0):
            scene.put("torchere", s * 1.75, 0, z)
            scene.light("torchere", s * 1.75, 2.02, z, FIRE, 9, 5.5)
        for z in (-6.0, -14.0, -18.0, -26.0):
            sconce(scene, s * AISLE, 2.2, z, -s * 90.0)
        for z in (-8.0, -16.0, -26.0):
            sconce(scene, s * AISLE, GALLERY + 2.0, z, -s * 90.0)
        for k in range(1, 7):
            kind = "banner_red" if k % 2 else "banner_blue"
            scene.put(kind, s * (NAVE - 0.02), 8.45, -BAY * k, -s * 90.0)
            scene.put("shield", s * NAVE, 4.42, -BAY * k, -s * 90.0)
        for z, kind in ((-4.0, "banner_blue"), (-12.0, "banner_red"), (-20.0, "banner_red")):
            scene.put("bench", s * 9.85, 0, z, 90)
            scene.put(kind, s * AISLE, 4.2, z, -s * 90.0)


# -------------------------------------------------------------------------------- the courtyard


def courtyard(scene: Scene) -> None:
    court = scene.room("courtyard")
    x0, x1, z0, z1 = OUTER, COURT_EAST, COURT_NORTH, COURT_SOUTH
    court.add("flagstones", floor(x0, z0, x1 + 0.6, z1, 0.0))  # on under the gate
    length = x1 - x0
    court.add_model(arch.wall(length, COURT_WALL, 0.6, back=None), place(x0, 0, z0, SOUTH_FACING))
    court.add_model(arch.wall(length, COURT_WALL, 0.6, back=None), place(x1, 0, z1, NORTH_FACING))
    gate = Opening(8.7, 11.3, 0.0, 2.3)
    court.add_model(
        arch.wall(z1 - z0, COURT_WALL, 0.6, [gate], back=None), place(x1, 0, z0, WEST_FACING)
    )
    frame(court, gate, place(x1, 0, z0, WEST_FACING))
    court.add("neon", arch.tube_about(gate, 0.42).transformed(place(x1, 0, z0, WEST_FACING)))
    for z, y in ((-14.4, 1.6), (-17.6, 1.6), (-16.0, 4.3)):
        scene.light("neon", x1 - 0.4, y, z, NEON, 4.0, 6.0)
    beyond = arch.arched_pane(gate, 0.55, False)
    court.add("planks", beyond.transformed(place(x1, 0, z0, WEST_FACING)))
    battlements(court, x0, z0, x1, z1)
    cloister(scene, court)
    court.add_model(arch.stair(2 * FLIGHT, RISE, GOING, 1.8), place(22.8, 0, z0, 180))
    slope = RISE / GOING
    court.add_model(arch.balustrade(8.7, 8.7 * slope), place(22.6, 0.27, z0 + 1.68, 180))
    scene.put("newel", 22.85, 0, z0 + 1.68)
    scene.put("newel", 13.62, GALLERY, z0 + 2.0)
    court.add("sky", sky_dome(44.0).transformed(translation(6.0, -2.0, -16.0)))
    court_fittings(scene)


def battlements(court: Model, x0: float, z0: float, x1: float, z1: float) -> None:
    y = COURT_WALL
    runs = [(x0, z0 - 0.6, x1, z0), (x0, z1, x1, z1 + 0.6), (x1, z0 - 0.6, x1 + 0.6, z1 + 0.6)]
    for ax, az, bx, bz in runs:
        court.add("trim", box(ax - 0.08, y, az - 0.08, bx + 0.08, y + 0.16, bz + 0.08, 0.03))
        along_x = bx - ax > bz - az
        span = bx - ax if along_x else bz - az
        for k in range(int(span / 1.7)):
            s = 0.5 + 1.7 * k
            if along_x:
                court.add(
                    "ashlar",
                    box(ax + s, y + 0.16, az + 0.05, ax + s + 0.9, y + 1.0, bz - 0.05, 0.0, "-y"),
                )
            else:
                court.add(
                    "ashlar",
                    box(ax + 0.05, y + 0.16, az + s, bx - 0.05, y + 1.0, az + s + 0.9, 0.0, "-y"),
                )


def cloister(scene: Scene, court: Model) -> None:
    front, z0, z1 = 13.8, COURT_NORTH, COURT_SOUTH
    piers = [Opening(BAY * k + 0.4, BAY * (k + 1) - 0.4, 0, 0) for k in range(5)]
    court.add_model(
        arch.wall(z1 - z0, GALLERY - IMPOST, 0.7, piers), place(front, IMPOST, z1, EAST_FACING)
    )
    court.add(
        "trim", arch.cornice(z1 - z0 - 1.8, 0.8).transformed(place(front, GALLERY, z1, EAST_FACING))
    )
    court.add("flagstones", floor(OUTER, z0, front, z1, GALLERY))
    court.add("planks", ceiling(OUTER, z0, front - 0.7, z1, SLAB))
    for k in range(6):
        z = z1 - BAY * k
        scene.put("column", front - 0.35, 0, z)
        if k < 5:
            scene.put("archivolt", front, IMPOST, z - BAY / 2, 90)
            scene.put("pedestal", front - 0.35, GALLERY, z)
            court.add(
                "timber", box(OUTER, SLAB - 0.28, z - 0.14, front - 0.7, SLAB, z + 0.14, 0.02, "+y")
            )
        if k < 4 and k != 1:  # the lift arrives there
            scene.put("balustrade", front - 0.35, GALLERY, z - 0.4, 90)
    court.add_model(arch.balustrade(1.45), place(front - 0.2, GALLERY, z0 + 2.15, -90))
    for z in (-12.0, -20.0):
        scene.put("lantern", 12.2, SLAB, z)
        scene.light("cloister", 12.2, SLAB - 0.62, z, WARM, 14, 8)
    sconce(scene, OUTER, GALLERY + 2.0, -16.0, 90.0, 11.0)


def sky_dome(radius: float) -> Mesh:
    """Seen from within; its texture is a disc with the zenith in the middle."""
    rings, around = 8, 32
    positions = np.zeros((rings + 1, around + 1, 3))
    uvs = np.zeros((rings + 1, around + 1, 2))
    for i in range(rings + 1):
        tilt = math.pi / 2 * (1 - i / rings)
        for j in range(around + 1):
            a = 2 * math.pi * (j % around) / around
            out = math.sin(tilt) if i < rings else 0.0
            positions[i, j] = (out * math.cos(a), math.cos(tilt), out * math.sin(a))
            disc = 0.49 * tilt / (math.pi / 2)
            uvs[i, j] = (0.5 + disc * math.cos(a), 0.5 + disc * math.sin(a))
    columns = around + 1
    triangles = []
    for i in range(rings):
        for j in range(around):
            a, b = i * columns + j, i * columns + j + 1
            triangles += [(a, b, b + columns), (a, b + columns, a + columns)]
    points = positions.reshape(-1, 3)
    return drop_degenerate(
        Mesh(points * radius, normalized(-points), uvs.reshape(-1, 2), np.array(triangles))
    )


def court_fittings(scene: Scene) -> None:
    scene.put("fountain", 20.0, 0, -15.0)
    scene.mark("spray_0", 20.0, 3.05, -15.0)
    scene.mark("mist_0", 19.0, 1.7, -16.0)
    scene.light("fountain", 20.0, 3.9, -13.6, MOON, 10, 8)
    for k in range(14):
        a = 2 * math.pi * k / 14
        votive(scene, 20.0 + 1.86 * math.cos(a), 0.72, -15.0 + 1.86 * math.sin(a))
    scene.light("moon", 22.5, 13.5, -12.0, MOON, 160, 30)
    for x, z, yaw in (
        (16.0, COURT_SOUTH, 180),
        (22.5, COURT_SOUTH, 180),
        (COURT_EAST, -11.5, -90),
        (COURT_EAST, -20.5, -90),
    ):
        sconce(scene, x, 2.5, z, yaw, 17.0, 9.0)
    court = scene.room("courtyard")
    for x, y, z, yaw, width, height, seed in (
        (COURT_EAST, 0, -9.0, -90, 3.0, 5.2, 1), (COURT_EAST, 0, -23.5, -90, 3.6, 6.0, 2),
        (19.5, 0, COURT_SOUTH, 180, 4.0, 5.6, 3), (24.6, 0, COURT_NORTH, 0, 2.8, 4.8, 4),
        (13.8, 0, -17.7, 90, 0.9, 2.6, 5), (17.5, 3.3, COURT_NORTH, 0, 4.0, 4.2, 6),
    ):  # fmt: skip
        court.add_model(fit.ivy(width, height, seed), place(x, y, z, yaw))
    for z in (-13.4, -18.6):
        scene.put("banner_blue", COURT_EAST, 6.6, z, -90)
    for k, (x, z, yaw) in enumerate(
        [(25.9, -7.0, 8), (24.8, -6.8, -20), (25.8, -8.2, 33), (15.0, -6.9, 12)]
    ):
        scene.put("crate", x, 0, z, yaw)
    scene.put("crate", 25.7, 0.9, -7.2, -14)
    for x, z in ((25.9, -25.2), (25.1, -25.4), (25.7, -24.4), (24.0, -7.4)):
        scene.put("barrel", x, 0, z, x * 40)


# ------------------------------------------------------------------------------- the west rooms


def with_hole(builder, x0: float, z0: float, x1: float, z1: float, y: float) -> list[Mesh]:
    hx0, hz0, hx1, hz1 = HOLE
    return [
        builder(x0, z0, x1, hz0, y),
        builder(hx1, hz0, x1, hz1, y),
        builder(x0, hz1, x1, z1, y),
    ]


def west_rooms(scene: Scene) -> None:
    room = scene.room("west_rooms")
    x0, x1, z0, z1 = WEST, -OUTER, COURT_NORTH, COURT_SOUTH
    room.add("flagstones", floor(x0, z0, x1, z1, 0.0))
    room.add("planks", *with_hole(ceiling, x0, z0, x1, z1, SLAB))
    room.add("planks", *with_hole(floor, x0, z0, x1, z1, GALLERY))
    room.add("planks", ceiling(x0, z0, x1, z1, LIBRARY_CEILING))
    hx0, hz0, hx1, hz1 = HOLE
    for a, b in (((hx1, hz0), (hx0, hz0)), ((hx1, hz1), (hx1, hz0))):
        edge = [
            (a[0], SLAB, a[1]),
            (b[0], SLAB, b[1]),
            (b[0], GALLERY, b[1]),
            (a[0], GALLERY, a[1]),
        ]
        room.add("timber", polygon(edge[::-1]))
    for foot, height, material in (
        (0.0, SLAB, "brick"),
        (GALLERY, LIBRARY_CEILING - GALLERY, "plaster"),
    ):
        for length, matrix, openings in (
            (x1 - x0, place(x0, foot, z0, SOUTH_FACING), []),
            (x1 - x0, place(x1, foot, z1, NORTH_FACING), []),
            (z1 - z0, place(x0, foot, z1, EAST_FACING), library_windows() if foot else []),
        ):
            room.add_model(arch.wall(length, height, 0.5, openings, material, back=None), matrix)
            if foot:
                room.add("timber", arch.skirting(length, 0.3).transformed(matrix))
    # the well's walls between the storeys
    for a, b in (((x0, hz1), (x0, hz0)),):
        room.add(
            "brick",
            polygon(
                [
                    (a[0], SLAB, a[1]),
                    (b[0], SLAB, b[1]),
                    (b[0], GALLERY, b[1]),
                    (a[0], GALLERY, a[1]),
                ]
            ),
        )
    for o in library_windows():
        matrix = place(x0, GALLERY, z1, EAST_FACING)
        room.add("leaded_glass", arch.arched_pane(o, 0.3, False).transformed(matrix))
        frame(room, o, matrix)
    partitions(room)
    service_stair(scene, room)
    for k in range(5):
        z = z0 + 2.0 + BAY * k
        room.add(
            "timber",
            box(x0, LIBRARY_CEILING - 0.35, z - 0.16, x1, LIBRARY_CEILING, z + 0.16, 0.02, "+y"),
        )
        beam_start = hx1 if hz0 < z < hz1 else x0
        room.add("timber", box(beam_start, SLAB - 0.25, z - 0.12, x1, SLAB, z + 0.12, 0.02, "+y"))
    store_fittings(scene)
    library_fittings(scene)


def library_windows() -> list[Opening]:
    return [Opening(x - 0.8, x + 0.8, 0.9, 2.3) for x in (4.0, 10.0, 16.0)]


def partitions(room: Model) -> None:
    doors = [Opening(x - 0.8, x + 0.8, 0.0, 2.0) for x in (4.0, 14.0)]
    matrix = place(-13.6, 0, COURT_SOUTH, EAST_FACING)
    room.add_model(arch.wall(20.0, SLAB, 0.4, doors, "brick"), matrix)
    cell = [Opening(5.4, 7.0, 0.0, 2.3, arched=False)]
    other = place(WEST, 0, -15.0, SOUTH_FACING)
    room.add_model(arch.wall(-14.0 - WEST, SLAB, 0.4, cell, "brick"), other)
    room.add_model(
        fit.portcullis(1.6, 2.3),
        place(WEST + 6.2, 0, -15.2, 0) @ translation(0.75, 0, 0.75) @ place(0, 0, 0, 62),
    )
    for o in doors:
        middle = translation((o.x0 + o.x1) / 2, o.spring, 0)
        room.add("trim", arch.archivolt(o.radius, 0.24, 0.05, 9).transformed(matrix @ middle))
        back = translation((o.x0 + o.x1) / 2, o.spring, -0.4) @ scaling(1, 1, -1)
        room.add("trim", arch.archivolt(o.radius, 0.24, 0.05, 9).transformed(matrix @ back))
    leaf = fit.door_leaf(1.6, 2.75, False)
    room.add_model(leaf, place(-13.52, 0, -9.2, -80))


def service_stair(scene: Scene, room: Model) -> None:
    hx0, hz0, hx1, hz1 = HOLE
    room.add_model(arch.stair(2 * FLIGHT, RISE, GOING, hx1 - hx0, 0.0), place(hx0, 0, hz0, -90))
    room.add_model(arch.balustrade(hz1 - hz0 - 0.3), place(hx1 + 0.14, GALLERY, hz0, -90))
    room.add_model(arch.balustrade(hx1 - hx0), place(hx0, GALLERY, hz0 - 0.14, 0))
    scene.put("newel", hx1 + 0.14, GALLERY, hz1 - 0.2)
    scene.put("newel", hx1 + 0.14, GALLERY, hz0 - 0.14)


def store_fittings(scene: Scene) -> None:
    for z in (-8.0, -16.0, -24.0):
        scene.put("lantern", -12.2, SLAB, z)
        scene.light("corridor", -12.2, SLAB - 0.62, z, WARM, 12.5, 8)
    sconce(scene, -18.0, 2.2, COURT_SOUTH, 180, 15.0, 10.0)
    sconce(scene, -14.0, 2.2, -22.0, -90, 15.0, 10.0)
    stacks = [(-22.2, -6.7, 5), (-21.2, -6.6, -8), (-22.1, -7.8, 17), (-14.7, -6.7, 0), (-14.7, -13.9, 30),
              (-16.0, -25.3, 10), (-17.1, -25.4, -5), (-14.8, -25.2, 40)]  # fmt: skip
    for x, z, yaw in stacks:
        scene.put("crate", x, 0, z, yaw)
    scene.put("crate", -22.1, 0.9, -6.9, 30)
    scene.put("crate", -16.5, 0.9, -25.3, -12)
    for x, z in (
        (-22.3, -10.0),
        (-22.2, -10.9),
        (-21.5, -10.4),
        (-18.6, -25.4),
        (-19.4, -25.2),
        (-14.6, -17.2),
    ):
        scene.put("barrel", x, 0, z, z * 50)
    scene.put("table", -18.0, 0, -11.0, 15)
    scene.put("bench", -18.2, 0, -10.1, 15)
    scene.put("candle", -18.0, 0.8, -11.0)
    scene.light("table", -18.0, 1.35, -11.0, WARM, 7, 7)


def library_fittings(scene: Scene) -> None:
    for z in (-11.0, -20.0):
        scene.put("small_chandelier", -15.8, 7.55, z)
        scene.light("library", -15.8, 8.05, z, WARM, 25, 12)
        ring_of_candles(scene, -15.8, 7.55, z, fit.SMALL_CHANDELIER)
        scene.put("table", -15.8, GALLERY, z, 90)
        scene.put("bench", -14.8, GALLERY, z, 90)
        scene.put("bench", -16.8, GALLERY, z, 90)
        scene.put("candle", -15.7, GALLERY + 0.8, z + 0.8)
    for x in (-21.7, -19.6, -17.5, -15.4, -13.3):
        scene.put("bookcase", x, GALLERY, COURT_SOUTH, 180)
    for x in (-19.0, -16.9, -14.8, -12.7):
        scene.put("bookcase", x, GALLERY, COURT_NORTH, 0)
    for z in (-13.0, -16.0, -19.0):
        scene.put("bookcase", -OUTER, GALLERY, z, -90)
    for z in (-10.0, -16.0, -22.0):
        scene.light("library_window", WEST + 1.1, GALLERY + 2.4, z, MOON, 10, 8)


# ------------------------------------------------------------------------------------ viewpoints


def viewpoints(scene: Scene) -> None:
    scene.camera("cam_hero", (1.1, 3.0, -4.9), (-0.5, 4.6, -30.0))
    scene.camera("cam_balcony", (-0.4, GALLERY + 1.9, -2.6), (0.5, 6.4, -28.0))
    scene.camera("cam_stairs", (3.0, 1.8, -20.4), (-0.5, 4.3, -33.0))
    scene.camera("cam_gallery", (8.6, GALLERY + 1.7, -27.5), (2.0, 6.0, -4.0))
    scene.camera("cam_courtyard", (25.6, 1.8, -10.0), (13.5, 4.3, -21.0), 65.0)
    scene.camera("cam_library", (-12.4, GALLERY + 1.7, -8.0), (-18.2, GALLERY + 1.2, -24.0))
    scene.camera("cam_store", (-14.8, 1.7, -7.0), (-20.5, 1.4, -14.5))
    scene.spawns = [
        (0.0, 1.7, -2.0), (9.2, 1.7, -24.0), (-9.2, 1.7, -12.0), (22.0, 1.7, -9.0), (12.2, 1.7, -17.0),
        (-12.2, 1.7, -14.0), (-17.0, 1.7, -20.0), (0.0, GALLERY + 1.7, -2.0), (-14.0, GALLERY + 1.7, -15.0),
    ]  # fmt: skip
