"""What the game adds to a level: sentry drones, cores, grenades and bolts, each about its centre.

They stand in a row on a stage, for its cameras; the game takes them by the names of their nodes.
Forward is -Z. What glows takes the place of lights: the host adds those.
"""

from __future__ import annotations

import math

import numpy as np

from .mesh import (
    MIRROR_X,
    Mesh,
    Model,
    block,
    box,
    closed_surface,
    cylinder,
    floor,
    lathe,
    merge,
    place,
    polygon,
    rotation_x,
    rotation_y,
    rotation_z,
    sphere,
    torus,
    translation,
)
from .scene import Scene

FORWARD = rotation_x(-90)  # turns +Y to -Z
HEIGHT = 1.2  # of the row
ROW = {"drone": 0.0, "drone_off": 1.1, "core": 2.0, "grenade": 2.5, "bolt": 2.9}
GRENADE_RADIUS = 0.075


def build() -> Scene:
    scene = Scene()
    scene.prefabs = {
        "drone": drone("drone_eye", "drone_pupil", "drone_thrust"),
        "drone_off": tilted(drone("drone_dead", "drone_dead", "drone_dead")),
        "core": core(),
        "grenade": grenade(),
        "bolt": bolt(),
    }
    for name, x in ROW.items():
        scene.put(name, x, HEIGHT, 0)
    stage(scene)
    return scene


def stage(scene: Scene) -> None:
    scene.room("stage").add("slate", floor(-3, -4, 6, 3, 0), box(-0.6, 0, 1, 3.4, 3, 1.1))
    scene.light("key", -0.6, 2.6, -1.6, (1.0, 0.9, 0.8), 12.0, 9.0)
    scene.light("key", 2.6, 2.4, -1.2, (1.0, 0.9, 0.8), 8.0, 9.0)
    scene.light("fill", 1.0, 0.4, -2.2, (0.5, 0.66, 1.0), 5.0, 9.0)
    scene.camera("cam_drone", (-0.55, 1.35, -1.05), (0.0, HEIGHT, 0.0), 42)
    scene.camera("cam_side", (-1.0, 1.55, 0.45), (0.0, HEIGHT, 0.0), 42)
    scene.camera("cam_off", (0.8, 1.45, -1.1), (1.1, HEIGHT, 0.0), 42)
    scene.camera("cam_core", (1.85, 1.3, -0.55), (2.0, HEIGHT, 0.0), 42)
    scene.camera("cam_grenade", (2.4, 1.27, -0.25), (2.5, HEIGHT, 0.0), 42)
    scene.camera("cam_bolt", (2.6, 1.3, -0.45), (2.9, HEIGHT, 0.0), 42)
    scene.camera("cam_row", (1.3, 1.7, -3.0), (1.3, HEIGHT, 0.0), 42)


# ---------------------------------------------------------------------------------------- drones


def drone(eye: str, pupil: str, thrust: str) -> Model:
    """0.7 m from fin to fin."""
    model = Model()
    model.add("drone_shell", *hull())
    model.add("drone_joint", cylinder(0.19, 0.05, 24).transformed(translation(0, -0.025, 0)))
    add_ring(model)
    add_eye(model, eye, pupil)
    add_fins(model)
    add_thruster(model, thrust)
    for side in (-1, 1):  # two small lamps on the brow
        lamp = box(-0.022, -0.006, -0.006, 0.022, 0.006, 0.006, 0.0)
        model.add(eye, lamp.transformed(place(side * 0.1, 0.112, -0.158, side * -32)))
    return model


def hull() -> list[Mesh]:
    """Two bowls with cut edges and a gap between them."""
    upper = [(0.185, 0.025), (0.222, 0.025), (0.232, 0.036), (0.222, 0.075), (0.168, 0.135),
             (0.156, 0.139), (0.085, 0.168), (0.08, 0.178), (0.045, 0.184), (0.0, 0.184)]  # fmt: skip
    lower = [(0.0, -0.158), (0.075, -0.158), (0.085, -0.152), (0.165, -0.108), (0.212, -0.06),
             (0.222, -0.036), (0.214, -0.025), (0.185, -0.025)]  # fmt: skip
    return [lathe(upper, 20, 18), lathe(lower, 20, 18)]


