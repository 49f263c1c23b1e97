#!/usr/bin/env python3
"""Sets `cargo bench --bench disks` beside libigl's SLIM on the same disks, in one run.

    python3 tests/bench/slim.py [--limit SECONDS] [--reference DIR] [FILE...]

Needs numpy, scipy and libigl from PyPI. Each program maps each disk on one thread, one after the other; energies are means
by area, recomputed from positions. SLIM starts from Tutte's map, which is counted, and ends when a step gains less than 1e-9
of the energy, or at the limit. Seconds are the processor's, so that other work on the machine counts little.

Symmetric Dirichlet (4 for an isometry): "lowest" is the lowest energy that either reached; "own end" is each one's last.
ARAP (0 for an isometry): ours has the barrier and SLIM none. Ours is timed by ARAP and barrier together, to 1 % and 1e-6 of its
own end; SLIM until its ARAP energy alone is within 1 % of ours, and to 1e-6 of its own end if that is as low. DIR holds the
results of the code of the authors of Locally Injective Mappings: the seconds that it took for ARAP with the barrier to within 1 %
of its own end, its set-up left out, on another machine, are set beside ours.
"""
import argparse
import json
import os
import resource
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

import igl
import numpy as np
import scipy.sparse as sp
from scipy.sparse.linalg import spsolve

ROOT = Path(__file__).resolve().parents[2]


def processor():
    usage = resource.getrusage(resource.RUSAGE_SELF)
    return usage.ru_utime + usage.ru_stime


def read(path):
    """Positions, texture coordinates and triangles of an OBJ in which both have the same indices."""
    rows = {"v": [], "vt": [], "f": []}
    for line in Path(path).read_text().splitlines():
        kind, *fields = line.split()
        rows[kind].append([int(field.split("/")[0]) - 1 if kind == "f" else float(field) for field in fields])
    return np.array(rows["v"]), np.array(rows["vt"]), np.array(rows["f"], dtype="i4")


def boundary(triangles):
    """The longest boundary loop."""
    halfedges = {(a, b) for t in triangles.tolist() for a, b in zip(t, t[1:] + t[:1])}
    after = {a: b for a, b in halfedges if (b, a) not in halfedges}
    loops = []
    while after:
        start, loop = next(iter(after)), []
        at = start
        while at in after:
            loop.append(at)
            at = after.pop(at)
        loops.append(loop)
    return max(loops, key=len)


def tutte(positions, triangles):
    """Uniform weights, boundary on a circle by arc length."""
    loop = boundary(triangles)
    lengths = np.linalg.norm(positions[np.roll(loop, -1)] - positions[loop], axis=1)
    angles = 2 * np.pi * np.concatenate([[0], np.cumsum(lengths)[:-1]]) / lengths.sum()
    n = len(positions)
    ends = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    adjacency = sp.coo_matrix((np.ones(len(ends)), ends.T), (n, n)).tocsr()
    adjacency = ((adjacency + adjacency.T) > 0).astype(float)
    laplacian = (sp.diags(np.asarray(adjacency.sum(1)).ravel()) - adjacency).tocsr()
    inner = np.setdiff1d(np.arange(n), loop)
    uv = np.zeros((n, 2))
    uv[loop] = np.column_stack([np.cos(angles), np.sin(angles)])
    uv[inner] = spsolve(laplacian[inner][:, inner].tocsc(), -(laplacian[inner][:, loop] @ uv[loop]))
    return uv


class Metric:
    """Mean symmetric Dirichlet energy of maps of one surface, each at its best size, and how many triangles they flip.

    With the metric tensors G in space and H in the plane, s1^2 + s2^2 = trace(G^-1 H) and s1^2 s2^2 = det H / det G.
    """

    def __init__(self, positions, triangles):
        self.triangles = triangles
        self.space = self.tensor(positions)
        self.area = np.sqrt(self.space[3])

    def tensor(self, x):
        a, b = (x[self.triangles[:, i]] - x[self.triangles[:, 0]] for i in (1, 2))
        aa, ab, bb = (a * a).sum(1), (a * b).sum(1), (b * b).sum(1)
        return aa, ab, bb, aa * bb - ab * ab

    def energy(self, uv):
        (g11, g12, g22, det_g), (h11, h12, h22, det_h) = self.space, self.tensor(uv)
        norm = (g22 * h11 - 2 * g12 * h12 + g11 * h22) / det_g
        stretch, shrink = (np.average(x, weights=self.area) for x in (norm, norm * det_g / det_h))
        # What s^2 * stretch + shrink / s^2 is at the best size s.
        return 2 * np.sqrt(stretch * shrink)

    def arap(self, uv):
        """Mean of (s1 - 1)^2 + (s2 - 1)^2, s2 signed."""
        (g11, g12, g22, det_g), (h11, h12, h22, _) = self.space, self.tensor(uv)
        norm = (g22 * h11 - 2 * g12 * h12 + g11 * h22) / det_g
        nuclear = np.sqrt(np.maximum(norm + 2 * self.signed(uv) / np.sqrt(det_g), 0))
        return np.average(norm - 2 * nuclear + 2, weights=self.area)

    def signed(self, uv):
        """Twice the signed areas in the plane."""
        a, b = (uv[self.triangles[:, i]] - uv[self.triangles[:, 0]] for i in (1, 2))
        return a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]

    def flips(self, uv):
        return int((self.signed(uv) <= 0).sum())


