#!/usr/bin/env python3
"""Compares frames with Mitsuba 3, a renderer that shares nothing with this engine.

    python3 tests/truth/compare.py --program build/release/bin/truth_scenes --out /tmp/truth

needs Python 3.9 with `pip install mitsuba numpy`. Writes FOLDER/NAME.png: ours, Mitsuba's, and
ten times their difference. Exits with 1 if a scene differs by more than its bound.
"""

import argparse
import json
import pathlib
import subprocess
import sys

import numpy

BOUND = 0.01  # of the mean relative difference
BLOCK = 8  # pixels: Mitsuba samples absorption, which is noise; such pictures are compared in blocks


def write_ply(path, mesh):
    lines = ["ply", "format ascii 1.0", f"element vertex {len(mesh['positions'])}"]
    lines += ["property float x", "property float y", "property float z"]
    lines += [f"element face {len(mesh['triangles'])}"]
    lines += ["property list uchar int vertex_indices", "end_header"]
    lines += [" ".join(map(repr, position)) for position in mesh["positions"]]
    lines += ["3 " + " ".join(map(str, triangle)) for triangle in mesh["triangles"]]
    path.write_text("\n".join(lines) + "\n")


def rgb(value):
    return {"type": "rgb", "value": list(value)}


def medium(material):
    extinction = [-float(numpy.log(a)) for a in material["attenuation"]]
    most = max(extinction)
    return {
        "type": "homogeneous",
        "albedo": rgb([0, 0, 0]),
        "sigma_t": rgb([e / most for e in extinction]),
        "scale": most,
    }


def absorbing(material):
    return material["kind"] == "glass" and min(material["attenuation"]) < 1


# Within another glass what bends light is the ratio of the two.
def glass(material, outer):
    outside = outer["index"] if outer else 1.0
    shape = {"bsdf": {"type": "dielectric", "int_ior": material["index"], "ext_ior": outside}}
    if absorbing(material):
        shape["interior"] = medium(material)
    if outer and absorbing(outer):
        shape["exterior"] = medium(outer)
    return shape


def surface(material, outer):
    kind = material["kind"]
    black = {"type": "diffuse", "reflectance": rgb([0, 0, 0])}
    if kind == "matt":
        diffuse = {"type": "diffuse", "reflectance": rgb(material["color"])}
        return {"bsdf": {"type": "twosided", "nested": diffuse}}
    if kind == "glowing":
        return {"bsdf": black, "emitter": {"type": "area", "radiance": rgb(material["color"])}}
    if kind == "mirror":
        return {"bsdf": {"type": "twosided", "nested": {"type": "conductor", "material": "none"}}}
    if kind == "pane":
        return {"bsdf": {"type": "thindielectric", "int_ior": material["index"], "ext_ior": 1.0}}
    return glass(material, outer)


def lamp(mi, description):
    radius, candela = description["source_radius"], description["candela"]
    if radius == 0:
        return {"type": "point", "position": description["position"], "intensity": rgb([candela] * 3)}
    radiance = candela / (numpy.pi * radius * radius)
    return {
        "type": "sphere",
        "center": description["position"],
        "radius": radius,
        "emitter": {"type": "area", "radiance": rgb([float(radiance)] * 3)},
    }


def render(mi, scene, folder, samples):
    """Radiance as an array of rows of pixels."""
    materials = scene["materials"]
    has_media = any(m["kind"] == "glass" for m in materials.values())
    depth = max(2, scene["max_depth"] + 1)  # segments of a path
    world = {
        "type": "scene",
        "integrator": {"type": "volpath" if has_media else "path", "max_depth": depth, "rr_depth": 1000},
        "sensor": {
            "type": "perspective",
            "fov": float(numpy.degrees(scene["vertical_fov"])),
            "fov_axis": "y",
            "to_world": mi.ScalarTransform4f().look_at(scene["eye"], scene["target"], [0, 1, 0]),
            "film": {
                "type": "hdrfilm",
                "width": scene["side"],
                "height": scene["side"],
                "rfilter": {"type": "box"},
                "component_format": "float32",
            },
            "sampler": {"type": "multijitter", "sample_count": samples},
        },
    }
    for number, mesh in enumerate(scene["meshes"]):
        path = folder / f"{scene['name']}_{number}.ply"
        write_ply(path, mesh)
        outer = materials["outer"] if mesh["material"] == "inner" else None
        shape = {"type": "ply", "filename": str(path), "face_normals": True}
        shape.update(surface(materials[mesh["material"]], outer))
        world[f"mesh_{number}"] = shape
    if scene["ambient"] > 0:
        world["sky"] = {"type": "constant", "radiance": rgb([scene["ambient"]] * 3)}
    for number, description in enumerate(scene["lamps"]):
        world[f"lamp_{number}"] = lamp(mi, description)
    return numpy.array(mi.render(mi.load_dict(world)))[:, :, :3]


def absorbs(scene):
    return any(absorbing(material) for material in scene["materials"].values())


def in_blocks(picture):
    side = picture.shape[0] // BLOCK
    return picture.reshape(side, BLOCK, side, BLOCK, 3).mean(axis=(1, 3))


def write_picture(mi, path, ours, theirs):
    pictures = [ours, theirs, 10 * numpy.abs(ours - theirs)]
    beside = numpy.concatenate(pictures, axis=1).astype(numpy.float32)
    mi.util.write_bitmap(str(path), beside)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--program", default="build/release/bin/truth_scenes", help="renders ours")
    parser.add_argument("--out", default="truth", help="folder to write to")
    parser.add_argument("--samples", type=int, default=1024, help="of Mitsuba, a pixel")
    parser.add_argument("--scene", nargs="*", help="names; default: all")
    arguments = parser.parse_args()
    try:
        import mitsuba as mi
    except ImportError:
        sys.exit("compare.py needs Mitsuba: pip install mitsuba")
    mi.set_variant("scalar_rgb")
    folder = pathlib.Path(arguments.out)
    subprocess.run([arguments.program, "--out", str(folder)], check=True, stdout=subprocess.DEVNULL)
    print("| scene | what | mean relative difference | pixels that differ by more than 5% |")
    print("| --- | --- | --- | --- |")
    failed = False
    for path in sorted(folder.glob("*.json")):
        scene = json.loads(path.read_text())
        if arguments.scene and scene["name"] not in arguments.scene:
            continue
        side = scene["side"]
        ours = numpy.fromfile(path.with_suffix(".f32"), dtype=numpy.float32).reshape(side, side, 3)
        theirs = render(mi, scene, folder, arguments.samples)
        write_picture(mi, path.with_suffix(".png"), ours, theirs)
        if absorbs(scene):
            ours, theirs = in_blocks(ours), in_blocks(theirs)
        least = 0.01 * theirs.mean()
        relative = numpy.abs(ours - theirs) / numpy.maximum(theirs, least)
        per_pixel = relative.mean(axis=2)
        mean = per_pixel.mean()
        failed |= bool(mean > BOUND)
        print(f"| {scene['name']} | {scene['what']} | {100 * mean:.2f}% | {100 * (per_pixel > 0.05).mean():.1f}% |", flush=True)
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