def add_ring(model: Model) -> None:
    r, w, h = 0.288, 0.018, 0.02
    profile = [(r - w, -h / 2), (r - w / 2, -h), (r + w / 2, -h), (r + w, -h / 2), (r + w, h / 2),
               (r + w / 2, h), (r - w / 2, h), (r - w, h / 2), (r - w, -h / 2)]  # fmt: skip
    model.add("drone_steel", without_front(lathe(profile, 32, 18)))
    for k in range(4):
        arm = box(0.18, -0.012, -0.018, 0.28, 0.012, 0.018, 0.0)
        model.add("drone_joint", arm.transformed(rotation_y(90 * k + 45)))
        clamp = box(0.262, -0.027, -0.03, 0.314, 0.027, 0.03, 0.008)
        model.add("drone_shell", clamp.transformed(rotation_y(90 * k + 45)))


def without_front(mesh: Mesh) -> Mesh:
    """Leaves out what is within 45 degrees of -Z, in sight of the eye."""
    middle = mesh.positions[mesh.triangles].mean(axis=1)
    front = -middle[:, 2] > np.abs(middle[:, 0])
    used, triangles = np.unique(mesh.triangles[~front], return_inverse=True)
    return Mesh(mesh.positions[used], mesh.normals[used], mesh.uvs[used], triangles.reshape(-1, 3))


def add_eye(model: Model, eye: str, pupil: str) -> None:
    out = FORWARD @ translation(0, 0.045, 0)
    socket = [(0.118, 0.04), (0.118, 0.196), (0.106, 0.214), (0.088, 0.214), (0.08, 0.2), (0.08, 0.185)]
    model.add("drone_shell", lathe(socket, 20, 18).transformed(out))
    collar = [(0.117, 0.168), (0.125, 0.174), (0.125, 0.19), (0.117, 0.196)]
    model.add("drone_steel", lathe(collar, 20, 18).transformed(out))
    model.add(eye, lathe([(0.081, 0.19), (0.064, 0.205), (0.034, 0.214)], 20, 80).transformed(out))
    model.add(pupil, lathe([(0.034, 0.214), (0.018, 0.219), (0.0, 0.22)], 20, 80).transformed(out))


def add_fins(model: Model) -> None:
    fin = swept([(-0.07, 0.09), (0.035, 0.045), (0.3, 0.352)], 0.013)
    model.add("drone_shell", fin, fin.transformed(MIRROR_X))
    tail = swept([(0.05, 0.17), (0.16, 0.235), (0.1, 0.245)], 0.01)
    model.add("drone_shell", tail.transformed(rotation_z(90)))
    model.add("drone_steel", cylinder(0.004, 0.13, 6, 0.002).transformed(translation(0.07, 0.16, 0.06)))
    for side in (-1, 1):  # air brakes behind
        flap = box(-0.05, -0.006, 0.2, 0.05, 0.006, 0.31, 0.003)
        model.add("drone_steel", flap.transformed(rotation_y(side * 24) @ rotation_x(12)))


def swept(spans: list, half: float) -> Mesh:
    """A blade along +X between two chords: (front, back) at its root and tip, and both x."""
    (root_front, root_back), (tip_front, tip_back), (x0, x1) = spans
    corners = []
    for k in range(8):
        tip, back = k & 1, k & 4
        z = (tip_back if back else tip_front) if tip else (root_back if back else root_front)
        thin = 0.45 if tip else 1.0
        corners.append((x1 if tip else x0, half * thin * (1 if k & 2 else -1), z))
    return block(np.array(corners), 0.004)


def add_thruster(model: Model, thrust: str) -> None:
    nozzle = [(0.05, -0.15), (0.06, -0.2), (0.066, -0.2), (0.074, -0.15)]
    model.add("drone_steel", lathe(nozzle, 16, 18))
    inner = [(0.056, -0.178), (0.052, -0.156)]
    model.add("drone_joint", lathe([(r + 0.004, y - 0.02) for r, y in inner], 16, 18).flipped())
    glow = [(0.058 * math.cos(a), -0.172, 0.058 * math.sin(a)) for a in turn(16)]
    model.add(thrust, polygon(glow))


def turn(count: int) -> list[float]:
    return [2 * math.pi * k / count for k in range(count)]


def tilted(model: Model) -> Model:
    return Model().add_model(model, rotation_z(17) @ rotation_x(-12))


# ----------------------------------------------------------------------------------------- cores


