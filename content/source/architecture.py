"""Walls with openings, arches, columns, stairs, balustrades and vaults, in local frames.

A wall's frame: x runs along it, y goes up, and the front faces +Z at z = 0.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from .mesh import (
    UNIT_UVS,
    Mesh,
    Model,
    block,
    box,
    closed_surface,
    extrude,
    hewn,
    lathe,
    merge,
    normalized,
    place,
    polygon,
    sphere,
    translation,
)

ARCH_STEPS = 14


@dataclass
class Opening:
    x0: float
    x1: float
    y0: float
    spring: float  # where the arch begins, or the flat head
    arched: bool = True

    @property
    def radius(self) -> float:
        return (self.x1 - self.x0) / 2 if self.arched else 0.0

    def edges(self) -> list[float]:
        if not self.arched:
            return [self.x0, self.x1]
        return [x for x, _ in self.curve()]

    def curve(self) -> list[tuple[float, float]]:
        """The head from left to right."""
        if not self.arched:
            return [(self.x0, self.spring), (self.x1, self.spring)]
        middle = (self.x0 + self.x1) / 2
        points = []
        for k in range(ARCH_STEPS + 1):
            a = math.pi * (1 - k / ARCH_STEPS)
            points.append(
                (middle + self.radius * math.cos(a), self.spring + self.radius * math.sin(a))
            )
        points[0], points[-1] = (self.x0, self.spring), (self.x1, self.spring)
        return points

    def head(self, x: float) -> float:
        xs, ys = zip(*self.curve())
        return float(np.interp(x, xs, ys))


def wall(
    length: float,
    height: float,
    thickness: float,
    openings: list[Opening] = (),
    material: str = "ashlar",
    reveal: str = "trim",
    back: str | None = "same",
    vault: Opening | None = None,
) -> Model:
    """`back` names the rear face's material; None leaves it out. Under a vault the wall ends in
    its curve there."""
    model = Model()
    cuts = {round(x, 6) for o in openings for x in o.edges()} | {0.0, length}
    if vault:
        cuts |= {round(x, 6) for x in vault.edges()}
    cuts = sorted(cuts)
    front = []
    for x0, x1 in zip(cuts, cuts[1:]):
        middle = (x0 + x1) / 2
        low0 = low1 = 0.0
        through = sorted((o for o in openings if o.x0 < middle < o.x1), key=lambda o: o.y0)
        for o in through:
            if o.y0 > low0 + 1e-6:
                front.append(polygon([(x0, low0, 0), (x1, low1, 0), (x1, o.y0, 0), (x0, o.y0, 0)]))
            low0, low1 = o.head(x0), o.head(x1)
        high0 = high1 = height
        if vault and vault.x0 < middle < vault.x1:
            high0, high1 = vault.head(x0), vault.head(x1)
        front.append(polygon([(x0, low0, 0), (x1, low1, 0), (x1, high1, 0), (x0, high0, 0)]))
    model.add(material, *front)
    if back:
        turned = place(length, 0, -thickness, 180)
        mirrored = wall(
            length,
            height,
            thickness,
            [_mirrored(o, length) for o in openings],
            material,
            reveal,
            None,
        )
        model.add(
            material if back == "same" else back,
            *(m.transformed(turned) for m in mirrored.parts[material]),
        )
    for o in openings:
        model.add(reveal, *_reveal(o, thickness))
    return model


def _mirrored(o: Opening, length: float) -> Opening:
    return Opening(length - o.x1, length - o.x0, o.y0, o.spring, o.arched)


def _reveal(o: Opening, t: float) -> list[Mesh]:
    meshes = []
    if o.spring > o.y0 + 1e-6:
        meshes.append(
            polygon([(o.x0, o.y0, 0), (o.x0, o.y0, -t), (o.x0, o.spring, -t), (o.x0, o.spring, 0)])
        )
        meshes.append(
            polygon([(o.x1, o.y0, -t), (o.x1, o.y0, 0), (o.x1, o.spring, 0), (o.x1, o.spring, -t)])
        )
    if o.y0 > 0.01:
        meshes.append(
            polygon([(o.x0, o.y0, 0), (o.x1, o.y0, 0), (o.x1, o.y0, -t), (o.x0, o.y0, -t)])
        )
    curve = np.array(o.curve())
    count = len(curve)
    positions = np.zeros((2, count, 3))
    positions[:, :, :2] = curve
    positions[0, :, 2] = -t
    along = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(curve, axis=0), axis=1))])
    uvs = np.zeros((2, count, 2))
    uvs[:, :, 0] = along
    uvs[0, :, 1] = t
    normals = np.zeros((2, count, 3))
    normals[:, :, 1] = -1.0
    if o.arched:
        centre = ((o.x0 + o.x1) / 2, o.spring)
        normals[:, :, :2] = (np.array(centre) - curve) / o.radius
    triangles = []
    for k in range(count - 1):
        a, b, c, d = k, k + 1, count + k + 1, count + k
        triangles += [(a, b, c), (a, c, d)]
    mesh = Mesh(
        positions.reshape(-1, 3),
        normalized(normals.reshape(-1, 3)),
        uvs.reshape(-1, 2),
        np.array(triangles),
    )
    p = mesh.positions[mesh.triangles[0]]
    facing = np.cross(p[1] - p[0], p[2] - p[0]) @ mesh.normals[0]
    if facing < 0:
        mesh.triangles = mesh.triangles[:, ::-1]
    meshes.append(mesh)
    return meshes


def archivolt(radius: float, width: float = 0.32, proud: float = 0.06, stones: int = 11) -> Mesh:
    """A ring of voussoirs with a keystone, on a wall's front, its centre at the origin."""
    meshes = []
    for k in range(stones):
        key = k == stones // 2
        grow, out = (0.10, 0.05) if key else (0.0, 0.0)
        a0, a1 = math.pi * (1 - k / stones), math.pi * (1 - (k + 1) / stones)
        corners = []
        for bits in range(8):
            a = a1 if bits & 1 else a0
            r = radius + width + grow if bits & 2 else radius
            z = proud + out if bits & 4 else 0.0
            corners.append((r * math.cos(a), r * math.sin(a), z))
        meshes.append(hewn(np.array(corners), 0.028))
    return merge(meshes)


