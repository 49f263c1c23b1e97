#!/usr/bin/env python3
"""Makes problems with held vertices, solves them and judges the maps: held.py BINARY [--each N] [--seed S] [--only KIND]

    plane        a grid whose border is held on that of a known map, from Tutte's map: a composition of random twists and
                 waves, every triangle positive
    space        a block of tetrahedra whose surface is held on that of such a map, from its harmonic map
    thin         a sheet of height 1e-2 to 1e-6, stretched or bent by its ends, from rest
    graded       a sheet whose cells shrink to 1e-2 to 1e-6 of its side toward a corner, from rest: the corner pulled to the
                 middle, the opposite one pulled away, or an edge held and a corner pulled
    unreachable  a held triangle inverted, a border mirrored, two ends of an edge at one place, or a border on a line

A reachable problem counts as solved if the exit status is 0, every held vertex is within 1e-9 of the target's size and
every signed size is positive; a thin or graded one if it also took at most 60 iterations; an unreachable one if it ends with 3 or 5
within 2 CPU seconds. Prints the failures and a line per kind. Needs NumPy and SciPy.

--continued N also solves each thin and graded problem in N steps: the targets advance from rest in equal parts, and each solve starts
from the map before. Prints the difference of the energies where it exceeds 0.1 %, and the largest of each kind.
"""
import argparse
import json
import os
import pathlib
import resource
import subprocess
import tempfile
from itertools import permutations

import numpy as np
import scipy.sparse as sparse
from scipy.sparse.linalg import spsolve

KINDS = ("plane", "space", "thin", "unreachable", "graded")


def grid(n, height=1.0, x=None):
    """Vertices and triangles of n x n cells over a rectangle of length 1, diagonals alternating; lines at x if given."""
    x = np.linspace(0, 1, n + 1) if x is None else x
    vertices = np.stack(np.meshgrid(x, height * x, indexing="ij"), -1).reshape(-1, 2)
    triangles = []
    for i in range(n):
        for j in range(n):
            a, b, c, d = (i * (n + 1) + j + k for k in (0, n + 1, n + 2, 1))
            triangles += [(a, b, c), (a, c, d)] if (i + j) % 2 == 0 else [(a, b, d), (b, c, d)]
    return vertices, np.array(triangles)


def block(n):
    """Vertices and tetrahedra of n x n x n cubes of a unit cube, six to a cube."""
    x = np.linspace(0, 1, n + 1)
    vertices = np.stack(np.meshgrid(x, x, x, indexing="ij"), -1).reshape(-1, 3)
    step = np.array([(n + 1) ** 2, n + 1, 1])
    tets = []
    for cube in np.ndindex(n, n, n):
        for order in permutations(range(3)):
            path = np.cumsum([np.dot(cube, step), *step[list(order)]])
            tets.append(path if np.linalg.det(np.eye(3)[list(order)]) > 0 else path[[0, 1, 3, 2]])
    return vertices, np.array(tets)


def sizes(x, elements):
    return np.linalg.det(np.stack([x[elements[:, k]] - x[elements[:, 0]] for k in range(1, elements.shape[1])], 1))


def bent(x, random):
    """The places under random twists and waves, smooth maps without inversions if the strengths are moderate."""
    x = x - 0.5
    for _ in range(3):
        i, j = random.permutation(x.shape[1])[:2]
        center, reach, angle = random.normal(0, 0.3, x.shape[1]), random.uniform(0.3, 0.8), random.uniform(-2.5, 2.5)
        arm = x - center
        turn = angle * np.exp(-(arm**2).sum(1) / reach**2)
        y = x.copy()
        y[:, i] = center[i] + np.cos(turn) * arm[:, i] - np.sin(turn) * arm[:, j]
        y[:, j] = center[j] + np.sin(turn) * arm[:, i] + np.cos(turn) * arm[:, j]
        y[:, i] += random.uniform(0, 0.3) * np.sin(random.uniform(2, 7) * y[:, j])
        x = y
    return x


def tutte(x, elements, is_held):
    """Every free vertex the mean of its neighbors."""
    pairs = np.vstack([elements[:, [i, j]] for i, j in permutations(range(elements.shape[1]), 2)])
    adjacency = sparse.coo_matrix((np.ones(len(pairs)), pairs.T), (len(x), len(x))).tocsr()
    adjacency.data[:] = 1
    laplacian = (sparse.diags(np.asarray(adjacency.sum(1)).ravel()) - adjacency).tocsr()
    free, y = ~is_held, x.copy()
    y[free] = spsolve(laplacian[free][:, free].tocsc(), -laplacian[free][:, is_held] @ x[is_held]).reshape(-1, x.shape[1])
    return y


