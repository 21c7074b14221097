#!/usr/bin/env python3
"""Counts what the code of each feature executes for a frame of a scene that has none of them: nothing
for a ray, a pixel or a triangle (promise 3 of docs/design.md). Its code is known by the names of its
functions, which must run where the feature is present.

    ctest --test-dir build/release -R instructions.absence
"""

import argparse
import collections
import pathlib
import re
import sys

from measure import dumps_of, skip_without_valgrind

# Names of functions, with their classes and namespaces.
FEATURES = {
    "mirrors": r"Paths::|_and_follow|split_paths",
    "glass": r"Paths::|_and_follow|split_paths|media_at|Tints::|passage|Passage",
    "soft shadows": r"penumbra|sphere_points|sphere_probes",
    "fog": r"Fog|hide_in_fog|find_clear|veil",
    "sky": r"paint_sky",
    "bloom": r"Bloom|take_bright|halve|double_rows|double_columns|spread|keep_radiance",
    "occlusion": r"Openness::|OpenRays|find_openness",
    "edges": r"[Ee]dge",
    "blocks": r"BlockLight::|shade_blocks|block_is_smooth|interpolate_block",
    "particles": r"[Pp]article|[Ss]prite",
}
# Of a frame, not of a ray: parts of the plan are constructed and asked whether they are needed.
MOST_INSTRUCTIONS = 100


def short(name):
    """Without arguments and what a template's are."""
    name = name.replace("(anonymous namespace)", "")
    depth, out = 0, []
    for letter in name.split("(")[0]:
        depth += letter == "<"
        if depth == 0:
            out.append(letter)
        depth -= letter == ">"
    return "".join(out)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--program", required=True, type=pathlib.Path)
    parser.add_argument("--library", required=True, type=pathlib.Path)
    parser.add_argument("--list", action="store_true", help="print what runs for a feature alone")
    arguments = parser.parse_args()
    skip_without_valgrind()
    functions = dict(dumps_of([arguments.program], arguments.library.resolve()))
    plain = functions["plain"]
    total = sum(plain.values())
    mistakes = []
    print(f"{'feature':14} {'present':>12} {'absent':>8}   of {total:,} instructions")
    for feature, pattern in FEATURES.items():
        present, absent = collections.Counter(), collections.Counter()
        for counter, source in (present, functions[feature]), (absent, plain):
            for name, instructions in source.items():
                if re.search(pattern, short(name)):
                    counter[name] += instructions
        print(f"{feature:14} {sum(present.values()):12,} {sum(absent.values()):8,}")
        if arguments.list:
            for name in sorted(functions[feature].keys() - plain.keys()):
                print(f"    {functions[feature][name]:10,} {name[:150]}")
            for name in absent:
                print(f"    absent, but {absent[name]:,}: {name[:150]}")
        if sum(present.values()) <= 10 * MOST_INSTRUCTIONS:
            mistakes.append(f"{feature}: none of its functions is known by name")
        if sum(absent.values()) > MOST_INSTRUCTIONS:
            mistakes.append(f"{feature}: {', '.join(absent)}")
    again = sum(functions["plain again"].values())
    if abs(again - total) > 0.001 * total:
        mistakes.append(f"plain again: {again:,}, was {total:,}")
    if mistakes:
        sys.exit("\n".join(mistakes))


if __name__ == "__main__":
    main()
