#!/usr/bin/env python3
"""Unwraps meshes with xatlas and with unwrapd and judges both by its own definitions. See README.md."""
import argparse
import json
import os
import subprocess
import sys
import tempfile
import time
import venv
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
PACKAGES = ["xatlas==0.0.11", "numpy<3"]


def in_own_environment():
    """Starts this script again inside an environment that has xatlas and numpy."""
    home = HERE / ".venv"
    python = home / "bin" / "python"
    if Path(sys.prefix) == home:
        return
    if not (home / "ready").exists():
        venv.create(home, with_pip=True, clear=True)
        subprocess.run([python, "-m", "pip", "install", "--quiet", *PACKAGES], check=True)
        (home / "ready").touch()
    os.execv(python, [str(python), *sys.argv])


def read_obj(path):
    """Positions, triangles, per-corner UVs (or None); polygons are fans."""
    import numpy as np
    v, vt, f, ft = [], [], [], []
    for line in open(path, encoding="utf-8", errors="replace"):
        word, *rest = line.split() or [""]
        if word == "v":
            v.append([float(x) for x in rest[:3]])
        elif word == "vt":
            vt.append([float(x) for x in rest[:2]])
        elif word == "f":
            corners = [c.split("/") for c in rest]
            ids = [(int(c[0]), int(c[1]) if len(c) > 1 and c[1] else 0) for c in corners]
            ids = [(a - 1 if a > 0 else a + len(v), b - 1 if b > 0 else b + len(vt)) for a, b in ids]
            for k in range(1, len(ids) - 1):
                f.append([ids[0][0], ids[k][0], ids[k + 1][0]])
                ft.append([ids[0][1], ids[k][1], ids[k + 1][1]])
    V = np.array(v, np.float64)
    F = np.array(f, np.int64).reshape(-1, 3)
    UV = np.array(vt, np.float64)[np.array(ft, np.int64)] if vt else None
    return V, F, UV


def weld(V, F):
    """Float32 positions, bit-equal ones merged, faces that name one twice dropped."""
    import numpy as np
    W, inverse = np.unique(V.astype(np.float32) + 0.0, axis=0, return_inverse=True)
    F = inverse.reshape(-1)[F]
    keep = (F[:, 0] != F[:, 1]) & (F[:, 1] != F[:, 2]) & (F[:, 2] != F[:, 0])
    return W.astype(np.float64), F[keep]


def roots(n, a, b):
    """Representative of every element after joining a[i] with b[i]."""
    parent = list(range(n))

    def find(i):
        while parent[i] != i:
            parent[i] = parent[parent[i]]
            i = parent[i]
        return i

    for i, j in zip(a, b):
        parent[find(i)] = find(j)
    return [find(i) for i in range(n)]


def judge(V, F, UV):
    """The measures of one atlas; V (n,3), F (m,3), UV (m,3,2)."""
    import numpy as np
    P = V[F]
    e1, e2 = P[:, 1] - P[:, 0], P[:, 2] - P[:, 0]
    area = 0.5 * np.linalg.norm(np.cross(e1, e2), axis=1)
    d1, d2 = UV[:, 1] - UV[:, 0], UV[:, 2] - UV[:, 0]
    signed = 0.5 * (d1[:, 0] * d2[:, 1] - d1[:, 1] * d2[:, 0])

    edges, links_a, links_b, seam = {}, [], [], 0.0
    for face in range(len(F)):
        for c in range(3):
            i, j = F[face, c], F[face, (c + 1) % 3]
            ends = [(i, tuple(UV[face, c])), (j, tuple(UV[face, (c + 1) % 3]))]
            edges.setdefault((min(i, j), max(i, j)), {}).setdefault(tuple(sorted(ends)), []).append(face)
    for (i, j), sides in edges.items():
        seam += (len(sides) - 1) * np.linalg.norm(V[i] - V[j])
        for faces in sides.values():
            links_a += faces[:-1]
            links_b += faces[1:]
    _, chart = np.unique(roots(len(F), links_a, links_b), return_inverse=True)
    majority = np.sign(np.bincount(chart, weights=signed))

    good = (area > 1e-14 * np.sum(area)) & (signed != 0)
    scale = np.sqrt(area.sum() / np.abs(signed).sum())
    length = np.linalg.norm(e1[good], axis=1)
    x = np.einsum("ij,ij->i", e1[good], e2[good]) / length
    y = 2 * area[good] / length
    ju = d1[good] * scale / length[:, None]
    jv = (d2[good] * scale - ju * x[:, None]) / y[:, None]
    square = (ju**2).sum(1) + (jv**2).sum(1)
    det = ju[:, 0] * jv[:, 1] - ju[:, 1] * jv[:, 0]
    dirichlet = square * (1 + det**-2)
    inside = UV.min() >= -1e-6 and UV.max() <= 1 + 1e-6
    return {
        "charts": int(chart.max()) + 1,
        "seam": seam / np.sqrt(area.sum()),
        "sym_dirichlet": float(np.average(dirichlet, weights=area[good])),
        "flipped": int((np.sign(signed) * majority[chart] < 0).sum()),
        "degenerate": int(((signed == 0) & (area > 0)).sum()),
        "packed": float(np.abs(signed).sum()) if inside else float("nan"),
    }


