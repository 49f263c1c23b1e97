#!/usr/bin/env python3
"""Unwraps each mesh at several scales, rotated, and with its vertices and faces in other orders, and compares the cuts.

    python3 tests/bench/invariance.py --unwrapd target/release/unwrapd [--scales 5 --rotations 3 --orders 3] MESH...

The interpreter needs numpy and trimesh. All variants are combined: 45 unwraps of each mesh as it stands. Per mesh: charts and seam
(a share of the square root of the area) at the median; the share of variants whose charts differ by at most one from the median;
the median and the largest difference of the seam from its median. Each run has one thread, two run at once.
"""
import argparse
import json
import statistics
import subprocess
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import trimesh

SCALES = [1.0, 1e-3, 37.0, 0.11, 1e4]


def variants(mesh, args):
    """Each scale, rotation and order of a mesh."""
    random = np.random.default_rng(1)
    vertices, faces = np.asarray(mesh.vertices, float), np.asarray(mesh.faces)
    orders = [(np.arange(len(vertices)), np.arange(len(faces)))]
    orders += [(random.permutation(len(vertices)), random.permutation(len(faces))) for _ in range(args.orders - 1)]
    turns = [np.eye(3)] + [trimesh.transformations.random_rotation_matrix(random.random(3))[:3, :3] for _ in range(args.rotations - 1)]
    for number, turn in enumerate(turns):
        for order, (of_vertices, of_faces) in enumerate(orders):
            place = np.empty_like(of_vertices)
            place[of_vertices] = np.arange(len(vertices))
            for scale in SCALES[: args.scales]:
                name = f"scale {scale:g} rotation {number} order {order}"
                yield name, scale * (vertices @ turn.T)[of_vertices], place[faces[of_faces]]


def cut(unwrapd, variant, folder):
    """Charts and seam of a variant."""
    name, vertices, faces = variant
    stem = folder / name.replace(" ", "_")
    trimesh.Trimesh(vertices, faces, process=False).export(f"{stem}.ply")
    command = [unwrapd, "unwrap", f"{stem}.ply", "-o", f"{stem}.glb", "--report", f"{stem}.json", "--threads", "1"]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode:
        return name, None
    measures = json.loads(Path(f"{stem}.json").read_text())["groups"][0]["measures"]
    corners = vertices[faces]
    area = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1).sum() / 2
    for suffix in ("ply", "glb"):
        Path(f"{stem}.{suffix}").unlink()
    return name, (measures["charts"], measures["seam_length"] / np.sqrt(area))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--unwrapd", required=True)
    parser.add_argument("--scales", type=int, default=5)
    parser.add_argument("--rotations", type=int, default=3)
    parser.add_argument("--orders", type=int, default=3)
    parser.add_argument("--each", action="store_true", help="print every variant")
    parser.add_argument("meshes", nargs="+", type=Path)
    args = parser.parse_args()
    within, seams = [], []
    for path in args.meshes:
        mesh = trimesh.load(path, process=False, force="mesh")
        with tempfile.TemporaryDirectory() as folder, ThreadPoolExecutor(2) as pool:
            cuts = list(pool.map(lambda variant: cut(args.unwrapd, variant, Path(folder)), variants(mesh, args)))
        done = [(name, of) for name, of in cuts if of]
        charts = statistics.median(of[0] for _, of in done)
        seam = statistics.median(of[1] for _, of in done)
        off = [abs(of[1] / seam - 1) for _, of in done]
        near = [abs(of[0] - charts) <= 1 for _, of in done]
        within += near
        seams += off
        print(f"{path.stem:24} failed {len(cuts) - len(done)} charts {charts:g} ({min(of[0] for _, of in done)} to "
              f"{max(of[0] for _, of in done)}), within one {np.mean(near):.0%}; seam {seam:.2f}, off {statistics.median(off):.1%}, "
              f"at most {max(off):.1%}", flush=True)
        if args.each:
            for name, of in done:
                print(f"    {name}: {of[0]} charts, seam {of[1]:.2f}")
    print(f"all: within one {np.mean(within):.1%}; seam off {statistics.median(seams):.1%} at the median, at most 5 % on "
          f"{np.mean(np.array(seams) <= 0.05):.1%}")


main()