def slim(positions, triangles, metric, kind, energy, limit):
    """Energies after each of SLIM's steps with the seconds spent until then."""
    begin = processor()
    start = tutte(positions, triangles)
    if metric.flips(start):
        return None
    none = np.zeros((0, 2), order="F")
    data = igl.slim_precompute(np.asfortranarray(positions), np.asfortranarray(triangles), np.asfortranarray(start),
                               kind, np.zeros(0, "i4"), none, 0.0)
    spent, trace = processor() - begin, []
    while spent < limit:
        begin = processor()
        uv = np.asarray(igl.slim_solve(data, 1))[:, :2]
        spent += processor() - begin
        trace.append((spent, energy(uv)))
        if len(trace) > 1 and trace[-1][1] > (1 - 1e-9) * trace[-2][1]:
            break
    return trace


def ours(program, file, folder):
    environment = dict(os.environ, RAYON_NUM_THREADS="1")
    run = subprocess.run([*program, "--out", folder, file], cwd=ROOT, env=environment, capture_output=True, text=True, check=True)
    return [json.loads(line) for line in run.stdout.splitlines() if line.startswith("{")]


def seconds_to(trace, energy):
    return next((seconds for seconds, reached in trace if reached <= energy), None)


def shown(value, digits=2):
    return "-" if value is None else f"{value:.{digits}f}"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--limit", type=float, default=120.0, help="seconds for SLIM on one disk")
    parser.add_argument("--disks", help="the built benchmark; without it cargo builds it")
    parser.add_argument("--reference", type=Path, help="results of the authors' code")
    parser.add_argument("files", nargs="*")
    arguments = parser.parse_args()
    files = arguments.files or sorted(map(str, (ROOT / "../shared/data/disk").resolve().iterdir()))
    program = [arguments.disks] if arguments.disks else ["cargo", "bench", "--quiet", "--bench", "disks", "--"]
    ratios = {}
    print("disk | triangles | energy | ours: E, s to 1 %, s to 1e-6 of its end, factorizations, status | SLIM: E, s to 1 %, "
          "s to 1e-6 of its end, steps | ratio to 1 % | to 1e-6")
    with tempfile.TemporaryDirectory() as folder:
        for file in files:
            ran = ours(program, file, folder)
            if "error" in ran[0]:
                print(file, ran[0]["error"])
                continue
            for run in ran:
                for name, value in [*beside(run, arguments.limit), *authors(run, arguments.reference)]:
                    ratios.setdefault(name, []).append(value)
    for name, values in ratios.items():
        known = [value for value in values if value]
        told = f"median ratio {statistics.median(known):.1f}, least {min(known):.2f}, of " if known else ""
        print(f"{name}: {told}{len(known)} disks; {len(values) - len(known)} more do not get there")


def beside(run, limit):
    """Prints one disk's row for one energy; yields the ratios by name."""
    positions, uv, triangles = read(run["obj"])
    metric = Metric(positions, triangles)
    if metric.flips(uv):
        sys.exit(f"{run['file']}: flipped triangles")
    dirichlet = run["energy"] == "SymmetricDirichlet"
    kind, energy = (igl.SYMMETRIC_DIRICHLET, metric.energy) if dirichlet else (igl.ARAP, metric.arap)
    theirs = slim(positions, triangles, metric, kind, energy, limit)
    # The trace is per weight of the rest shapes; positions have the last word.
    factor = energy(uv) / run["trace"][-1][1]
    mine = [(seconds, factor * value) for seconds, value in run["trace"]]
    best = min(trace[-1][1] for trace in (mine, theirs if dirichlet else None) if trace)
    row = [Path(run["file"]).stem, len(triangles), run["energy"],
           columns(mine, best) + f", {run['factorizations']}, {run['status']}"]
    if not theirs:
        print(" | ".join(map(str, [*row, "Tutte's map is flipped", "-", "-"])), flush=True)
        return
    row.append(columns(theirs, best) + f", {len(theirs)}")
    near = ratio(seconds_to(theirs, 1.01 * best), seconds_to(mine, 1.01 * best))
    end = ratio(own_end(theirs), own_end(mine)) if dirichlet or near else None
    print(" | ".join(map(str, [*row, *(f"{r:.1f}" if r else "only ours" for r in (near, end))])), flush=True)
    yield f"{run['energy']} to 1 %", near
    yield f"{run['energy']} to 1e-6 of its own end", end


def authors(run, reference):
    """The ratio of the authors' code's seconds to ours, where it ran on this disk."""
    result = reference / "results" / f"{Path(run['file']).stem}_u_param_arap_pin1_spline.json" if reference else None
    if run["energy"] == "Arap" and result and result.exists():
        theirs = json.loads(result.read_text())["cpu_to_1e-02"]
        mine = seconds_to(run["trace"], 1.01 * run["trace"][-1][1])
        print(f"{Path(run['file']).stem}: the authors' code, ARAP to 1 %: {theirs:.2f} s, ratio {theirs / mine:.1f}", flush=True)
        yield "ARAP to 1 %, the authors' code", theirs / mine


def own_end(trace):
    return seconds_to(trace, trace[-1][1] * (1 + 1e-6))


def ratio(theirs, mine):
    return theirs / mine if theirs and mine else None


def columns(trace, best):
    return f"{trace[-1][1]:.6f}, {shown(seconds_to(trace, 1.01 * best), 3)}, {shown(own_end(trace), 3)}"


if __name__ == "__main__":
    main()
