#!/usr/bin/env python3
"""Makes the report: run.py --build DIR [--scenes DIR] [--out DIR] [--quick] [--section NAME ...].

Writes index.html with plots (SVG) and tables (CSV) of error against run time, measured on this machine.
"""

import argparse
import dataclasses
import datetime
import importlib
import os
import pathlib
import platform
import subprocess
import sys
import time

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))

from bench import Bench, Failure  # noqa: E402
import page  # noqa: E402

ROOT = HERE.parents[2]
SECTIONS = ["triangles", "structures", "falloff", "remembered", "light", "occlusion", "picture", "grenade", "sweeps",
            "scaling", "extremes"]


@dataclasses.dataclass
class Entry:
    title: str
    why: str
    result: object = None
    fault: str = ""
    commands: list = dataclasses.field(default_factory=list)
    seconds: float = 0.0


def scenes_of(folder):
    """The hall, and what others made, by name."""
    found = {"hall": str(ROOT / "content" / "hall.glb")}
    if folder.is_dir():
        found.update({path.stem: str(path) for path in sorted(folder.glob("*.glb"))})
    return found


def first_line(path, key):
    try:
        for line in pathlib.Path(path).read_text(encoding="utf-8").splitlines():
            if line.startswith(key):
                return line.split(":", 1)[1].strip()
    except OSError:
        pass
    return "an unknown processor"


def first_said(*line):
    """The first line that a program prints; nothing if it is not there."""
    try:
        said = subprocess.run(line, capture_output=True, text=True, check=False).stdout
    except OSError:
        return ""
    return said.splitlines()[0] if said else ""


def machine():
    version = first_said("git", "-C", str(ROOT), "describe", "--always", "--dirty")
    return [f"{first_line('/proc/cpuinfo', 'model name')}, {len(os.sched_getaffinity(0))} threads",
            f"{first_said('c++', '--version') or 'no compiler'}; {platform.system()} {platform.release()}",
            f"Peregrine {version or 'without a history'}, {datetime.datetime.now().astimezone():%d %B %Y, %H:%M}"]


def measure(name, bench, out):
    module = importlib.import_module(f"sections.{name}")
    entry = Entry(module.TITLE, module.WHY)
    begin = time.monotonic()
    try:
        entry.result = module.measure(bench)
        for part in entry.result.plots + entry.result.tables:
            part.write(out)
    except Failure as failure:
        entry.result, entry.fault = None, str(failure)
    except Exception as fault:  # noqa: BLE001  the other sections are still wanted
        entry.result, entry.fault = None, f"the section itself failed: {type(fault).__name__}: {fault}"
    entry.commands, bench.commands = bench.commands, []
    entry.seconds = time.monotonic() - begin
    return entry


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build" / "release", help="folder of the build")
    parser.add_argument("--scenes", type=pathlib.Path,
                        default=pathlib.Path(os.environ.get("PEREGRINE_SCENES", ROOT.parent / "shared" / "scenes")),
                        help="folder of levels made by others; without it the hall stands for them")
    parser.add_argument("--out", type=pathlib.Path, default=ROOT / "report", help="folder of the report")
    parser.add_argument("--quick", action="store_true", help="small pictures, few rays: some two minutes")
    parser.add_argument("--section", nargs="+", choices=SECTIONS, default=SECTIONS, help="these alone")
    options = parser.parse_args()
    if not (options.build / "bin" / "peregrine_bench").is_file():
        parser.error(f"{options.build} has no bin/peregrine_bench: build the project first")
    try:
        options.out.mkdir(parents=True, exist_ok=True)
        (options.out / "index.html").touch()
    except OSError as error:
        parser.error(f"nothing can be written to {options.out}: {error.strerror}")
    bench = Bench(options.build, scenes_of(options.scenes), options.quick)
    entries, faults = [], 0
    for i, name in enumerate(options.section):
        print(f"[{i + 1}/{len(options.section)}] {name}", end="", flush=True)
        entries.append(measure(name, bench, options.out))
        faults += bool(entries[-1].fault)
        print(f": {entries[-1].fault or f'{entries[-1].seconds:.0f} s'}", flush=True)
        page.write(options.out / "index.html", machine(), entries)
    print(f"wrote {options.out / 'index.html'}")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
