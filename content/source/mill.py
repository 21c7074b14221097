"""A windmill by a pond, where everything moves that can: the plan of mill.glb.

    gate (0, 0, 9)          south, towards +Z and the first camera
    pond (8, 0, 4)
    mill (0, 0, 0), its sails towards +Z
    mast with a flag (-7, 0, 3)
"""

from __future__ import annotations

import math

import numpy as np

from . import furniture as fit
from .animated import AnimatedScene, Node, Skinning, Track, about
from .mesh import (
    Mesh,
    Model,
    box,
    cylinder,
    floor,
    lathe,
    normalized,
    panel,
    sphere,
    surface,
    translation,
)
from .scene import FIRE, Camera

X, Y, Z = (1, 0, 0), (0, 1, 0), (0, 0, 1)
HUB = (0.0, 7.6, 2.9)
FLAG_LENGTH, FLAG_HEIGHT, FLAG_JOINTS = 3.2, 1.4, 9
POND, WAVES, WAVE_HEIGHT = 5.0, 3, 0.06


def build() -> AnimatedScene:
    scene = AnimatedScene()
    ground(scene)
    mill(scene)
    sails(scene)
    weathercock(scene)
    gate(scene)
    flag(scene)
    pond(scene)
    lantern(scene)
    viewpoints(scene)
    return scene


def ground(scene: AnimatedScene) -> None:
    meadow = scene.room("meadow")
    x0, z0, x1, z1 = 5.5, 1.5, 5.5 + POND, 1.5 + POND  # the hole for the pond
    for a, b, c, d in ((-40, -40, x0, 40), (x1, -40, 40, 40), (x0, -40, x1, z0), (x0, z1, x1, 40)):
        meadow.add("grass", floor(a, b, c, d, 0.0))
    rim = 0.25
    meadow.add(
        "plaster",
        box(x0 - rim, -0.5, z0 - rim, x1 + rim, 0.2, z0, 0.03),
        box(x0 - rim, -0.5, z1, x1 + rim, 0.2, z1 + rim, 0.03),
        box(x0 - rim, -0.5, z0, x0, 0.2, z1, 0.03),
        box(x1, -0.5, z0, x1 + rim, 0.2, z1, 0.03),
    )
    scene.nodes.append(Node("meadow", "meadow"))


def mill(scene: AnimatedScene) -> None:
    tower = scene.room("mill")
    tower.add("plaster", lathe([(2.6, 0), (2.45, 0.3), (2.4, 0.32), (1.85, 6.6)], 32))
    tower.add("timber", lathe([(2.05, 6.5), (2.15, 6.6), (2.15, 6.8), (1.9, 6.85)], 32))
    tower.add("slate", lathe([(2.2, 6.8), (1.6, 8.2), (0.7, 9.1), (0.0, 9.4)], 32, 60))
    tower.add("timber", cylinder(0.16, 2.0, 10).transformed(_towards_z(0, HUB[1], 0.9)))
    tower.add_model(fit.door_leaf(1.1, 2.1, True), translation(-0.55, 0.0, 2.62))
    for y, z in ((3.4, 2.18), (5.2, 2.02)):
        tower.add("leaded_glass", panel(0.6, 0.8).transformed(translation(0, y, z)))
        tower.add("timber", box(-0.4, y - 0.1, z - 0.3, 0.4, y, z + 0.06, 0.02))
        tower.add("timber", box(-0.4, y + 0.8, z - 0.3, 0.4, y + 0.9, z + 0.06, 0.02))
    scene.nodes.append(Node("mill", "mill"))


def _towards_z(x: float, y: float, z: float) -> np.ndarray:
    turn = np.array([[1, 0, 0, 0], [0, 0, -1, 0], [0, 1, 0, 0], [0, 0, 0, 1]], float)
    return translation(x, y, z) @ turn


def sails(scene: AnimatedScene) -> None:
    """Four nodes with one mesh, on a hub that turns evenly: a key every quarter."""
    sail = Model().add("timber", box(-0.07, 0.0, -0.05, 0.07, 5.4, 0.05, 0.015))
    for k in range(8):
        y = 1.2 + 0.55 * k
        sail.add("timber", box(-0.2, y, -0.025, 1.15, y + 0.05, 0.025, 0.0))
    sail.add("timber", box(1.1, 1.2, -0.025, 1.15, 5.1, 0.025, 0.0))
    cloth = panel(0.98, 3.8).transformed(translation(0.58, 1.25, 0.03))
    sail.add("canvas", cloth)
    scene.prefabs["sail"] = sail
    scene.prefabs["hub"] = Model().add("iron", sphere(0.3, 14, 8))
    hub = Node("hub", "hub", HUB)
    for k in range(4):
        hub.add(Node(f"sail_{k}", "sail", rotation=about(Z, 90 * k)))
    scene.nodes.append(hub)
    times = np.arange(5) * 2.5
    scene.clips["sails"] = [Track(hub, "rotation", times, [about(Z, -90 * k) for k in range(5)])]


