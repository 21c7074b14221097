"""How time grows with lamps and triangles: the exponent of a line through the logarithms."""

from section import Plot, Point, Section, exponent, number

TITLE = "Scaling"
WHY = "Time against how much there is. An exponent of 1 means in proportion; 0 means that it does not matter."


def measure(bench):
    lamps = bench.rows("lamps", *bench.scene("kaos"), "--passes", 1, "--size", "256x256")
    plots, parts = [], []
    radius = min(row["radius"] for row in lamps)
    small = [row for row in lamps if row["radius"] == radius]
    by_count = [Point(f"{row['lamps']:,}", row["lamps"], row["frame_ms"], group="a frame") for row in small]
    moves = [Point("", row["lamps"], max(row["commit_ms"], 1e-3), group="a commit that moves all") for row in small]
    plots.append(Plot("scaling_lamps", f"Lamps of a radius of {radius:g} m", "lamps", "ms", by_count + moves,
                      front=False, lines=True))
    parts.append(f"a frame grows with lamps to the power of {number(exponent(by_count))}, and a commit that moves all "
                 f"of them to {number(exponent(moves))}")
    names = ["teapots", "ctf_compromise", "oacmpdm10", "dragon_res2"]
    built = [row for row in bench.rows("build", *bench.scene(*names), "--passes", 1 if bench.quick else 3)]
    triangles = [Point(row["scene"], row["triangles"], row["build_ms"], group=row["contestant"]) for row in built]
    if len({p.x for p in triangles}) > 1:
        plots.append(Plot("scaling_triangles", "Building a BVH", "triangles", "ms, one thread", triangles, front=False,
                          lines=True))
        parts.append(f"building grows with triangles to {number(exponent(triangles))}")
    sentence = "; ".join(parts) + "."
    return Section(plots, [], sentence[0].upper() + sentence[1:])