def tube_about(o: Opening, distance: float, thickness: float = 0.035, sides: int = 6) -> Mesh:
    """A tube so far about an opening, from foot to foot, 0.12 m before the wall."""
    middle, radius = (o.x0 + o.x1) / 2, o.radius + distance
    turns = [(math.cos(math.pi * k / 20), math.sin(math.pi * k / 20)) for k in range(21)]
    path = [(middle + radius * c, o.spring + radius * s) for c, s in turns]
    path = [(middle + radius, 0.25), *path, (middle - radius, 0.25)]
    out = [(1.0, 0.0), *turns, (-1.0, 0.0)]
    around = [2 * math.pi * (j % sides) / sides for j in range(sides + 1)]
    positions = np.array(
        [
            [
                (
                    x + thickness * math.cos(t) * c,
                    y + thickness * math.cos(t) * s,
                    0.12 - thickness * math.sin(t),
                )
                for t in around
            ]
            for (x, y), (c, s) in zip(path, out)
        ]
    )
    return closed_surface(positions, np.zeros((*positions.shape[:2], 2)))


def arched_pane(o: Opening, depth: float, unit: bool) -> Mesh:
    """Fills an opening; `unit` stretches the texture once over its bounds."""
    curve = o.curve()
    outline = [(o.x0, o.y0), (o.x1, o.y0)] + curve[::-1]
    points = [
        (x, y, -depth) for x, y in dict.fromkeys((round(x, 7), round(y, 7)) for x, y in outline)
    ]
    uvs = None
    if unit:
        top = o.spring + o.radius
        uvs = [((x - o.x0) / (o.x1 - o.x0), (top - y) / (top - o.y0)) for x, y, _ in points]
    middle = ((o.x0 + o.x1) / 2, o.spring, -depth)
    mesh = polygon(points, uvs)
    hub_uv = [[0.5, o.radius / (o.spring + o.radius - o.y0)]] if unit else [[middle[0], -middle[1]]]
    count = len(points)
    return Mesh(
        np.concatenate([mesh.positions, [middle]]),
        np.concatenate([mesh.normals, mesh.normals[:1]]),
        np.concatenate([mesh.uvs, hub_uv]),
        np.array([(count, k, (k + 1) % count) for k in range(count)]),
    )


# -------------------------------------------------------------------------------------- columns


