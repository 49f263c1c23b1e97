#!/usr/bin/env python3
"""Unwraps meshes that other tools hang on or shatter: crowds of components, one flat chart, needles, walls that meet.

    python3 tests/bench/crowds.py --judge path/to/uvmetrics.py --unwrapd target/release/unwrapd [FILE...]

Makes the meshes itself, unwraps them and the given files with the default command, and has the judge look at what was written.
The interpreter needs numpy. Per mesh: faces, share of edges with more than two faces, charts, seconds of the wall and of the
processors, mean symmetric Dirichlet energy, share of the square. Exits with 1 if a run fails or if a face is flipped,
degenerate, or overlaps another.
"""
import argparse
import json
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np


def grid(n, m, width=1.0, height=1.0):
    """Quads of a flat sheet, two triangles each."""
    x, y = np.meshgrid(np.linspace(0, width, n + 1), np.linspace(0, height, m + 1), indexing="ij")
    vertices = np.stack([x.ravel(), y.ravel(), np.zeros(x.size)], 1)
    corner = (np.arange(n)[:, None] * (m + 1) + np.arange(m)).ravel()
    a, b, c, d = corner, corner + m + 1, corner + m + 2, corner + 1
    return vertices, np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)])


def components(n=10_000):
    """Tetrahedra of random shape and size."""
    random = np.random.default_rng(1)
    sizes = random.lognormal(0, 1, n)[:, None, None]
    corners = random.normal(size=(n, 4, 3)) * sizes + 20 * random.normal(size=(n, 1, 3))
    a, b, c, d = (corners[:, i] for i in range(4))
    inside_out = np.einsum("ij,ij->i", np.cross(b - a, c - a), d - a) < 0
    corners[inside_out] = corners[inside_out][:, [1, 0, 2, 3]]
    faces = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]])
    return corners.reshape(-1, 3), (4 * np.arange(n)[:, None, None] + faces).reshape(-1, 3)


def needles(n=500):
    """Strips a thousand times as long as wide."""
    vertices, faces = grid(40, 1, 1.0, 1e-3)
    angles = np.random.default_rng(2).uniform(0, np.pi, n)
    turned = [np.stack([np.cos(t) * vertices[:, 0] - np.sin(t) * vertices[:, 1],
                        np.sin(t) * vertices[:, 0] + np.cos(t) * vertices[:, 1],
                        np.full(len(vertices), 1e-2 * i)], 1) for i, t in enumerate(angles)]
    return np.concatenate(turned), np.concatenate([faces + i * len(vertices) for i in range(n)])


def walls(n=16):
    """All walls of n^3 rooms, half of them with a vertex in the middle: most edges along the axes have four faces."""
    index = np.arange((n + 1) ** 3).reshape((n + 1,) * 3)
    vertices = np.stack(np.meshgrid(*[np.arange(n + 1.0)] * 3, indexing="ij"), -1).reshape(-1, 3)
    quads = []
    for axis in range(3):
        flat = np.moveaxis(index, axis, 0)
        quads.append(np.stack([flat[:, :-1, :-1], flat[:, 1:, :-1], flat[:, 1:, 1:], flat[:, :-1, 1:]], -1).reshape(-1, 4))
    quads = np.concatenate(quads)
    plain, fans = quads[::2], quads[1::2]
    middles = len(vertices) + np.arange(len(fans))
    sides = [np.stack([fans[:, k], fans[:, (k + 1) % 4], middles], 1) for k in range(4)]
    vertices = np.concatenate([vertices, vertices[fans].mean(1)])
    return vertices, np.concatenate([plain[:, [0, 1, 2]], plain[:, [0, 2, 3]], *sides])


MADE = {"10,000 components": components, "one flat chart": lambda: grid(200, 200), "needles": needles, "walls": walls}


def nonmanifold(faces):
    """The share of the edges that have more than two faces."""
    edges = np.sort(np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]), axis=1)
    _, counts = np.unique(edges, axis=0, return_counts=True)
    return np.mean(counts > 2)


def write(path, vertices, faces):
    lines = [f"v {x:.9g} {y:.9g} {z:.9g}\n" for x, y, z in vertices] + [f"f {a} {b} {c}\n" for a, b, c in faces + 1]
    path.write_text("".join(lines))


def row(name, mesh, share, arguments, out):
    """Prints a mesh's row; whether all is well with it."""
    before, began = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
    run = subprocess.run([arguments.unwrapd, "unwrap", mesh, "-o", out], capture_output=True, text=True)
    wall, after = time.perf_counter() - began, resource.getrusage(resource.RUSAGE_CHILDREN)
    seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    if run.returncode:
        print(f"{name} | failed: {run.stderr.strip().splitlines()[-1:]}", flush=True)
        return False
    command = [sys.executable, arguments.judge, out, "--json"]
    judged = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    measures = json.loads(judged)
    bad = {key: measures[key] for key in ("flipped", "uv_degenerate", "overlap_pairs_exact") if measures[key]}
    print(f"{name} | {measures['faces']} | {share} | {measures['charts']} | {wall:.1f} | {seconds:.1f} | "
          f"{measures['sym_dirichlet_mean']:.3f} | {measures['pack_unit']:.3f} | {bad or 'valid'}", flush=True)
    return not bad


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("files", nargs="*", type=Path)
    parser.add_argument("--judge", required=True, type=Path)
    parser.add_argument("--unwrapd", default="target/release/unwrapd")
    arguments = parser.parse_args()
    print("mesh | faces | non-manifold edges | charts | s | CPU s | E | fill | remark")
    with tempfile.TemporaryDirectory() as folder:
        mesh, out, rows = Path(folder) / "mesh.obj", Path(folder) / "out.glb", []
        for name, make in MADE.items():
            vertices, faces = make()
            write(mesh, vertices, faces)
            rows.append(row(name, mesh, f"{nonmanifold(faces):.2f}", arguments, out))
        rows += [row(file.stem, file, "-", arguments, out) for file in arguments.files]
    return 0 if all(rows) else 1


if __name__ == "__main__":
    sys.exit(main())
