"""Sweeps of shapes beside Bullet: accuracy against time."""

from section import Plot, Point, Section, Table, number, span

TITLE = "Sweeps and overlaps"
WHY = "The error of the time of impact as a distance along the way, against double precision, and what a query takes."
ITEMS = ["sphere-0.1", "sphere-0.4", "capsule"]


def measure(bench):
    count = 4000 if bench.quick else 30000
    rows = bench.rows("queries", *bench.scene("oa_dm2"), "--items", *ITEMS, "--peer", "bullet", "--passes",
                      1 if bench.quick else 3, "--count", count, "--reference", count // 4)
    points = [Point(row["item"], 1e6 / row["per_s"], row["worst_error_mm"], group=row["contestant"],
                    peer="ullet" in row["contestant"]) for row in rows]
    ours = [p for p in points if not p.peer]
    theirs = [p for p in points if p.peer]
    plot = Plot("sweeps", "Sweeps in a level", "microseconds a query", "largest error, mm", points)
    data = Table("sweeps_accuracy", ["query", "by", "a second", "missed a million", "false a million", "median, mm",
                                     "largest, mm"],
                 [[r["item"], r["contestant"], r["per_s"], r["missed_per_million"], r["false_per_million"],
                   r["median_error_mm"], r["worst_error_mm"]] for r in rows])
    sentence = (f"Ours err by at most {number(max(p.y for p in ours))} mm and take {span([p.x for p in ours])} "
                f"microseconds")
    sentence += (f"; Bullet's by {number(max(p.y for p in theirs))} mm in {span([p.x for p in theirs])}."
                 if theirs else "; no peer was at hand.")
    return Section([plot], [data], sentence)
