"""Stiff and extreme cases: tests whose outcomes are exact, run here."""

import json
import pathlib
import tempfile

from bench import Failure
from section import Section, Table

TITLE = "Stiff and extreme cases"
WHY = ("Each line is a set of tests with exactly stated outcomes, over the structures and instruction sets that it "
       "concerns; they ran for this page.")

# What could go wrong, the program, and its tests.
CASES = [
    ("meshes with no area, NaN, infinities, repeated vertices", "abi.bad_input", "OddMesh*:BadMesh*"),
    ("fields that are NaN, infinite, negative or beyond their limits", "abi.bad_input", "Bad*"),
    ("coordinates far from the origin, ships that are 10,000 km apart", "abi.answers", "Far*"),
    ("rays, sweeps and points without length, of NaN and infinity", "abi.answers", "OddEdge*:*Odd*"),
    ("closed meshes: no ray leaks at edges or vertices", "watertight_test", "*"),
    ("grenades at rest in corners, wedges and funnels", "gameplay.grenade", "GrenadeCorner*"),
    ("characters in acute corners, on stairs, between doors, on lifts", "gameplay.character", "*"),
    ("lamps on surfaces, of radius 1e-30 and 1e30", "unit_test", "Room.OddLamps"),
    ("baking with spacings and ranges from 1e-30 to infinity", "abi.answers", "Bake.GoesToExtremes"),
    ("fog with the camera on its plane, horizontal rays", "unit_test", "Fog*"),
    ("mirrors that face each other, glass in glass", "unit_test", "Paths*"),
    ("out of memory at each allocation", "abi.allocation_failure", "*"),
    ("worlds that move ask for no memory", "abi.steady_state", "*"),
]


def outcome(bench, program, tests):
    path = bench.programs / program
    if not path.is_file():
        raise Failure(f"{program} was not built")
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder) / "tests.json"
        bench.run([str(path), f"--gtest_filter={tests}", f"--gtest_output=json:{out}"], least_status=1)
        suites = json.loads(out.read_text(encoding="utf-8"))["testsuites"]
    found = [test for suite in suites for test in suite["testsuite"] if test["result"] == "COMPLETED"]
    failed = [f"{test['classname']}.{test['name']}" for test in found if "failures" in test]
    return len(found), failed


def measure(bench):
    rows, total, wrong = [], 0, 0
    for what, program, tests in CASES:
        if bench.quick and program == "watertight_test":
            continue
        count, failed = outcome(bench, program, tests)
        total, wrong = total + count, wrong + len(failed)
        result = "as stated" if not failed else "not: " + ", ".join(failed)
        rows.append([what, f"{program} {tests}", count, result if count else "no such test"])
    bench.commands.append("each program with --gtest_filter, as in the table")
    sentence = f"{total - wrong:,} of {total:,} tests ended as stated, in {len(rows)} sets."
    return Section([], [Table("extremes", ["what", "tests", "count", "outcome"], rows)], sentence)
