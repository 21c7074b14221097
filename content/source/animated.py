"""Scenes that move: a tree of nodes, skins, morph targets and animation clips."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np

from .glb import FLOAT, Writer
from .scene import Scene

UBYTE = 5121


def about(axis: tuple, degrees: float) -> tuple:
    """A rotation as glTF writes it: x, y, z, w."""
    half = math.radians(degrees) / 2
    x, y, z = (c * math.sin(half) for c in axis)
    return (x, y, z, math.cos(half))


@dataclass
class Node:
    name: str
    mesh: str | None = None
    translation: tuple | None = None
    rotation: tuple | None = None
    light: int | None = None
    camera: int | None = None
    joints: list["Node"] | None = None  # the skin, with the joints as they stand
    children: list["Node"] = field(default_factory=list)

    def add(self, *children: "Node") -> "Node":
        self.children += children
        return self


@dataclass
class Track:
    node: Node
    path: str
    times: np.ndarray
    values: np.ndarray  # a row a key; with CUBICSPLINE three rows: tangent, value, tangent
    interpolation: str = "LINEAR"


@dataclass
class Skinning:
    joints: np.ndarray  # (n, 4)
    weights: np.ndarray  # (n, 4), rows sum to 1
    rest: np.ndarray  # (joints, 3): where the joints stand, unturned


@dataclass
class AnimatedScene(Scene):
    nodes: list[Node] = field(default_factory=list)
    clips: dict[str, list[Track]] = field(default_factory=dict)
    skinning: dict[str, Skinning] = field(default_factory=dict)  # by mesh
    targets: dict[str, list[tuple]] = field(default_factory=dict)  # of positions and normals
    sun: tuple | None = None  # colour, lux; the light after all others


class AnimatedWriter(Writer):
    scene: AnimatedScene

    def mesh(self, name: str, parts: dict) -> None:
        super().mesh(name, parts)
        primitives = self.meshes[-1]["primitives"]
        if name in self.scene.skinning:
            (primitive,) = primitives
            skinning = self.scene.skinning[name]
            assert np.abs(skinning.weights.sum(axis=1) - 1).max() < 1e-6, name
            primitive["attributes"]["JOINTS_0"] = self.joints(skinning.joints)
            primitive["attributes"]["WEIGHTS_0"] = self.attribute(skinning.weights)
        if name in self.scene.targets:
            (primitive,) = primitives
            primitive["targets"] = [
                {"POSITION": self.attribute(positions, bounds=True), "NORMAL": self.attribute(normals)}
                for positions, normals in self.scene.targets[name]
            ]

    def joints(self, array: np.ndarray) -> int:
        data = array.astype("u1")
        self.accessors.append(
            {
                "bufferView": self.view(data.tobytes(), 34962),
                "componentType": UBYTE,
                "count": len(data),
                "type": "VEC4",
            }
        )
        return len(self.accessors) - 1

    def floats(self, array: np.ndarray, kind: str, bounds: bool = False) -> int:
        data = np.asarray(array, "<f4")
        count = len(data) if kind != "SCALAR" else data.size
        entry = {
            "bufferView": self.view(data.tobytes()),
            "componentType": FLOAT,
            "count": count,
            "type": kind,
        }
        if bounds:
            entry["min"], entry["max"] = [float(data.min())], [float(data.max())]
        self.accessors.append(entry)
        return len(self.accessors) - 1

    def add_nodes(self) -> None:
        self.numbers: dict[int, int] = {}
        self.skins: list[dict] = []
        self.top = [self.add_node(node) for node in self.scene.nodes]
        for node in self.flat(self.scene.nodes):
            if node.joints:
                self.add_skin(node)

    def flat(self, nodes: list[Node]):
        for node in nodes:
            yield node
            yield from self.flat(node.children)

    def add_node(self, node: Node) -> int:
        entry: dict = {"name": node.name}
        if node.mesh:
            entry["mesh"] = self.mesh_numbers[node.mesh]
        if node.translation:
            entry["translation"] = [round(float(v), 6) for v in node.translation]
        if node.rotation:
            entry["rotation"] = [round(float(v), 8) for v in node.rotation]
        if node.light is not None:
            entry["extensions"] = {"KHR_lights_punctual": {"light": node.light}}
        if node.camera is not None:
            entry["camera"] = node.camera
        number = len(self.nodes)
        self.numbers[id(node)] = number
        self.nodes.append(entry)
        if node.children:
            entry["children"] = [self.add_node(child) for child in node.children]
        return number

    def add_skin(self, node: Node) -> None:
        rest = self.scene.skinning[node.mesh].rest
        binds = np.tile(np.eye(4), (len(rest), 1, 1))
        binds[:, 3, :3] = -rest  # column by column
        self.nodes[self.numbers[id(node)]]["skin"] = len(self.skins)
        self.skins.append(
            {
                "joints": [self.numbers[id(joint)] for joint in node.joints],
                "inverseBindMatrices": self.floats(binds.reshape(-1, 16), "MAT4"),
            }
        )

    def animation(self, name: str, tracks: list[Track]) -> dict:
        channels, samplers = [], []
        for track in tracks:
            keys = 3 if track.interpolation == "CUBICSPLINE" else 1
            values = np.asarray(track.values, float)
            kind = {"rotation": "VEC4", "weights": "SCALAR"}.get(track.path, "VEC3")
            if kind == "SCALAR":  # a row is the weights of all targets
                values = values.reshape(len(track.times) * keys, -1)
            assert len(values) == keys * len(track.times), (name, track.path)
            target = {"node": self.numbers[id(track.node)], "path": track.path}
            channels.append({"sampler": len(samplers), "target": target})
            samplers.append(
                {
                    "input": self.floats(np.asarray(track.times), "SCALAR", bounds=True),
                    "output": self.floats(values, kind),
                    "interpolation": track.interpolation,
                }
            )
        return {"name": name, "channels": channels, "samplers": samplers}

    def punctual(self) -> list[dict]:
        lights = super().punctual()
        if self.scene.sun:
            colour, lux = self.scene.sun
            lights.append(
                {"name": "sun", "type": "directional", "color": list(colour), "intensity": lux}
            )
        return lights

    def roots(self) -> list[int]:
        return self.top

    def document(self) -> dict:
        clips = [self.animation(name, tracks) for name, tracks in self.scene.clips.items()]
        document = super().document()
        document["skins"] = self.skins
        document["animations"] = clips
        return document
