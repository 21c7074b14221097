"""Fall-offs of lamps against the inverse square."""

from section import Plot, Point, Section, Table, best, number

TITLE = "Fall-off of lamps"
WHY = ("How far the light of each fall-off is from that of the inverse square, which is what a lamp gives, and what "
       "a lamp at a hit costs with it.")


def measure(bench):
    rows = bench.rows("falloff", "--passes", 3 if bench.quick else 9)
    models = [row for row in rows if "rms" in row]
    points = [Point(row["falloff"], row["ns"], row["rms"],
                    default=row["falloff"] == "windowed inverse square") for row in models]
    default = next(p for p in points if p.default)
    fastest = best([p for p in points if not p.default], key=lambda p: p.x)
    plot = Plot("falloff", "Fall-offs", "ns a lamp and hit", "how far off, as a factor (root mean square)", points,
                logarithmic=(False, False))
    sentence = (f"The default costs {number(default.x)} ns and is off by a factor of {number(default.y)}; the fastest of the others, "
                f"{fastest.label}, costs {number(fastest.x)} ns and is off by {number(fastest.y)}.")
    data = Table("falloff_models", ["fall-off", "largest factor", "root mean square", "ns"],
                 [[r["falloff"], r["factor"], r["rms"], r["ns"]] for r in models])
    return Section([plot], [data], sentence)
