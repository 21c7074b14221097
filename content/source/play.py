"""What moves and what matters in the game: doors, the lift, the gate, cores and patrols.

The game knows them by the names of their nodes:
  door_left_N, door_right_N   leaves that turn about their own Y axis; open, and closed at a yaw of -90
  lift_N, lift_N_top          a platform, and where it goes
  gate_N, gate_N_exit         a grille that rises, and the place to reach
  crate_N                     can be pushed
  core_N                      what to collect
  patrol_N_K                  the way of drone N, in a loop if its end is near its beginning
"""

from __future__ import annotations

from . import architecture as arch
from . import furniture as fit
from .architecture import Opening
from .mesh import MIRROR_X, Mesh, Model, box, cylinder, place, rotation_z, torus, translation
from .scene import Scene

GALLERY, LANDING = 5.4, 2.7
EYE = 1.8  # how high drones fly above a floor
LIFT_X, LIFT_Z, LIFT_HALF, LIFT_THICK = 15.2, -12.0, 1.05, 0.14
GATE = Opening(-1.3, 1.3, 0.0, 2.3)

PATROLS = [
    ((-4.0, EYE, -6.5), (4.0, EYE, -6.5), (4.0, EYE, -24.5), (-4.0, EYE, -24.5)),  # the nave
    ((16.8, EYE, -9.0), (24.3, EYE, -9.2), (24.3, EYE, -22.8), (16.8, EYE, -22.8)),  # the court
    ((-12.4, EYE, -7.0), (-12.4, EYE, -24.8)),  # the corridor
    ((-13.2, GALLERY + EYE, -8.4), (-18.6, GALLERY + EYE, -8.4), (-18.6, GALLERY + EYE, -23.6),
     (-13.2, GALLERY + EYE, -23.6)),  # the library
    ((8.3, GALLERY + EYE, -5.0), (8.3, GALLERY + EYE, -29.0)),  # the east gallery
    ((12.2, GALLERY + EYE, -7.4), (12.2, GALLERY + EYE, -23.0)),  # the walk above the cloister
    ((-8.3, EYE, -4.0), (-8.3, EYE, -29.0)),  # the west aisle
]  # fmt: skip

CORES = [
    (0.0, LANDING + 1.15, -30.9),  # on the grand stair
    (-21.7, GALLERY + 1.15, -11.5),  # in the library
    (-16.6, 1.15, -20.4),  # in the far store room
]


def prefabs() -> dict[str, Model]:
    leaf = fit.door_leaf(0.89, 2.98, True)
    return {
        "door_left": leaf,
        "door_right": Model().add_model(leaf, MIRROR_X),
        "gate": Model().add("grate", arch.arched_pane(GATE, 0.3, False)),
        "lift": lift_platform(),
    }


def add(scene: Scene) -> None:
    for z in (-10.0, -22.0):
        for x, left, right in ((10.46, 0, 180), (-10.54, 180, 0)):
            scene.put("door_left", x, 0, z - 0.895, left)
            scene.put("door_right", x, 0, z + 0.895, right)
    lift(scene)
    scene.put("gate", 26.8, 0, -16.0, -90)
    scene.mark("gate_0_exit", 25.6, 0.0, -16.0)
    for k, core in enumerate(CORES):
        scene.mark(f"core_{k}", *core)
    for k, way in enumerate(PATROLS):
        for i, point in enumerate(way):
            scene.mark(f"patrol_{k}_{i}", *point)


def lift_platform() -> Model:
    """Its upper side is at y = 0."""
    h, t = LIFT_HALF, LIFT_THICK
    model = Model().add("planks", box(-h + 0.08, -t + 0.03, -h + 0.08, h - 0.08, 0.0, h - 0.08, 0.0))
    for s in (-1, 1):
        rail = sorted((s * h, s * (h - 0.08)))
        model.add("iron", box(rail[0], -t, -h, rail[1], 0.0, h, 0.015))
        model.add("iron", box(-h + 0.08, -t, rail[0], h - 0.08, 0.0, rail[1], 0.015))
        shoe = box(-0.14, -t, s * (h + 0.02) - 0.05, 0.14, 0.42, s * (h + 0.02) + 0.05, 0.012)
        model.add("iron", shoe)
    return model


def lift(scene: Scene) -> None:
    scene.put("lift", LIFT_X, LIFT_THICK, LIFT_Z)
    scene.mark("lift_0_top", LIFT_X, GALLERY, LIFT_Z)
    court = scene.room("courtyard")
    court.add("timber", box(13.8, GALLERY - 0.12, LIFT_Z - 1.05, LIFT_X - 1.07, GALLERY,
                            LIFT_Z + 1.05, 0.01))  # fmt: skip
    top = GALLERY + 2.6
    for s in (-1, 1):
        z = LIFT_Z + s * (LIFT_HALF + 0.17)
        court.add("timber", box(LIFT_X - 0.09, 0.0, z - 0.09, LIFT_X + 0.09, top, z + 0.09, 0.015, "-y"))
        foot = box(LIFT_X - 0.24, 0.0, z - 0.14, LIFT_X + 0.24, 0.16, z + 0.14, 0.03, "-y")
        court.add("trim", foot)
    beam = LIFT_HALF + 0.45
    court.add("timber", box(LIFT_X - 0.11, top, LIFT_Z - beam, LIFT_X + 0.11, top + 0.24,
                            LIFT_Z + beam, 0.02))  # fmt: skip
    at = translation(LIFT_X, top - 0.12, LIFT_Z)
    court.add("iron", *[mesh.transformed(at) for mesh in wheel()])


def wheel() -> list[Mesh]:
    """Hangs under the beam and turns about X."""
    upright = rotation_z(90)
    axle = cylinder(0.035, 0.36, 8).transformed(translation(0.18, 0, 0) @ upright)
    return [torus(0.17, 0.035, 18, 6).transformed(upright), axle]
