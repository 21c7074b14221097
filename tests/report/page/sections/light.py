"""Light that is found in blocks, and lamps that are left out."""

from sections import prices
from section import Plot, Section, number

TITLE = "Light in blocks, and dim lamps left out"
WHY = "Against light at every pixel from every lamp: FLIP of the picture, and what a frame takes."


def measure(bench):
    points = prices.points(bench, lambda name: name.startswith(("light", "least")),
                           groups=lambda name: "blocks" if name.startswith("light") else "dim lamps")
    for point in points:
        point.label = point.label.removeprefix("light, ")
    exact = prices.points(bench, lambda name: name == "one ray", default="one ray")
    bench.commands.pop()
    exact[0].y, exact[0].label = 0.0, "every pixel"
    plot = Plot("light", "Light", "ms a frame, one thread", "FLIP, mean", exact + points,
                logarithmic=(False, False))
    quickest = min(points, key=lambda p: p.x)
    which = "the quickest choice" if quickest.x < exact[0].x else "no choice is quicker; the nearest"
    sentence = (f"Light at every pixel takes {number(exact[0].x)} ms; {which}, {quickest.label}, takes "
                f"{number(quickest.x)} ms and errs by {number(quickest.y)}.")
    return Section([plot], [], sentence)
