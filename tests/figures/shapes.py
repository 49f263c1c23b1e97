"""Meshes made for the figures: a puppet, squares, disks, bars, voxels and surfaces in them."""
import json

import numpy as np

from maps import sizes
from work import read_off

# Half the outline of the puppet that stands for the paper's Woody, from the top of its head down.
HALF = [(0, 1), (.13, .99), (.2, .88), (.17, .76), (.09, .7), (.12, .64), (.3, .62), (.62, .62), (.74, .6), (.77, .54), (.72, .48),
        (.6, .48), (.3, .48), (.2, .45), (.17, .34), (.21, .22), (.25, .1), (.3, -.3), (.36, -.5), (.38, -.62), (.3, -.67), (.2, -.64),
        (.15, -.5), (.1, -.2), (.05, 0), (0, .04)]
HEAD, HANDS, FEET = np.array([0, .88]), np.array([[-.68, .55], [.68, .55]]), np.array([[-.29, -.58], [.29, -.58]])


def rounded(points, rounds=3):
    """A closed outline with its corners cut, again and again."""
    points = np.asarray(points, float)
    for _ in range(rounds):
        following = np.roll(points, -1, 0)
        points = np.stack([.75 * points + .25 * following, .25 * points + .75 * following], 1).reshape(-1, 2)
    return points


