"""What a level consists of: rooms, shared props, lights, cameras and places to start."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from .mesh import Model

WARM = (1.0, 0.66, 0.34)
FIRE = (1.0, 0.55, 0.22)
MOON = (0.50, 0.66, 1.0)
NEON = (0.10, 0.85, 1.0)


@dataclass
class Light:
    name: str
    position: tuple
    colour: tuple
    candela: float
    reach: float


@dataclass
class Prop:
    prefab: str
    position: tuple
    yaw: float = 0.0


@dataclass
class Camera:
    name: str
    position: tuple
    target: tuple
    yfov: float = 60.0

    def matrix(self) -> np.ndarray:
        eye = np.array(self.position, float)
        back = eye - np.array(self.target, float)
        back /= np.linalg.norm(back)
        right = np.cross((0, 1, 0), back)
        right /= np.linalg.norm(right)
        matrix = np.eye(4)
        matrix[:3, 0], matrix[:3, 1], matrix[:3, 2] = right, np.cross(back, right), back
        matrix[:3, 3] = eye
        return matrix


@dataclass
class Scene:
    rooms: dict[str, Model] = field(default_factory=dict)
    prefabs: dict[str, Model] = field(default_factory=dict)
    props: list[Prop] = field(default_factory=list)
    lights: list[Light] = field(default_factory=list)
    cameras: list[Camera] = field(default_factory=list)
    spawns: list[tuple] = field(default_factory=list)
    marks: list[tuple[str, tuple]] = field(default_factory=list)

    def room(self, name: str) -> Model:
        return self.rooms.setdefault(name, Model())

    def put(self, prefab: str, x: float, y: float, z: float, yaw: float = 0.0) -> None:
        assert prefab in self.prefabs, prefab
        self.props.append(Prop(prefab, (x, y, z), yaw))

    def light(self, name: str, x, y, z, colour, candela: float, reach: float) -> None:
        number = sum(light.name.startswith(name + "_") for light in self.lights)
        self.lights.append(Light(f"{name}_{number}", (x, y, z), colour, candela, reach))

    def camera(self, name: str, position: tuple, target: tuple, yfov: float = 60.0) -> None:
        self.cameras.append(Camera(name, position, target, yfov))

    def mark(self, name: str, x: float, y: float, z: float) -> None:
        self.marks.append((name, (x, y, z)))

    def all_models(self) -> list[Model]:
        return [*self.rooms.values(), *self.prefabs.values()]
