#!/usr/bin/env python3
"""Generates content/mill.glb: a windmill with a gate, a flag, a pond and a lantern that move."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
sys.dont_write_bytecode = True

from source import mill  # noqa: E402
from source.animated import AnimatedWriter  # noqa: E402

MAX_BYTES = 3_000_000


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    default = Path(__file__).resolve().parent / "mill.glb"
    parser.add_argument("--out", type=Path, default=default, help="the file to write (%(default)s)")
    arguments = parser.parse_args()
    writer = AnimatedWriter(mill.build(), "mill")
    data = writer.write()
    assert len(data) < MAX_BYTES, f"{len(data)} bytes are too many"
    arguments.out.write_bytes(data)
    print(f"triangles {sum(writer.triangles.values())} stored, meshes {len(writer.meshes)}")
    print(f"nodes     {len(writer.nodes)}, animations {', '.join(writer.scene.clips)}")
    print(f"bytes     {len(data)}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
