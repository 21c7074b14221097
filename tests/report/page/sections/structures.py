"""Structures and builders: what building costs, and what rays gain."""

from section import Plot, Point, Section, Table, number

TITLE = "Structures and builders"
WHY = ("All of ours give the same hits, bit for bit. So the price is building and memory, and what is bought is the "
       "time of rays. Of each the fastest way of asking.")
OURS = [("BVH, fast", "bvh", "fast"), ("BVH", "bvh", "balanced"), ("BVH, best", "bvh", "best"),
        ("kd-tree", "kdtree", "balanced"), ("BIH", "bih", "balanced")]


def measure(bench):
    rows = []
    names = ["oa_dm2"] if bench.quick else ["ctf_compromise"]
    common = [*bench.scene(*names), "--passes", 1 if bench.quick else 2, "--rays", "P", "D", "--size", 256 if bench.quick else 512]
    for label, structure, quality in OURS:
        peer = ["--peer", "embree"] if label == "BVH" else []
        measured = bench.rows("trace", *common, "--structure", structure, "--build", quality, *peer)
        for rays in "PD":
            for is_peer in (False, True):
                of = [row for row in measured
                      if row["rays"] == rays and (row["contestant"] != "peregrine") == is_peer]
                if of:
                    fastest = max(of, key=lambda row: row["mrays_per_s"])
                    rows.append({**fastest, "label": "Embree" if is_peer else label, "is_peer": is_peer})
    result = []
    for rays, what in (("P", "primary rays"), ("D", "diffuse bounces")):
        points = [Point(row["label"], row["build_ms"], 1e3 / row["mrays_per_s"],
                        group="Embree" if row["is_peer"] else "", peer=row["is_peer"],
                        default=row["label"] == "BVH") for row in rows if row["rays"] == rays]
        result.append(Plot(f"structures_{rays}", f"Building, and {what}", "ms to build, one thread", "ns a ray", points))
    ours = [p for p in result[0].points if not p.peer]
    default, quickest = next(p for p in ours if p.default), min(ours, key=lambda p: p.x)
    data = Table("structures_rows", ["structure", "rays", "build, ms", "bytes a triangle", "million rays a second"],
                 [[r["label"], r["rays"], r["build_ms"], r["bytes_per_triangle"], r["mrays_per_s"]] for r in rows])
    sentence = (f"The default is built in {number(default.x)} ms and takes {number(default.y)} ns a primary ray; "
                f"{quickest.label} is built in {number(quickest.x)} ms and takes {number(quickest.y)} ns.")
    return Section(result, [data], sentence)
