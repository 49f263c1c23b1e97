"""Figure 18: a disk turned inside a fixed rim, its conformal distortion bounded, by our barrier and by Lipman's cones.

Y. Lipman, Bounded Distortion Mapping Spaces for Triangular Meshes, SIGGRAPH 2012: with B and C the similarity and
anti-similarity parts of a triangle's Jacobian, sigma1 = |B| + |C| and sigma2 = |B| - |C|, so |C| <= (K - 1)/(K + 1) Re(B conj(R))
is a convex part of the maps with sigma1/sigma2 <= K for each choice of frames R. Each iteration is a second-order cone program
(solved by Clarabel), after which the frames follow the map. The energy is ARAP with the same frames, as in the paper's figure.
"""
import json
import time

import clarabel
import numpy as np
import scipy.sparse as sp

from problems import read_positions, run, table
from published import FIGURES

# Frames have converged when the energy falls by less than this share.
SETTLED = 1e-4
MAX_ITERATIONS = 50

HEADER = ("triangles", "turn", "K", "method", "end", "it", "CPU s", "s per it", "ARAP", "max σ₁/σ₂", "mean σ₁/σ₂", "inverted")


def disk(rings):
    """Concentric rings, 6k vertices on the k-th, of a disk of radius 1."""
    vertices, triangles, before = [[0.0, 0.0]], [], [0]
    for k in range(1, rings + 1):
        ring = list(range(len(vertices), len(vertices) + 6 * k))
        angles = 2 * np.pi * np.arange(6 * k) / (6 * k)
        vertices += (k / rings * np.stack([np.cos(angles), np.sin(angles)], 1)).tolist()
        for side in range(6):
            outer = [ring[(side * k + i) % (6 * k)] for i in range(k + 1)]
            inner = [before[(side * (k - 1) + i) % len(before)] for i in range(k)]
            triangles += [[inner[i], outer[i], outer[i + 1]] for i in range(k)]
            triangles += [[inner[i], outer[i + 1], inner[i + 1]] for i in range(k - 1)]
        before = ring
    return np.array(vertices), np.array(triangles)


def rest_operators(x, triangles):
    """Areas, and the sparse matrices that take stacked positions (x, y of each vertex) to B and to C of each triangle."""
    edges = np.stack([x[triangles[:, 1]] - x[triangles[:, 0]], x[triangles[:, 2]] - x[triangles[:, 0]]], 2)
    inverse = np.linalg.inv(edges)
    gradients = np.concatenate([-inverse.sum(1, keepdims=True), inverse], 1)
    m = len(triangles)

    def matrix(of_x, of_y):
        """Row 2t, 2t+1 of triangle t: half the sums of gradient entries that multiply x and y of its corners."""
        row, column, value = [], [], []
        for part in (0, 1):
            for coordinate, weights in ((0, of_x[part]), (1, of_y[part])):
                sign, axis = weights
                row.append(np.repeat(2 * np.arange(m) + part, 3))
                column.append((2 * triangles + coordinate).ravel())
                value.append((0.5 * sign * gradients[:, :, axis]).ravel())
        shape = (2 * m, 2 * len(x))
        return sp.csr_matrix((np.concatenate(value), (np.concatenate(row), np.concatenate(column))), shape)

    # J = [[x_u, x_v], [y_u, y_v]]: B = (x_u + y_v, y_u - x_v)/2, C = (x_u - y_v, y_u + x_v)/2.
    b = matrix([(1, 0), (-1, 1)], [(1, 1), (1, 0)])
    c = matrix([(1, 0), (1, 1)], [(-1, 1), (1, 0)])
    return 0.5 * np.abs(np.linalg.det(edges)), b, c


def quality(b, c, areas, x):
    """ARAP energy, conformal distortion of every triangle, inverted triangles."""
    similar, anti = (np.hypot(*(part @ x).reshape(-1, 2).T) for part in (b, c))
    sigma = similar + anti, similar - anti
    arap = 0.5 * (areas * ((sigma[0] - 1) ** 2 + (sigma[1] - 1) ** 2)).sum()
    distortion = np.where(sigma[1] > 0, sigma[0] / np.where(sigma[1] > 0, sigma[1], 1), np.inf)
    return arap, distortion, int((sigma[1] <= 0).sum())