def reachable(kind, random):
    """Rest, elements, held vertices, targets and start of a problem that a known map solves."""
    while True:
        vertices, elements = grid(random.integers(12, 40)) if kind == "plane" else block(random.integers(5, 10))
        known = bent(vertices, random)
        if (sizes(known, elements) > 0.02 * np.abs(sizes(vertices, elements))).all():
            is_held = (np.isclose(vertices, 0) | np.isclose(vertices, 1)).any(1)
            held = np.flatnonzero(is_held)
            return vertices, elements, held, known[held], tutte(known, elements, is_held)


def thin(random):
    n, height = 30, 10.0 ** -random.integers(2, 7)
    vertices, triangles = grid(n, height)
    left, right = np.arange(n + 1), n * (n + 1) + np.arange(n + 1)
    if random.random() < 0.5:
        held, targets = [0, (n + 1) ** 2 - 1], [(0, 0), (random.uniform(0.9, 1.4), height)]
    else:
        ends, angle, to = np.hstack([left, right]), random.uniform(-1, 1), random.uniform((0.5, -0.3), (0.9, 0.3))
        arm = vertices[right, 1] - height / 2
        targets = np.vstack([vertices[left], np.stack([to[0] - np.sin(angle) * arm, to[1] + np.cos(angle) * arm], 1)])
        held = ends
    return vertices, triangles, held, targets, None


def graded(random):
    n, finest = 30, 10.0 ** -random.integers(2, 7)
    widths = finest ** (np.arange(n)[::-1] / (n - 1))
    vertices, triangles = grid(n, x=np.append(0, np.cumsum(widths)) / widths.sum())
    way, last, away = random.integers(3), (n + 1) ** 2 - 1, random.uniform(0.8, 1.4, 2)
    if way == 0:
        return vertices, triangles, [0, last], [random.uniform(0.3, 0.6, 2), (1, 1)], None
    if way == 1:
        return vertices, triangles, [0, last], [(0, 0), away], None
    edge = np.arange(n + 1)
    return vertices, triangles, [*edge, last], [*vertices[edge], away], None


def unreachable(random):
    n = random.integers(10, 40)
    vertices, triangles = grid(n)
    border = np.flatnonzero((np.isclose(vertices, 0) | np.isclose(vertices, 1)).any(1))
    way, (a, b, c) = random.integers(4), triangles[random.integers(len(triangles))]
    if way == 0:
        return vertices, triangles, [a, b, c], vertices[[b, a, c]], None
    if way == 1:
        return vertices, triangles, border, vertices[border] * (-1, 1), None
    if way == 2:
        return vertices, triangles, [a, b], vertices[[a, a]], None
    return vertices, triangles, border, vertices[border] * (1, 0), None


def write(folder, vertices, elements, held, targets, start):
    plane = elements.shape[1] == 3
    mesh = folder / ("m.obj" if plane else "m.tet")
    with open(mesh, "w") as file:
        if not plane:
            file.write(f"{len(vertices)} {len(elements)}\n")
        for v in vertices:
            file.write(("v {!r} {!r} 0\n" if plane else "{!r} {!r} {!r}\n").format(*map(float, v)))
        for e in elements:
            file.write(("f " if plane else "") + " ".join(str(v + plane) for v in e) + "\n")
    problem = dict(mesh=mesh.name, energy="symmetric-dirichlet", barrier="spline", units="normalized",
                   handles=[int(v) for v in held], targets=[[float(x) for x in t] for t in targets])
    if start is not None:
        np.savetxt(folder / "start.txt", start, fmt="%.17g")
        problem["initial"] = "start.txt"
    (folder / "p.json").write_text(json.dumps(problem))


def report_of(folder):
    """The report of the last solve, empty if it wrote none."""
    path = folder / "r.json"
    return json.loads(path.read_text()) if path.exists() else {}


