"""Visibility that was proved once, in frames of the same bits."""

from section import Section, Plot, Point, Table, span

TITLE = "Visibility remembered"
WHY = ("The error is 0 by construction: frames with proofs have the bits of traced ones. What is bought with proofs "
       "is shadow rays, and so time; the unit is what Embree takes for the primary rays.")


def measure(bench):
    levels = ["ctf_compromise"] if bench.quick else ["hall", "ctf_compromise", "kaos", "oa_dm2", "oacmpdm10"]
    size = "256x256" if bench.quick else "512x512"
    rows = bench.rows("frame", *bench.scene(*levels), "--look", "exact", "--size", size, "--passes", 2,
                      "--first-passes", 1, "--peer", "embree")
    points = [Point(row["scene"], row["proofs"] / 1e3, row["ratio"], group="proved") for row in rows]
    points += [Point(row["scene"], 0.1, row["first_ratio"], group="nothing proved", default=True) for row in rows]
    plot = Plot("remembered", "Exact frames", "thousand proofs (0.1: none)",
                "frame, in Embree's times for primary rays", points, logarithmic=(True, False), front=False)
    gains = [row["first_ratio"] / row["ratio"] for row in rows]
    data = Table("remembered_frames", ["level", "proofs", "first frame, ms", "proved, ms", "Embree's primary rays, ms"],
                 [[r["scene"], r["proofs"], r["first_frame_ms"], r["frame_ms"], r["peer_primary_ms"]] for r in rows])
    firsts = [row["first_ratio"] for row in rows]
    sentence = (f"With proofs a frame is {span(gains)} times as fast; without, it takes {span(firsts)} times what "
                f"Embree takes for its primary rays.")
    return Section([plot], [data], sentence)