def cone_program(b, c, areas, frames, bound, held, targets):
    """The map of least energy in the convex part that the frames choose: status and positions."""
    m, n = len(areas), b.shape[1]
    weights = sp.diags(np.repeat(areas, 2))
    # half of A |J - R|^2 = A (|B - R|^2 + |C|^2), and Clarabel minimizes half of x P x, plus q x.
    quadratic = sp.triu(2 * (b.T @ weights @ b + c.T @ weights @ c)).tocsc()
    linear = -2 * (b.T @ (weights @ frames.ravel()))
    k = (bound - 1) / (bound + 1)
    rotate = sp.csr_matrix((frames.ravel(), (np.repeat(np.arange(m), 2), np.arange(2 * m))), (m, 2 * m))
    cones = sp.csr_matrix(sp.vstack([k * (rotate @ b), c]))
    order = np.stack([np.arange(m), m + 2 * np.arange(m), m + 2 * np.arange(m) + 1], 1).ravel()
    fixed = sp.csr_matrix((np.ones(len(held)), (np.arange(len(held)), held)), (len(held), n))
    rows = sp.vstack([fixed, -cones[order]]).tocsc()
    right = np.concatenate([targets, np.zeros(3 * m)])
    kinds = [clarabel.ZeroConeT(len(held))] + [clarabel.SecondOrderConeT(3)] * m
    settings = clarabel.DefaultSettings()
    settings.verbose = False
    solution = clarabel.DefaultSolver(quadratic, linear, rows, right, kinds, settings).solve()
    return str(solution.status), np.array(solution.x)


def lipman(x, triangles, bound, held, targets, start):
    """Status, iterations, seconds and positions, the frames taken from `start` first."""
    areas, b, c = rest_operators(x, triangles)
    place, energy = start, np.inf
    begin = time.process_time()
    for iteration in range(1, MAX_ITERATIONS + 1):
        similar = (b @ place).reshape(-1, 2)
        frames = similar / np.maximum(np.linalg.norm(similar, axis=1, keepdims=True), 1e-300)
        status, solution = cone_program(b, c, areas, frames, bound, held, targets)
        if "Solved" not in status:
            return status, iteration, time.process_time() - begin, None
        place = solution
        before, energy = energy, quality(b, c, areas, place)[0]
        if before - energy < SETTLED * energy:
            break
    return status, iteration, time.process_time() - begin, place


def ours(program, folder, x, triangles, handles, bound):
    mesh, handle_file = folder / "disk.off", folder / "handles.json"
    lines = [f"{a!r} {b!r} 0" for a, b in x.tolist()] + [f"3 {a} {b} {c}" for a, b, c in triangles.tolist()]
    mesh.write_text(f"OFF\n{len(x)} {len(triangles)} 0\n" + "\n".join(lines) + "\n")
    handle_file.write_text(json.dumps({"handles": handles}))
    command = [program, "deform", mesh, "--handles", handle_file, "-o", folder / "x.txt", "--report", folder / "r.json"]
    seconds = run(command + (["--max-conformal", bound] if bound else []))
    report = json.loads((folder / "r.json").read_text())
    return report["status"], report["iterations"], seconds, np.array(read_positions(folder / "x.txt")).ravel()


def rows(arguments, folder):
    x, triangles = disk(arguments.rings)
    areas, b, c = rest_operators(x, triangles)
    radius = np.linalg.norm(x, axis=1)
    rim, core = np.flatnonzero(radius > 1 - 1e-9), np.flatnonzero(radius < 0.3)
    for degrees in arguments.turns:
        turn = np.radians(degrees)
        rotation = np.array([[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]])
        targets = x.copy()
        targets[core] = x[core] @ rotation.T
        vertices = np.concatenate([rim, core])
        handles = [{"vertex": int(v), "to": targets[v].tolist()} for v in vertices]

        def row(bound, method, run_of_it):
            status, iterations, seconds, place = run_of_it
            measures = ("–",) * 4
            if place is not None:
                arap, distortion, inverted = quality(b, c, areas, place)
                measures = f"{arap:.5g}", f"{distortion.max():.4g}", f"{np.average(distortion, weights=areas):.4g}", inverted
            return (len(triangles), f"{degrees}°", bound or "–", method, status, iterations, f"{seconds:.2f}", f"{seconds / iterations:.3f}",
                    *measures)

        free = ours(arguments.unwrapd, folder, x, triangles, handles, None)
        yield row(None, "barrier", free)
        worst = quality(b, c, areas, free[3])[1].max()
        held = (2 * vertices[:, None] + np.arange(2)).ravel()
        for share in arguments.bounds:
            bound = round(1 + share * (worst - 1), 3)
            yield row(bound, "barrier and bound", ours(arguments.unwrapd, folder, x, triangles, handles, bound))
            cones = lipman(x, triangles, bound, held, targets.ravel()[held], free[3])
            yield row(bound, "Lipman 2012, frames of our free map", cones)
            cones = lipman(x, triangles, bound, held, targets.ravel()[held], x.ravel())
            yield row(bound, "Lipman 2012, frames at rest", cones)


def main(arguments, _cases, folder):
    """Prints the table for each turn and bound asked for."""
    table(f"Figure 18: a disk turned inside a fixed rim, ARAP (the paper: {FIGURES['18']})", HEADER, rows(arguments, folder))
