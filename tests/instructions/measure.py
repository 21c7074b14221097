#!/usr/bin/env python3
"""Counts the instructions that the library executes for fixed work, and compares them with those in
counts.json: more than its tolerance is an error, much less asks for the file to be renewed.

    cmake --build --preset release --target renew_instructions

Counts are the same on every machine, but not from every compiler: with another one than that of the
file, or without valgrind, there is nothing to compare (exit status 77).
"""

import argparse
import collections
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

SKIPPED = 77


def skip(reason):
    print("skipped:", reason)
    sys.exit(SKIPPED)


def read_dump(path, library):
    """A dump of callgrind: its name, and the instructions of each function inside the library."""
    name, inside, called, function = None, False, False, ""
    functions, objects, names = collections.Counter(), {}, {}
    for line in path.read_text().splitlines():
        if match := re.match(r"desc: Trigger: Client Request: (.*)", line):
            name = match[1]
        elif match := re.match(r"ob=\((\d+)\)(?: (.*))?", line):
            if match[2]:
                objects[match[1]] = match[2]
            inside = objects[match[1]] == library
        elif match := re.match(r"cob=\((\d+)\) (.*)", line):
            objects[match[1]] = match[2]
        elif match := re.match(r"c?fn=\((\d+)\)(?: (.*))?", line):
            if match[2]:
                names[match[1]] = match[2]
            if line.startswith("fn="):
                function = names[match[1]]
        elif line.startswith("calls="):
            called = True  # the next line is what the call took
        elif re.match(r"[0-9+*-]", line):
            if inside and not called:
                functions[function] += int(line.split()[-1])
            called = False
    return name, functions


def dumps_of(command, library):
    """What a program has counted, in the order of names."""
    with tempfile.TemporaryDirectory() as folder:
        command = ["valgrind", "--tool=callgrind", "--instr-atstart=no",
                   f"--callgrind-out-file={folder}/out", *map(str, command)]
        run = subprocess.run(command, capture_output=True, text=True,
                             env={**os.environ, "LD_BIND_NOW": "1"})
        if "RT_ERROR_UNSUPPORTED" in run.stderr:
            skip("this machine has no AVX2")
        if run.returncode:
            sys.exit(f"{' '.join(command)}\nexit status {run.returncode}\n{run.stderr}")
        dumps = [read_dump(path, str(library)) for path in pathlib.Path(folder).glob("out.*")]
        return sorted((dump for dump in dumps if dump[0]), key=lambda dump: dump[0])


def skip_without_valgrind():
    if not shutil.which("valgrind"):
        skip("there is no valgrind")


def compare(counts, expected, tolerance):
    """Prints a table; the names of what is too much, and of what asks for new numbers."""
    worse, other = [], sorted(set(counts) ^ set(expected))
    print(f"{'instructions in the library':28} {'now':>12} {'before':>12} {'change':>8}")
    for name, now in counts.items():
        before = expected.get(name)
        change = (now / before - 1) if before else 0
        print(f"{name:28} {now:12,} {before or 0:12,} {100 * change:+7.2f}%")
        if change > tolerance["more"]:
            worse.append(name)
        if change < -tolerance["less"]:
            other.append(name)
    return worse, other


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--program", required=True, type=pathlib.Path)
    parser.add_argument("--library", required=True, type=pathlib.Path)
    parser.add_argument("--scene", required=True, type=pathlib.Path)
    parser.add_argument("--counts", required=True, type=pathlib.Path, help="the file of numbers")
    parser.add_argument("--build", required=True, help="compiler and kind of build")
    parser.add_argument("--renew", action="store_true", help="write the file instead")
    arguments = parser.parse_args()
    stored = json.loads(arguments.counts.read_text())
    skip_without_valgrind()
    if arguments.build != stored["build"] and not arguments.renew:
        skip(f"the numbers are of {stored['build']}, this is {arguments.build}")
    dumps = dumps_of([arguments.program, arguments.scene], arguments.library.resolve())
    counts = {name: sum(functions.values()) for name, functions in dumps}
    if not counts or not all(counts.values()):
        sys.exit(f"nothing was counted in {arguments.library}: {counts}")
    worse, other = compare(counts, stored["instructions"], stored["tolerance"])
    if arguments.renew:
        stored.update(build=arguments.build, instructions=counts)
        arguments.counts.write_text(json.dumps(stored, indent=2) + "\n")
        print("wrote", arguments.counts)
        return
    renew = "cmake --build --preset release --target renew_instructions"
    if worse:
        sys.exit(f"more than before: {'; '.join(worse)}. If it is worth that: {renew}")
    if other:
        sys.exit(f"much less than before, or new, or gone: {'; '.join(other)}. Keep it: {renew}")


if __name__ == "__main__":
    main()
