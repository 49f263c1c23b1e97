"""What comes after an image-to-3D model: a noisy surface with colors at its vertices becomes a textured GLB.

    python image_to_3d.py [OUT.glb]

Such models end in a field on a grid, of which marching cubes or tetrahedra make hundreds of thousands of small triangles. Here the
field is a knot with noise. Its surface is unwrapped, the colors of its vertices are baked, and the written file is proven.
Needs trimesh and Pillow.
"""

import itertools
import sys

import numpy as np
import trimesh
from PIL import Image

import unwrapd

#: The six tetrahedra of a cube: the ways from one corner to the opposite along its edges.
TETS = [np.cumsum([np.zeros(3, int), *np.eye(3, dtype=int)[list(way)]], 0) for way in itertools.permutations(range(3))]


def knot(side):
    """A field that is negative inside a trefoil, and its step."""
    t = np.linspace(0, 2 * np.pi, 400, endpoint=False)
    path = np.stack([np.sin(t) + 2 * np.sin(2 * t), np.cos(t) - 2 * np.cos(2 * t), -np.sin(3 * t)], 1)
    axis = np.linspace(-4, 4, side)
    points = np.stack(np.meshgrid(axis, axis, axis, indexing="ij"), -1).reshape(-1, 3)
    nearest = np.full(len(points), np.inf)
    for place in path:
        nearest = np.minimum(nearest, ((points - place) ** 2).sum(1))
    noise = 0.03 * np.random.default_rng(1).standard_normal(len(points))
    return (np.sqrt(nearest) - 0.6 + noise).reshape(side, side, side)


def isosurface(field):
    """Vertices and faces of its zero set, by marching tetrahedra: closed, oriented outward, vertices shared."""
    shape = np.array(field.shape)
    cells = np.stack(np.meshgrid(*(np.arange(n - 1) for n in shape), indexing="ij"), -1).reshape(-1, 3)
    values, triangles = field.reshape(-1), []
    corners = np.concatenate([cells[:, None] + tet for tet in TETS])
    tets = np.ravel_multi_index(np.moveaxis(corners, -1, 0), field.shape)
    is_inside = values[tets] < 0
    tets = np.take_along_axis(tets, np.argsort(~is_inside, 1, kind="stable"), 1)
    count = is_inside.sum(1)
    # Inside corners come first: one or three of them cut off a triangle, two a quadrilateral.
    for n_inside, patterns in {
        1: [((0, 1), (0, 2), (0, 3))],
        2: [((0, 2), (0, 3), (1, 3)), ((0, 2), (1, 3), (1, 2))],
        3: [((0, 3), (1, 3), (2, 3))],
    }.items():
        chosen = tets[count == n_inside]
        triangles += [np.stack([chosen[:, edge] for edge in pattern], 1) for pattern in patterns]
    edges = np.concatenate(triangles).reshape(-1, 2)
    edges, faces = np.unique(edges, axis=0, return_inverse=True)
    inside, outside = (np.stack(np.unravel_index(end, field.shape), 1) for end in edges.T)
    share = values[edges[:, 0]] / (values[edges[:, 0]] - values[edges[:, 1]])
    vertices = inside + share[:, None] * (outside - inside)
    faces = faces.reshape(-1, 3)
    a, b, c = (vertices[corner] for corner in faces.T)
    outward = (outside - inside)[faces].sum(1)
    is_turned = (np.cross(b - a, c - a) * outward).sum(1) < 0
    faces[is_turned] = faces[is_turned][:, ::-1]
    return vertices / (shape - 1), faces


def main(path="knot.glb"):
    vertices, faces = isosurface(knot(40))
    colors = 0.5 + 0.5 * np.sin(12 * vertices + (0, 2, 4))

    atlas = unwrapd.unwrap(vertices, faces, resolution=1024, padding=4)
    image, _ = unwrapd.bake(atlas, colors, 1024)

    texture = Image.fromarray((255 * image.clip(0, 1)).astype(np.uint8))
    visual = trimesh.visual.TextureVisuals(uv=atlas.uvs, image=texture)
    trimesh.Trimesh(vertices[atlas.vmapping], atlas.indices, visual=visual, process=False).export(path)

    proof = unwrapd.verify_file(path, bijective=True)
    assert proof["certified"], proof["lacking"]
    print(f"{len(faces)} faces, {atlas.n_charts} charts, {path}: certified")


if __name__ == "__main__":
    main(*sys.argv[1:])
