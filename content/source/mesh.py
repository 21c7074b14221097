"""Triangle meshes as numpy arrays, and the primitives the architecture is built from.

Texture coordinates are in metres here; the writer divides them by each material's tile size, so
every surface has the same texel density whatever its shape.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np


@dataclass
class Mesh:
    positions: np.ndarray  # (n, 3)
    normals: np.ndarray  # (n, 3)
    uvs: np.ndarray  # (n, 2), metres; v grows downwards as in glTF
    triangles: np.ndarray  # (m, 3), counter-clockwise seen from the front

    def transformed(self, matrix: np.ndarray) -> "Mesh":
        linear = matrix[:3, :3]
        positions = self.positions @ linear.T + matrix[:3, 3]
        normals = normalized(self.normals @ np.linalg.inv(linear))
        flip = np.linalg.det(linear) < 0
        triangles = self.triangles[:, ::-1] if flip else self.triangles
        return Mesh(positions, normals, self.uvs, triangles)

    def with_uvs(self, uvs: np.ndarray) -> "Mesh":
        return Mesh(self.positions, self.normals, uvs, self.triangles)

    def grain_up(self) -> "Mesh":
        """Turns the texture a quarter, for posts and legs."""
        return self.with_uvs(self.uvs[:, ::-1])

    def scaled_uvs(self, factor: float) -> "Mesh":
        return self.with_uvs(self.uvs * factor)

    def flipped(self) -> "Mesh":
        return Mesh(self.positions, -self.normals, self.uvs, self.triangles[:, ::-1])


class Model:
    """Meshes grouped by the material's name."""

    def __init__(self) -> None:
        self.parts: dict[str, list[Mesh]] = {}

    def add(self, material: str, *meshes: Mesh) -> "Model":
        self.parts.setdefault(material, []).extend(meshes)
        return self

    def add_model(self, other: "Model", matrix: np.ndarray | None = None) -> "Model":
        for material, meshes in other.parts.items():
            for mesh in meshes:
                self.add(material, mesh if matrix is None else mesh.transformed(matrix))
        return self

    def merged(self) -> dict[str, Mesh]:
        return {name: merge(meshes) for name, meshes in self.parts.items()}


# ------------------------------------------------------------------------------------ transforms


def translation(x: float, y: float, z: float) -> np.ndarray:
    matrix = np.eye(4)
    matrix[:3, 3] = (x, y, z)
    return matrix


def rotation_y(degrees: float) -> np.ndarray:
    c, s = _cos_sin(degrees)
    return np.array([[c, 0, s, 0], [0, 1, 0, 0], [-s, 0, c, 0], [0, 0, 0, 1]], float)


def rotation_x(degrees: float) -> np.ndarray:
    c, s = _cos_sin(degrees)
    return np.array([[1, 0, 0, 0], [0, c, -s, 0], [0, s, c, 0], [0, 0, 0, 1]], float)


def rotation_z(degrees: float) -> np.ndarray:
    c, s = _cos_sin(degrees)
    return np.array([[c, -s, 0, 0], [s, c, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]], float)


def scaling(x: float, y: float, z: float) -> np.ndarray:
    return np.diag([x, y, z, 1.0])


MIRROR_X = scaling(-1, 1, 1)
MIRROR_Z = scaling(1, 1, -1)


def place(x: float, y: float, z: float, yaw: float = 0.0) -> np.ndarray:
    return translation(x, y, z) @ rotation_y(yaw)


def _cos_sin(degrees: float) -> tuple[float, float]:
    # Quarter turns are exact, so that neighbouring walls share their corners to the bit.
    quarter = {0: (1.0, 0.0), 90: (0.0, 1.0), 180: (-1.0, 0.0), 270: (0.0, -1.0)}
    if degrees % 360 in quarter:
        return quarter[degrees % 360]
    angle = math.radians(degrees)
    return math.cos(angle), math.sin(angle)


# --------------------------------------------------------------------------------------- helpers


def normalized(vectors: np.ndarray) -> np.ndarray:
    length = np.linalg.norm(vectors, axis=-1, keepdims=True)
    return vectors / np.maximum(length, 1e-20)


