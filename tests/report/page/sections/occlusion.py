"""Ambient occlusion by rays and baked."""

from sections import prices
from section import Plot, Section, number

TITLE = "Ambient occlusion"
WHY = ("Against 256 rays at every pixel: 16 rays at every pixel, in blocks that are cut where openness changes, and "
       "baked at points so far apart.")


def measure(bench):
    points = prices.points(bench, lambda name: name.startswith("occlusion"), default="occlusion, blocks of 8",
                           groups=lambda name: "baked" if "baked" in name else "by rays")
    for point in points:
        point.label = point.label.removeprefix("occlusion, ").replace("occlusion", "every pixel")
    plot = Plot("occlusion", "Ambient occlusion, range 1 m", "ms a frame, one thread", "FLIP, mean", points,
                logarithmic=(True, False))
    named = {p.label: p for p in points}
    rays, baked = named["blocks of 8"], named["baked, 0.5 m"]
    sentence = (f"Blocks of 8 take {number(rays.x)} ms a frame and err by {number(rays.y)}; baked at 0.5 m it is "
                f"{number(baked.x)} ms and {number(baked.y)}.")
    return Section([plot], [], sentence)
