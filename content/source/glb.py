"""Writes a scene as binary glTF 2.0."""

from __future__ import annotations

import json
import math
import struct

import numpy as np

from . import textures
from .materials import MATERIALS, Material
from .mesh import Mesh, normalized
from .scene import Scene

FLOAT, USHORT, UINT = 5126, 5123, 5125
TRIANGLE_MIN_AREA = 1e-8


def tangents(mesh: Mesh) -> np.ndarray:
    """Per-vertex tangents; w makes cross(normal, tangent) * w point up in the image."""
    p, uv, t = mesh.positions, mesh.uvs, mesh.triangles
    e1, e2 = p[t[:, 1]] - p[t[:, 0]], p[t[:, 2]] - p[t[:, 0]]
    d1, d2 = uv[t[:, 1]] - uv[t[:, 0]], uv[t[:, 2]] - uv[t[:, 0]]
    det = d1[:, 0] * d2[:, 1] - d2[:, 0] * d1[:, 1]
    det = np.where(np.abs(det) < 1e-12, 1e-12, det)[:, None]
    du = (e1 * d2[:, 1:] - e2 * d1[:, 1:]) / det
    dv = (e2 * d1[:, :1] - e1 * d2[:, :1]) / det
    tangent, down = np.zeros_like(p), np.zeros_like(p)
    for k in range(3):
        np.add.at(tangent, t[:, k], normalized(du))
        np.add.at(down, t[:, k], normalized(dv))
    n = mesh.normals
    tangent -= n * np.sum(n * tangent, axis=1, keepdims=True)
    lost = np.linalg.norm(tangent, axis=1) < 1e-6
    other = np.where(np.abs(n[:, :1]) < 0.9, [[1.0, 0, 0]], [[0, 0, 1.0]])
    tangent[lost] = np.cross(n, other)[lost]
    tangent = normalized(tangent)
    up = np.sum(np.cross(n, tangent) * -down, axis=1)
    return np.concatenate([tangent, np.where(up < 0, -1.0, 1.0)[:, None]], axis=1)


def check(name: str, mesh: Mesh) -> None:
    assert np.isfinite(mesh.positions).all(), name
    assert mesh.triangles.min() >= 0 and mesh.triangles.max() < len(mesh.positions), name
    length = np.linalg.norm(mesh.normals, axis=1)
    assert np.abs(length - 1).max() < 1e-3, f"{name}: a normal is not of unit length"
    a, b, c = (mesh.positions.astype(np.float32)[mesh.triangles[:, k]] for k in range(3))
    face = np.cross(b - a, c - a)
    assert np.linalg.norm(face, axis=1).min() > TRIANGLE_MIN_AREA, f"{name}: degenerate triangle"
    agree = np.sum(face * mesh.normals[mesh.triangles].sum(axis=1), axis=1)
    assert (
        agree > 0
    ).all(), f"{name}: {int((agree <= 0).sum())} triangles face away from their normals"