def weathercock(scene: AnimatedScene) -> None:
    """Turns by jerks."""
    arrow = Model().add("iron", cylinder(0.05, 0.6, 6))
    arrow.add("iron", box(-0.7, 0.55, -0.02, 0.7, 0.63, 0.02, 0.0))
    arrow.add("iron", box(-0.9, 0.42, -0.02, -0.6, 0.76, 0.02, 0.0))
    scene.prefabs["weathercock"] = arrow
    cock = Node("weathercock", "weathercock", (0, 9.35, 0))
    scene.nodes.append(cock)
    turns = [0, 35, 20, 80, 60, 0]
    times = np.array([0, 0.9, 1.2, 2.6, 3.1, 4.4])
    values = [about(Y, degrees) for degrees in turns]
    scene.clips["weathercock"] = [Track(cock, "rotation", times, values, "STEP")]


def gate(scene: AnimatedScene) -> None:
    """A portcullis between two posts: quickly up, slowly down."""
    posts = scene.room("gate_posts")
    for side in (-1, 1):
        x = side * 1.75
        posts.add("plaster", box(x - 0.35, 0, 8.65, x + 0.35, 3.4, 9.35, 0.04))
        posts.add("slate", box(x - 0.45, 3.4, 8.55, x + 0.45, 3.55, 9.45, 0.04))
        far = side * 6.5
        low, high = min(x + side * 0.35, far), max(x + side * 0.35, far)
        posts.add("plaster", box(low, 0, 8.8, high, 1.2, 9.2, 0.03))
    posts.add("timber", box(-2.1, 3.0, 8.85, 2.1, 3.3, 8.94, 0.02))
    scene.nodes.append(Node("gate_posts", "gate_posts"))
    scene.prefabs["portcullis"] = fit.portcullis(2.8, 2.8)
    bars = Node("portcullis", "portcullis", (0, 0.05, 9.0))
    scene.nodes.append(bars)
    times = np.array([0.0, 1.5, 3.0, 7.0])
    heights = [0.05, 2.3, 2.3, 0.05]
    rows = [row for y in heights for row in ((0, 0, 0), (0, y, 9.0), (0, 0, 0))]
    scene.clips["gate"] = [Track(bars, "translation", times, np.array(rows), "CUBICSPLINE")]


def flag(scene: AnimatedScene) -> None:
    """Skinned: a chain of joints along +X, each of which swings a little later than the last."""
    mast = scene.room("mast")
    mast.add("timber", cylinder(0.09, 7.4, 10, 0.06).transformed(translation(-7, 0, 3)))
    mast.add("brass", sphere(0.13, 10, 6).transformed(translation(-7, 7.45, 3)))
    scene.nodes.append(Node("mast", "mast"))

    columns, rows = 4 * (FLAG_JOINTS - 1) + 1, 9
    gx, gy = np.meshgrid(
        np.linspace(0, FLAG_LENGTH, columns), np.linspace(-FLAG_HEIGHT, 0, rows)
    )
    u, v = (gx / FLAG_LENGTH), (-gy / FLAG_HEIGHT)
    cloth = surface(np.stack([gx, gy, np.zeros_like(gx)], 2), np.stack([v, u], 2))
    scene.prefabs["flag"] = Model().add("banner_blue", cloth)
    along = cloth.positions[:, 0] / FLAG_LENGTH * (FLAG_JOINTS - 1)
    first = np.minimum(along.astype(int), FLAG_JOINTS - 2)
    part = along - first
    none = np.zeros_like(first)
    rest = np.zeros((FLAG_JOINTS, 3))
    rest[:, 0] = np.linspace(0, FLAG_LENGTH, FLAG_JOINTS)
    scene.skinning["flag"] = Skinning(
        np.stack([first, first + 1, none, none], 1),
        np.stack([1 - part, part, 0 * part, 0 * part], 1),
        rest,
    )

    joints = [Node(f"flag_{k}") for k in range(FLAG_JOINTS)]
    joints[0].translation = (-6.92, 7.3, 3)
    for k, joint in enumerate(joints[1:]):
        joint.translation = (FLAG_LENGTH / (FLAG_JOINTS - 1), 0, 0)
        joints[k].add(joint)
    scene.nodes += [joints[0], Node("flag", "flag", joints=joints)]
    scene.clips["flag"] = [_wave(joint, k) for k, joint in enumerate(joints)]


