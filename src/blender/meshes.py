# SPDX-FileCopyrightText: The authors of unwrapd
# SPDX-License-Identifier: GPL-3.0-or-later

"""Meshes of Blender as arrays, and UVs back into them."""

import numpy as np


class Mesh:
    """A mesh of an object: triangles of its polygons, and what its loops have.

    While it is being edited, only its selected and visible polygons may change.
    """

    def __init__(self, thing, is_edited=False):
        self.data = data = thing.data
        self.name = thing.name
        data.calc_loop_triangles()
        triangles, loops = data.loop_triangles, data.loops
        #: The loops of triangles (T, 3), the vertices of loops (L,), and where the loops of polygons begin (P + 1,).
        self.triangles = gathered(triangles, "loops", np.int32, 3)
        self.vertices = gathered(loops, "vertex_index", np.int32)
        self.polygons = gathered(triangles, "polygon_index", np.int32)
        starts = gathered(data.polygons, "loop_start", np.int32)
        self.starts = np.append(starts, np.int32(len(loops)))
        self.positions = placed(gathered(data.vertices, "co", np.float32, 3), thing.matrix_world)
        edges = gathered(data.edges, "vertices", np.int32, 2)
        self.seams = edges[gathered(data.edges, "use_seam", bool)]
        #: Which triangles (T,) may change, and which have an area.
        self.is_free = free_polygons(data, is_edited)[self.polygons]
        self.has_area = areas(self.positions[self.faces]) > 0.0

    @property
    def faces(self):
        """Vertices of triangles (T, 3)."""
        return self.vertices[self.triangles]

    def uvs(self):
        """UVs of loops (L, 2) of the active layer; None if there is none."""
        layer = self.data.uv_layers.active
        return None if layer is None else gathered(layer.uv, "vector", np.float32, 2)

    def pins(self):
        """Which loops are pinned (L,)."""
        layer = self.data.uv_layers.active
        if layer is None or len(layer.pin) == 0:
            return np.zeros(len(self.vertices), bool)
        return gathered(layer.pin, "value", bool)

    def write(self, uvs):
        """Gives the loops of the active layer UVs, in a new layer if there is none."""
        layer = self.data.uv_layers.active or self.data.uv_layers.new(name="UVMap")
        # What is written through `layer.uv` is not undone (Blender 5.0.1); through the attribute it is.
        attribute = self.data.attributes[layer.name]
        attribute.data.foreach_set("vector", np.ascontiguousarray(uvs, np.float32).ravel())
        self.data.update()


def gathered(things, name, dtype, width=1):
    """A property of many things as an array."""
    found = np.empty(len(things) * width, dtype)
    things.foreach_get(name, found)
    return found.reshape(-1, width) if width > 1 else found


def free_polygons(data, is_edited):
    """Which polygons (P,) an operator may change."""
    if not is_edited:
        return np.ones(len(data.polygons), bool)
    return gathered(data.polygons, "select", bool) & ~gathered(data.polygons, "hide", bool)


def areas(corners):
    """Twice the areas of triangles, by the positions of their corners (T, 3, 3)."""
    a, b, c = np.moveaxis(corners.astype(np.float64), 1, 0)
    return np.linalg.norm(np.cross(b - a, c - a), axis=1)


def placed(positions, matrix):
    """Positions in the world, as seen from the same side where an object is mirrored."""
    matrix = np.array(matrix)
    found = positions @ matrix[:3, :3].T + matrix[:3, 3]
    return found * [-1, 1, 1] if np.linalg.det(matrix[:3, :3]) < 0 else found


def meshes_of(things, is_edited=False):
    """The meshes of objects, each once however many share it; those without faces are left out."""
    each = {thing.data: thing for thing in things if thing.type == "MESH"}
    return [Mesh(thing, is_edited) for data, thing in each.items() if len(data.polygons) > 0]


def point_at(mesh, polygons):
    """Selects some polygons of a mesh, and nothing else of it."""
    data = mesh.data
    chosen = np.zeros(len(data.polygons), bool)
    chosen[polygons] = True
    for things in (data.vertices, data.edges):
        things.foreach_set("select", np.zeros(len(things), bool))
    for polygon in polygons:
        for vertex in data.polygons[polygon].vertices:
            data.vertices[vertex].select = True
        for key in data.polygons[polygon].loop_indices:
            data.edges[data.loops[key].edge_index].select = True
    data.polygons.foreach_set("select", chosen)
    data.update()
