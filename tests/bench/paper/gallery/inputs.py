"""Handles, drawings and surfaces made for the figures."""
import io

import matplotlib.image
import numpy as np

# Anchors of the camel's map and where they go.
CAMEL = [([0.95, 0.06], [0.62, -0.12]), ([0.55, 0.6], [0.55, 0.6]), ([0.9, 0.6], [0.9, 0.6])]

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


def fruit(_):
    vertices, triangles = ball(1.0, 40, 60)
    bump = lambda x, z: 1 + 0.05 * np.cos(5 * np.arctan2(z, x))
    lines = [f"v {x * bump(x, z):.9f} {0.8 * y:.9f} {z * bump(x, z):.9f}" for x, y, z in vertices]
    return "\n".join(lines + [f"f {a + 1} {b + 1} {c + 1}" for a, b, c in triangles]) + "\n"


def press_fruit():
    return {"handles": [held([0, -0.75, 0], 0.3), moved([0, 0.75, 0], 0.3, [0, -0.4, 0])]}


# Where the drawing of a face lies in UV space: its middle, its right and up, which the chart of the face has turned by 45 degrees.
MIDDLE, RIGHT, UP = np.array([0.385, 0.385]), 0.22 * np.array([1, -1]) / np.sqrt(2), 0.22 * np.array([1, 1]) / np.sqrt(2)


def drawn_face(_):
    """Eyes, a nose and a mouth on skin with a grid, v up."""
    v, u = 1 - np.mgrid[0:768, 0:768] / 768
    uv = np.stack([1 - u, v], axis=-1) - MIDDLE
    x, y = (uv @ axis / (axis @ axis) for axis in (RIGHT, UP))
    rgb = np.ones((768, 768, 3)) * (0.93, 0.78, 0.66)
    rgb[(((x + 10) * 4) % 1 < 0.05) | (((y + 10) * 4) % 1 < 0.05)] *= 0.8
    spot = lambda cx, cy, rx, ry: ((x - cx) / rx) ** 2 + ((y - cy) / ry) ** 2 < 1
    for cx in (-0.5, 0.5):
        rgb[spot(cx, 0.25, 0.2, 0.1)] = (1, 1, 1)
        rgb[spot(cx, 0.25, 0.09, 0.095)] = (0.15, 0.35, 0.6)
        rgb[spot(cx, 0.45, 0.24, 0.03)] = (0.3, 0.18, 0.1)
    rgb[spot(0, 0.0, 0.09, 0.13)] = (0.85, 0.55, 0.5)
    rgb[spot(0, -0.4, 0.3, 0.08)] = (0.75, 0.2, 0.25)
    return png(np.clip(rgb, 0, 1))


# Vertices of the face, corners and lids of the eyes, brows, nose, corners and lips of the mouth, and where the drawing has them.
FEATURES = {
    1809: (-0.66, 0.25), 13910: (-0.34, 0.25), 10039: (-0.5, 0.33), 2047: (-0.5, 0.17), 22644: (-0.5, 0.45),
    1808: (0.66, 0.25), 13908: (0.34, 0.25), 6794: (0.5, 0.33), 2046: (0.5, 0.17), 19969: (0.5, 0.45),
    2874: (0, 0), 326: (0, 0.11), 7389: (-0.27, -0.4), 10631: (0.27, -0.4), 2357: (0, -0.33), 724: (0, -0.47),
}


def face_points():
    to = lambda x, y: list(map(float, MIDDLE + x * RIGHT + y * UP))
    return {"points": [{"vertex": v, "to": to(*at)} for v, at in FEATURES.items()]}


def turned_disk():
    rim = [(100 + 85 * np.cos(a), 100 + 85 * np.sin(a)) for a in np.radians(range(0, 360, 45))]
    handles = [held([float(x), float(y)], 6) for x, y in rim]
    return {"handles": [*handles, moved([100, 100], 20, [100, 100], turn=80.0)]}