def _wave(joint: Node, k: int) -> Track:
    keys, period = 16, 1.6
    swing = 9.0 + 2.5 * k  # degrees
    values = []
    for i in range(keys + 1):
        phase = 2 * math.pi * i / keys - 0.9 * k
        turn = about(Y, swing * math.sin(phase))
        values.append(turn if k else _multiplied(about(Y, 18), turn))
    return Track(joint, "rotation", np.arange(keys + 1) * period / keys, values)


def _multiplied(a: tuple, b: tuple) -> tuple:
    av, bv = np.array(a[:3]), np.array(b[:3])
    v = a[3] * bv + b[3] * av + np.cross(av, bv)
    return (*v, a[3] * b[3] - av @ bv)


def pond(scene: AnimatedScene) -> None:
    """Morph targets: the sum of two standing waves a quarter apart is one that travels."""
    points = 41
    grid = np.linspace(0, POND, points)
    gx, gz = np.meshgrid(grid, POND - grid)  # rows go north, columns east: front faces up
    water = surface(np.stack([gx, np.zeros_like(gx), gz], 2), np.stack([gx, -gz], 2))
    water = Mesh(water.positions, np.tile((0.0, 1.0, 0.0), (points * points, 1)), water.uvs,
                 water.triangles)  # fmt: skip
    scene.prefabs["water"] = Model().add("water", water)
    k = 2 * math.pi * WAVES / POND
    angle = k * (water.positions[:, 0] + 0.5 * water.positions[:, 2])
    scene.targets["water"] = [
        _standing_wave(np.sin(angle), np.cos(angle), k),
        _standing_wave(np.cos(angle), -np.sin(angle), k),
    ]
    node = Node("pond", "water", (5.5, 0.05, 1.5))
    scene.nodes.append(node)
    keys, period = 24, 3.0
    phase = np.arange(keys + 1) * (2 * math.pi / keys)
    weights = np.stack([np.cos(phase), np.sin(phase)], 1).reshape(-1, 1)
    times = np.arange(keys + 1) * (period / keys)
    scene.clips["pond"] = [Track(node, "weights", times, weights)]


def _standing_wave(height: np.ndarray, slope: np.ndarray, k: float) -> tuple:
    flat = np.zeros_like(height)
    positions = np.stack([flat, WAVE_HEIGHT * height, flat], 1)
    tilt = -WAVE_HEIGHT * k * slope
    return positions, np.stack([tilt, flat, 0.5 * tilt], 1)


def lantern(scene: AnimatedScene) -> None:
    """Swings over the door, and its light with it."""
    arm = scene.room("lantern_arm")
    arm.add("iron", box(0.88, 3.02, 1.6, 0.94, 3.08, 3.5, 0.0))
    scene.nodes.append(Node("lantern_arm", "lantern_arm"))
    scene.prefabs["lantern"] = fit.lantern()
    scene.light("lantern", 0, -0.62, 0, FIRE, 12.0, 9.0)
    hook = Node("lantern", "lantern", (0.91, 3.02, 3.4))
    hook.add(Node("lantern_light", translation=(0, -0.62, 0), light=0))
    scene.nodes.append(hook)
    keys, period = 20, 2.4
    phase = 2 * math.pi * np.arange(keys + 1) / keys
    values = [about(X, 16 * math.sin(p)) for p in phase]
    times = np.arange(keys + 1) * period / keys
    scene.clips["lantern"] = [Track(hook, "rotation", times, values)]


def viewpoints(scene: AnimatedScene) -> None:
    scene.sun = ((1.0, 0.78, 0.52), 2.2)
    scene.nodes.append(Node("sun", rotation=_multiplied(about(Y, 50), about(X, -28)), light=1))
    scene.camera("cam_mill", (9.5, 3.4, 20.5), (-0.4, 5.3, 2.0), 48)
    scene.camera("cam_pond", (12.6, 2.7, 10.6), (2.6, 4.6, 0.0), 62)
    scene.camera("cam_orbit", (0, 5.0, 18.5), (0, 5.2, 0.0), 54)
    for k, camera in enumerate(scene.cameras[:2]):
        scene.nodes.append(camera_node(camera, k))
    pivot = Node("orbit").add(camera_node(scene.cameras[2], 2))
    scene.nodes.append(pivot)
    times = np.arange(5) * 6.0
    scene.clips["orbit"] = [Track(pivot, "rotation", times, [about(Y, 90 * k) for k in range(5)])]
    scene.nodes.append(Node("spawn_0", translation=(0, 1.7, 14)))


def camera_node(camera: Camera, number: int) -> Node:
    towards = normalized(np.array(camera.target, float) - np.array(camera.position, float))
    yaw = math.degrees(math.atan2(-towards[0], -towards[2]))
    pitch = math.degrees(math.asin(towards[1]))
    turn = _multiplied(about(Y, yaw), about(X, pitch))
    return Node(camera.name, translation=camera.position, rotation=turn, camera=number)
