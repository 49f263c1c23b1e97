#!/usr/bin/env python3
"""Unwraps meshes with `unwrapd unwrap`, uvunwrap and xatlas and has an independent judge measure the atlases.

    python3 tests/bench/atlas.py --judge path/to/uvmetrics.py --unwrapd target/release/unwrapd MESH... [-- --packing tight]

JUDGE is a program `JUDGE FILE --json` that prints its measures of a file's UVs. The interpreter needs numpy, uvunwrap and xatlas
from PyPI, open3d for `--peers UVAtlas`, and bpy for `--peers Blender`, whose Smart UV Project it is. Every tool gets the same mesh: positions in f32, welded where equal, faces without
three corners dropped. What stands after `--` goes to unwrapd. uvunwrap runs twice: as it is, and with the padding that leaves
the gap of 2 texels that unwrapd keeps, so that the shares of the square compare. xatlas gets the mesh with a diagonal of 1000,
because what it takes for an area of zero does not scale.

Per mesh and tool: charts, seam length over the square root of the area, mean symmetric Dirichlet energy, share of the square,
faults (faces flipped or without area, pairs that overlap), smallest gap of two charts in texels at 1024, seconds of the
processors, and of the wall for packing; then means, medians and ratios to uvunwrap.
"""
import argparse
import json
import resource
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np


def read_obj(path):
    """Positions, welded where equal in f32, triangles with three corners, and their UVs (faces, 3, 2)."""
    positions, places, faces = [], [], []
    for line in path.read_text().splitlines():
        kind, *words = line.split() or [""]
        if kind == "v":
            positions.append([float(w) for w in words[:3]])
        elif kind == "vt":
            places.append([float(w) for w in words[:2]])
        elif kind == "f":
            corners = [[int(i) - 1 for i in w.split("/")[:2]] for w in words]
            faces += [[corners[0], corners[k], corners[k + 1]] for k in range(1, len(corners) - 1)]
    positions, index = np.unique(np.array(positions, np.float32), axis=0, return_inverse=True)
    faces = np.array(faces)
    uv, faces = np.array(places)[faces[..., 1]], index.reshape(-1)[faces[..., 0]]
    proper = (faces[:, 0] != faces[:, 1]) & (faces[:, 1] != faces[:, 2]) & (faces[:, 2] != faces[:, 0])
    return positions, faces[proper], uv[proper]


def write_obj(path, positions, faces, uv):
    """`uv`: (faces, 3, 2)."""
    with open(path, "w", encoding="ascii") as out:
        out.writelines(f"v {x!r} {y!r} {z!r}\n" for x, y, z in positions.astype(float).tolist())
        out.writelines(f"vt {u!r} {v!r}\n" for u, v in uv.reshape(-1, 2).tolist())
        for i, (a, b, c) in enumerate((faces + 1).tolist()):
            out.write(f"f {a}/{3 * i + 1} {b}/{3 * i + 2} {c}/{3 * i + 3}\n")


def squared(uv, atlas):
    """Of a texture that is wider than high, or the other way, the smallest square around it."""
    return uv * np.array([atlas.width, atlas.height]) / max(atlas.width, atlas.height)


def run_uvunwrap(positions, faces, padding):
    import uvunwrap
    mesh = uvunwrap.Mesh(positions, faces.astype(np.uint32))
    atlas = uvunwrap.generate([mesh], **padding)
    return squared(np.array(atlas.meshes[0].corner_uvs).reshape(-1, 3, 2), atlas)


def run_xatlas(positions, faces):
    import xatlas
    atlas = xatlas.Atlas()
    scale = 1000 / np.linalg.norm(np.ptp(positions, axis=0))
    atlas.add_mesh(positions * scale.astype(np.float32), faces.astype(np.uint32))
    atlas.generate()
    _, indices, uv = atlas[0]
    return squared(np.asarray(uv, float)[indices], atlas)


def run_uvatlas(positions, faces):
    import open3d
    mesh = open3d.t.geometry.TriangleMesh(open3d.core.Tensor(positions), open3d.core.Tensor(faces))
    mesh.compute_uvatlas(size=1024, gutter=2.0)
    return mesh.triangle.texture_uvs.numpy()


def run_blender(positions, faces):
    import bpy
    bpy.ops.wm.read_factory_settings(use_empty=True)
    mesh = bpy.data.meshes.new("mesh")
    mesh.from_pydata(positions.tolist(), [], faces.tolist())
    thing = bpy.data.objects.new("object", mesh)
    bpy.context.collection.objects.link(thing)
    bpy.context.view_layer.objects.active = thing
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.uv.smart_project()
    bpy.ops.object.mode_set(mode="OBJECT")
    uv = np.empty(2 * len(mesh.loops), np.float32)
    mesh.uv_layers.active.uv.foreach_get("vector", uv)
    return uv.reshape(-1, 3, 2).astype(float)


