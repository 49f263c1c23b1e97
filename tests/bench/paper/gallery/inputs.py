"""Handles, drawings and surfaces made for the figures."""
import io

import matplotlib.image
import numpy as np

DISK = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 200 200"><circle cx="100" cy="100" r="90"/></svg>'


def held(center, radius):
    return {"center": center, "radius": radius, "to": center}


def moved(center, radius, to, **more):
    return {"center": center, "radius": radius, "to": to} | more


def spot_head_back():
    hooves = [held([x, -0.72, z], 0.12) for x in (-0.22, 0.22) for z in (0.03, 0.79)]
    return {"handles": [*hooves, moved([0.0, 0.5, -0.35], 0.25, [0.45, 0.95, 0.1])]}


def nested_balls(_):
    lines, first = [], 1
    for radius in (1.0, 0.8):
        vertices, triangles = ball(radius, 24, 36)
        lines += [f"v {x:.9f} {y:.9f} {z:.9f}" for x, y, z in vertices]
        lines += [f"f {a + first} {b + first} {c + first}" for a, b, c in triangles]
        first += len(vertices)
    return "\n".join(lines) + "\n"


def ball(radius, rings, around):
    vertices = [(0, radius, 0)]
    for i in range(1, rings):
        for j in range(around):
            a, b = np.pi * i / rings, 2 * np.pi * j / around
            vertices.append((radius * np.sin(a) * np.cos(b), radius * np.cos(a), radius * np.sin(a) * np.sin(b)))
    vertices.append((0, -radius, 0))
    at = lambda i, j: 1 + (i - 1) * around + j % around
    triangles = [(0, at(1, j + 1), at(1, j)) for j in range(around)]
    for i in range(1, rings - 1):
        for j in range(around):
            a, b, c, d = at(i, j), at(i, j + 1), at(i + 1, j), at(i + 1, j + 1)
            triangles += [(a, b, c), (b, d, c)]
    last = len(vertices) - 1
    return vertices, triangles + [(at(rings - 1, j), at(rings - 1, j + 1), last) for j in range(around)]


def bent_balls():
    return {"handles": [held([-0.9, 0, 0], 0.25), moved([0.9, 0, 0], 0.25, [1.0, 0.6, 0.0]), moved([0, 0.9, 0], 0.25, [0.0, 0.45, 0.0])]}


def test_picture(_):
    """Rings over tinted squares."""
    y, x = np.mgrid[0:300, 0:400]
    odd = (x // 25 + y // 25) % 2
    rgb = np.stack([0.25 + 0.6 * x / 400, 0.55 + 0.25 * odd, 0.85 - 0.6 * y / 300], axis=-1)
    radius = np.hypot(x - 200, y - 150)
    rgb[(np.abs(radius - 60) < 4) | (np.abs(radius - 120) < 4)] = (0.1, 0.1, 0.15)
    return png(np.clip(rgb, 0, 1))


def png(pixels):
    file = io.BytesIO()
    matplotlib.image.imsave(file, pixels, format="png")
    return file.getvalue()


def picture_handles():
    pairs = [((140, 150), (250, 90)), ((260, 150), (150, 210)), ((60, 60), (60, 60)), ((340, 240), (340, 240))]
    return {"handles": [{"at": a, "to": b} for a, b in pairs]}


def bunny_ears():
    ears = [moved([-1.45, 2.35, -0.75], 0.35, [-2.3, 0.9, -0.6]), moved([-0.6, 2.5, -0.2], 0.3, [-1.5, 0.9, 0.6])]
    return {"handles": [held([-0.3, -0.2, 0.0], 0.6), *ears]}


def press_bunny():
    return {"handles": [held([-0.04, -0.75, 0.13], 0.3), moved([-0.02, 0.74, -0.18], 0.2, [-0.02, -0.2, -0.1])]}


def drawn_face(_):
    """Eyes, a nose and a mouth on skin, symmetric."""
    y, x = np.mgrid[0:512, 0:512] / 512
    rgb = np.ones((512, 512, 3)) * (0.93, 0.78, 0.66)
    spot = lambda cx, cy, rx, ry: ((x - cx) / rx) ** 2 + ((y - cy) / ry) ** 2 < 1
    for cx in (0.36, 0.64):
        rgb[spot(cx, 0.40, 0.085, 0.045)] = (1, 1, 1)
        rgb[spot(cx, 0.40, 0.04, 0.042)] = (0.15, 0.35, 0.6)
        rgb[spot(cx, 0.31, 0.10, 0.012)] = (0.3, 0.18, 0.1)
    rgb[spot(0.5, 0.54, 0.035, 0.05)] = (0.85, 0.55, 0.5)
    rgb[spot(0.5, 0.70, 0.12, 0.035)] = (0.75, 0.2, 0.25)
    grid = ((x * 16) % 1 < 0.04) | ((y * 16) % 1 < 0.04)
    rgb[grid] *= 0.8
    return png(rgb)


def turned_disk():
    rim = [(100 + 85 * np.cos(a), 100 + 85 * np.sin(a)) for a in np.radians(range(0, 360, 45))]
    handles = [held([float(x), float(y)], 6) for x, y in rim]
    return {"handles": [*handles, moved([100, 100], 20, [100, 100], turn=150.0)]}
