"""Triangles of the plane as fragments, many at once."""
import numpy as np

CHUNK = 4_000_000


def barycentric(corners, points):
    """Weights of `points` (n, 2) in triangles (n, 3, 2)."""
    a, e, f = corners[:, 0], corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    area = e[:, 0] * f[:, 1] - e[:, 1] * f[:, 0]
    area = np.where(area == 0, 1e-300, area)
    d = points - a
    s = (d[:, 0] * f[:, 1] - d[:, 1] * f[:, 0]) / area
    t = (e[:, 0] * d[:, 1] - e[:, 1] * d[:, 0]) / area
    return np.stack([1 - s - t, s, t], 1)


def nearest(corners, points):
    """Weights at the nearest points of triangles' edges, and distances."""
    best = np.full(len(points), np.inf)
    weights = np.zeros((len(points), 3))
    for k in range(3):
        a, b = corners[:, k], corners[:, (k + 1) % 3]
        edge = b - a
        length2 = np.maximum((edge * edge).sum(1), 1e-300)
        t = np.clip(((points - a) * edge).sum(1) / length2, 0, 1)
        distance = np.linalg.norm(points - a - t[:, None] * edge, axis=1)
        closer = distance < best
        best[closer] = distance[closer]
        weights[closer] = 0
        weights[closer, k] = 1 - t[closer]
        weights[closer, (k + 1) % 3] = t[closer]
    return weights, best


def boxes(triangles, size, margin):
    """Chunks (faces, pixels as (n, 2) of x and y) of all pixels in the boxes of triangles (n, 3, 2), in pixels."""
    low = np.clip(np.floor(triangles.min(1) - margin), 0, size).astype(int)
    high = np.clip(np.ceil(triangles.max(1) + margin), 0, size).astype(int)
    extent = np.maximum(high - low, 0)
    counts = extent.prod(1)
    begin = 0
    while begin < len(triangles):
        total = np.cumsum(counts[begin:])
        end = begin + max(1, int(np.searchsorted(total, CHUNK)))
        faces = np.repeat(np.arange(begin, end), counts[begin:end])
        first = np.repeat(np.cumsum(counts[begin:end]) - counts[begin:end], counts[begin:end])
        place = np.arange(len(faces)) - first
        width = np.maximum(extent[faces, 0], 1)
        yield faces, np.stack([low[faces, 0] + place % width, low[faces, 1] + place // width], 1)
        begin = end


def visible(triangles, depths, size):
    """Of triangles in pixels with depths (n, 3) at their corners those nearest to the eye: (faces, weights, pixels)."""
    found = []
    for faces, pixels in boxes(triangles, size, 0):
        weights = barycentric(triangles[faces], pixels + 0.5)
        inside = (weights >= 0).all(1)
        faces, pixels, weights = faces[inside], pixels[inside], weights[inside]
        depth = (weights * depths[faces]).sum(1)
        found.append((faces, weights, pixels[:, 1] * size + pixels[:, 0], depth))
    faces, weights, pixels, depth = (np.concatenate(parts) for parts in zip(*found))
    order = np.lexsort((depth, pixels))
    _, first = np.unique(pixels[order], return_index=True)
    chosen = order[first]
    return faces[chosen], weights[chosen], pixels[chosen]


def covered(triangles, size, reach=1.5):
    """The face and weights of each pixel in a triangle or within reach beside one, (faces, weights, pixels); -1 of none."""
    face = np.full(size * size, -1)
    weights = np.zeros((size * size, 3))
    for faces, pixels in boxes(triangles, size, 0):
        inside_weights = barycentric(triangles[faces], pixels + 0.5)
        inside = (inside_weights >= 0).all(1)
        at = pixels[inside, 1] * size + pixels[inside, 0]
        face[at], weights[at] = faces[inside], inside_weights[inside]
    best = np.where(face < 0, reach, -1.0)
    for faces, pixels in boxes(triangles, size, reach):
        at = pixels[:, 1] * size + pixels[:, 0]
        free = best[at] >= 0
        faces, pixels, at = faces[free], pixels[free], at[free]
        near, distance = nearest(triangles[faces], pixels + 0.5)
        order = np.argsort(-distance, kind="stable")
        order = order[distance[order] < best[at[order]]]
        # Of several for one pixel the last, which is the nearest, stays.
        face[at[order]], weights[at[order]], best[at[order]] = faces[order], near[order], distance[order]
    at = np.flatnonzero(face >= 0)
    return face[at], weights[at], at
