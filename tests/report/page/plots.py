"""Points on two axes, as SVG."""

import math

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as pyplot  # noqa: E402

COLORS = ["#1f5fa8", "#c2571a", "#3d8c40", "#8a4fa3", "#a8861f", "#4a4a4a"]
PEER = "#999999"


def front_of(points):
    """Those that none of the others beats in both."""
    kept, least = [], None
    for point in sorted(points, key=lambda p: (p.x, p.y)):
        if least is None or point.y < least:
            kept.append(point)
            least = point.y
    return kept


def floor_of(values):
    """Where a logarithmic axis puts what is zero."""
    positive = [value for value in values if value > 0]
    return min(positive) / 10 if positive else 1e-9


def draw(plot, path):
    pyplot.rcParams.update({"font.size": 9, "svg.hashsalt": plot.name, "svg.fonttype": "path"})
    figure, axes = pyplot.subplots(figsize=(7.2, 4.2))
    floors = [floor_of([getattr(p, axis) for p in plot.points]) for axis in "xy"]

    def place(point):
        return tuple(
            max(getattr(point, axis), floors[i]) if plot.logarithmic[i] else getattr(point, axis)
            for i, axis in enumerate("xy"))

    groups = list(dict.fromkeys(p.group for p in plot.points))
    colors = {group: COLORS[i % len(COLORS)] for i, group in enumerate(groups)}
    for group in groups:
        points = [p for p in plot.points if p.group == group]
        places = [place(p) for p in points]
        peer = all(p.peer for p in points)
        color = PEER if peer else colors[group]
        if plot.lines:
            axes.plot(*zip(*sorted(places)), color=color, linewidth=1)
        axes.scatter(*zip(*places), s=26, color=color, marker="s" if peer else "o", zorder=3,
                     label=group or None)
    for point in plot.points:
        if point.default:
            axes.scatter(*place(point), s=130, facecolors="none", edgecolors="black", zorder=4)
    if plot.front:
        steps = [place(p) for p in front_of(plot.points)]
        axes.step(*zip(*steps), where="post", color="black", linewidth=0.8, alpha=0.5, zorder=2)
    label_points(axes, plot, place)
    if plot.logarithmic[0]:
        axes.set_xscale("log")
    if plot.logarithmic[1]:
        axes.set_yscale("log")
    axes.margins(x=0.18, y=0.12)
    axes.set_xlabel(plot.x_label)
    has_zero = plot.logarithmic[1] and any(p.y <= 0 for p in plot.points)
    axes.set_ylabel(plot.y_label + (" (lowest: 0)" if has_zero else ""))
    axes.set_title(plot.title, loc="left", fontsize=10)
    axes.grid(True, which="major", color="#e4e4e4", linewidth=0.6)
    axes.set_axisbelow(True)
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)
    if len(groups) > 1:
        axes.legend(frameon=False, fontsize=8, loc="best")
    figure.tight_layout()
    figure.savefig(path, metadata={"Date": None})
    pyplot.close(figure)


def label_points(axes, plot, place):
    """Beside each point, unless a name stands there already."""
    def on_axis(value, logarithmic):
        return math.log10(value) if logarithmic else value

    places = [place(p) for p in plot.points]
    spans = []
    for i in range(2):
        values = [on_axis(p[i], plot.logarithmic[i]) for p in places]
        spans.append((min(values), (max(values) - min(values)) or 1))
    taken = []
    for point, at in sorted(zip(plot.points, places), key=lambda pair: not pair[0].default):
        if not point.label:
            continue
        x, y = ((on_axis(at[i], plot.logarithmic[i]) - spans[i][0]) / spans[i][1] for i in range(2))
        for dy in (4, -9, 13, -18, 22, -27):
            row = y + dy / 260
            if all(abs(row - other_y) > 0.033 or x > other_end or x + 0.011 * len(point.label) < other
                   for other, other_end, other_y in taken):
                taken.append((x, x + 0.011 * len(point.label), row))
                axes.annotate(point.label, at, xytext=(6, dy), textcoords="offset points",
                              fontsize=7.5, color="#333333")
                break
