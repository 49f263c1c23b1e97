#!/usr/bin/env python3
"""Packs the islands of files with `unwrapd repack`, Blender, xatlas and sparrow, at one measured gap.

    python3 tests/bench/packers.py --judge path/to/uvmetrics.py --unwrapd target/release/unwrapd \\
        --python blender=py313/bin/python --python xatlas=py312/bin/python --python sparrow=py312/bin/python FILE...

FILE is an OBJ or glTF. A file without UVs is unwrapped first, and its row says how full that page is. `--python TOOL=PATH` names
an interpreter that can import the tool's package (`bpy`, `xatlas`, or `spyrrow` with `shapely`); a tool without one is left out.
JUDGE is a module with `load` and `evaluate`.

Every tool gets the islands at the scale at which they lie, may turn them to any angle, and is run again with another margin until
the smallest gap between two islands, measured on the result, is 2 texels of a used square of 1,024 or a little more. Islands that
lie on each other are packed apart.

Per file: islands, and per tool the share of the used square that is covered and the seconds of the processor of its last run,
the interpreter included.
"""
import argparse
import importlib.util
import json
import resource
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

GAP = 2.0
# Gaps that count as equal: what is asked for less the rounding of the tools, and that plus a tenth.
NEAR = (0.99 * GAP, 1.1 * GAP)
# Runs of a tool with different margins, and seconds after which one is killed.
RUNS = 5
LIMIT = 300
TOOLS = ["blender", "xatlas", "sparrow"]
# Seconds that sparrow has in all; two searches of 2 s first look for the height at which the strip becomes a square.
SPARROW_SECONDS = 10


def blender(uv, island, margin):
    import bpy
    import numpy as np

    bpy.ops.wm.read_factory_settings(use_empty=True)
    key = np.column_stack([np.repeat(island, 3), uv.reshape(-1, 2)])
    corners, index = np.unique(key, axis=0, return_inverse=True)
    mesh = bpy.data.meshes.new("mesh")
    vertices = np.column_stack([corners[:, 1:], corners[:, 0]])
    mesh.from_pydata(vertices.tolist(), [], index.reshape(-1, 3).tolist())
    layer = mesh.uv_layers.new(name="UVMap")
    layer.data.foreach_set("uv", uv.reshape(-1).astype(np.float32))
    body = bpy.data.objects.new("body", mesh)
    bpy.context.collection.objects.link(body)
    bpy.context.view_layer.objects.active = body
    body.select_set(True)
    bpy.context.scene.tool_settings.use_uv_select_sync = True
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.uv.pack_islands(
        rotate=True, rotate_method="ANY", scale=True, merge_overlap=False, margin_method="FRACTION",
        margin=margin / 1024, shape_method="CONCAVE",
    )
    bpy.ops.object.mode_set(mode="OBJECT")
    packed = np.empty(uv.size, np.float32)
    mesh.uv_layers[0].data.foreach_get("uv", packed)
    return packed.reshape(uv.shape).astype(float)


def xatlas(uv, island, margin):
    import numpy as np
    import xatlas as package

    key = np.column_stack([np.repeat(island, 3), uv.reshape(-1, 2)])
    corners, index = np.unique(key, axis=0, return_inverse=True)
    atlas = package.Atlas()
    atlas.add_uv_mesh(corners[:, 1:].astype(np.float32), index.reshape(-1, 3).astype(np.uint32))
    pack = package.PackOptions()
    pack.resolution = 1024
    pack.padding = max(int(round(margin)), 0)
    pack.bruteForce = True
    atlas.generate(pack_options=pack)
    _, faces, packed = atlas.get_mesh(0)
    packed = packed * (atlas.width, atlas.height)
    return packed[faces.reshape(-1, 3)].astype(float)


def sparrow(uv, island, margin):
    import math

    import numpy as np
    import spyrrow
    from shapely.geometry import Polygon
    from shapely.ops import unary_union

    span = np.ptp(uv.reshape(-1, 2), axis=0).max()
    uv = (uv - uv.reshape(-1, 2).mean(axis=0)) / span
    area = 0
    outlines, centers = [], []
    for k in range(island.max() + 1):
        triangles = uv[island == k]
        center = triangles.reshape(-1, 2).mean(axis=0)
        # A slit closes and a border that touches itself becomes one outline.
        outline = unary_union([Polygon(t - center).buffer(1e-4, join_style=2) for t in triangles])
        outline = outline.buffer(1e-3).buffer(-1e-3)
        if outline.geom_type != "Polygon":
            outline = outline.convex_hull
        outline = Polygon(outline.exterior).simplify(2e-4)
        area += outline.area
        outlines.append(list(outline.exterior.coords)[:-1])
        centers.append(center)

    def solve(height, seconds):
        items = [spyrrow.Item(str(k), outline, 1, None) for k, outline in enumerate(outlines)]
        config = spyrrow.StripPackingConfig(
            early_termination=False, total_computation_time=seconds, num_workers=1, seed=1,
            min_items_separation=margin / 1024 * height,
        )
        return spyrrow.StripPackingInstance("", height, items).solve(config)

    height = math.sqrt(area / 0.8)
    for seconds in (2, 2, SPARROW_SECONDS - 4):
        solution = solve(height, seconds)
        if seconds == 2:
            height = math.sqrt(height * solution.width)
    packed = uv.copy()
    for item in solution.placed_items:
        k, angle = int(item.id), math.radians(item.rotation)
        turn = np.array([[math.cos(angle), math.sin(angle)], [-math.sin(angle), math.cos(angle)]])
        packed[island == k] = (uv[island == k] - centers[k]) @ turn + item.translation
    return packed


