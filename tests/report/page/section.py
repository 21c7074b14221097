"""What a section of the report is made of."""

import csv
import dataclasses
import math

import plots


@dataclasses.dataclass
class Section:
    """What a section's measure(bench) returns."""

    plots: list = dataclasses.field(default_factory=list)
    tables: list = dataclasses.field(default_factory=list)
    sentence: str = ""  # what to conclude, of figures of this run


@dataclasses.dataclass
class Table:
    name: str  # of its file
    columns: list
    rows: list  # lists of cells

    def write(self, folder):
        with open(folder / f"{self.name}.csv", "w", newline="", encoding="utf-8") as file:
            writer = csv.writer(file)
            writer.writerow(self.columns)
            writer.writerows(self.rows)


@dataclasses.dataclass
class Point:
    label: str
    x: float
    y: float
    group: str = ""
    default: bool = False
    peer: bool = False


@dataclasses.dataclass
class Plot:
    """Points with a price and an error; lower and farther left is better."""

    name: str
    title: str
    x_label: str
    y_label: str
    points: list
    logarithmic: tuple = (True, True)  # which axes
    front: bool = True  # of Pareto
    lines: bool = False  # through the points of each group

    def write(self, folder):
        plots.draw(self, folder / f"{self.name}.svg")
        Table(self.name, ["group", "label", self.x_label, self.y_label, "default", "peer"],
              [[p.group, p.label, p.x, p.y, int(p.default), int(p.peer)]
               for p in self.points]).write(folder)


def best(points, key):
    """The point that is least in something, of those that have a number for it."""
    return min(points, key=key)


def number(value):
    """For a sentence: three significant digits, as a person would write them."""
    if value == 0:
        return "0"
    digits = 2 - math.floor(math.log10(abs(value)))
    value = round(value, digits)
    if 1e-4 <= abs(value) < 1e7:
        text = f"{value:,.{max(digits, 0)}f}"
        return text.rstrip("0").rstrip(".") if "." in text else text
    mantissa, power = f"{value:.2e}".split("e")
    return f"{mantissa.rstrip('0').rstrip('.')} x 10^{int(power)}"


def span(values):
    """For a sentence: from the least to the most."""
    least, most = number(min(values)), number(max(values))
    return least if least == most else f"{least} to {most}"


def exponent(points):
    """The slope of a line through the points' logarithms: y grows like x to that power."""
    logs = [(math.log(p.x), math.log(p.y)) for p in points]
    mean_x = sum(x for x, _ in logs) / len(logs)
    mean_y = sum(y for _, y in logs) / len(logs)
    spread = sum((x - mean_x) ** 2 for x, _ in logs)
    return sum((x - mean_x) * (y - mean_y) for x, y in logs) / spread
