"""Bodies modeled by distances: smooth unions of balls, cones and blocks, filled with tetrahedra.

A function f of points is negative inside. `filled` cuts a body-centered lattice along f = 0, after vertices near the surface
are moved onto it (Labelle and Shewchuk 2007): no tetrahedron becomes a sliver, and the surface is smooth.
"""
import heapq

import numpy as np

from maps import border
from paint import skin


def cone(p, a, b, ra, rb):
    """The distance from a segment with radii at its ends that change evenly."""
    a, b = np.asarray(a, float), np.asarray(b, float)
    along = b - a
    t = np.clip((p - a) @ along / (along @ along), 0, 1)
    return np.linalg.norm(p - a - t[:, None] * along, axis=1) - (ra + t * (rb - ra))


def ball(p, center, radii):
    """About the distance from an ellipsoid along the axes."""
    q = (p - np.asarray(center, float)) / np.asarray(radii, float)
    length = np.linalg.norm(q, axis=1)
    slope = np.linalg.norm(q / np.asarray(radii, float), axis=1)
    return length * (length - 1) / np.maximum(slope, 1e-9)


def union(parts, blend):
    """The smooth union of shapes: where two meet, within `blend`, the corner is rounded."""
    out = parts[0]
    for part in parts[1:]:
        out = joined(out, part, blend)
    return out


def joined(a, b, blend):
    h = np.maximum(blend - np.abs(a - b), 0) / blend
    return np.minimum(a, b) - .25 * blend * h * h


def without(a, b, blend):
    return -joined(-a, b, blend)


def mirrored(p):
    """Points with x ≥ 0: a shape of them is symmetric."""
    return np.column_stack([np.abs(p[:, 0]), p[:, 1:]])


def lattice(low, high, side):
    """A body-centered lattice of cubes: points and tetrahedra, four about each face between two cubes."""
    n = np.ceil((np.asarray(high) - low) / side).astype(int)
    grid = np.stack(np.meshgrid(*(np.arange(k + 1) for k in n), indexing="ij"), -1).reshape(-1, 3)
    cells = np.stack(np.meshgrid(*(np.arange(k) for k in n), indexing="ij"), -1).reshape(-1, 3)
    corner = lambda at: np.ravel_multi_index(tuple(at.T), n + 1)
    center = lambda at: len(grid) + np.ravel_multi_index(tuple(at.T), n)
    tets = []
    for axis in range(3):
        first = cells[cells[:, axis] < n[axis] - 1]
        step, one, two = (np.eye(3, dtype=int)[(axis + k) % 3] for k in range(3))
        a, b = center(first), center(first + step)
        ring = [first + step, first + step + one, first + step + one + two, first + step + two]
        for k in range(4):
            tets.append(np.stack([a, b, corner(ring[k]), corner(ring[(k + 1) % 4])], 1))
    x = low + side * np.concatenate([grid, cells + .5])
    return x, np.concatenate(tets)


def volumes(x, tets):
    a, b, c, d = (x[tets[:, k]] for k in range(4))
    return np.einsum("nd,nd->n", b - a, np.cross(c - a, d - a))


def oriented(x, tets):
    """Tetrahedra with positive volumes; those without volume are left out."""
    volume = volumes(x, tets)
    tets = np.where((volume < 0)[:, None], tets[:, [0, 1, 3, 2]], tets)
    return tets[np.abs(volume) > 1e-12 * np.abs(volume).max()]


def filled(shape, low, high, side):
    """Positions and tetrahedra of the inside of `shape`, edges about `side` long."""
    x, tets = lattice(low, high, side)
    value = shape(x)
    # Move vertices near the surface onto it, each along one of its edges.
    tets = tets[(value[tets] < 0).any(1) | (value[tets] == 0).any(1)]
    pairs = np.unique(np.sort(tets[:, [[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]]].reshape(-1, 2), 1), axis=0)
    cut = pairs[value[pairs[:, 0]] * value[pairs[:, 1]] < 0]
    ends = np.concatenate([cut, cut[:, ::-1]])
    t = value[ends[:, 0]] / (value[ends[:, 0]] - value[ends[:, 1]])
    order = np.argsort(t)
    for (a, b), share in zip(ends[order].tolist(), t[order].tolist()):
        if share < .3 and value[a] != 0 and value[b] != 0:
            x[a] += share * (x[b] - x[a])
            value[a] = 0
    return pieces(x, tets, value)


