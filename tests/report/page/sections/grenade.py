"""A thrown grenade, stepped in several ways, against its exact path."""

from section import Plot, Point, Section, number

TITLE = "Grenades: time steps"
WHY = ("How far a grenade is, 5 seconds after the throw, from the path of steps a hundred times as fine, and what a "
       "tick costs, by the rate of ticks.")


def measure(bench):
    rows = [row for row in bench.rows("grenade", *bench.scene("hall"), "--passes", 1 if bench.quick else 3)
            if "method" in row]
    points = [Point(f"{row['rate']:g} Hz", row["us_a_tick"] * row["rate"] / 1e3, row["median_after_5_s_m"],
                    group=row["method"]) for row in rows]
    plot = Plot("grenade", "After 5 s in the hall", "ms a second of the game", "median distance, m", points, lines=True)
    worst = max(points, key=lambda p: p.y)
    least = min(points, key=lambda p: p.y)
    sentence = (f"The least error is {number(least.y)} m, {least.group} at {least.label}, for {number(least.x)} ms a "
                f"second; the largest is {number(worst.y)} m, {worst.group} at {worst.label}, for {number(worst.x)} ms.")
    return Section([plot], [], sentence)
