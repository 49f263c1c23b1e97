# SPDX-FileCopyrightText: The authors of unwrapd
# SPDX-License-Identifier: GPL-3.0-or-later

"""Seams along edges of polygons.

The library sees triangles and may cut a polygon between them, which UVs of loops cannot say: such a seam is led around
the polygon instead.
"""

import numpy as np


def split(mesh, uvs, mask):
    """The polygons that are cut, by the UVs of the corners of triangles (T, 3, 2). Triangles without area do not count."""
    mask = mask & mesh.has_area
    triangles, corners = mesh.triangles[mask], uvs[mask]
    first = np.zeros((len(mesh.vertices), 2), uvs.dtype)
    first[triangles[::-1]] = corners[::-1]
    return np.unique(mesh.polygons[mask][(first[triangles] != corners).any(axis=(1, 2))]).tolist()


def of_loops(mesh, uvs, mask):
    """UVs of the loops (L, 2) of triangles in a mask, where no polygon is cut; zeros elsewhere."""
    found = np.zeros((len(mesh.vertices), 2), np.float32)
    # Those with area come last: they decide.
    for some in (mask & ~mesh.has_area, mask & mesh.has_area):
        found[mesh.triangles[some]] = uvs[some]
    return found


def around(mesh, uvs, mask, known):
    """The seams of UVs of corners as pairs of vertices, those through polygons led around them.

    They take the shorter side of a polygon, or the longer one if there is a seam all along the shorter one.
    """
    loops, uvs = mesh.triangles[mask], uvs[mask]
    begin, end = loops.reshape(-1), np.roll(loops, -1, axis=1).reshape(-1)
    at_begin, at_end = uvs.reshape(-1, 2), np.roll(uvs, -1, axis=1).reshape(-1, 2)
    polygon = np.repeat(mesh.polygons[mask], 3)
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
    found = {*pairs(edges[is_seam & (edges[:, 2] < 0), :2])}
    for v, w, polygon in edges[is_seam & (edges[:, 2] >= 0)].tolist():
        shorter, longer = ways(mesh, polygon, v, w)
        found |= longer if shorter <= known else shorter
    return found


def next_loop(mesh, loops, polygons):
    """The loops that follow in their polygons."""
    following = loops + 1
    return np.where(following == mesh.starts[polygons + 1], mesh.starts[polygons], following)


def ways(mesh, polygon, v, w):
    """The shorter and the longer way between two vertices along the sides of a polygon, as pairs of vertices."""
    ring = ring_of(mesh, polygon)
    i, j = sorted((ring.index(v), ring.index(w)))
    both = [ring[i : j + 1], ring[j:] + ring[: i + 1]]

    def length(way):
        return np.linalg.norm(np.diff(mesh.positions[way], axis=0), axis=1).sum()

    return [{*pairs(np.stack([way[:-1], way[1:]], 1))} for way in sorted(both, key=length)]


def sides(mesh, polygon):
    """The sides of a polygon, as pairs of vertices."""
    ring = ring_of(mesh, polygon)
    return {*pairs(np.stack([ring, ring[1:] + ring[:1]], 1))}


def ring_of(mesh, polygon):
    """The vertices around a polygon."""
    return mesh.vertices[mesh.starts[polygon] : mesh.starts[polygon + 1]].tolist()


def pairs(edges):
    """Edges (E, 2) as tuples, the lower vertex first."""
    return map(tuple, np.sort(edges, axis=1).tolist())
