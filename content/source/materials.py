"""The level's materials: which textures they use, how large a tile is, and how they shine."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Callable

from . import textures


@dataclass
class Material:
    name: str
    tile: float = 1.0  # metres a texture covers; 1 with texture coordinates that are no lengths
    roughness: float = 0.9
    metallic: float = 0.0
    colour: tuple = (1.0, 1.0, 1.0)
    emissive: tuple = (0.0, 0.0, 0.0)
    emissive_strength: float = 1.0
    relief: Callable | None = None  # gives a colour and a height
    relief_strength: float = 1.0
    picture: Callable | None = None  # gives a colour, perhaps with alpha
    glows: bool = False  # the picture is emitted too
    masked: bool = False
    double_sided: bool = False
    quality: int = 88
    index: float = 0.0  # of refraction; 0: glTF's 1.5
    transmission: float = 0.0  # the part that goes through
    thickness: float = 0.0  # metres; 0: a sheet
    attenuation: tuple = (1.0, 1.0, 1.0)  # what is left of white light after ...
    attenuation_distance: float = 0.0  # ... so many metres


def _red_banner():
    return textures.banner((122, 22, 22, 255), (58, 10, 14, 255))


def _blue_banner():
    return textures.banner((28, 44, 96, 255), (12, 18, 46, 255))


MATERIALS = [
    Material("ashlar", 2.0, 0.85, relief=textures.ashlar),
    Material("trim", 1.0, 0.75, relief=textures.trim),
    Material("marble", 4.0, 0.03, relief=textures.marble, quality=90, index=1.75),
    Material("flagstones", 2.0, 0.8, relief=textures.flagstones),
    Material("brick", 2.0, 0.9, relief=textures.brick),
    Material("plaster", 2.0, 0.9, relief=textures.plaster),
    Material("planks", 2.0, 0.6, relief=textures.planks),
    Material("timber", 1.0, 0.7, relief=textures.timber),
    Material("carpet", 1.0, 1.0, relief=textures.carpet),
    Material("coffer", 1.0, 0.7, relief=textures.coffer),
    Material("iron", 1.0, 0.45, 0.3, relief=textures.iron),
    Material("brass", 1.0, 0.12, 0.8, picture=textures.brass),
    Material("water", 1.5, 0.0, relief=textures.water, index=1.33, transmission=0.75),
    Material("crystal_ball", 1.0, 0.0, index=1.5, transmission=1.0, thickness=0.4,
             attenuation=(0.75, 0.9, 1.0), attenuation_distance=0.4),
    Material("books", 1.0, 0.8, relief=textures.books),
    Material("grate", 1.0, 0.5, 0.3, relief=textures.grate, masked=True, double_sided=True),
    Material("banner_red", 1.0, 1.0, picture=_red_banner, masked=True, double_sided=True),
    Material("banner_blue", 1.0, 1.0, picture=_blue_banner, masked=True, double_sided=True),
    Material("ivy", 1.0, 0.8, picture=textures.ivy, masked=True, double_sided=True),
    Material("stained_glass", 1.0, 0.95, emissive=(1, 1, 1), emissive_strength=1.6,
             picture=textures.stained_glass, glows=True, quality=92),
    Material("leaded_glass", 1.0, 0.8, emissive=(0.55, 0.62, 0.75),
             picture=textures.leaded_glass, glows=True),
    Material("warm_glass", 1.0, 0.8, emissive=(1.0, 0.50, 0.16), colour=(0.1, 0.1, 0.1),
             picture=textures.leaded_glass_pale, glows=True),
    Material("embers", 0.5, 1.0, emissive=(1, 1, 1), emissive_strength=1.5,
             picture=textures.embers, glows=True),
    Material("sky", 1.0, 1.0, colour=(0.0, 0.0, 0.0), emissive=(0.8, 0.8, 0.8),
             picture=textures.night_sky, glows=True),
    Material("flame", colour=(0.0, 0.0, 0.0), emissive=(1.0, 1.0, 1.0), emissive_strength=1.3,
             picture=textures.fire, glows=True),
    Material("neon", colour=(0.0, 0.0, 0.0), emissive=(0.10, 0.85, 1.0), emissive_strength=6.0),
    Material("wax", roughness=0.6, colour=(0.72, 0.64, 0.48), emissive=(0.10, 0.06, 0.025)),
    Material("grass", 4.0, 1.0, picture=textures.grass),
    Material("canvas", colour=(0.75, 0.68, 0.54), double_sided=True),
    Material("slate", colour=(0.10, 0.11, 0.13), roughness=0.6),
    Material("drone_shell", colour=(0.045, 0.05, 0.06), roughness=0.38, metallic=0.25),
    Material("drone_steel", colour=(0.42, 0.43, 0.45), roughness=0.32, metallic=0.6),
    Material("drone_joint", colour=(0.02, 0.02, 0.022), roughness=0.7),
    Material("drone_eye", colour=(0.0, 0.0, 0.0), emissive=(1.0, 0.06, 0.02), emissive_strength=1.5),
    Material("drone_pupil", colour=(0.0, 0.0, 0.0), emissive=(1.0, 0.4, 0.2), emissive_strength=2.5),
    Material("drone_thrust", colour=(0.0, 0.0, 0.0), emissive=(1.0, 0.35, 0.08)),
    Material("drone_dead", colour=(0.03, 0.012, 0.012), roughness=0.15),
    Material("crystal_bright", roughness=0.2, colour=(0.2, 0.4, 0.45), emissive=(0.3, 0.95, 1.0),
             emissive_strength=1.3),
    Material("crystal", roughness=0.2, colour=(0.1, 0.3, 0.4), emissive=(0.03, 0.4, 0.62)),
    Material("crystal_deep", roughness=0.2, colour=(0.05, 0.2, 0.3), emissive=(0.01, 0.16, 0.3)),
    Material("grenade", colour=(0.07, 0.085, 0.055), roughness=0.5, metallic=0.1),
    Material("grenade_stripe", colour=(0.0, 0.0, 0.0), emissive=(1.0, 0.5, 0.05)),
    Material("bolt_core", colour=(0.0, 0.0, 0.0), emissive=(1.0, 0.6, 0.35), emissive_strength=4.0),
    Material("bolt_trail", colour=(0.0, 0.0, 0.0), emissive=(1.0, 0.12, 0.03),
             emissive_strength=1.6, double_sided=True),
]  # fmt: skip