def fluted_shaft(foot: float, top: float, height: float, flutes: int = 12) -> Mesh:
    """Half-round flutes; the radius swells a little on the way up."""
    columns = flutes * 2 + 1
    angle = np.arange(columns) * (2 * math.pi / (columns - 1))
    dent = np.array([0.0, 0.11])[np.arange(columns) % 2]
    fade = np.array([0.1, 1, 1, 0.1])
    t = np.array([0, 0.05, 0.95, 1.0])
    radius = foot + (top - foot) * t + 0.012 * np.sin(math.pi * t)
    r = radius[:, None] * (1 - dent[None, :] * fade[:, None])
    positions = np.stack(
        [r * np.cos(angle), np.repeat(t[:, None] * height, columns, 1), -r * np.sin(angle)], 2
    )
    positions[:, -1] = positions[:, 0]
    uvs = np.stack(np.broadcast_arrays(angle[None, :] * foot, -(t * height)[:, None]), 2)
    return closed_surface(positions, uvs)


def capital(foot: float, top: float, height: float, leaves: int = 8) -> Mesh:
    """A bell with two tiers of curling leaves."""
    columns = leaves * 2 + 1
    angle = np.arange(columns) * (2 * math.pi / (columns - 1))
    t = np.array([0.0, 0.24, 0.42, 0.48, 0.72, 0.92, 1.0])
    bell = foot + (top - foot) * t**2.2
    lower = np.array([0, 0.12, 0.32, 0.04, 0, 0, 0])
    upper = np.array([0, 0, 0, 0.02, 0.16, 0.28, 0.02])
    lobe = 0.5 + 0.5 * np.cos(leaves * angle)
    other = 0.5 - 0.5 * np.cos(leaves * angle)
    r = bell[:, None] * (1 + lower[:, None] * lobe + upper[:, None] * other)
    positions = np.stack(
        [r * np.cos(angle), np.repeat(t[:, None] * height, columns, 1), -r * np.sin(angle)], 2
    )
    positions[:, -1] = positions[:, 0]
    uvs = np.stack(np.broadcast_arrays(angle[None, :] * top, -(t * height)[:, None]), 2)
    return closed_surface(positions, uvs)


def plain_shaft(foot: float, top: float, height: float) -> Mesh:
    middle = (foot + top) / 2 + 0.008
    return lathe([(foot, 0.0), (middle, height * 0.5), (top, height)], 14)


def column(
    height: float, radius: float, abacus: float = 0.43, plinth: float = 0.45, fluted: bool = True
) -> Model:
    r = radius
    base_height, cap_height, abacus_height, plinth_height = (
        0.26 * r / 0.3,
        0.52 * r / 0.3,
        0.14,
        0.18,
    )
    base = [
        (r * 1.42, 0.0), (r * 1.52, base_height * 0.22), (r * 1.42, base_height * 0.45),
        (r * 1.22, base_height * 0.52), (r * 1.20, base_height * 0.66), (r * 1.30, base_height * 0.80),
        (r * 1.02, base_height),
    ]  # fmt: skip
    shaft = height - plinth_height - base_height - cap_height - abacus_height
    y = plinth_height + base_height
    neck = [(r * 0.86, -0.05), (r * 0.96, -0.015), (r * 0.86, 0.02)]
    turned = fluted_shaft if fluted else plain_shaft
    return Model().add(
        "trim",
        box(-plinth, 0, -plinth, plinth, plinth_height, plinth, 0.03, "-y"),
        lathe(base, 14 if fluted else 11).transformed(translation(0, plinth_height, 0)),
        turned(r, r * 0.86, shaft).transformed(translation(0, y, 0)),
        lathe(neck, 14 if fluted else 11, 30).transformed(translation(0, y + shaft, 0)),
        capital(r * 0.84, abacus * 0.92, cap_height).transformed(translation(0, y + shaft, 0)),
        box(-abacus, height - abacus_height, -abacus, abacus, height, abacus, 0.025),
    )


def pedestal(height: float = 1.0, half: float = 0.36) -> Model:
    cap = half + 0.05
    return Model().add(
        "trim",
        box(-cap, 0, -cap, cap, 0.14, cap, 0.025, "-y"),
        box(-half, 0.14, -half, half, height - 0.12, half, 0.0, "-y +y"),
        box(-cap, height - 0.12, -cap, cap, height, cap, 0.025),
    )


