"""Pictures of atlases and of surfaces with them, drawn several times as large and shrunk."""
import sys
from pathlib import Path

import numpy as np
from PIL import Image
from scipy.ndimage import gaussian_filter, maximum_filter

sys.path.insert(0, str(Path(__file__).parents[1] / "bake"))
from raster import visible  # noqa: E402

from atlases import corner_normals  # noqa: E402

SUPERSAMPLES = 3
COLORS = np.array([[0x6F, 0xA8, 0xDC], [0xF4, 0xB1, 0x6A], [0x8C, 0xC8, 0x8A], [0xE5, 0x8A, 0x8A], [0xB0, 0x9A, 0xD8],
                    [0xE8, 0xD0, 0x6C], [0x7C, 0xC9, 0xC3], [0xE3, 0x9A, 0xC6], [0xB8, 0xA0, 0x88], [0xA9, 0xB4, 0xC4]]) / 255
INK = np.array([0.13, 0.15, 0.20])
PAPER = np.array([0.955, 0.955, 0.945])
KEY, FILL = (np.array(v) / np.linalg.norm(v) for v in ([-0.5, 0.7, 0.65], [0.8, 0.1, 0.5]))


def checked(atlas, faces, weights, checks):
    """Colors of places on charts: a checkerboard in two tones, with so many squares along the root of the surface's area."""
    uv = np.einsum("nk,nkw->nw", weights, atlas.uv[faces]) * (checks / (atlas.scale() * atlas.areas().sum() ** 0.5))
    light = np.floor(uv).astype(int).sum(1) % 2 == 0
    color = COLORS[atlas.paint(len(COLORS))[atlas.chart[faces]]]
    return np.where(light[:, None], 0.45 * color + 0.55, color)


def shrunk(pixels):
    """An 8-bit picture of the colors (n, n, 3) in 0 to 1."""
    return Image.fromarray(np.round(255 * np.clip(pixels, 0, 1)).astype(np.uint8)).reduce(SUPERSAMPLES)


def marked(ends, depth, width):
    """Where lines (k, 2, 3) in pixels and depth are, unless `depth` (n, n) is nearer; `width` in pixels, odd."""
    size = len(depth)
    length = np.abs(ends[:, 1, :2] - ends[:, 0, :2]).max(1)
    steps = np.ceil(2 * length).astype(int) + 1
    line = np.repeat(np.arange(len(ends)), steps)
    part = (np.arange(len(line)) - np.repeat(np.cumsum(steps) - steps, steps)) / np.maximum(steps - 1, 1)[line]
    points = ends[line, 0] + part[:, None] * (ends[line, 1] - ends[line, 0])
    x, y = np.clip(points[:, :2].astype(int), 0, size - 1).T
    seen = points[:, 2] < depth[y, x]
    mask = np.zeros((size, size), bool)
    mask[y[seen], x[seen]] = True
    disc = np.hypot(*np.mgrid[-(width // 2):width // 2 + 1, -(width // 2):width // 2 + 1]) <= width / 2
    return maximum_filter(mask, footprint=disc)


def layout(atlas, size, checks):
    """The unit square with the charts, `size` pixels wide."""
    n = size * SUPERSAMPLES
    flip = lambda uv: np.stack([uv[..., 0], 1 - uv[..., 1]], -1) * (n - 1)
    pixels = np.tile(PAPER, (n * n, 1))
    faces, weights, at = visible(flip(atlas.uv), np.zeros((len(atlas.faces), 3)), n)
    pixels[at] = checked(atlas, faces, weights, checks)
    lines = np.concatenate([flip(atlas.borders), np.zeros((*atlas.borders.shape[:2], 1))], 2)
    pixels = pixels.reshape(n, n, 3)
    pixels[marked(lines, np.ones((n, n)), SUPERSAMPLES)] = INK
    return shrunk(pixels)


def axes(azimuth, elevation, up):
    """Right, up and toward the eye; degrees; `up` is y or z."""
    a, e = np.radians([azimuth, elevation])
    eye = np.array([np.sin(a) * np.cos(e), np.sin(e), np.cos(a) * np.cos(e)])
    frame = np.array([[np.cos(a), 0, -np.sin(a)], np.cross(eye, [np.cos(a), 0, -np.sin(a)]), eye])
    return frame if up == "y" else frame @ np.array([[1, 0, 0], [0, 0, 1], [0, -1, 0]])


def surface(atlas, size, checks, view):
    """The surface with the charts' colors and seams, seen from `view`, which goes to `axes`."""
    n = size * SUPERSAMPLES
    frame = axes(*view)
    seen = atlas.positions @ frame.T
    low, high = seen.min(0), seen.max(0)
    scale = 0.95 * n / (high - low)[:2].max()
    project = lambda p: ((p @ frame.T - (low + high) / 2) * scale * [1, -1, -1]) + [n / 2, n / 2, 0]
    corners = project(atlas.positions[atlas.faces])
    faces, weights, at = visible(corners[..., :2], corners[..., 2], n)
    normals = np.einsum("nk,nkw->nw", weights, corner_normals(atlas.positions, atlas.faces)[faces]) @ frame.T
    normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-300)
    normals *= np.where(normals[:, 2:] < 0, -1, 1)
    depth = np.full(n * n, np.inf)
    depth[at] = np.einsum("nk,nk->n", weights, corners[..., 2][faces])
    light = shade(normals) * open_sky(depth, n)[at]
    pixels = np.ones((n * n, 3))
    pixels[at] = checked(atlas, faces, weights, checks) * light[:, None]
    pixels, depth = pixels.reshape(n, n, 3), depth.reshape(n, n)
    bias = 0.0015 * n
    pixels[marked(project(atlas.seams) - [0, 0, bias], depth, SUPERSAMPLES)] = INK
    return shrunk(pixels)


def shade(normals):
    """How bright, lit from the left above and less from the right."""
    return 0.60 + 0.42 * np.maximum(normals @ KEY, 0) + 0.12 * np.maximum(normals @ FILL, 0)


def open_sky(depth, n):
    """Less than 1 where the neighborhood is nearer to the eye: what is hollow is darker."""
    covered = np.isfinite(depth).reshape(n, n)
    values = np.where(covered, depth.reshape(n, n), 0)
    radius = n / 40
    mean = gaussian_filter(values, radius) / np.maximum(gaussian_filter(covered.astype(float), radius), 1e-9)
    return (1 - 0.35 * np.clip((values - mean) / (2.5 * radius), 0, 1)).reshape(-1)
