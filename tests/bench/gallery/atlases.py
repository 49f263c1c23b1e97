"""What can be seen of an atlas: its charts, their colors, where the surface is cut."""
import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components

SMOOTH = np.cos(np.radians(40))


class Atlas:
    """Positions (n, 3), faces (m, 3) and UVs (m, 3, 2), with v up.

    `chart` has a number for each face, 0 the largest; `seams` and `borders` the ends of edges, in space (k, 2, 3) where the
    surface is cut, in the plane (k, 2, 2) around the charts.
    """

    def __init__(self, positions, faces, uv):
        self.positions, self.faces, self.uv = positions.astype(float), faces, uv
        corners = np.concatenate([faces[..., None], uv], 2).reshape(-1, 3)
        _, first, corner = np.unique(corners, axis=0, return_index=True, return_inverse=True)
        of_face = np.repeat(np.arange(len(faces)), 3)
        pairs, edge = np.unique(sides(corner.reshape(-1, 3)), axis=0, return_inverse=True)
        self.borders = uv.reshape(-1, 2)[first[pairs[np.bincount(edge) == 1]]]
        self.chart = by_area(joined(of_face, edge, len(faces)), self.areas())
        welded, surface_edge = np.unique(sides(faces), axis=0, return_inverse=True)
        ways = np.unique(np.stack([surface_edge, edge], 1), axis=0)[:, 0]
        self.seams = self.positions[welded[np.bincount(ways) > 1]]
        self.neighbors = neighbors(of_face, surface_edge, self.chart)

    def areas(self):
        a, b, c = self.positions[self.faces].transpose(1, 0, 2)
        return 0.5 * np.linalg.norm(np.cross(b - a, c - a), axis=1)

    def scale(self):
        """Lengths in the plane for each in space."""
        e, f = self.uv[:, 1] - self.uv[:, 0], self.uv[:, 2] - self.uv[:, 0]
        return (0.5 * np.abs(e[:, 0] * f[:, 1] - e[:, 1] * f[:, 0]).sum() / self.areas().sum()) ** 0.5

    def paint(self, n_colors):
        """The color of each chart: of those that no neighbor has the one that is used least."""
        color = np.full(self.chart.max() + 1, -1)
        for chart in range(len(color)):
            taken = np.bincount(color[self.neighbors[chart]] + 1, minlength=n_colors + 1)[1:] > 0
            uses = np.bincount(color + 1, minlength=n_colors + 1)[1:]
            color[chart] = np.lexsort((uses, taken))[0]
        return color


def sides(triangles):
    """Ends of the three sides of each, the smaller one first."""
    return np.sort(np.stack([triangles, np.roll(triangles, -1, 1)], 2).reshape(-1, 2), 1)


def joined(of_face, edge, n_faces):
    """The component of each face, where faces with an edge in common are joined."""
    incidence = coo_matrix((np.ones(len(edge)), (of_face, edge)), (n_faces, edge.max() + 1)).tocsr()
    return connected_components(incidence @ incidence.T)[1]


def by_area(chart, areas):
    """Numbers in the order of falling area."""
    order = np.argsort(-np.bincount(chart, areas), kind="stable")
    return np.argsort(order)[chart]


def neighbors(of_face, edge, chart):
    """For each chart those across its seams."""
    n_charts = chart.max() + 1
    incidence = coo_matrix((np.ones(len(edge)), (chart[of_face], edge)), (n_charts, edge.max() + 1)).tocsr()
    meets = (incidence @ incidence.T).tolil().rows
    return [[c for c in meets[chart] if c != chart] for chart in range(n_charts)]


def corner_normals(positions, faces):
    """Normals (m, 3, 3), smooth except at creases: each the sum of the faces at its vertex that turn from its own by less."""
    a, b, c = positions[faces].transpose(1, 0, 2)
    normals = np.cross(b - a, c - a)
    units = normals / np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-300)
    vertex, face = faces.reshape(-1), np.repeat(np.arange(len(faces)), 3)
    order = np.argsort(vertex, kind="stable")
    degree = np.bincount(vertex)
    start = np.cumsum(degree) - degree
    own = np.repeat(np.arange(len(vertex)), degree[vertex])
    place = np.arange(len(own)) - np.repeat(np.cumsum(degree[vertex]) - degree[vertex], degree[vertex])
    other = face[order[start[vertex[own]] + place]]
    smooth = (units[face[own]] * units[other]).sum(1) > SMOOTH
    sums = np.stack([np.bincount(own, smooth * normals[other, k], len(vertex)) for k in range(3)], 1)
    return (sums / np.maximum(np.linalg.norm(sums, axis=1, keepdims=True), 1e-300)).reshape(-1, 3, 3)
