"""Surfaces drawn with a depth buffer, lit from the viewer's left, textured if asked for."""
import numpy as np

LIGHT = np.array([-0.45, 0.65, 0.75]) / np.linalg.norm([-0.45, 0.65, 0.75])
CLAY = np.array([0.86, 0.80, 0.70])


def rotation(azimuth, elevation):
    """World (y up) to view (x right, y up, z toward the viewer); degrees."""
    a, e = np.radians([azimuth, elevation])
    turn = np.array([[np.cos(a), 0, -np.sin(a)], [0, 1, 0], [np.sin(a), 0, np.cos(a)]])
    tilt = np.array([[1, 0, 0], [0, np.cos(e), -np.sin(e)], [0, np.sin(e), np.cos(e)]])
    return tilt @ turn


def render(mesh, view=(30, 15), size=520, color=CLAY, uvs=None, texture=None, frame=(), wire=0.0):
    """An RGB picture (size, size, 3) in [0, 1]; `texture(uv)` gives colors of points (n, 2). `frame` holds meshes
    whose common box the picture shows, so that several pictures have one scale; `wire` darkens the edges of triangles."""
    turned = mesh.positions @ rotation(*view).T
    box = np.concatenate([m.positions for m in (mesh, *frame)]) @ rotation(*view).T
    center, extent = (box.min(0) + box.max(0)) / 2, (box.max(0) - box.min(0))[:2].max()
    scale = 0.94 * size / extent
    screen = (turned - center) * scale
    x, y = size / 2 + screen[:, 0], size / 2 - screen[:, 1]
    normals = vertex_normals(turned, mesh.triangles)
    picture, depth = np.ones((size, size, 3)), np.full((size, size), -np.inf)
    for face, t in enumerate(mesh.triangles):
        tx, ty = x[t], y[t]
        area = (tx[1] - tx[0]) * (ty[2] - ty[0]) - (tx[2] - tx[0]) * (ty[1] - ty[0])
        low = np.maximum([np.floor(tx.min()), np.floor(ty.min())], 0).astype(int)
        high = np.minimum([np.ceil(tx.max()), np.ceil(ty.max())], size - 1).astype(int)
        if abs(area) < 1e-12 or (low > high).any():
            continue
        px, py = np.meshgrid(np.arange(low[0], high[0] + 1), np.arange(low[1], high[1] + 1))
        w1 = ((px - tx[0]) * (ty[2] - ty[0]) - (tx[2] - tx[0]) * (py - ty[0])) / area
        w2 = ((tx[1] - tx[0]) * (py - ty[0]) - (px - tx[0]) * (ty[1] - ty[0])) / area
        w = np.stack([1 - w1 - w2, w1, w2], axis=-1)
        z = w @ screen[t, 2]
        inside = (w >= -1e-9).all(-1) & (z > depth[py, px])
        if not inside.any():
            continue
        w, px, py = w[inside], px[inside], py[inside]
        normal = w @ normals[t]
        normal /= np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-12)
        shade = 0.42 + 0.58 * np.abs(normal @ LIGHT)
        base = texture(w @ uvs[face]) if texture else np.broadcast_to(color, (len(w), 3))
        height = 2 * np.abs(area) / np.hypot(tx - np.roll(tx, 1), ty - np.roll(ty, 1)).max()
        near = (w.min(1) * height < 0.8)[:, None]
        picture[py, px] = np.clip(base * shade[:, None] * np.where(near, 1 - wire, 1), 0, 1)
        depth[py, px] = z[inside]
    return picture


def vertex_normals(positions, triangles):
    a, b, c = (positions[triangles[:, k]] for k in range(3))
    normals = np.zeros_like(positions)
    for k in range(3):
        np.add.at(normals, triangles[:, k], np.cross(b - a, c - a))
    return normals


def checkerboard(n):
    """A texture of n × n pairs of squares over the unit square, tinted by place."""
    def colors(uv):
        odd = (np.floor(uv * 2 * n).astype(int).sum(1) % 2)[:, None]
        tint = np.stack([0.35 + 0.6 * uv[:, 0] % 1, 0.55 + 0 * uv[:, 0], 0.35 + 0.6 * uv[:, 1] % 1], axis=1)
        return np.where(odd == 1, np.array([0.97, 0.97, 0.95]), np.clip(tint, 0, 1))
    return colors


def image(pixels):
    """A texture from a picture (rows downwards), v up."""
    rows, columns = pixels.shape[:2]
    def colors(uv):
        column = np.clip((uv[:, 0] * columns).astype(int), 0, columns - 1)
        row = np.clip(((1 - uv[:, 1]) * rows).astype(int), 0, rows - 1)
        return pixels[row, column, :3]
    return colors
