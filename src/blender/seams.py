"""Seams along edges of polygons.

The library sees triangles and may cut a polygon between them, which UVs of loops cannot say: such a seam is led around
the polygon instead.
"""

import numpy as np


def split(mesh, uvs):
    """The polygons that are cut, by the UVs of the corners of triangles (T, 3, 2)."""
    first = np.zeros((len(mesh.vertices), 2), uvs.dtype)
    first[mesh.triangles[::-1]] = uvs[::-1]
    return np.unique(mesh.polygons[(first[mesh.triangles] != uvs).any(axis=(1, 2))])


def of_loops(mesh, uvs):
    """UVs of loops (L, 2) of a mesh of which no polygon is cut."""
    found = np.zeros((len(mesh.vertices), 2), np.float32)
    found[mesh.triangles] = uvs
    return found


def around(mesh, uvs):
    """The seams of UVs of corners as pairs of vertices, those through polygons led around them on the shorter side."""
    loops = mesh.triangles
    begin, end = loops.reshape(-1), np.roll(loops, -1, axis=1).reshape(-1)
    at_begin, at_end = uvs.reshape(-1, 2), np.roll(uvs, -1, axis=1).reshape(-1, 2)
    polygon = np.repeat(mesh.polygons, 3)
    v, w = mesh.vertices[begin], mesh.vertices[end]
    # Sides that run the same way have the same pair; inside a polygon a side is told from others between its vertices.
    turned = (v > w)[:, None]
    place = np.where(turned, np.hstack([at_end, at_begin]), np.hstack([at_begin, at_end]))
    is_inner = next_loop(mesh, begin, polygon) != end
    key = np.stack([np.minimum(v, w), np.maximum(v, w), np.where(is_inner, polygon, -1)], 1)
    edges, number = np.unique(key, axis=0, return_inverse=True)
    number = number.reshape(-1)
    low, high = np.full((len(edges), 4), np.inf), np.full((len(edges), 4), -np.inf)
    np.minimum.at(low, number, place)
    np.maximum.at(high, number, place)
    is_seam = (low != high).any(axis=1)
    found = edges[is_seam & (edges[:, 2] < 0), :2].tolist()
    for v, w, polygon in edges[is_seam & (edges[:, 2] >= 0)].tolist():
        found += shorter_way(mesh, polygon, v, w)
    return found


def next_loop(mesh, loops, polygons):
    """The loops that follow in their polygons."""
    following = loops + 1
    return np.where(following == mesh.starts[polygons + 1], mesh.starts[polygons], following)


def shorter_way(mesh, polygon, v, w):
    """The shorter way between two vertices along the sides of a polygon."""
    ring = mesh.vertices[mesh.starts[polygon] : mesh.starts[polygon + 1]].tolist()
    i, j = sorted((ring.index(v), ring.index(w)))
    ways = [ring[i : j + 1], ring[j:] + ring[: i + 1]]

    def length(way):
        return np.linalg.norm(np.diff(mesh.positions[way], axis=0), axis=1).sum()

    way = min(ways, key=length)
    return [list(side) for side in zip(way, way[1:])]
