"""Rows of the benchmark of prices, which several sections look at."""

from section import Point

LEVEL = "ctf_compromise"


def rows(bench):
    size, passes = ("256x256", 1) if bench.quick else ("640x640", 1)
    if not hasattr(bench, "prices"):
        bench.prices = bench.rows("prices", *bench.scene(LEVEL), "--size", size, "--passes", passes)
    else:
        bench.commands.append("as above")
    return bench.prices


def points(bench, wanted, default="", groups=lambda name: ""):
    """One for each row whose setting is wanted."""
    return [Point(row["setting"], row["frame_ms"], row["flip_mean"], group=groups(row["setting"]),
                  default=row["setting"] == default)
            for row in rows(bench) if wanted(row["setting"])]
