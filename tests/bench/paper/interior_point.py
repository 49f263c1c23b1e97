#!/usr/bin/env python3
"""The reference problems with Green's strain as an interior-point method sees them (Table 1 and figure 5 of the paper).

    python3 tests/bench/interior_point.py --reference DIR --unwrapd PROGRAM [--limit SECONDS] [NAME...]

Ipopt (from the Python package casadi) minimizes the unmodified energy with determinants at least epsilon as inequalities and
handles as equalities, with exact derivatives; `unwrapd solve` minimizes energy and barrier. Prints iterations, seconds,
energy without barrier, inverted elements and residual of both.
"""
import argparse
import json
import subprocess
import tempfile
import time
from pathlib import Path

import casadi
import numpy as np


def read_off(path):
    rows = [line.split() for line in path.read_text().splitlines() if line.strip()]
    n, m = int(rows[1][0]), int(rows[1][1])
    x = np.array([[float(w) for w in row[:2]] for row in rows[2:2 + n]])
    return x, np.array([[int(w) for w in row[1:4]] for row in rows[2 + n:2 + n + m]])


def element():
    """Energy and determinant of a triangle, given its corners and the inverse of its rest edges."""
    corners, inverse = casadi.SX.sym("c", 6), casadi.SX.sym("i", 4)
    c = casadi.reshape(corners, 2, 3)
    edges = casadi.horzcat(c[:, 1] - c[:, 0], c[:, 2] - c[:, 0])
    jacobian = edges @ casadi.reshape(inverse, 2, 2)
    strain = jacobian.T @ jacobian - casadi.SX.eye(2)
    return casadi.Function("e", [corners, inverse], [casadi.sumsqr(strain), casadi.det(edges)])


def interior_point(problem, folder, limit):
    rest, triangles = read_off(folder / problem["mesh"])
    edges = np.stack([rest[triangles[:, 1]] - rest[triangles[:, 0]], rest[triangles[:, 2]] - rest[triangles[:, 0]]], 2)
    inverse = np.linalg.inv(edges)
    epsilon = problem.get("eps", 1e-4 * np.linalg.det(edges).min())
    x = casadi.MX.sym("x", 2 * len(rest))
    ids = (2 * triangles[:, :, None] + np.arange(2)).reshape(len(triangles), 6)
    corners = casadi.reshape(x[ids.ravel().tolist()], 6, len(triangles))
    energies, determinants = element().map(len(triangles))(corners, inverse.transpose(0, 2, 1).reshape(-1, 4).T)
    held = np.array(problem["handles"])
    places = x[(2 * held[:, None] + np.arange(2)).ravel().tolist()]
    targets = np.array(problem["targets"]).ravel()
    options = {"ipopt.print_level": 0, "print_time": False, "ipopt.max_cpu_time": limit, "ipopt.max_iter": 5000}
    program = {"x": x, "f": casadi.sum2(energies), "g": casadi.vertcat(determinants.T, places)}
    solver = casadi.nlpsol("s", "ipopt", program, options)
    n = len(triangles)
    lower = np.concatenate([np.full(n, epsilon), targets])
    upper = np.concatenate([np.full(n, np.inf), targets])
    begin = time.process_time()
    result = solver(x0=rest.ravel(), lbg=lower, ubg=upper)
    seconds = time.process_time() - begin
    values = np.array(result["g"]).ravel()
    stats = solver.stats()
    return (stats["return_status"], stats["iter_count"], seconds, float(result["f"]), int((values[:n] <= 0).sum()),
            float(((values[n:] - targets) ** 2).sum()))


def ours(program, path):
    with tempfile.TemporaryDirectory() as folder:
        report = Path(folder) / "r.json"
        command = [program, "solve", path, "-o", Path(folder) / "x.txt", "--report", report, "--barrier-continuation"]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
        r = json.loads(report.read_text())
    return r["status"], r["iterations"], r["solve_seconds"], r["energy"], r["inverted"], r["residual"]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--reference", type=Path, required=True)
    parser.add_argument("--unwrapd", required=True)
    parser.add_argument("--limit", type=float, default=120.0)
    parser.add_argument("names", nargs="*", default=["grid608_green_spline", "woody-lo_pt_bend_green_spline",
                                                     "woody-lo_pt_squeeze_green_spline"])
    arguments = parser.parse_args()
    print("problem | method | status | it | s | energy | inverted | residual")
    for name in arguments.names:
        path = arguments.reference / "problems" / f"{name}.json"
        problem = json.loads(path.read_text())
        for method, row in [("ipopt", interior_point(problem, path.parent, arguments.limit)), ("unwrapd", ours(arguments.unwrapd, path))]:
            status, iterations, seconds, energy, inverted, residual = row
            print(f"{name} | {method} | {status} | {iterations} | {seconds:.2f} | {energy:.6g} | {inverted} | {residual:.1e}", flush=True)


if __name__ == "__main__":
    main()
