"""Whole frames: edges, sizes and texture filters against 16 rays a pixel."""

from sections import prices
from section import Plot, Section, number

TITLE = "A frame: edges, sizes, filters"
WHY = ("What a player sees of each choice, against 16 rays a pixel at the textures' finest level: the mean of FLIP "
       "over the level's cameras, and what a frame takes.")


def group(name):
    if name.startswith("size"):
        return "enlarged"
    return "edges" if name.startswith("edges") else "one ray a pixel"


def measure(bench):
    points = prices.points(bench, lambda name: not name.startswith(("light", "least", "occlusion")),
                           default="mip-maps", groups=group)
    plot = Plot("picture", "Frames, all lamps and shadows", "ms a frame, one thread", "FLIP, mean", points,
                logarithmic=(True, False))
    named = {p.label: p for p in points}
    default, finest = named["mip-maps"], min(points, key=lambda p: p.y)
    half = named["size 1/2"]
    sentence = (f"The default takes {number(default.x)} ms at an error of {number(default.y)}; the best picture here, "
                f"{finest.label}, takes {number(finest.x / default.x)} times as long for an error of "
                f"{number(finest.y)}, and half the sides take {number(half.x / default.x)} times as long for "
                f"{number(half.y)}.")
    return Section([plot], [], sentence)