class Writer:
    def __init__(self, scene: Scene, name: str = "hall") -> None:
        self.scene = scene
        self.name = name
        self.blob = bytearray()
        self.views: list[dict] = []
        self.accessors: list[dict] = []
        self.images: list[dict] = []
        self.textures: list[dict] = []
        self.materials: list[dict] = []
        self.used: set[str] = set()  # extensions of materials
        self.meshes: list[dict] = []
        self.mesh_numbers: dict[str, int] = {}
        self.triangles: dict[str, int] = {}
        self.nodes: list[dict] = []
        used = {name for model in scene.all_models() for name in model.parts}
        self.defined = [material for material in MATERIALS if material.name in used]
        missing = used - {material.name for material in self.defined}
        assert not missing, f"undefined materials: {sorted(missing)}"
        self.material_numbers = {m.name: k for k, m in enumerate(self.defined)}

    def view(self, data: bytes, target: int | None = None) -> int:
        self.blob.extend(b"\0" * (-len(self.blob) % 4))
        entry = {"buffer": 0, "byteOffset": len(self.blob), "byteLength": len(data)}
        if target:
            entry["target"] = target
        self.blob.extend(data)
        self.views.append(entry)
        return len(self.views) - 1

    def attribute(self, array: np.ndarray, bounds: bool = False) -> int:
        data = array.astype("<f4")
        entry = {
            "bufferView": self.view(data.tobytes(), 34962),
            "componentType": FLOAT,
            "count": len(data),
            "type": f"VEC{data.shape[1]}",
        }
        if bounds:
            entry["min"] = data.min(axis=0).tolist()
            entry["max"] = data.max(axis=0).tolist()
        self.accessors.append(entry)
        return len(self.accessors) - 1

    def indices(self, triangles: np.ndarray, vertices: int) -> int:
        small = vertices < 65535
        data = triangles.reshape(-1).astype("<u2" if small else "<u4")
        self.accessors.append(
            {
                "bufferView": self.view(data.tobytes(), 34963),
                "componentType": USHORT if small else UINT,
                "count": len(data),
                "type": "SCALAR",
            }
        )
        return len(self.accessors) - 1

    def texture(self, name: str, data: bytes) -> dict:
        kind = "image/png" if data[:4] == b"\x89PNG" else "image/jpeg"
        self.images.append({"name": name, "bufferView": self.view(data), "mimeType": kind})
        self.textures.append({"sampler": 0, "source": len(self.images) - 1})
        return {"index": len(self.textures) - 1}

    def material(self, m: Material) -> dict:
        pbr: dict = {"metallicFactor": m.metallic, "roughnessFactor": m.roughness}
        entry: dict = {"name": m.name, "pbrMetallicRoughness": pbr}
        if m.colour != (1.0, 1.0, 1.0):
            pbr["baseColorFactor"] = [*m.colour, 1.0]
        colour, height = None, None
        if m.relief:
            colour, height = m.relief()
        elif m.picture:
            colour = m.picture()
        if colour is not None:
            data = (
                textures.png(colour) if colour.shape[2] == 4 else textures.jpeg(colour, m.quality)
            )
            pbr["baseColorTexture"] = self.texture(m.name, data)
        if height is not None:
            normals = textures.normal_map(height, m.tile, m.relief_strength)
            entry["normalTexture"] = self.texture(m.name + "_normal", textures.jpeg(normals, 93))
        if any(m.emissive):
            entry["emissiveFactor"] = list(m.emissive)
        if m.glows:
            entry["emissiveTexture"] = dict(pbr["baseColorTexture"])
        if extensions := self.extensions(m):
            entry["extensions"] = extensions
        if m.masked:
            entry["alphaMode"] = "MASK"
            entry["alphaCutoff"] = 0.5
        if m.double_sided:
            entry["doubleSided"] = True
        return entry

    def extensions(self, m: Material) -> dict:
        found = {}
        if m.emissive_strength != 1.0:
            found["emissive_strength"] = {"emissiveStrength": m.emissive_strength}
        if m.index:
            found["ior"] = {"ior": m.index}
        if m.transmission:
            found["transmission"] = {"transmissionFactor": m.transmission}
        if m.thickness:
            found["volume"] = {
                "thicknessFactor": m.thickness,
                "attenuationColor": list(m.attenuation),
                "attenuationDistance": m.attenuation_distance,
            }
        found = {f"KHR_materials_{name}": value for name, value in found.items()}
        self.used |= found.keys()
        return found

    def mesh(self, name: str, parts: dict[str, Mesh]) -> None:
        primitives = []
        for material, mesh in parts.items():
            check(f"{name}/{material}", mesh)
            definition = self.defined[self.material_numbers[material]]
            uvs = mesh.uvs / definition.tile
            attributes = {
                "POSITION": self.attribute(mesh.positions, bounds=True),
                "NORMAL": self.attribute(mesh.normals),
                "TEXCOORD_0": self.attribute(uvs),
            }
            if definition.relief:
                attributes["TANGENT"] = self.attribute(tangents(mesh.with_uvs(uvs)))
            primitives.append(
                {
                    "attributes": attributes,
                    "indices": self.indices(mesh.triangles, len(mesh.positions)),
                    "material": self.material_numbers[material],
                }
            )
        self.mesh_numbers[name] = len(self.meshes)
        self.triangles[name] = sum(len(mesh.triangles) for mesh in parts.values())
        self.meshes.append({"name": name, "primitives": primitives})

    def add_nodes(self) -> None:
        for name in self.scene.rooms:
            self.nodes.append({"name": name, "mesh": self.mesh_numbers[name]})
        counts: dict[str, int] = {}
        for prop in self.scene.props:
            number = counts.get(prop.prefab, 0)
            counts[prop.prefab] = number + 1
            node = {
                "name": f"{prop.prefab}_{number}",
                "mesh": self.mesh_numbers[prop.prefab],
                "translation": [round(v, 5) for v in prop.position],
            }
            if prop.yaw:
                half = math.radians(prop.yaw) / 2
                node["rotation"] = [0, round(math.sin(half), 8), 0, round(math.cos(half), 8)]
            self.nodes.append(node)
        for k, light in enumerate(self.scene.lights):
            self.nodes.append(
                {
                    "name": light.name,
                    "translation": [round(v, 5) for v in light.position],
                    "extensions": {"KHR_lights_punctual": {"light": k}},
                }
            )
        for k, camera in enumerate(self.scene.cameras):
            matrix = [round(float(v), 7) for v in camera.matrix().T.reshape(-1)]
            self.nodes.append({"name": camera.name, "camera": k, "matrix": matrix})
        for k, position in enumerate(self.scene.spawns):
            self.nodes.append({"name": f"spawn_{k}", "translation": list(position)})
        for name, position in self.scene.marks:
            self.nodes.append({"name": name, "translation": [round(v, 5) for v in position]})

    def write(self) -> bytes:
        for name, model in {**self.scene.rooms, **self.scene.prefabs}.items():
            self.mesh(name, model.merged())
        for material in self.defined:
            self.materials.append(self.material(material))
        self.add_nodes()
        return pack(self.document(), bytes(self.blob))

    def punctual(self) -> list[dict]:
        return [
            {
                "name": light.name,
                "type": "point",
                "color": list(light.colour),
                "intensity": light.candela,
                "range": light.reach,
            }
            for light in self.scene.lights
        ]

    def perspectives(self) -> list[dict]:
        return [
            {
                "name": camera.name,
                "type": "perspective",
                "perspective": {"yfov": math.radians(camera.yfov), "znear": 0.05, "zfar": 200.0},
            }
            for camera in self.scene.cameras
        ]

    def document(self) -> dict:
        return {
            "asset": {"version": "2.0", "generator": f"Peregrine content/generate_{self.name}.py"},
            "extensionsUsed": ["KHR_lights_punctual", *sorted(self.used)],
            "extensions": {"KHR_lights_punctual": {"lights": self.punctual()}},
            "scene": 0,
            "scenes": [{"name": self.name, "nodes": self.roots()}],
            "nodes": self.nodes,
            "cameras": self.perspectives(),
            "meshes": self.meshes,
            "materials": self.materials,
            "samplers": [{"magFilter": 9729, "minFilter": 9987, "wrapS": 10497, "wrapT": 10497}],
            "textures": self.textures,
            "images": self.images,
            "accessors": self.accessors,
            "bufferViews": self.views,
            "buffers": [{"byteLength": len(self.blob)}],
        }

    def roots(self) -> list[int]:
        return list(range(len(self.nodes)))


def pack(document: dict, blob: bytes) -> bytes:
    text = json.dumps(document, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    blob += b"\0" * (-len(blob) % 4)
    document["buffers"][0]["byteLength"] = len(blob)
    total = 12 + 8 + len(text) + 8 + len(blob)
    return b"".join(
        [
            struct.pack("<4sII", b"glTF", 2, total),
            struct.pack("<I4s", len(text), b"JSON"),
            text,
            struct.pack("<I4s", len(blob), b"BIN\0"),
            blob,
        ]
    )