def newel(height: float = 1.15) -> Model:
    return pedestal(height, 0.19).add(
        "trim", sphere(0.17, 10, 6).transformed(translation(0, height + 0.14, 0))
    )


# ---------------------------------------------------------------------------- balustrades, stairs


def baluster(height: float) -> Mesh:
    profile = [(0.052, 0), (0.042, 0.07), (0.070, 0.28), (0.028, 0.68), (0.058, 1.0)]
    return lathe([(r, y * height) for r, y in profile], 6, 60)


def _bar(length: float, rise: float, y0: float, y1: float, half: float, bevel: float) -> Mesh:
    corners = []
    for bits in range(8):
        x = length if bits & 1 else 0.0
        y = (y1 if bits & 2 else y0) + (rise if bits & 1 else 0.0)
        corners.append((x, y, half if bits & 4 else -half))
    return block(np.array(corners), bevel)


def balustrade(length: float, rise: float = 0.0, spacing: float = 0.35) -> Model:
    """Along +X from the origin, 1 m high; with a rise it follows a stair."""
    curb = 0.16
    model = Model().add("trim", _bar(length, rise, 0.88, 1.0, 0.11, 0.03))
    model.add("trim", _bar(length, rise, -0.12 if rise else 0.0, curb, 0.10, 0.02))
    count = max(1, round(length / spacing))
    turned = baluster(0.88 - curb + (0.06 if rise else 0.0))
    for k in range(count):
        t = (k + 0.5) / count
        model.add(
            "trim",
            turned.transformed(translation(t * length, curb + t * rise - (0.03 if rise else 0), 0)),
        )
    return model


def stair(steps: int, rise: float, going: float, width: float, bevel: float = 0.012) -> Model:
    """Climbs along +X from the origin, solid down to y = 0; z runs from 0 to -width."""
    model = Model()
    for k in range(steps):
        x0, x1 = k * going, (k + 1) * going
        top = (k + 1) * rise
        # The nosing juts out over the step below.
        under = top - 0.05
        model.add("trim", box(x0 - 0.025, under, -width, x1, top, 0, bevel, "+x"))
        model.add(
            "ashlar",
            polygon(
                [(x0, k * rise, -width), (x0, k * rise, 0), (x0, under, 0), (x0, under, -width)]
            ),
        )
        model.add("ashlar", polygon([(x0, 0, 0), (x1, 0, 0), (x1, under, 0), (x0, under, 0)]))
        model.add(
            "ashlar",
            polygon([(x1, 0, -width), (x0, 0, -width), (x0, under, -width), (x1, under, -width)]),
        )
    return model


def stair_path(steps: int, rise: float, going: float, before: float, after: float) -> list:
    """Where a carpet lies: along the floor, over the nosings, and on along the landing."""
    path = [(-before, 0.0)]
    for k in range(steps):
        path += [(k * going - 0.026, k * rise), (k * going - 0.026, (k + 1) * rise)]
    return path + [(steps * going + after, steps * rise)]


def runner(path: list[tuple[float, float]], width: float, lift: float = 0.012) -> Mesh:
    """A carpet along a path of (x, y), climbing +X, its middle at z = 0."""
    points = np.array(path, float)
    steps = np.diff(points, axis=0)
    lengths = np.linalg.norm(steps, axis=1)
    normals = np.stack([-steps[:, 1], steps[:, 0]], axis=1) / lengths[:, None]
    lifted = points.copy()
    for k in range(len(points)):
        around = normals[max(k - 1, 0) : k + 1]
        offset = (
            around.sum(axis=0)
            if len(around) == 2 and abs(around[0] @ around[1]) < 0.5
            else around[0]
        )
        lifted[k] += lift * offset
    v = np.concatenate([[0], np.cumsum(lengths)]) / width
    meshes = []
    for k in range(len(points) - 1):
        (xa, ya), (xb, yb) = lifted[k], lifted[k + 1]
        corners = [
            (xa, ya, width / 2),
            (xb, yb, width / 2),
            (xb, yb, -width / 2),
            (xa, ya, -width / 2),
        ]
        uvs = [(1, -v[k]), (1, -v[k + 1]), (0, -v[k + 1]), (0, -v[k])]
        meshes.append(polygon(corners, np.array(uvs)))
    return merge(meshes)