PEERS = {
    "uvunwrap": lambda v, f: run_uvunwrap(v, f, {}),
    "uvunwrap, gap 2": lambda v, f: run_uvunwrap(v, f, {"padding": 1}),
    "xatlas": run_xatlas,
    "UVAtlas": run_uvatlas,
    "Blender": run_blender,
}


def judged(judge, path):
    done = subprocess.run([sys.executable, judge, path, "--json"], capture_output=True, text=True)
    m = json.loads(done.stdout)
    faults = sum(m[key] for key in ("flipped", "uv_degenerate", "uv_collapsed", "overlap_pairs"))
    return {"faults": faults, "charts": m["charts"], "seam": m["seam_length"] / m["area_3d"] ** 0.5, "E": m["sym_dirichlet_mean"],
            "fill": m["pack_square"], "gap": m.get("gap_texels_1024"), "spread": m["density_p95_over_p5"]}


def cpu(who):
    usage = resource.getrusage(who)
    return usage.ru_utime + usage.ru_stime


def ours(arguments, mesh, folder):
    out = folder / "ours.obj"
    begin = cpu(resource.RUSAGE_CHILDREN)
    done = subprocess.run([arguments.unwrapd, "unwrap", mesh, "-o", out, *arguments.options],
                          check=True, capture_output=True, text=True)
    seconds = cpu(resource.RUSAGE_CHILDREN) - begin
    stages = {words[2]: float(words[0]) for line in (done.stderr + done.stdout).splitlines()
              if len(words := line.split()) > 2 and words[1] == "s"}
    return judged(arguments.judge, out) | {"cpu": seconds, "pack": stages["write"] - stages["pack"]}


def theirs(arguments, name, positions, faces, folder):
    begin = cpu(resource.RUSAGE_SELF)
    uv = PEERS[name](positions, faces)
    seconds = cpu(resource.RUSAGE_SELF) - begin
    out = folder / "theirs.obj"
    write_obj(out, positions, faces, uv)
    return judged(arguments.judge, out) | {"cpu": seconds, "pack": None}


def show(mesh, tool, row):
    number = lambda key, digits: "" if row[key] is None else f"{row[key]:.{digits}f}"
    print(f"{mesh:20} | {tool:16} | {row['charts']:5} | {row['seam']:6.2f} | {row['E']:.3f} | {row['fill']:.3f} | "
          f"{row['faults']:4} | {number('gap', 1):>5} | {row['cpu']:6.2f} | {number('pack', 2)}", flush=True)


def summarize(rows):
    print()
    for tool in rows[0]:
        mean = statistics.mean(row[tool]["fill"] for row in rows)
        line = f"{tool}: fill mean {mean:.3f}, least {min(row[tool]['fill'] for row in rows):.3f}"
        if tool != "unwrapd":
            for key in ("charts", "seam"):
                ratios = [row["unwrapd"][key] / row[tool][key] for row in rows]
                line += f"; our {key} over its: median {statistics.median(ratios):.2f}, most {max(ratios):.2f}"
            least = min(row["unwrapd"]["fill"] - row[tool]["fill"] for row in rows)
            line += f"; our fill less its: least {least:+.3f}"
        print(line)
    for key in ("E", "cpu", "pack"):
        values = [row["unwrapd"][key] for row in rows]
        print(f"unwrapd {key}: median {statistics.median(values):.3f}, most {max(values):.3f}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("meshes", nargs="+", type=Path)
    parser.add_argument("--judge", required=True, type=Path)
    parser.add_argument("--unwrapd", default="target/release/unwrapd")
    parser.add_argument("--peers", nargs="+", choices=PEERS, default=list(PEERS)[:3])
    split = sys.argv.index("--") if "--" in sys.argv else len(sys.argv)
    arguments = parser.parse_args(sys.argv[1:split])
    arguments.options = sys.argv[split + 1:]
    rows = []
    print("mesh | tool | charts | seam | E | fill | faults | gap | cpu s | packing s")
    with tempfile.TemporaryDirectory() as folder:
        for mesh in arguments.meshes:
            folder = Path(folder)
            row = {"unwrapd": ours(arguments, mesh, folder)}
            positions, faces, _ = read_obj(folder / "ours.obj")
            for name in arguments.peers:
                row[name] = theirs(arguments, name, positions, faces, folder)
            for tool, figures in row.items():
                show(mesh.stem, tool, figures)
            rows.append(row)
    summarize(rows)


if __name__ == "__main__":
    main()
