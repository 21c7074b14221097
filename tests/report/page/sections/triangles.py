"""Ray/triangle tests: ours, and those of others."""

from section import Plot, Point, Section, Table, number

TITLE = "Ray/triangle tests"
WHY = ("Rays at the edge that two triangles share pass through one of them: a test that misses both leaks. Errors of t "
       "are in units of its last place, beside extended precision. What depends on the ray alone is done once "
       "for eight triangles.")


def measure(bench):
    rows = bench.rows("triangles", "--passes", 2 if bench.quick else 9)
    points = [Point(row["test"], row["ns"], row["worst_ulps"], default=row["test"] == "ours") for row in rows]
    plot = Plot("triangles", "One ray at a time", "ns a test", "largest error of t, ulps", points,
                logarithmic=(False, True))
    data = Table("triangles_tests", ["test", "missed a million at edges", "beside a million", "median, ulps",
                                     "largest, ulps", "ns"],
                 [[r["test"], r["missed_per_million"], r["beside_per_million"], r["median_ulps"], r["worst_ulps"],
                   r["ns"]] for r in rows])
    named = {row["test"]: row for row in rows}
    ours, fast = named["ours"], named["Moeller-Trumbore, float"]
    sentence = (f"Ours misses {number(ours['missed_per_million'])} of a million rays at edges and errs by at most "
                f"{number(ours['worst_ulps'])} ulps for {number(ours['ns'])} ns; Moeller-Trumbore in float misses "
                f"{number(fast['missed_per_million'])}, errs by {number(fast['worst_ulps'])} and takes "
                f"{number(fast['ns'])} ns.")
    return Section([plot], [data], sentence)