def merge(meshes: list[Mesh]) -> Mesh:
    offsets = np.cumsum([0] + [len(mesh.positions) for mesh in meshes])
    return Mesh(
        np.concatenate([mesh.positions for mesh in meshes]),
        np.concatenate([mesh.normals for mesh in meshes]),
        np.concatenate([mesh.uvs for mesh in meshes]),
        np.concatenate([mesh.triangles + offset for mesh, offset in zip(meshes, offsets)]),
    )


def drop_degenerate(mesh: Mesh) -> Mesh:
    a, b, c = (mesh.positions[mesh.triangles[:, k]] for k in range(3))
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    return Mesh(mesh.positions, mesh.normals, mesh.uvs, mesh.triangles[area > 1e-8])


def box_uv(points: np.ndarray, normal: np.ndarray) -> np.ndarray:
    """Projects along the dominant axis of the normal; u runs to the viewer's right."""
    x, y, z = points[:, 0], points[:, 1], points[:, 2]
    axis = int(np.argmax(np.abs(normal) + (0.02, 0.0, 0.01)))
    if axis == 0:
        return np.stack([-z if normal[0] > 0 else z, -y], axis=1)
    if axis == 1:
        return np.stack([x, z if normal[1] > 0 else -z], axis=1)
    return np.stack([x if normal[2] > 0 else -x, -y], axis=1)


def polygon(points: list, uvs: np.ndarray | None = None) -> Mesh:
    """A flat convex polygon, counter-clockwise from the front."""
    p = np.array(points, float)
    normal = np.zeros(3)
    for k in range(len(p)):
        normal += np.cross(p[k], p[(k + 1) % len(p)])
    normal = normal / np.linalg.norm(normal)
    fan = [(0, k, k + 1) for k in range(1, len(p) - 1)]
    uvs = box_uv(p, normal) if uvs is None else np.array(uvs, float)
    return Mesh(p, np.tile(normal, (len(p), 1)), uvs, np.array(fan))


UNIT_UVS = np.array([[0, 1], [1, 1], [1, 0], [0, 0]], float)


def panel(width: float, height: float) -> Mesh:
    """Faces +Z, its foot's centre at the origin, the whole texture once."""
    w = width / 2
    return polygon([(-w, 0, 0), (w, 0, 0), (w, height, 0), (-w, height, 0)], UNIT_UVS)


def floor(x0: float, z0: float, x1: float, z1: float, y: float) -> Mesh:
    return polygon([(x0, y, z1), (x1, y, z1), (x1, y, z0), (x0, y, z0)])


def ceiling(x0: float, z0: float, x1: float, z1: float, y: float) -> Mesh:
    return polygon([(x0, y, z0), (x1, y, z0), (x1, y, z1), (x0, y, z1)])


# ------------------------------------------------------------------------------- bevelled blocks

_FACES = {  # corner numbers have bit 0 for +x, bit 1 for +y, bit 2 for +z
    "-x": (0, 4, 6, 2),
    "+x": (5, 1, 3, 7),
    "-y": (0, 1, 5, 4),
    "+y": (6, 7, 3, 2),
    "-z": (1, 0, 2, 3),
    "+z": (4, 5, 7, 6),
}


def block(corners: np.ndarray, bevel: float = 0.02, skip: str = "") -> Mesh:
    """A hexahedron whose edges are cut and shaded round. `skip` names faces that nobody sees."""
    corners = np.array(corners, float)
    skipped = set(skip.split())
    inset: dict[tuple[str, int], np.ndarray] = {}
    normals: dict[str, np.ndarray] = {}
    meshes = []
    for name, loop in _FACES.items():
        p = corners[list(loop)]
        normal = np.cross(p[2] - p[0], p[3] - p[1])
        normals[name] = normal / np.linalg.norm(normal)
        for k in range(4):
            here = p[k]
            ahead = p[(k + 1) % 4] - here
            behind = p[k - 1] - here
            inset[name, loop[k]] = here + bevel * (
                ahead / np.linalg.norm(ahead) + behind / np.linalg.norm(behind)
            )
        if name not in skipped:
            points = [inset[name, corner] for corner in loop] if bevel > 0 else list(p)
            meshes.append(polygon(points))
    if bevel > 0:
        meshes.extend(_bevels(inset, normals, skipped))
    return merge(meshes)


