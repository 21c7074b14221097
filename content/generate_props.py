#!/usr/bin/env python3
"""Generates content/props.glb: what the game adds to a level: drones, cores, grenades and bolts."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
sys.dont_write_bytecode = True

from source import props  # noqa: E402
from source.glb import Writer  # noqa: E402

MAX_BYTES = 1_000_000


class PropsWriter(Writer):
    def add_nodes(self) -> None:
        super().add_nodes()
        for node in self.nodes:  # there is one of each
            if "mesh" in node:
                node["name"] = node["name"].removesuffix("_0")


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    default = Path(__file__).resolve().parent / "props.glb"
    parser.add_argument("--out", type=Path, default=default, help="the file to write (%(default)s)")
    arguments = parser.parse_args()
    writer = PropsWriter(props.build(), "props")
    data = writer.write()
    assert len(data) < MAX_BYTES, f"{len(data)} bytes are too many"
    arguments.out.write_bytes(data)
    for name, count in writer.triangles.items():
        print(f"{name:10} {count:5} triangles")
    print(f"bytes      {len(data)}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