def continued(binary, folder, problem, n_steps):
    """The energy of the last of `n_steps` solves as the targets advance from rest, each from the map before; None if one fails."""
    vertices, elements, held, targets, _ = problem
    start = None
    for part in np.arange(1, n_steps + 1) / n_steps:
        moved = (1 - part) * vertices[held] + part * np.array(targets)
        write(folder, vertices, elements, held, moved, start)
        wrong, _, _ = judged(binary, folder, "plane", elements, held, moved)
        if wrong:
            return None
        start = np.loadtxt(folder / "x.txt", ndmin=2)[:, :2]
    return report_of(folder)["energy"]


def judged(binary, folder, kind, elements, held, targets):
    """What is wrong, empty if nothing; iterations; CPU seconds."""
    for name in ("x.txt", "r.json"):
        (folder / name).unlink(missing_ok=True)
    command = [binary, "solve", folder / "p.json", "-o", folder / "x.txt", "--report", folder / "r.json", "-q", "--threads", "1"]
    limit = lambda: resource.setrlimit(resource.RLIMIT_CPU, (60, 65))  # noqa: E731
    child = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, preexec_fn=limit)
    _, status, used = os.wait4(child.pid, 0)
    code, cpu = os.waitstatus_to_exitcode(status), used.ru_utime + used.ru_stime
    if kind == "unreachable":
        return "" if code in (3, 5) and cpu <= 2 else f"exit {code}", 0, cpu
    iterations = report_of(folder).get("iterations", 0)
    if code != 0:
        return f"exit {code}", iterations, cpu
    x = np.loadtxt(folder / "x.txt", ndmin=2)[:, : elements.shape[1] - 1]
    off = np.abs(x[held] - targets).max() / np.ptp(targets, axis=0).max()
    inverted = int((sizes(x, elements) <= 0).sum())
    wrong = [f"{inverted} inverted"] * bool(inverted) + [f"held off by {off:.1e}"] * bool(off > 1e-9)
    wrong += [f"{iterations} iterations"] * (kind in ("thin", "graded") and iterations > 60)
    return ", ".join(wrong), iterations, cpu


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("binary")
    parser.add_argument("--each", type=int, default=30)
    parser.add_argument("--seed", type=int, default=51)
    parser.add_argument("--only", choices=KINDS)
    parser.add_argument("--continued", type=int, metavar="N", help="compare energies with those of targets that advance in N steps")
    args = parser.parse_args()
    for kind in KINDS:
        if args.only not in (None, kind):
            continue
        solved, flips, steps, seconds, above, n_failed = 0, [], [], [], [], 0
        for k in range(args.each):
            random = np.random.default_rng([args.seed, KINDS.index(kind), k])
            problem = {"thin": thin, "graded": graded, "unreachable": unreachable}.get(kind, lambda random: reachable(kind, random))(random)
            vertices, elements, held, targets, start = problem
            with tempfile.TemporaryDirectory() as folder:
                folder = pathlib.Path(folder)
                write(folder, *problem)
                wrong, iterations, cpu = judged(args.binary, folder, kind, elements, held, np.array(targets))
                energy = report_of(folder).get("energy")
                if args.continued and kind in ("thin", "graded"):
                    least = continued(args.binary, folder, problem, args.continued)
                    if least is None or energy is None:
                        n_failed += 1
                    else:
                        above.append(energy / least - 1)
                        if abs(above[-1]) > 1e-3:
                            print(f"{kind} {k}: energy {100 * above[-1]:+.2f} % beside the continued one", flush=True)
            solved += not wrong
            flips.append(0 if start is None else int((sizes(start, elements) <= 0).sum()))
            steps.append(iterations)
            seconds.append(cpu)
            if wrong:
                height = f", height {np.ptp(vertices[:, 1]):.0e}" if kind == "thin" else ""
                height += f", finest {vertices[1, 1]:.0e}" if kind == "graded" else ""
                print(f"{kind} {k}: {wrong} ({len(elements)} elements, {flips[-1]} inverted at the start{height})", flush=True)
        print(
            f"{kind}: {solved} of {args.each} solved; inverted at the start {np.median(flips):.0f}, at most {max(flips)}; "
            f"iterations {np.median(steps):.0f}, at most {max(steps)}; CPU s {np.median(seconds):.2f}, at most {max(seconds):.2f}",
            flush=True,
        )
        if above or n_failed:
            difference = f"energy beside the continued one {100 * min(above):+.4f} to {100 * max(above):+.4f} %, " if above else ""
            print(f"{kind}: {difference}{n_failed} without both", flush=True)


if __name__ == "__main__":
    main()