def pieces(x, tets, value):
    """The parts of tetrahedra in which the linear function through the values is not positive."""
    points, added = [x], {}

    def between(a, b):
        key = (min(a, b), max(a, b))
        if key not in added:
            t = value[a] / (value[a] - value[b])
            added[key] = len(x) + len(added)
            points.append(((1 - t) * x[a] + t * x[b])[None])
        return added[key]

    kept = [tets[(value[tets] <= 0).all(1) & (value[tets] < 0).any(1)]]
    crossed = tets[(value[tets] > 0).any(1) & (value[tets] < 0).any(1)]
    new = []
    for tet in crossed.tolist():
        inside = [v for v in tet if value[v] < 0]
        on = [v for v in tet if value[v] == 0]
        out = [v for v in tet if value[v] > 0]
        if len(inside) == 1:
            new.append([*inside, *on, *(between(inside[0], v) for v in out)])
        elif len(out) == 1 and len(inside) == 3:
            new += prism(inside, [between(v, out[0]) for v in inside])
        elif len(out) == 1:
            # Two inside and one on the surface: a pyramid over a square.
            new += pyramid(on[0], [inside[0], inside[1], between(inside[1], out[0]), between(inside[0], out[0])])
        else:
            a, b = inside
            c, d = out
            new += prism([a, between(a, c), between(a, d)], [b, between(b, c), between(b, d)])
    x = np.concatenate(points)
    tets = np.concatenate([*kept, np.array(new).reshape(-1, 4)])
    used, tets = np.unique(oriented(x, tets), return_inverse=True)
    return x[used], tets.reshape(-1, 4)


def pyramid(tip, square):
    """Two tetrahedra; the square's diagonal begins at its lowest vertex, so that neighbors agree."""
    k = int(np.argmin(square))
    a, b, c, d = square[k:] + square[:k]
    return [[tip, a, b, c], [tip, a, c, d]]


def prism(bottom, top):
    """Three tetrahedra; each square's diagonal begins at its lowest vertex, so that neighbors agree."""
    if min(top) < min(bottom):
        bottom, top = top, bottom
    k = int(np.argmin(bottom))
    (a, b, c), (d, e, f) = bottom[k:] + bottom[:k], top[k:] + top[:k]
    return [[a, d, e, f], *pyramid(a, [b, c, f, e])]


def dinosaur(p):
    """A long neck, a tail, four legs and a ridge along the back; it looks along −x, y is up."""
    q = np.column_stack([p[:, 0], p[:, 1], np.abs(p[:, 2])])
    curve = lambda points, radii: [cone(q, a, b, ra, rb) for a, b, ra, rb in zip(points, points[1:], radii, radii[1:])]
    spine = [(-.55, 1.05, 0), (0, 1.15, 0), (.6, 1.02, 0)]
    neck = [(-.55, 1.1, 0), (-1.0, 1.45, 0), (-1.25, 1.95, 0), (-1.33, 2.4, 0)]
    tail = [(.6, 1.0, 0), (1.2, .78, 0), (1.8, .62, 0), (2.4, .66, 0), (2.9, .8, 0)]
    parts = curve(spine, (.42, .5, .4)) + curve(neck, (.34, .25, .19, .17)) + curve(tail, (.38, .26, .17, .11, .06))
    parts += [ball(q, (-1.45, 2.45, 0), (.3, .2, .19)), ball(q, (-1.66, 2.38, 0), (.2, .13, .14))]
    for x, knee in ((-.5, -.56), (.5, .58)):
        parts += curve([(x, .85, .26), (knee, .45, .33), (x, .1, .33)], (.24, .17, .15))
        parts.append(ball(q, (x - .08, .06, .33), (.22, .1, .17)))
    body = union(parts, .16)
    ridge = [ball(q, (x, y, 0), (.13, .17, .05)) for x, y in ((-.75, 1.62), (-.4, 1.6), (0, 1.72), (.4, 1.58), (.8, 1.3), (1.2, 1.08))]
    return np.minimum.reduce([joined(body, spike, .05) for spike in ridge])


def bust(p):
    """A woman's head with a bun, a neck and shoulders; it looks along z, y is up."""
    q = mirrored(p)
    skull = union([ball(q, (0, .2, -.1), (.78, .85, .92)), ball(q, (0, -.28, .28), (.5, .62, .52)), ball(q, (0, -.62, .5), (.24, .2, .22)),
                   ball(q, (.33, -.1, .47), (.26, .24, .24))], .25)
    nose = union([cone(q, (0, .18, .76), (0, -.2, .97), .07, .1), ball(q, (.09, -.22, .86), (.085, .065, .09))], .1)
    face = joined(skull, nose, .14)
    face = without(face, ball(q, (.27, .12, .88), (.17, .1, .16)), .12)
    face = joined(face, ball(q, (.27, .11, .66), (.13, .1, .12)), .04)
    face = joined(face, cone(q, (.1, .28, .8), (.42, .27, .66), .05, .03), .1)
    lips = [ball(q, (0, -.43, .79), (.19, .05, .09)), ball(q, (0, -.53, .77), (.16, .06, .09))]
    face = joined(face, lips[0], .05)
    face = joined(face, lips[1], .05)
    ear = without(ball(q, (.8, -.06, -.02), (.09, .26, .17)), ball(q, (.9, -.04, .05), (.08, .16, .1)), .05)
    face = joined(face, ear, .08)
    # Hair in strands from the forehead to a bun, thicker than the skull, cut off over the face and the ears.
    angle = np.arctan2(q[:, 0], p[:, 1] + .3)
    strands = .028 * np.cos(26 * angle) + .016 * np.cos(9 * p[:, 2] + 14 * angle)
    cap = ball(q, (0, .24, -.16), (.86, .92, .96)) + strands
    plane = .64 * p[:, 2] - .77 * p[:, 1] + .17 + .25 * q[:, 0] ** 2
    hair = -joined(-cap, -plane, .08)
    bun = ball(q, (0, .62, -1.1), (.42, .4, .36)) + .03 * np.cos(14 * np.arctan2(p[:, 1] - .62, p[:, 0]) + 9 * p[:, 2])
    head = union([face, hair, bun], .08)
    neck = cone(q, (0, -.6, -.18), (0, -1.5, -.25), .4, .42)
    shoulders = union([cone(q, (0, -1.75, -.25), (.95, -1.95, -.3), .46, .32), ball(q, (0, -1.9, -.1), (.8, .5, .5))], .3)
    return np.maximum(joined(joined(head, neck, .2), shoulders, .4), BASE - p[:, 1])


