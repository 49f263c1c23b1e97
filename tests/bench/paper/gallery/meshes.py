"""Meshes as arrays, from the files that the program reads and writes."""
from dataclasses import dataclass
from pathlib import Path

import numpy as np


@dataclass
class Mesh:
    """Positions (n, 2 or 3), triangles (m, 3), UVs of their corners (m, 3, 2) or None, tetrahedra (k, 4) or None."""

    positions: np.ndarray
    triangles: np.ndarray
    uvs: np.ndarray | None = None
    tets: np.ndarray | None = None

    def areas(self):
        """Signed areas of the triangles of a planar mesh."""
        return signed_areas(self.positions[:, :2][self.triangles])

    def volumes(self):
        """Signed volumes of the tetrahedra."""
        a, b, c, d = (self.positions[self.tets[:, k]] for k in range(4))
        return np.einsum("ij,ij->i", np.cross(b - a, c - a), d - a) / 6


def signed_areas(corners):
    """Of triangles (m, 3, 2)."""
    (u, v) = (corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    return 0.5 * (u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0])


def read(path):
    """A mesh from .obj, .off or .tet."""
    path = Path(path)
    return {".obj": read_obj, ".off": read_off, ".tet": read_tet}[path.suffix](path.read_text().splitlines())


def read_obj(lines):
    rows = [line.split() for line in lines if line.strip()]
    numbers = lambda key, n: np.array([[float(w) for w in row[1:1 + n]] for row in rows if row[0] == key])
    corners = [[word.split("/") for word in row[1:]] for row in rows if row[0] == "f"]
    triangles = [[f[0], f[k], f[k + 1]] for f in corners for k in range(1, len(f) - 1)]
    index = lambda which: np.array([[int(c[which]) - 1 for c in t] for t in triangles])
    has_uvs = len(triangles[0][0]) > 1 and triangles[0][0][1]
    return Mesh(numbers("v", 3), index(0), numbers("vt", 2)[index(1)] if has_uvs else None)


def read_off(lines):
    rows = [line.split() for line in lines if line.strip() and not line.startswith("#")]
    n, m = int(rows[1][0]), int(rows[1][1])
    positions = np.array([[float(w) for w in row[:3]] for row in rows[2:2 + n]])
    return Mesh(positions, np.array([[int(w) for w in row[1:4]] for row in rows[2 + n:2 + n + m]]))


def read_tet(lines):
    rows = [line.split() for line in lines if line.strip()]
    n, m = int(rows[0][0]), int(rows[0][1])
    positions = np.array([[float(w) for w in row] for row in rows[1:1 + n]])
    tets = np.array([[int(w) for w in row] for row in rows[1 + n:1 + n + m]])
    return Mesh(positions, boundary(tets), tets=tets)


def boundary(tets):
    """The faces of one tetrahedron only, seen from outside counter-clockwise."""
    faces = np.concatenate([tets[:, f] for f in ([0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2])])
    _, first, count = np.unique(np.sort(faces, axis=1), axis=0, return_index=True, return_counts=True)
    return faces[first[count == 1]]


def singular_values(rest, deformed):
    """Of the Jacobian of every triangle of a planar map, the larger first; the smaller has the sign of the determinant."""
    edges = lambda x: np.stack([x[:, 1] - x[:, 0], x[:, 2] - x[:, 0]], axis=2)
    j = edges(deformed) @ np.linalg.inv(edges(rest))
    s = np.linalg.svd(j, compute_uv=False)
    s[:, 1] *= np.sign(np.linalg.det(j))
    return s


def turns(rest, deformed):
    """Turns about x of a bar along x: the sum of the rotations that fit each layer best to the next, in (-180, 180] degrees."""
    layers = [np.flatnonzero(np.isclose(rest[:, 0], x)) for x in np.unique(np.round(rest[:, 0], 9))]
    around = [deformed[layer][:, 1:] - deformed[layer][:, 1:].mean(0) for layer in layers]
    angles = [np.arctan2((p[:, 0] * q[:, 1] - p[:, 1] * q[:, 0]).sum(), (p * q).sum()) for p, q in zip(around, around[1:])]
    return np.sum(angles) / (2 * np.pi)
