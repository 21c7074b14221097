#!/usr/bin/env python3
"""Generates content/hall.glb, the first level: geometry, textures, lights, cameras and spawns."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
sys.dont_write_bytecode = True

from source import level  # noqa: E402
from source.glb import Writer  # noqa: E402

MAX_BYTES = 10_000_000


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    default = Path(__file__).resolve().parent / "hall.glb"
    parser.add_argument("--out", type=Path, default=default, help="the file to write (%(default)s)")
    parser.add_argument("--parts", action="store_true", help="list the triangles of every mesh")
    arguments = parser.parse_args()

    scene = level.build()
    writer = Writer(scene)
    data = writer.write()
    assert len(data) < MAX_BYTES, f"{len(data)} bytes are too many"
    arguments.out.write_bytes(data)
    report(scene, writer, data, arguments.parts)
    return 0


def report(scene, writer: Writer, data: bytes, parts: bool) -> None:
    uses = {name: 1 for name in scene.rooms}
    for prop in scene.props:
        uses[prop.prefab] = uses.get(prop.prefab, 0) + 1
    shown = sum(count * uses.get(name, 0) for name, count in writer.triangles.items())
    if parts:
        for name, count in writer.triangles.items():
            print(f"  {name:18} {count:6} triangles x {uses.get(name, 0)}")
    images = sum(writer.views[image["bufferView"]]["byteLength"] for image in writer.images)
    print(f"triangles  {shown} shown, {sum(writer.triangles.values())} stored")
    print(f"meshes     {len(writer.meshes)}, nodes {len(writer.nodes)}")
    print(f"materials  {len(writer.materials)}, images {len(writer.images)} ({images} bytes)")
    print(
        f"lights     {len(scene.lights)}, cameras {len(scene.cameras)}, spawns {len(scene.spawns)}"
    )
    print(f"bytes      {len(data)}")


if __name__ == "__main__":
    sys.exit(main())