def _bevels(inset: dict, normals: dict, skipped: set) -> list[Mesh]:
    meshes = []
    names = list(_FACES)
    for i, first in enumerate(names):
        for second in names[i + 1 :]:
            if first[1] == second[1] or first in skipped or second in skipped:
                continue
            shared = [c for c in _FACES[first] if c in _FACES[second]]
            loop = _FACES[first]
            a, b = shared
            if loop[(loop.index(a) + 1) % 4] != b:
                a, b = b, a
            points = [inset[first, b], inset[first, a], inset[second, a], inset[second, b]]
            meshes.append(_rounded(points, [normals[n] for n in (first, first, second, second)]))
    for corner in range(8):
        around = [name for name in names if corner in _FACES[name]]
        if any(name in skipped for name in around):
            continue
        points = [inset[name, corner] for name in around]
        face = np.cross(points[1] - points[0], points[2] - points[0])
        if face @ sum(normals[name] for name in around) < 0:
            points.reverse()
            around.reverse()
        meshes.append(_rounded(points, [normals[name] for name in around]))
    return meshes


def _rounded(points: list, normals: list) -> Mesh:
    flat = polygon(points)
    return Mesh(
        flat.positions, np.array(normals), box_uv(flat.positions, normals[0]), flat.triangles
    )


def box(x0, y0, z0, x1, y1, z1, bevel: float = 0.02, skip: str = "") -> Mesh:
    corners = [(x1 if k & 1 else x0, y1 if k & 2 else y0, z1 if k & 4 else z0) for k in range(8)]
    return block(np.array(corners, float), bevel, skip)


def hewn(corners: np.ndarray, chamfer: float = 0.02) -> Mesh:
    """A stone set in a wall: its sides slope to a smaller +z face, and its back is not there."""
    corners = np.array(corners, float)
    face = corners[list(_FACES["+z"])]
    for k, corner in enumerate(_FACES["+z"]):
        ahead, behind = face[(k + 1) % 4] - face[k], face[k - 1] - face[k]
        corners[corner] = face[k] + chamfer * (
            ahead / np.linalg.norm(ahead) + behind / np.linalg.norm(behind)
        )
    return block(corners, 0.0, "-z")


def hewn_box(x0, y0, z0, x1, y1, z1, chamfer: float = 0.02) -> Mesh:
    corners = [(x1 if k & 1 else x0, y1 if k & 2 else y0, z1 if k & 4 else z0) for k in range(8)]
    return hewn(np.array(corners, float), chamfer)


# --------------------------------------------------------------------------- turned and swept parts


