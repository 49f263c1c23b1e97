"""Problems of the plane as an interior-point method sees them (Table 1 and figure 5 of the paper).

Ipopt (from the Python package casadi) minimizes the unmodified energy with determinants at least epsilon as inequalities and
handles as equalities, with exact derivatives, from the rest positions.
"""
import json
import time

import casadi
import numpy as np

from problems import read_mesh

MAX_ITERATIONS = 5000


def energy_density(name, jacobian, area):
    """The energy of one triangle as the problem files define it."""
    if name == "green":
        return casadi.sumsqr(jacobian.T @ jacobian - casadi.SX.eye(2))
    if name == "dirichlet":
        return 0.5 * area * casadi.sumsqr(jacobian - casadi.SX.eye(2))
    if name == "arap":
        turned = casadi.norm_2(casadi.vertcat(jacobian[0, 0] + jacobian[1, 1], jacobian[1, 0] - jacobian[0, 1]))
        return 0.5 * area * (casadi.sumsqr(jacobian) - 2 * turned + 2)
    raise ValueError(f"no interior-point form of {name}")


def triangle(name):
    """Energy and determinant of a triangle, given its corners, the inverse of its rest edges and its area."""
    corners, inverse, area = casadi.SX.sym("c", 6), casadi.SX.sym("i", 4), casadi.SX.sym("a")
    c = casadi.reshape(corners, 2, 3)
    edges = casadi.horzcat(c[:, 1] - c[:, 0], c[:, 2] - c[:, 0])
    jacobian = edges @ casadi.reshape(inverse, 2, 2)
    return casadi.Function("e", [corners, inverse, area], [energy_density(name, jacobian, area), casadi.det(edges)])


def interior_point(problem, limit):
    """Status, iterations, processor seconds, energy, inverted elements and residual, within `limit` seconds."""
    keys = json.loads(problem.read_text())
    vertices, triangles = (np.array(a) for a in read_mesh(problem.parent / keys["mesh"]))
    rest = vertices[:, :2]
    edges = np.stack([rest[triangles[:, 1]] - rest[triangles[:, 0]], rest[triangles[:, 2]] - rest[triangles[:, 0]]], 2)
    determinants = np.linalg.det(edges)
    epsilon = keys.get("eps", 1e-4 * determinants.min())
    x = casadi.MX.sym("x", 2 * len(rest))
    n = len(triangles)
    ids = (2 * triangles[:, :, None] + np.arange(2)).reshape(n, 6)
    corners = casadi.reshape(x[ids.ravel().tolist()], 6, n)
    inverse = np.linalg.inv(edges).transpose(0, 2, 1).reshape(-1, 4).T
    energies, sizes = triangle(keys["energy"]).map(n)(corners, inverse, 0.5 * determinants[None, :])
    held = np.array(keys["handles"])
    places = x[(2 * held[:, None] + np.arange(2)).ravel().tolist()]
    targets = np.array(keys["targets"]).ravel()
    options = {"ipopt.print_level": 0, "print_time": False, "ipopt.sb": "yes", "ipopt.max_cpu_time": limit, "ipopt.max_iter": MAX_ITERATIONS}
    program = {"x": x, "f": casadi.sum2(energies), "g": casadi.vertcat(sizes.T, places)}
    solver = casadi.nlpsol("s", "ipopt", program, options)
    lower, upper = np.full(n, epsilon), np.full(n, np.inf)
    begin = time.process_time()
    result = solver(x0=rest.ravel(), lbg=np.concatenate([lower, targets]), ubg=np.concatenate([upper, targets]))
    seconds = time.process_time() - begin
    values = np.array(result["g"]).ravel()
    stats = solver.stats()
    return {"status": stats["return_status"], "iterations": stats["iter_count"], "seconds": seconds, "energy": float(result["f"]),
            "inverted": int((values[:n] <= 0).sum()), "smallest": float((values[:n] / determinants).min()),
            "residual": float(((values[n:] - targets) ** 2).sum())}