BASE = -1.85
BUST = ((-1.5, -2, -1.7), (1.5, 1.3, 1.2))


NAPE, CROWN = (0, -.6, -.75), (0, .8, -1.45)


def cut_bust(to, rounds=0):
    """The surface of the bust, open below and cut from there along a path up its back to a place: a disk. Positions, triangles,
    and the path. Each round halves the edges."""
    x, tets = filled(bust, *BUST, .082)
    triangles = skin(x, tets)
    a, b, c = (x[triangles[:, k]] for k in range(3))
    normal = np.cross(b - a, c - a)
    below = (a[:, 1] < BASE + .1) & (normal[:, 1] < -.6 * np.linalg.norm(normal, axis=1))
    x, triangles = compact(x, triangles[~below])
    rim = np.unique(border(triangles))
    x[rim, 1] = BASE
    for _ in range(rounds):
        x, triangles = halved(x, triangles)
        x = np.where(x[:, 1:2] > BASE + .1, projected(bust, x), x)
    rim = np.unique(border(triangles))
    start = rim[np.argmin(x[rim] @ [0, 0, 1] + np.abs(x[rim, 0]))]
    end = np.argmin(np.linalg.norm(x - to, axis=1))
    path = shortest(x, triangles, int(start), int(end))
    line = x[path]
    x, triangles = opened(x, triangles, path)
    # Files know vertices by their places: both sides of the cut need their own.
    x[-(len(path) - 1):, 0] += 1e-5
    return x, triangles, line


def compact(x, triangles):
    used, triangles = np.unique(triangles, return_inverse=True)
    return x[used], triangles.reshape(-1, 3)


def halved(x, triangles):
    """Every triangle in four."""
    sides = np.sort(triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), 1)
    unique, place = np.unique(sides, axis=0, return_inverse=True)
    a, b, c = triangles.T
    d, e, f = (len(x) + place.reshape(-1, 3)).T
    x = np.concatenate([x, x[unique].mean(1)])
    return x, np.concatenate([np.stack(t, 1) for t in ((a, d, f), (d, b, e), (f, e, c), (d, e, f))])


def projected(shape, x, step=1e-4):
    """Points moved onto the surface of a shape along its gradient, those far from it left where they are."""
    value = shape(x)
    gradient = np.stack([(shape(x + step * e) - value) / step for e in np.eye(3)], 1)
    move = -(value / np.maximum((gradient ** 2).sum(1), 1e-3))[:, None] * gradient
    return x + np.where(np.linalg.norm(move, axis=1)[:, None] < .02, move, 0)


def shortest(x, triangles, start, end):
    """The vertices of the shortest path along edges."""
    near = {}
    for a, b in np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]).tolist():
        length = float(np.linalg.norm(x[a] - x[b]))
        near.setdefault(a, []).append((b, length))
        near.setdefault(b, []).append((a, length))
    best, before, queue = {start: 0.0}, {}, [(0.0, start)]
    while queue:
        so_far, a = heapq.heappop(queue)
        if a == end:
            break
        for b, length in near[a]:
            if so_far + length < best.get(b, np.inf):
                best[b], before[b] = so_far + length, a
                heapq.heappush(queue, (so_far + length, b))
    path = [end]
    while path[-1] != start:
        path.append(before[path[-1]])
    return path[::-1]


def opened(x, triangles, path):
    """The surface cut along a path from its border: triangles to the left of the path get vertices of their own."""
    new = triangles.copy()
    ahead, behind = dict(zip(path, path[1:])), dict(zip(path[1:], path))
    of_edge = {(t[k], t[(k + 1) % 3]): (n, k) for n, t in enumerate(triangles.tolist()) for k in range(3)}
    for number, v in enumerate(path[:-1]):
        # Go around the vertex from the triangle to the left of the path ahead to the path behind, or to the border.
        to = ahead[v]
        while (v, to) in of_edge and to != behind.get(v):
            face, corner = of_edge[v, to]
            new[face, corner] = len(x) + number
            to = int(triangles[face, (corner + 2) % 3])
    return np.concatenate([x, x[path[:-1]]]), new
