"""Lamps, doors, banners, crates and the other things that fill the rooms."""

from __future__ import annotations

import math

import numpy as np

from .architecture import pedestal
from .mesh import (
    Model,
    box,
    cylinder,
    lathe,
    merge,
    panel,
    place,
    polygon,
    rotation_x,
    rotation_z,
    scaling,
    sphere,
    surface,
    torus,
    translation,
    Mesh,
)


def flame(height: float = 0.2) -> Mesh:
    """Leans and twists a little on its way up, so that no two sides look alike."""
    profile = [(0.0, 0.0), (0.16, 0.12), (0.20, 0.28), (0.13, 0.58), (0.05, 0.85), (0.0, 1.0)]
    mesh = lathe([(r * height, y * height) for r, y in profile], 6, 80)
    up = mesh.positions[:, 1] / height
    around = np.arctan2(mesh.positions[:, 2], mesh.positions[:, 0])
    swell = 1 + 0.22 * np.sin(2 * around + 4 * up)
    mesh.positions[:, 0] = mesh.positions[:, 0] * swell + 0.07 * height * np.sin(4.5 * up)
    mesh.positions[:, 2] = (
        mesh.positions[:, 2] * swell + 0.05 * height * np.sin(3.5 * up + 0.8) * up
    )
    turn = mesh.uvs[:, 0] / max(mesh.uvs[:, 0].max(), 1e-9)
    return mesh.with_uvs(np.stack([turn, 0.995 - 0.99 * up], axis=1))


def candle(height: float = 0.16, radius: float = 0.025) -> Model:
    model = Model().add("wax", cylinder(radius, height, 6))
    return model.add("flame", flame(0.11).transformed(translation(0, height, 0)))


def sconce() -> Model:
    """On a wall that faces +Z; the light belongs above the flame, at (0, 0.42, 0.34)."""
    cup = lathe(
        [
            (0.0, -0.06),
            (0.03, -0.05),
            (0.05, 0.0),
            (0.11, 0.05),
            (0.13, 0.12),
            (0.10, 0.12),
            (0.0, 0.04),
        ],
        10,
    )
    arm = box(-0.02, -0.10, 0.0, 0.02, -0.055, 0.36, 0.0)
    brace = box(-0.015, -0.015, -0.25, 0.015, 0.015, 0.16, 0.0).transformed(
        translation(0, -0.2, 0.19) @ rotation_x(-38)
    )
    return (
        Model()
        .add("iron", box(-0.07, -0.4, 0.0, 0.07, 0.12, 0.035, 0.012, "-z"), arm, brace)
        .add("iron", cup.transformed(translation(0, 0, 0.34)))
        .add("flame", flame(0.26).transformed(translation(0, 0.05, 0.34)))
    )


def _chain_link() -> Mesh:
    sides, around = 3, 6
    rows = []
    for i in range(sides + 1):
        b = 2 * math.pi * i / sides
        row = []
        for j in range(around + 1):
            a = -2 * math.pi * j / around
            r = 0.045 + 0.013 * math.cos(b)
            x, y = r * math.cos(a), r * math.sin(a)
            row.append(
                (
                    x,
                    y + math.copysign(0.05, round(y, 9)) if abs(y) > 1e-9 else y,
                    0.013 * math.sin(b),
                )
            )
        rows.append(row)
    positions = np.array(rows)
    uvs = np.stack(np.meshgrid(np.arange(around + 1) * 0.05, np.arange(sides + 1) * 0.02), 2)
    mesh = surface(positions, uvs)
    centre = np.stack(
        [positions[..., 0] * 0.75, positions[..., 1] * 0.75, positions[..., 2] * 0], 2
    )
    outward = (positions - centre).reshape(-1, 3)
    facing = np.cross(
        *(
            mesh.positions[mesh.triangles[:, k]] - mesh.positions[mesh.triangles[:, 0]]
            for k in (1, 2)
        )
    )
    if np.sum(facing * outward[mesh.triangles[:, 0]]) < 0:
        mesh = mesh.flipped()
    return mesh


def chain(length: float) -> Mesh:
    """Hangs down from the origin."""
    link, pitch = _chain_link().transformed(scaling(1.3, 1.8, 1.3)), 0.30
    return merge(
        [
            link.transformed(place(0, -pitch * (k + 0.5), 0, 90 * (k % 2)))
            for k in range(max(1, round(length / pitch)))
        ]
    )


