#!/usr/bin/env python3
"""Who may include whom: check_includes.py ROOT [--self-test].

A file under engine/ includes from its own floor and from those below it (docs/design.md). abi/ stands on
top. gameplay/ sees the header and GLM alone; host_sample/ nothing of the engine's inside.
"""

import pathlib
import re
import sys
import tempfile

# From the bottom up.
FLOORS = ["base", "math", "simd", "geometry", "accel", "trace", "scene", "query", "shade", "render"]
INCLUDE = re.compile(r'^\s*#\s*include\s*(?:"([^"]+)"|<([^>]+)>)', re.MULTILINE)
# How a source that is compiled for each instruction set names itself.
TARGET = re.compile(r'^\s*#\s*define\s+HWY_TARGET_INCLUDE\s+"([^"]+)"', re.MULTILINE)
SUFFIXES = {".h", ".hpp", ".c", ".cpp"}
HEADER = "peregrine/"  # of abi/include


def sources(folder):
    return sorted(p for p in folder.rglob("*") if p.suffix in SUFFIXES)


def included(path):
    """The names that a file includes, each with whether it stands in quotes."""
    text = path.read_text(encoding="utf-8")
    for match in INCLUDE.finditer(text):
        yield (match[1] or match[2]), match[1] is not None
    for match in TARGET.finditer(text):
        yield match[1], True


def floor_of(root, name):
    """The folder of engine/ that an included name is in; None if in none."""
    first = pathlib.PurePosixPath(name).parts[0]
    return first if (root / "engine" / name).is_file() else None


def check_engine(root):
    for folder in sorted(p for p in (root / "engine").iterdir() if p.is_dir()):
        if folder.name not in FLOORS:
            yield f"engine/{folder.name}: not a floor that this test knows"
            continue
        allowed = FLOORS[: FLOORS.index(folder.name) + 1]
        for path in sources(folder):
            here = path.relative_to(root)
            for name, quoted in included(path):
                floor = floor_of(root, name)
                if floor and floor not in allowed:
                    yield f"{here}: includes {name}, from a floor above"
                elif name.startswith(HEADER):
                    yield f"{here}: includes {name}, the door above"
                elif quoted and not floor:
                    yield f"{here}: includes {name}, which is not in engine/"


def check_gameplay(root):
    for path in sources(root / "gameplay"):
        for name, quoted in included(path):
            own = name.startswith("gameplay/") or (path.parent / name).is_file()
            standard = not quoted and "/" not in name
            if not (own or standard or name == "peregrine/rt.h" or name.startswith("glm/")):
                yield f"{path.relative_to(root)}: includes {name}; gameplay sees rt.h and GLM alone"


def check_host(root):
    for path in sources(root / "host_sample"):
        for name, quoted in included(path):
            own = any((base / name).is_file() for base in (path.parent, root / "host_sample", root))
            reached = (path.parent / name).resolve().is_relative_to((root / "engine").resolve())
            if reached or name.startswith("engine/") or (quoted and not own and floor_of(root, name)):
                yield f"{path.relative_to(root)}: includes {name} of the engine"


def complaints(root):
    return [*check_engine(root), *check_gameplay(root), *check_host(root)]


def self_test():
    """Each planted violation is found, and nothing else."""
    good = {
        "engine/base/a.h": "#include <vector>\n",
        "engine/trace/bvh/b.cpp": '#include "base/a.h"\n#include "trace/bvh/c.h"\n',
        "engine/trace/bvh/c.h": "",
        "engine/scene/d.h": '#include "trace/bvh/c.h"\n',
        "gameplay/e.h": '#include <peregrine/rt.h>\n#include <glm/glm.hpp>\n#include "gameplay/f.h"\n',
        "gameplay/f.h": "#include <cmath>\n",
        "host_sample/g.cpp": '#include "window/h.h"\n#include <GLFW/glfw3.h>\n',
        "host_sample/window/h.h": "",
    }
    planted = {
        "engine/base/up.h": '#include "trace/bvh/c.h"\n',
        "engine/trace/up.cpp": '#  include "scene/d.h"\n',
        "engine/trace/up_kernels.cpp": '#define HWY_TARGET_INCLUDE "scene/d.h"\n',
        "engine/scene/door.h": "#include <peregrine/rt.h>\n",
        "engine/scene/nowhere.h": '#include "nowhere.h"\n',
        "engine/cellar/a.h": "",
        "gameplay/inside.h": '#include "base/a.h"\n',
        "gameplay/json.h": "#include <nlohmann/json.hpp>\n",
        "host_sample/inside.cpp": '#include "base/a.h"\n',
        "host_sample/around.cpp": '#include "../engine/base/a.h"\n',
    }

    def plant(root, files):
        for name, text in files.items():
            path = root / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8")

    failures = []
    with tempfile.TemporaryDirectory() as folder:
        plant(pathlib.Path(folder), good)
        failures += [f"a false alarm: {c}" for c in complaints(pathlib.Path(folder))]
    for name, text in planted.items():
        with tempfile.TemporaryDirectory() as folder:
            plant(pathlib.Path(folder), {**good, name: text})
            if len(complaints(pathlib.Path(folder))) != 1:
                failures.append(f"not found, or not once: {name}")
    return failures


def main():
    root = pathlib.Path(sys.argv[1])
    found = self_test() if "--self-test" in sys.argv else complaints(root)
    for line in found:
        print(line)
    print(len(found), "complaints")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
