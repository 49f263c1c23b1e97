"""What the checks compute from positions: sizes, singular values, distortion. Nothing here comes from the program's reports."""
import numpy as np


def edges(x, elements):
    """Of every element the matrix whose columns are its edges from the first corner."""
    return np.swapaxes(x[elements[:, 1:]] - x[elements[:, :1]], 1, 2)


def sizes(x, elements):
    """Signed areas or volumes."""
    m = edges(x, elements)
    return np.linalg.det(m) / (2 if m.shape[1] == 2 else 6)


def flips(x, elements):
    """How many elements are inverted; all of them stand upright at rest."""
    return int((sizes(x, elements) <= 0).sum())


def singular_values(rest, x, elements):
    """Of every element's jacobian, the largest first."""
    return np.linalg.svd(edges(x, elements) @ np.linalg.inv(edges(rest, elements)), compute_uv=False)


def conformal(rest, x, elements):
    """σ₁/σ₂ + σ₂/σ₁: the measure that the paper colors by; 2 where angles are kept."""
    s = np.maximum(singular_values(rest, x, elements), 1e-12)
    ratio = s[:, 0] / s[:, -1]
    return ratio + 1 / ratio


def area_distortion(rest, x, elements):
    """Mean of r + 1/r over the elements, by rest size, where r is the size over the rest size; 2 at best."""
    before = sizes(rest, elements)
    r = np.maximum(np.abs(sizes(x, elements)) / before, 1e-6)
    return float(np.average(r + 1 / r, weights=before))


def green(rest, x, elements):
    """The sum of the squared norms of Green's strain."""
    f = edges(x, elements) @ np.linalg.inv(edges(rest, elements))
    strain = np.swapaxes(f, 1, 2) @ f - np.eye(x.shape[1])
    return float((strain ** 2).sum())


def distance(x, pull):
    """The largest distance of a handle from its target."""
    return max(float(np.linalg.norm(x[v] - np.asarray(to))) for v, to in pull.items())


def disc(x, center, radius):
    """The vertices of a disc, at least the nearest."""
    d = np.linalg.norm(x - np.asarray(center), axis=1)
    return np.flatnonzero(d <= max(radius, d.min()))


def pulled(x, *handles, radius=0.06):
    """Targets of handles (center, offset or none, degrees or none): discs moved and turned about their centers."""
    pull = {}
    for center, offset, *turn in handles:
        a = np.radians(turn[0] if turn else 0.0)
        spin = np.eye(x.shape[1])
        spin[:2, :2] = [[np.cos(a), -np.sin(a)], [np.sin(a), np.cos(a)]]
        for v in disc(x, center, radius):
            pull[int(v)] = spin @ (x[v] - center) + center + np.asarray(offset, float)
    return pull


def border(triangles):
    """Directed edges on the border of triangles."""
    sides = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    known = {tuple(side) for side in sides.tolist()}
    return np.array([side for side in sides.tolist() if (side[1], side[0]) not in known])


def crossings(x, sides):
    """Pairs of edges that cross in their insides."""
    a, b = x[sides[:, 0]], x[sides[:, 1]]
    turn = lambda p, q, r: (q[..., 0] - p[..., 0]) * (r[..., 1] - p[..., 1]) - (q[..., 1] - p[..., 1]) * (r[..., 0] - p[..., 0])
    one, two = turn(a[:, None], b[:, None], a[None]), turn(a[:, None], b[:, None], b[None])
    apart = (one * two < 0)
    shared = (sides[:, None, :, None] == sides[None, :, None, :]).any((2, 3))
    return int((apart & apart.T & ~shared).sum() // 2)