def _profile_normals(
    profile: np.ndarray, crease: float
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Splits a profile at its creases: the points, their normals, and the start of each piece."""
    steps = np.diff(profile, axis=0)
    lengths = np.linalg.norm(steps, axis=1)
    facing = np.stack([steps[:, 1], -steps[:, 0]], axis=1) / lengths[:, None]
    limit = math.cos(math.radians(crease))
    points, normals, joined = [profile[0]], [facing[0]], []
    for k in range(1, len(profile) - 1):
        if facing[k - 1] @ facing[k] < limit:
            points += [profile[k], profile[k]]
            normals += [facing[k - 1], facing[k]]
            joined += [True, False]
        else:
            points.append(profile[k])
            normals.append(normalized(facing[k - 1] + facing[k]))
            joined.append(True)
    points.append(profile[-1])
    normals.append(facing[-1])
    joined.append(True)
    return np.array(points), np.array(normals), np.array(joined)


def lathe(profile: list, segments: int = 16, crease: float = 40.0) -> Mesh:
    """Turns a profile of (radius, height), listed from the foot up, about the Y axis."""
    points, flat, joined = _profile_normals(np.array(profile, float), crease)
    angle = np.arange(segments + 1) * (2 * math.pi / segments)
    cos, sin = np.cos(angle), np.sin(angle)
    cos[-1], sin[-1] = cos[0], sin[0]
    r, y = points[:, :1], points[:, 1:]
    positions = np.stack([r * cos, np.repeat(y, segments + 1, 1), r * -sin], axis=2)
    nr, ny = flat[:, :1], flat[:, 1:]
    normals = np.stack([nr * cos, np.repeat(ny, segments + 1, 1), nr * -sin], axis=2)
    around = float(np.max(points[:, 0])) * angle
    along = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))])
    uvs = np.stack(np.broadcast_arrays(around[None, :], -along[:, None]), axis=2)
    return _grid(positions, normals, uvs, joined)


def _grid(positions, normals, uvs, joined=None) -> Mesh:
    """Rows go up, columns go to the right seen from the front."""
    rows, columns = positions.shape[:2]
    triangles = []
    for i in range(rows - 1):
        if joined is not None and not joined[i]:
            continue
        for j in range(columns - 1):
            a, b = i * columns + j, i * columns + j + 1
            c, d = b + columns, a + columns
            triangles += [(a, b, c), (a, c, d)]
    mesh = Mesh(
        positions.reshape(-1, 3),
        normalized(normals.reshape(-1, 3)),
        uvs.reshape(-1, 2),
        np.array(triangles),
    )
    return drop_degenerate(mesh)


def surface(positions: np.ndarray, uvs: np.ndarray) -> Mesh:
    """A smooth grid of points, its normals from central differences; open at its borders."""
    du = np.gradient(positions, axis=1)
    dv = np.gradient(positions, axis=0)
    return _grid(positions, np.cross(du, dv), uvs)


def closed_surface(positions: np.ndarray, uvs: np.ndarray) -> Mesh:
    """Like surface(), but the first and the last column are the same seam."""
    wrapped = np.concatenate([positions[:, -2:-1], positions, positions[:, 1:2]], axis=1)
    du = (wrapped[:, 2:] - wrapped[:, :-2]) / 2
    dv = np.gradient(positions, axis=0)
    return _grid(positions, np.cross(du, dv), uvs)


def extrude(profile: list, length: float, crease: float = 40.0) -> Mesh:
    """Sweeps a profile of (out, up) along +X: a moulding on a wall that faces +Z."""
    points, flat, joined = _profile_normals(np.array(profile, float), crease)
    count = len(points)
    ends = np.array([0.0, length])
    positions = np.zeros((count, 2, 3))
    positions[:, :, 0] = ends
    positions[:, :, 1] = points[:, 1:]
    positions[:, :, 2] = points[:, :1]
    normals = np.zeros((count, 2, 3))
    normals[:, :, 1] = flat[:, 1:]
    normals[:, :, 2] = flat[:, :1]
    along = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))])
    uvs = np.stack(np.broadcast_arrays(ends[None, :], -along[:, None]), axis=2)
    return _grid(positions, normals, uvs, joined)


def torus(radius: float, thickness: float, segments: int = 24, sides: int = 6) -> Mesh:
    """A ring about the Y axis."""
    profile = [
        (radius + thickness * math.cos(a), thickness * math.sin(a))
        for a in (2 * math.pi * (k / sides) - math.pi / 2 for k in range(sides + 1))
    ]
    return lathe(profile, segments, 80)


def sphere(radius: float, segments: int = 20, rings: int = 12) -> Mesh:
    profile = [
        (radius * math.sin(math.pi * k / rings), -radius * math.cos(math.pi * k / rings))
        for k in range(rings + 1)
    ]
    profile[0], profile[-1] = (0.0, -radius), (0.0, radius)
    return lathe(profile, segments, 80)


def cylinder(radius: float, height: float, segments: int = 10, top: float | None = None) -> Mesh:
    end = radius if top is None else top
    return lathe([(0, 0), (radius, 0), (end, height), (0, height)], segments, 40)