def with_xatlas(V, F):
    """Runs in a process of its own, so that its time is the whole process' time."""
    import numpy as np
    with tempfile.TemporaryDirectory() as folder:
        mesh, out = Path(folder, "in.npz"), Path(folder, "out.npz")
        np.savez(mesh, V=V, F=F)
        begin = time.perf_counter()
        subprocess.run([sys.executable, __file__, "--xatlas", mesh, out], check=True)
        seconds = time.perf_counter() - begin
        return np.load(out)["UV"].astype(np.float64), seconds


def xatlas_process(mesh, out):
    import numpy as np
    import xatlas
    data = np.load(mesh)
    atlas = xatlas.Atlas()
    atlas.add_mesh(data["V"].astype(np.float32), data["F"].astype(np.uint32))
    pack = xatlas.PackOptions()
    pack.padding, pack.resolution = 2, 1024
    atlas.generate(pack_options=pack)
    _, faces, uv = atlas[0]
    np.savez(out, UV=uv[faces])


def with_unwrapd(program, V, F):
    with tempfile.TemporaryDirectory() as folder:
        mesh, out = Path(folder, "in.obj"), Path(folder, "out.obj")
        with open(mesh, "w", encoding="ascii") as file:
            file.writelines(f"v {x!r} {y!r} {z!r}\n" for x, y, z in V.tolist())
            file.writelines(f"f {a} {b} {c}\n" for a, b, c in (F + 1).tolist())
        begin = time.perf_counter()
        subprocess.run([program, "unwrap", mesh, "-o", out], check=True, capture_output=True)
        seconds = time.perf_counter() - begin
        return read_obj(out)[2], seconds


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("meshes", nargs="+", type=Path, help="OBJ files")
    parser.add_argument("--unwrapd", default=ROOT / "target/release/unwrapd", type=Path)
    parser.add_argument("--json", type=Path, help="write the rows here too")
    arguments = parser.parse_args()
    in_own_environment()
    rows = []
    print("| mesh | faces | tool | charts | seam/√area | sym. Dirichlet | flipped | zero area | packed | s |")
    print("|---|--:|---|--:|--:|--:|--:|--:|--:|--:|")
    for path in arguments.meshes:
        V, F = weld(*read_obj(path)[:2])
        for tool, run in (("xatlas", with_xatlas), ("unwrapd", lambda v, f: with_unwrapd(arguments.unwrapd, v, f))):
            UV, seconds = run(V, F)
            row = {"mesh": path.stem, "faces": len(F), "tool": tool, **judge(V, F, UV), "seconds": seconds}
            rows.append(row)
            print(f"| {row['mesh']} | {row['faces']} | {tool} | {row['charts']} | {row['seam']:.1f} "
                  f"| {row['sym_dirichlet']:.3f} | {row['flipped']} | {row['degenerate']} | {row['packed']:.3f} "
                  f"| {seconds:.2f} |", flush=True)
    if arguments.json:
        arguments.json.write_text(json.dumps(rows, indent=1))


if __name__ == "__main__":
    if sys.argv[1:2] == ["--xatlas"]:
        xatlas_process(*sys.argv[2:4])
    else:
        main()
