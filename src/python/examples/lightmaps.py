"""A lightmap for a scene: one atlas for all objects, and the light of a lamp in it, with shadows.

    python lightmaps.py [OUT.png]

Objects share an atlas when they are unwrapped together. Light is computed at the vertices of finely divided objects, as a renderer
would at texels, and baked. Needs trimesh and Pillow.
"""

import sys

import numpy as np
import trimesh
from PIL import Image

import unwrapd

LAMP = np.array([1.5, -1.0, 4.0])
BALL, RADIUS = np.array([0.0, 0.0, 1.0]), 0.6


def flat(mesh):
    """Vertices, faces and normals, with a vertex for each side that meets at an edge, so that each side has its own light."""
    rows = np.concatenate([mesh.triangles.reshape(-1, 3), np.repeat(mesh.face_normals, 3, 0)], 1)
    rows, corners = np.unique(rows.round(9), axis=0, return_inverse=True)
    return rows[:, :3], corners.reshape(-1, 3), rows[:, 3:]


def scene():
    """Objects in the coordinates of the scene, with normals: a floor, a box, a ball."""
    floor = trimesh.creation.box((5, 5, 0.2))
    box = trimesh.creation.box((1, 1, 1))
    box.apply_translation((-1.6, 0.6, 0.6))
    ball = trimesh.creation.icosphere(4, RADIUS)
    smooth = (ball.vertices + BALL, ball.faces, ball.vertices / RADIUS)
    return [flat(floor.subdivide_to_size(0.08)), flat(box.subdivide_to_size(0.08)), smooth]


def light(points, normals):
    """What comes from the lamp, unless the ball is in between, and a little from everywhere."""
    way = LAMP - points
    distance = np.linalg.norm(way, axis=1, keepdims=True)
    way /= distance
    lambert = (way * normals).sum(1).clip(0) * 12 / distance[:, 0] ** 2
    to_ball = BALL - points
    along = (to_ball * way).sum(1)
    off = np.linalg.norm(to_ball - along[:, None] * way, axis=1)
    is_shaded = (along > 1e-3) & (off < RADIUS * (1 - 1e-3)) & (np.linalg.norm(to_ball, axis=1) > 1.01 * RADIUS)
    return 0.15 + np.where(is_shaded, 0, lambert)


def main(path="lightmap.png"):
    objects = scene()
    atlases = unwrapd.unwrap([(vertices, faces) for vertices, faces, _ in objects], resolution=512, padding=4)
    assert atlases[0].certified

    lights = [light(vertices, normals) for vertices, _, normals in objects]
    image, mask = unwrapd.bake(atlases, lights, 512)
    Image.fromarray((255 * (image / 1.2).clip(0, 1)).astype(np.uint8)).save(path)

    lit = image[mask]
    print(
        f"{len(objects)} objects, {atlases[0].n_charts} charts, {mask.mean():.0%} of the texels used, "
        f"light from {lit.min():.2f} to {lit.max():.2f}: {path}"
    )


if __name__ == "__main__":
    main(*sys.argv[1:])