def cornice(length: float, scale: float = 1.0) -> Mesh:
    """A moulding, its top at y = 0, that juts out towards +Z."""
    profile = [(0.0, -0.34), (0.05, -0.34), (0.05, -0.27), (0.08, -0.25), (0.13, -0.17), (0.21, -0.13),
               (0.21, -0.10), (0.26, -0.10), (0.28, -0.06), (0.28, 0.0), (0.0, 0.0)]  # fmt: skip
    return extrude([(z * scale, y * scale) for z, y in profile], length, 30)


def skirting(length: float, height: float = 0.3) -> Mesh:
    profile = [
        (0.07, 0.0),
        (0.07, height * 0.7),
        (0.045, height * 0.8),
        (0.03, height),
        (0.0, height),
    ]
    return extrude(profile, length, 30)


def coffered_vault(radius: float, length: float, across: int, along: int) -> Model:
    """A barrel along -Z from z = 0, springing at y = 0; each coffer has two steps and a panel."""
    model = Model()

    def point(a: float, z: float, r: float) -> np.ndarray:
        return np.array((-r * math.cos(a), r * math.sin(a), z))

    def quad(material: str, corners: list, smooth: bool) -> None:
        points = [point(*c) for c in corners]
        uvs = [(-c[1], radius * c[0]) for c in corners]
        mesh = polygon(points, np.array(uvs))
        if smooth:
            mesh.normals = np.array([(math.cos(c[0]), -math.sin(c[0]), 0.0) for c in corners])
        model.add(material, mesh)

    da, dz = math.pi / across, length / along
    rib_a, rib_z = 0.15 / radius, 0.15
    step_a, step_z = 0.09 / radius, 0.09
    for i in range(across):
        for k in range(along):
            frames = []
            for m in range(3):
                a = rib_a * (m > 0) + step_a * (m > 1)
                z = rib_z * (m > 0) + step_z * (m > 1)
                frames.append((i * da + a, (i + 1) * da - a, -k * dz - z, -(k + 1) * dz + z))
            outer, middle, inner = frames
            r1, r2 = radius + 0.15, radius + 0.30
            _ring(quad, outer, middle, radius, radius, True)
            _ring(quad, middle, middle, radius, r1, False)
            _ring(quad, middle, inner, r1, r1, False)
            _ring(quad, inner, inner, r1, r2, False)
            a0, a1, z0, z1 = inner
            corners = [point(a0, z0, r2), point(a0, z1, r2), point(a1, z1, r2), point(a1, z0, r2)]
            model.add("coffer", polygon(corners, UNIT_UVS))
    return model


def _ring(quad, a, b, ra: float, rb: float, smooth: bool) -> None:
    """Four quads from the rectangle a at radius ra to the rectangle b at radius rb."""

    def loop(f, r):
        return [(f[0], f[2], r), (f[0], f[3], r), (f[1], f[3], r), (f[1], f[2], r)]

    outer, inner = loop(a, ra), loop(b, rb)
    for k in range(4):
        j = (k + 1) % 4
        quad("trim", [outer[k], outer[j], inner[j], inner[k]], smooth)


def rib(radius: float, width: float, depth: float, steps: int = 24) -> Mesh:
    """A flat arch band under a barrel along Z, centred on z = 0."""
    inner = radius - depth
    meshes = []
    half = width / 2
    for k in range(steps):
        a0, a1 = math.pi * k / steps, math.pi * (k + 1) / steps

        def p(a, r, z):
            return (-r * math.cos(a), r * math.sin(a), z)

        loop = [(a0, half), (a0, -half), (a1, -half), (a1, half)]
        uvs = np.array([(z, inner * a) for a, z in loop])
        under = polygon([p(a, inner, z) for a, z in loop], uvs)
        n0, n1 = (math.cos(a0), -math.sin(a0), 0), (math.cos(a1), -math.sin(a1), 0)
        under.normals = np.array([n0, n0, n1, n1], float)
        meshes.append(under)
        meshes.append(
            polygon(
                [p(a0, radius, half), p(a0, inner, half), p(a1, inner, half), p(a1, radius, half)]
            )
        )
        meshes.append(
            polygon(
                [
                    p(a0, inner, -half),
                    p(a0, radius, -half),
                    p(a1, radius, -half),
                    p(a1, inner, -half),
                ]
            )
        )
    return merge(meshes)