def _strut(a, b, half: float) -> Mesh:
    a, b = np.array(a, float), np.array(b, float)
    axis = (b - a) / np.linalg.norm(b - a)
    side = np.cross(axis, (0, 0, 1) if abs(axis[2]) < 0.9 else (1, 0, 0))
    side /= np.linalg.norm(side)
    up = np.cross(side, axis)
    ring = [a + half * (c * side + s * up) for c, s in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    far = [p + (b - a) for p in ring]
    quads = []
    for k in range(4):
        j = (k + 1) % 4
        quads.append(polygon([ring[j], ring[k], far[k], far[j]]))
    middle = (a + b) / 2
    for k, quad in enumerate(quads):
        if quad.normals[0] @ (quad.positions.mean(axis=0) - middle) < 0:
            quads[k] = quad.flipped()
    return merge(quads)


CHANDELIER, SMALL_CHANDELIER = (1.25, 16), (0.8, 8)  # radius in metres, candles


def chandelier(drop: float, radius: float, candles: int) -> Model:
    """Its ring lies at y = 0 and it hangs from y = drop; the light belongs at (0, 0.5, 0)."""
    model = Model()
    crown = 1.9
    model.add("iron", chain(drop - crown).transformed(translation(0, drop, 0)))
    model.add("brass", sphere(0.11, 12, 8).transformed(translation(0, crown, 0)))
    profile = [(radius - 0.05, 0.0), (radius - 0.03, -0.05), (radius + 0.03, -0.05), (radius + 0.05, 0.0),
               (radius + 0.03, 0.07), (radius - 0.03, 0.07), (radius - 0.05, 0.0)]  # fmt: skip
    model.add("brass", lathe(profile, 30, 50))
    for k in range(candles):
        a = 2 * math.pi * (k + 0.5) / candles
        here = translation(radius * math.cos(a), 0.07, radius * math.sin(a))
        model.add("brass", lathe([(0.0, 0.0), (0.06, 0.03), (0.0, 0.045)], 7).transformed(here))
        model.add_model(candle(0.17, 0.024), here @ translation(0, 0.04, 0))
    for k in range(4):
        a = 2 * math.pi * k / 4
        foot = (radius * math.cos(a), 0.06, radius * math.sin(a))
        model.add("iron", _strut(foot, (0.08 * math.cos(a), crown, 0.08 * math.sin(a)), 0.014))
        model.add("brass", sphere(0.07, 7, 4).transformed(translation(foot[0], -0.1, foot[2])))
    return model


def brazier() -> Model:
    """The light belongs at (0, 1.55, 0)."""
    bowl = lathe(
        [
            (0.0, 0.62),
            (0.16, 0.64),
            (0.34, 0.74),
            (0.44, 0.92),
            (0.47, 0.92),
            (0.47, 0.96),
            (0.41, 0.96),
            (0.38, 0.88),
        ],
        20,
    )
    model = Model().add(
        "iron", bowl, torus(0.30, 0.018, 20, 5).transformed(translation(0, 0.25, 0))
    )
    for k in range(3):
        a = 2 * math.pi * k / 3 + 0.4
        top = (0.26 * math.cos(a), 0.72, 0.26 * math.sin(a))
        model.add("iron", _strut((0.42 * math.cos(a), 0.0, 0.42 * math.sin(a)), top, 0.022))
    coals = lathe([(0.385, 0.885), (0.25, 0.94), (0.0, 0.96)], 16, 80)
    model.add("embers", coals.with_uvs(coals.positions[:, [0, 2]]))
    for x, z, h in (
        (0, 0, 0.5),
        (0.16, 0.05, 0.36),
        (-0.13, 0.1, 0.32),
        (0.02, -0.17, 0.4),
        (-0.08, -0.06, 0.44),
    ):
        model.add("flame", flame(h).transformed(translation(x, 0.9, z)))
    return model


def torchere() -> Model:
    """A tall stand; the light belongs at (0, 1.98, 0)."""
    stem = [
        (0.20, 0.0),
        (0.20, 0.03),
        (0.06, 0.10),
        (0.025, 0.22),
        (0.022, 0.80),
        (0.045, 0.85),
        (0.022, 0.90),
        (0.022, 1.38),
        (0.06, 1.44),
        (0.15, 1.52),
        (0.17, 1.58),
        (0.0, 1.54),
    ]
    model = Model().add("iron", lathe(stem, 9, 50))
    return model.add("flame", flame(0.36).transformed(translation(0, 1.54, 0)))


def lantern() -> Model:
    """Hangs from the origin by a short chain; the light belongs at (0, -0.62, 0), in the open cage."""
    model = Model().add("iron", chain(0.34))
    model.add("iron", lathe([(0.17, -0.46), (0.15, -0.43), (0.03, -0.34), (0.0, -0.33)], 8, 30))
    model.add("iron", cylinder(0.14, 0.03, 8).transformed(translation(0, -0.92, 0)))
    for k in range(4):
        a = math.pi / 2 * k + math.pi / 4
        model.add(
            "iron",
            _strut(
                (0.13 * math.cos(a), -0.9, 0.13 * math.sin(a)),
                (0.15 * math.cos(a), -0.44, 0.15 * math.sin(a)),
                0.009,
            ),
        )
    model.add_model(candle(0.1, 0.03), translation(0, -0.89, 0))
    return model


def banner(material: str, width: float = 1.4, height: float = 3.2) -> Model:
    """Hangs from a rod at y = 0 on a wall that faces +Z."""
    rows, columns = 9, 6
    x = np.linspace(-width / 2, width / 2, columns)
    y = np.linspace(-height, 0, rows)
    gx, gy = np.meshgrid(x, y)
    swing = -gy / height
    z = 0.12 + swing * (0.07 * np.sin(gx * 5.0 + 0.6) + 0.03 * np.sin(gy * 2.6 + gx * 2))
    u, v = np.meshgrid(np.linspace(0, 1, columns), np.linspace(1, 0, rows))
    cloth = surface(np.stack([gx, gy, z], 2), np.stack([u, v], 2))
    rod = cylinder(0.025, width + 0.3, 6).transformed(
        translation(width / 2 + 0.15, 0.02, 0.12) @ rotation_z(90)
    )
    model = Model().add(material, cloth).add("brass", rod)
    for side in (-1, 1):
        model.add(
            "brass",
            sphere(0.055, 6, 4).transformed(translation(side * (width / 2 + 0.15), 0.02, 0.12)),
        )
        model.add(
            "iron",
            box(
                side * width / 2 - 0.015,
                -0.02,
                0.0,
                side * width / 2 + 0.015,
                0.01,
                0.12,
                0.0,
                "-z",
            ),
        )
    return model


def crate(size: float = 0.9) -> Model:
    h, f = size / 2, 0.07
    model = Model().add(
        "planks",
        box(-h + 0.03, 0.02, -h + 0.03, h - 0.03, size - 0.03, h - 0.03, 0.0).scaled_uvs(1.6),
    )
    for s in (-1, 1):
        for t in (-1, 1):
            x, z = sorted((s * h, s * (h - f))), sorted((t * h, t * (h - f)))
            model.add("timber", box(x[0], 0, z[0], x[1], size, z[1], 0.008).grain_up())
        for y in (0.0, size - f):
            x = sorted((s * h, s * (h - f)))
            model.add(
                "timber",
                box(-h + f, y, x[0] + s * -0.004, h - f, y + f, x[1] + s * -0.004, 0.0, "-x +x"),
            )
            model.add(
                "timber",
                box(x[0] + s * -0.004, y, -h + f, x[1] + s * -0.004, y + f, h - f, 0.0, "-z +z"),
            )
    return model


def barrel() -> Model:
    h = 1.0
    staves = [
        (0.0, 0.04),
        (0.28, 0.04),
        (0.285, 0.0),
        (0.31, 0.0),
        (0.375, h * 0.3),
        (0.39, h * 0.5),
        (0.375, h * 0.7),
        (0.31, h),
        (0.285, h),
        (0.28, h - 0.04),
        (0.0, h - 0.04),
    ]
    model = Model().add("planks", lathe(staves, 14, 35).scaled_uvs(1.8))
    for y, r in ((0.07, 0.327), (0.28, 0.375), (0.72, 0.375), (0.93, 0.327)):
        hoop = [(r - 0.015, y - 0.035), (r + 0.012, y), (r - 0.015, y + 0.035)]
        model.add("iron", lathe(hoop, 14, 80))
    return model


def door_leaf(width: float, height: float, arched: bool) -> Model:
    """One leaf, hinged at x = 0, 8 cm thick, its front at z = 0; the arch rises towards x = width."""
    steps = 10 if arched else 1
    outline = [(0.0, 0.0), (width, 0.0)]
    if arched:
        spring = height - width
        outline += [
            (
                width - width * math.sin(math.pi / 2 * k / steps),
                spring + width * math.cos(math.pi / 2 * k / steps),
            )
            for k in range(steps + 1)
        ]
    else:
        outline += [(width, height), (0.0, height)]
    front = polygon([(x, y, 0) for x, y in outline])
    rear = polygon([(x, y, -0.08) for x, y in reversed(outline)])
    edge = [
        polygon([(xb, yb, 0), (xa, ya, 0), (xa, ya, -0.08), (xb, yb, -0.08)])
        for (xa, ya), (xb, yb) in zip(outline, outline[1:] + outline[:1])
    ]
    model = Model().add("planks", front, rear, *edge)
    for y in (0.35, height * 0.36, height * 0.68 if not arched else height - width - 0.1):
        for z0, z1, skip in ((0.0, 0.018, "-z"), (-0.098, -0.08, "+z")):
            model.add("iron", box(0.03, y - 0.05, z0, width * 0.86, y + 0.05, z1, 0.006, skip))
    ring = torus(0.085, 0.012, 14, 5).transformed(
        translation(width * 0.86, 1.08, 0.035) @ rotation_x(80)
    )
    return model.add(
        "iron", ring, box(width * 0.83, 1.14, 0.0, width * 0.89, 1.22, 0.03, 0.01, "-z")
    )


def table(length: float = 2.6, width: float = 1.0) -> Model:
    half, w = length / 2, width / 2
    model = Model().add("planks", box(-half, 0.74, -w, half, 0.80, w, 0.012).scaled_uvs(1.3))
    for s in (-1, 1):
        model.add(
            "timber",
            box(
                s * (half - 0.35) - 0.06,
                0.08,
                -0.09,
                s * (half - 0.35) + 0.06,
                0.74,
                0.09,
                0.015,
                "-y +y",
            ).grain_up(),
        )
        model.add(
            "timber",
            box(
                s * (half - 0.35) - 0.08,
                0.0,
                -w + 0.12,
                s * (half - 0.35) + 0.08,
                0.08,
                w - 0.12,
                0.015,
                "-y",
            ),
        )
        model.add(
            "timber",
            box(
                s * (half - 0.35) - 0.07,
                0.66,
                -w + 0.1,
                s * (half - 0.35) + 0.07,
                0.74,
                w - 0.1,
                0.015,
                "+y",
            ),
        )
    return model.add(
        "timber", box(-half + 0.35, 0.24, -0.04, half - 0.35, 0.34, 0.04, 0.01, "-x +x")
    )


def bench(length: float = 2.2) -> Model:
    half = length / 2
    model = Model().add("timber", box(-half, 0.40, -0.17, half, 0.46, 0.17, 0.012))
    for s in (-1, 1):
        model.add(
            "timber",
            box(
                s * (half - 0.25) - 0.04,
                0.0,
                -0.15,
                s * (half - 0.25) + 0.04,
                0.40,
                0.15,
                0.012,
                "-y +y",
            ).grain_up(),
        )
    return model


def bookcase(width: float = 2.0, height: float = 3.0) -> Model:
    """Stands against a wall that faces +Z."""
    w, d = width / 2, 0.42
    model = Model()
    for s in (-1, 1):
        model.add(
            "timber",
            box(
                s * (w - 0.03) - 0.03, 0, 0, s * (w - 0.03) + 0.03, height, d, 0.008, "-z -y"
            ).grain_up(),
        )
    model.add("timber", box(-w - 0.05, height, 0, w + 0.05, height + 0.10, d + 0.05, 0.02, "-z"))
    shelves = int(height / 0.5)
    for k in range(shelves + 1):
        y = k * (height - 0.04) / shelves
        model.add("timber", box(-w + 0.06, y, 0, w - 0.06, y + 0.04, d - 0.01, 0.006, "-z -x +x"))
    pitch = (height - 0.04) / shelves
    for k in range(shelves):
        y = k * pitch + 0.04
        shift = (k * 0.37) % 1.0
        row = 0.5 * (k % 2)
        points = [
            (-w + 0.06, y, d - 0.14),
            (w - 0.06, y, d - 0.14),
            (w - 0.06, y + pitch - 0.04, d - 0.14),
            (-w + 0.06, y + pitch - 0.04, d - 0.14),
        ]
        uvs = np.array([(0, 0.5), (width - 0.12, 0.5), (width - 0.12, 0.04), (0, 0.04)]) + (
            shift,
            row,
        )
        model.add("books", polygon(points, uvs))
    return model


def fountain() -> Model:
    basin = [
        (2.0, 0.0),
        (2.0, 0.10),
        (1.9, 0.14),
        (1.82, 0.30),
        (1.86, 0.50),
        (1.98, 0.58),
        (2.02, 0.66),
        (1.98, 0.72),
        (1.74, 0.72),
        (1.68, 0.66),
        (1.66, 0.2),
    ]
    stem = [
        (0.42, 0.1),
        (0.42, 0.5),
        (0.30, 0.62),
        (0.20, 0.9),
        (0.24, 1.2),
        (0.17, 1.4),
        (0.22, 1.55),
        (0.60, 1.68),
        (0.95, 1.86),
        (1.0, 1.95),
        (0.94, 1.98),
        (0.80, 1.90),
        (0.3, 1.8),
    ]
    upper = [
        (0.16, 1.78),
        (0.14, 2.1),
        (0.10, 2.3),
        (0.20, 2.42),
        (0.46, 2.55),
        (0.50, 2.62),
        (0.44, 2.62),
        (0.15, 2.54),
    ]
    model = Model().add("trim", lathe(basin, 28), lathe(stem, 18), lathe(upper, 16))
    model.add(
        "trim",
        lathe([(0.1, 2.5), (0.07, 2.7), (0.12, 2.78), (0.04, 2.84)], 12),
    )
    model.add("crystal_ball", sphere(0.2, 16, 10).transformed(translation(0, 3.0, 0)))
    for radius, y in ((1.70, 0.56), (0.88, 1.91), (0.42, 2.59)):
        disc = lathe([(radius, y), (radius * 0.5, y + 0.001), (0.0, y + 0.001)], 32, 80)
        model.add("water", disc.with_uvs(disc.positions[:, [0, 2]]))
    return model


def armillary() -> Model:
    """Rings about a globe, on a plinth: the hall's emblem."""
    model = pedestal(1.1, 0.38)
    model.add(
        "brass",
        lathe(
            [(0.3, 1.1), (0.26, 1.16), (0.10, 1.22), (0.06, 1.42), (0.10, 1.5), (0.05, 1.54)], 16
        ),
    )
    rings = [(0.86, 0, 0), (0.82, 90, 0), (0.82, 90, 60), (0.82, 90, 120), (0.76, 23, 20)]
    for radius, tilt, turn in rings:
        m = translation(0, 2.38, 0) @ place(0, 0, 0, turn) @ rotation_x(tilt)
        model.add("brass", torus(radius, 0.03, 32, 5).transformed(m))
    model.add("brass", sphere(0.24, 20, 12).transformed(translation(0, 2.38, 0)))
    return model.add("iron", _strut((0, 1.5, 0), (0, 3.3, 0), 0.018))


def shield() -> Model:
    """A round boss on a wall that faces +Z, its centre at the origin."""
    flat = rotation_x(90)
    ring = lathe([(0.46, 0.0), (0.46, 0.05), (0.40, 0.085), (0.34, 0.05)], 20, 30)
    disc = lathe([(0.35, 0.045), (0.16, 0.085)], 20)
    boss = lathe([(0.17, 0.08), (0.15, 0.14), (0.08, 0.18), (0.0, 0.19)], 12, 60)
    model = Model().add("trim", ring.transformed(flat)).add("brass", boss.transformed(flat))
    return model.add(
        "coffer", disc.with_uvs(disc.positions[:, [0, 2]] * 0.95 + 0.5).transformed(flat)
    )


def ivy(width: float, height: float, seed: int) -> Model:
    """Hangs on a wall that faces +Z, its foot's middle at the origin; ragged at the top."""
    rng = np.random.RandomState(seed)
    columns = max(4, round(width / 0.34))
    x = np.linspace(-width / 2, width / 2, columns + 1)
    shape = np.sin(np.linspace(0.25, math.pi - 0.25, columns + 1))
    top = height * (0.12 + 0.88 * shape * rng.uniform(0.4, 1.0, columns + 1))
    model = Model()
    for layer in range(2):
        z = 0.04 + 0.07 * layer + rng.uniform(0.0, 0.05, (2, columns + 1))
        tall = top * (1.0 - 0.18 * layer)
        for k in range(columns):
            points = [(x[k], 0.0, z[0, k]), (x[k + 1], 0.0, z[0, k + 1]),
                      (x[k + 1], tall[k + 1], z[1, k + 1]), (x[k], tall[k], z[1, k])]  # fmt: skip
            uvs = np.array([(px + 0.37 * layer, -py + 0.21 * layer) for px, py, _ in points])
            for corner in ((0, 1, 2), (0, 2, 3)):
                model.add("ivy", polygon([points[c] for c in corner], uvs[list(corner)]))
    return model


def portcullis(width: float, height: float) -> Model:
    mesh = panel(width, height)
    return Model().add("grate", mesh.with_uvs(mesh.uvs * (width, height)))