def core() -> Model:
    """A crystal whose faces glow unlike each other, in a cage of 0.35 m."""
    model = Model()
    shades = ("crystal_bright", "crystal", "crystal_deep")
    for k, face in enumerate(crystal(0.086, 0.042, 0.142, 6)):
        model.add(shades[(k * 5 + k // 6) % 3], face)
    hoop = torus(0.168, 0.0055, 28, 5)
    for k in range(3):
        model.add("drone_steel", hoop.transformed(rotation_y(60 * k) @ rotation_z(90)))
    model.add("drone_joint", torus(0.168, 0.0075, 28, 5))
    for side in (-1, 1):
        cap = lathe([(0.0, -0.012), (0.022, -0.012), (0.026, -0.004), (0.016, 0.012), (0.0, 0.012)], 10, 18)
        model.add("drone_joint", cap.transformed(translation(0, side * 0.163, 0)))
        pin = cylinder(0.006, 0.03, 6, 0.003)
        turned = rotation_x(180) if side > 0 else np.eye(4)
        model.add("drone_steel", pin.transformed(translation(0, side * 0.158, 0) @ turned))
    return model


def crystal(radius: float, half: float, tip: float, sides: int) -> list[Mesh]:
    """A prism between two pyramids, turned against each other, face by face."""
    upper = [(radius * math.cos(a), half, -radius * math.sin(a)) for a in turn(sides)]
    lower = [(0.86 * radius * math.cos(a + 0.22), -half, -0.86 * radius * math.sin(a + 0.22))
             for a in turn(sides)]  # fmt: skip
    faces = []
    for k in range(sides):
        j = (k + 1) % sides
        faces.append(polygon([upper[k], upper[j], (0, tip, 0)]))
        faces.append(polygon([lower[k], lower[j], upper[j]]))
        faces.append(polygon([lower[k], upper[j], upper[k]]))
        faces.append(polygon([lower[j], lower[k], (0, -tip, 0)]))
    return faces


# ---------------------------------------------------------------------------- grenades and bolts


def grenade() -> Model:
    model = Model()
    for low, high in ((-70.0, -8.0), (8.0, 70.0)):
        model.add("grenade", ribbed(0.0735, low, high, 12))
    band = [(0.068, -0.012), (0.0735, -0.012), (0.075, -0.0105), (0.075, -0.0045), (0.073, -0.003)]
    model.add("drone_steel", lathe(band, 24, 18))
    model.add("drone_steel", lathe([(r, -y) for r, y in reversed(band)], 24, 18))
    model.add("grenade_stripe", lathe([(0.073, -0.003), (0.0736, 0.0), (0.073, 0.003)], 24, 80))
    cap = [(0.032, 0.058), (0.032, 0.066), (0.029, 0.069), (0.014, 0.069), (0.012, 0.075), (0.0, 0.075)]
    model.add("drone_joint", lathe(cap, 14, 18))
    base = [(0.0, -0.074), (0.022, -0.074), (0.028, -0.07), (0.03, -0.06)]
    model.add("drone_joint", lathe(base, 14, 18))
    model.add("drone_steel", torus(0.009, 0.0018, 10, 4).transformed(
        translation(0.0, 0.0705, -0.022) @ rotation_x(70)))  # fmt: skip
    return model


def ribbed(radius: float, low: float, high: float, ribs: int) -> Mesh:
    """A zone of a ball between two latitudes, with grooves from pole to pole and around it."""
    columns, rows = 3 * ribs, 7
    across = np.radians(np.linspace(low, high, rows))[:, None]
    around = np.arange(columns + 1) * (2 * math.pi / columns)
    groove = np.where(np.arange(columns + 1) % 3 == 0, 0.94, 1.0)[None, :]
    ring = np.where(np.isin(np.arange(rows), (0, 3)), 0.955, 1.0)[:, None]
    r = radius * np.minimum(groove, ring)
    positions = np.stack(
        [r * np.cos(across) * np.cos(around), r * np.sin(across) + 0 * around,
         r * np.cos(across) * -np.sin(around)], 2)  # fmt: skip
    uvs = np.stack(np.broadcast_arrays(radius * around[None, :], -radius * across), 2)
    return closed_surface(positions, uvs)


def bolt() -> Model:
    """0.36 m long."""
    model = Model()
    model.add("bolt_core", lathe([(0.013, -0.02), (0.021, 0.05), (0.016, 0.1), (0.0, 0.16)], 10, 80)
              .transformed(FORWARD))  # fmt: skip
    model.add("bolt_trail", lathe([(0.0, -0.2), (0.006, -0.11), (0.013, -0.02)], 10, 80)
              .transformed(FORWARD))  # fmt: skip
    fin = merge([polygon(points) for points in (
        [(0.012, 0, 0.03), (0.012, 0, -0.03), (0.045, 0, 0.075)],
        [(0.012, 0, -0.03), (0.012, 0, 0.03), (0.045, 0, 0.075)],
    )])  # fmt: skip
    for k in range(3):
        model.add("bolt_trail", fin.transformed(rotation_z(120 * k + 90)))
    return model