def work(tool, margin, given, out):
    """Runs one tool in this process: the islands of GIVEN are written to OUT as they are packed."""
    import numpy as np

    with np.load(given) as file:
        packed = {"blender": blender, "xatlas": xatlas, "sparrow": sparrow}[tool](file["uv"], file["island"], float(margin))
    np.save(out, packed)


def module(path):
    spec = importlib.util.spec_from_file_location(Path(path).stem, path)
    loaded = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(loaded)
    return loaded


def timed(command):
    """The end of a command, which is killed after LIMIT seconds, and the seconds of the processor that it took."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(["timeout", str(LIMIT), *command], capture_output=True, text=True, check=False)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return done, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def measured(judge, vertices, faces, uv):
    """Covered share of the used square, and the smallest gap in texels of it."""
    import numpy as np

    corners = uv.reshape(-1, 2)
    low, side = corners.min(axis=0), np.ptp(corners, axis=0).max()
    result = judge.evaluate(vertices, faces, (uv - low) / side, res=2048, pairs=False)
    gap = result.get("gap_texels_1024")
    return result["pack_unit"], gap if gap is not None else float("inf")


def at_gap(run, step=0.0):
    """The fullest page of those whose gap is wide enough, over margins that are halved in; None if there is none."""
    best, margin, low, high = None, GAP, 0.0, None
    for _ in range(RUNS):
        result = run(margin)
        if result is None:
            break
        fill, gap, seconds = result
        if gap >= NEAR[0] and (best is None or fill > best[0]):
            best = (fill, gap, seconds)
        if NEAR[0] <= gap <= NEAR[1]:
            break
        if gap < GAP:
            low, next_margin = margin, margin + 1.02 * (GAP - gap) if high is None else (margin + high) / 2
        else:
            high, next_margin = margin, (low + margin) / 2
        if step:
            next_margin = step * round(next_margin / step + (0.25 if gap < GAP else -0.25))
        if next_margin in (low, high):
            break
        margin = next_margin
    return best


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--judge", required=True)
    parser.add_argument("--unwrapd", required=True)
    parser.add_argument("--python", action="append", default=[], metavar="TOOL=PATH")
    parser.add_argument("--json", metavar="FILE", help="also write the numbers there")
    parser.add_argument("files", nargs="+")
    options = parser.parse_args()
    import numpy as np

    judge = module(options.judge)
    islands = module(Path(__file__).parent / "repack.py").islands
    python = dict(entry.split("=", 1) for entry in options.python)
    tools = [tool for tool in TOOLS if tool in python]
    rows = []
    print("file | islands | unwrap | repack fill, gap, s | " + " | ".join(f"{tool} fill, gap, s" for tool in tools), flush=True)
    for path in options.files:
        with tempfile.TemporaryDirectory() as folder:
            row = {"file": Path(path).name}
            given, out, arrays = path, f"{folder}/out.obj", f"{folder}/given.npz"
            loaded = judge.load(path) if Path(path).suffix in (".obj", ".glb", ".gltf") else None
            if loaded is None or loaded[0][3] is None:
                given = f"{folder}/given.obj"
                done, _ = timed([options.unwrapd, "unwrap", path, "-o", given])
                if not Path(given).exists():
                    print(f"{row['file']} | {done.stderr.strip().splitlines()[-1]}", flush=True)
                    continue
                loaded = judge.load(given)
                row["unwrap"] = measured(judge, *loaded[0][1:])[0]
            elif Path(path).suffix != ".obj":
                out = f"{folder}/out.glb"
            _, vertices, faces, uv = loaded[0]
            # Vertices that the file splits for normals are one.
            island = islands(judge.weld_positions(vertices, faces)[1], uv)
            row["islands"] = int(island.max() + 1)
            np.savez(arrays, uv=uv, island=island)

            def ours(margin):
                done, seconds = timed([options.unwrapd, "repack", given, "-o", out, "--rotate", "any", "--stack", "off",
                                       "--resolution", "1024", "--padding", str(round(margin))])
                if not Path(out).exists():
                    print(done.stderr.strip(), file=sys.stderr)
                    return None
                return *measured(judge, *judge.load(out)[0][1:]), seconds

            def theirs(tool):
                def run(margin):
                    packed = f"{folder}/packed.npy"
                    Path(packed).unlink(missing_ok=True)
                    done, seconds = timed([python[tool], __file__, "--work", tool, str(margin), arrays, packed])
                    if not Path(packed).exists():
                        print(done.stderr.strip(), file=sys.stderr)
                        return None
                    return *measured(judge, vertices, faces, np.load(packed)), seconds
                return run

            row["repack"] = at_gap(ours, 1.0)
            for tool in tools:
                row[tool] = at_gap(theirs(tool), 1.0 if tool == "xatlas" else 0.0)
            rows.append(row)
            shown = ["-" if row[tool] is None else "{:.3f} {:.2f} {:.2f}".format(*row[tool]) for tool in ["repack", *tools]]
            unwrap = f"{row['unwrap']:.3f}" if "unwrap" in row else "-"
            print(f"{row['file']} | {row['islands']} | {unwrap} | {' | '.join(shown)}", flush=True)
    for other in ["unwrap", *tools]:
        pairs = [(row["repack"][0], row[other] if other == "unwrap" else row[other][0])
                 for row in rows if row.get(other) is not None and row["repack"] is not None]
        if pairs:
            gains = [ours - theirs for ours, theirs in pairs]
            print(f"repack less {other}: median {statistics.median(gains):+.3f}, lowest {min(gains):+.3f}, "
                  f"below on {sum(gain < 0 for gain in gains)} of {len(gains)}")
    if options.json:
        Path(options.json).write_text(json.dumps(rows, indent=1))


if __name__ == "__main__":
    if sys.argv[1:2] == ["--work"]:
        work(*sys.argv[2:6])
    else:
        main()