def filled(work, name, outline, n_triangles, statuses=(0,)):
    """An outline filled with triangles by `unwrapd deform`, which leaves it where it is: (name, positions, triangles)."""
    if name not in work.known:
        at = 100 * outline * [1, -1]
        path = " ".join(f"{x:.4f},{y:.4f}" for x, y in at)
        low, size = at.min(0) - 1, np.ptp(at, 0) + 2
        view = f"{low[0]:.2f} {low[1]:.2f} {size[0]:.2f} {size[1]:.2f}"
        svg = work.named(f"{name}.svg", f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{view}"><polygon points="{path}"/></svg>\n')
        still = {"handles": [{"center": at[0].tolist(), "radius": 1, "to": at[0].tolist()}]}
        handles = work.named(f"{name}-still.json", json.dumps(still))
        work.run("deform", svg, "--triangles", n_triangles, "--handles", handles, "-o", f"{name}-rest.off", statuses=statuses)
        x, triangles = read_off(work.folder / f"{name}-rest.off")
        x = x[:, :2] * [.01, -.01]
        if sizes(x, triangles).sum() < 0:
            triangles = triangles[:, [0, 2, 1]]
        work.known[name] = (name, x, triangles)
    return work.known[name]


def woody(work, n_triangles=5040):
    half = np.array(HALF, float)
    outline = np.concatenate([half, half[-2:0:-1] * [-1, 1]])
    return filled(work, f"woody{n_triangles}", rounded(outline), n_triangles)


def disk(work, n_triangles=2400):
    a = np.linspace(0, 2 * np.pi, 160, endpoint=False)
    return filled(work, f"disk{n_triangles}", np.stack([np.cos(a), np.sin(a)], 1), n_triangles)


def rectangle(name, columns, rows, width=1.0):
    """A regular mesh, its diagonals to both sides in turn."""
    height = width * rows / columns
    y, x = np.mgrid[0:rows + 1, 0:columns + 1]
    at = np.stack([x.ravel() * width / columns, y.ravel() * height / rows], 1)
    j, i = (v.ravel() for v in np.mgrid[0:rows, 0:columns])
    a = j * (columns + 1) + i
    b, c, d = a + 1, a + columns + 2, a + columns + 1
    even = ((i + j) % 2 == 0)[:, None]
    one = np.where(even, np.stack([a, b, c], 1), np.stack([a, b, d], 1))
    two = np.where(even, np.stack([a, c, d], 1), np.stack([b, c, d], 1))
    return name, at, np.concatenate([one, two])


class Voxels:
    """Cubes, six Kuhn tetrahedra each, where `inside` (a, b, c) is true; the corner (0, 0, 0) is `low`, a cube is `side` wide."""

    def __init__(self, inside, low, side):
        self.low, self.side = np.asarray(low, float), side
        size = np.array(inside.shape) + 1
        cells = np.argwhere(inside)
        steps = np.eye(3, dtype=int)
        tets = []
        for order in [(0, 1, 2), (1, 2, 0), (2, 0, 1), (0, 2, 1), (2, 1, 0), (1, 0, 2)]:
            path = np.cumsum([np.zeros(3, int), *steps[list(order)]], 0)
            tet = np.ravel_multi_index(tuple(np.moveaxis(cells[:, None] + path, -1, 0)), size)
            tets.append(tet if order in ((0, 1, 2), (1, 2, 0), (2, 0, 1)) else tet[:, [0, 1, 3, 2]])
        tets = np.concatenate(tets)
        used = np.unique(tets)
        self.number = np.full(size.prod(), -1)
        self.number[used] = np.arange(len(used))
        self.size, self.tets = size, self.number[tets]
        self.x = self.low + side * np.stack(np.unravel_index(used, size), 1)

    def carried(self, points, x):
        """Where the map of the cubes' corners to `x` takes points inside of the cubes."""
        at = (points - self.low) / self.side
        cell = np.minimum(np.floor(at), self.size - 2).astype(int)
        part = at - cell
        order = np.argsort(-part, 1)
        part = np.take_along_axis(part, order, 1)
        weights = np.column_stack([1 - part[:, 0], part[:, 0] - part[:, 1], part[:, 1] - part[:, 2], part[:, 2]])
        corner, out = cell.copy(), np.zeros((len(points), 3))
        for k in range(4):
            out += weights[:, k:k + 1] * x[self.number[np.ravel_multi_index(tuple(corner.T), self.size)]]
            if k < 3:
                corner[np.arange(len(cell)), order[:, k]] += 1
        return out


def bar(layers, width, stretch=1.0):
    """A bar of cubes along x, (name, positions, tetrahedra)."""
    voxels = Voxels(np.ones((layers, width, width), bool), [0, -width / 2, -width / 2], 1.0)
    return f"bar{layers}x{width}", voxels.x * [stretch, 1, 1], voxels.tets


def around(points, cells, margin=0.3):
    """The cubes that meet a surface given by dense points, and all that these enclose; `cells` along the longest side."""
    side = np.ptp(points, 0).max() / cells
    low = points.min(0) - margin * side
    shape = np.ceil((points.max(0) - low) / side + margin).astype(int)
    wall = np.zeros(shape + 2, bool)
    wall[tuple((np.floor((points - low) / side).astype(int) + 1).T)] = True
    outside = np.zeros_like(wall)
    outside[0, 0, 0] = True
    while True:
        grown = outside.copy()
        for axis in range(3):
            for way in (1, -1):
                shifted = np.roll(outside, way, axis)
                shifted[tuple(slice(None) if k != axis else (0 if way == 1 else -1) for k in range(3))] = False
                grown |= shifted
        grown &= ~wall
        if (grown == outside).all():
            return Voxels(~outside[1:-1, 1:-1, 1:-1], low, side)
        outside = grown


def turned(profile, n=40):
    """A surface of revolution about y through (radius, height) points, closed at both ends if these have radius 0."""
    profile = np.asarray(profile, float)
    a = np.linspace(0, 2 * np.pi, n, endpoint=False)
    x = np.stack([profile[:, :1] * np.cos(a), np.repeat(profile[:, 1:], n, 1), -profile[:, :1] * np.sin(a)], -1).reshape(-1, 3)
    i, j = (v.ravel() for v in np.mgrid[0:len(profile) - 1, 0:n])
    p, q = i * n + j, i * n + (j + 1) % n
    return x, np.concatenate([np.stack([p, p + n, q], 1), np.stack([q, p + n, q + n], 1)])
