"""Shapes whose parts repeat, parts that nearly do, squares with UVs, and meshes of polygons. All are made by script."""
import numpy as np


class Part:
    """A piece of surface: positions and polygons."""

    def __init__(self, positions, polygons, material=""):
        self.positions, self.polygons, self.material = np.asarray(positions, float), polygons, material

    def moved(self, matrix, by=(0, 0, 0)):
        matrix = np.asarray(matrix, float)
        turned = self.polygons if np.linalg.det(matrix) > 0 else [polygon[::-1] for polygon in self.polygons]
        return Part(self.positions @ matrix.T + by, turned, self.material)

    def of(self, material):
        return Part(self.positions, self.polygons, material)

    def renumbered(self, random):
        """Vertices, polygons and the first corner of each polygon in another order."""
        order = random.permutation(len(self.positions))
        number = np.argsort(order)
        polygons = [list(number[np.roll(polygon, random.integers(len(polygon)))]) for polygon in self.polygons]
        polygons = [polygons[k] for k in random.permutation(len(polygons))]
        return Part(self.positions[order], polygons, self.material)

    def triangulated(self):
        fans = [[p[0], p[k], p[k + 1]] for p in self.polygons for k in range(1, len(p) - 1)]
        return Part(self.positions, fans, self.material)


def turn(random):
    q, _ = np.linalg.qr(random.normal(size=(3, 3)))
    return q if np.linalg.det(q) > 0 else -q


def scattered(parts, random, apart=10.0):
    """Each part turned at random, at a place of its own."""
    side = int(np.ceil(len(parts) ** (1 / 3)))
    places = [apart * np.array([k % side, k // side % side, k // side ** 2]) for k in range(len(parts))]
    return [part.moved(turn(random), place) for part, place in zip(parts, places)]


# Solids.


def prism(outline, height, taper=1.0):
    """A prism over a convex or star-shaped outline (n, 2); caps are polygons."""
    outline = np.asarray(outline, float)
    n = len(outline)
    below = np.column_stack([outline, np.zeros(n)])
    above = np.column_stack([taper * outline, np.full(n, height)])
    sides = [[k, (k + 1) % n, n + (k + 1) % n, n + k] for k in range(n)]
    return Part(np.concatenate([below, above]), [list(range(n))[::-1], list(range(n, 2 * n)), *sides])


def box(x, y, z, at=(0, 0, 0)):
    return prism([(0, 0), (x, 0), (x, y), (0, y)], z).moved(np.eye(3), at)


def circle(n, radius=1.0, at=(0, 0), phase=0.0):
    angle = 2 * np.pi * (np.arange(n) + phase) / n
    return np.column_stack([at[0] + radius * np.cos(angle), at[1] + radius * np.sin(angle)])


def revolved(profile, n, is_closed=False):
    """A surface of revolution of (radius, height); closed profiles make rings."""
    profile = np.asarray(profile, float)
    m = len(profile)
    angle = 2 * np.pi * np.arange(n) / n
    positions = [[r * np.cos(a), r * np.sin(a), z] for a in angle for r, z in profile]
    rows = range(m if is_closed else m - 1)
    at = lambda k, i: (k % n) * m + i % m
    return Part(positions, [[at(k, i), at(k + 1, i), at(k + 1, i + 1), at(k, i + 1)] for k in range(n) for i in rows])


def torus(radius, tube, n=24, m=10):
    return revolved(circle(m, tube, (radius, 0)), n, is_closed=True)


def bracket(length=1.0, width=0.17):
    """A solid that is no mirror image of itself."""
    outline = np.array([(0, 0), (3, 0), (3, 1), (1.3, 1), (1.0, 2.2), (0, 2.0)])
    part = prism(outline - 0.8, 0.7)
    shear = np.array([[length, 0, 0.3], [0, 1, width], [0, 0, 1]])
    return part.moved(shear)


# Models whose parts repeat.


def cubes(random, n=500):
    return scattered([box(1, 1, 1).triangulated() for _ in range(n)], random), 1


def quad_cubes(random, n=500):
    return scattered([box(1, 1, 1).renumbered(random) for _ in range(n)], random), 1


def gear(random, teeth=24):
    hub = revolved([(0.6, 0), (2, 0), (2, 0.8), (0.6, 0.8)], 4 * teeth, is_closed=True)
    outline = [(0, -0.13), (0.4, -0.09), (0.4, 0.09), (0, 0.13)]
    tooth = prism(outline, 0.8)
    around = [2 * np.pi * k / teeth for k in range(teeth)]
    rotated = [[[np.cos(a), -np.sin(a), 0], [np.sin(a), np.cos(a), 0], [0, 0, 1]] for a in around]
    return [hub] + [tooth.moved(m, (2.05 * m[0][0], 2.05 * m[1][0], 0)) for m in rotated], 2


def stairs(random, n=14):
    steps = [box(3, 1, 0.3, (0, k, 0.3 * k)) for k in range(n)]
    stringers = [box(0.2, float(n), 0.4, (x, 0, -1.0)) for x in (-0.3, 3.1)]
    return steps + stringers, 2


def studs(random, columns=8, rows=4):
    brick = box(0.8 * columns, 0.8 * rows, 0.96)
    stud = prism(circle(32, 0.24), 0.18)
    tops = [stud.moved(np.eye(3), (0.4 + 0.8 * i, 0.4 + 0.8 * j, 0.97)) for i in range(columns) for j in range(rows)]
    return [brick] + tops, 2


def chain(random, n=40):
    link = torus(1.0, 0.22).moved(np.diag([1.5, 1, 1]))
    upright = [[1, 0, 0], [0, 0, -1], [0, 1, 0]]
    return [link.moved(np.eye(3) if k % 2 else upright, (2.4 * k, 0, 0)) for k in range(n)], 1


def kit(random):
    """40 props of six kinds, of one to five solids each."""
    crate = [box(1, 1, 1), *[box(0.1, 0.1, 1.1, (x, y, -0.05)) for x in (-0.11, 1.01) for y in (-0.11, 1.01)]]
    barrel = [revolved([(0.5, 0), (0.62, 0.5), (0.5, 1)], 20), prism(circle(20, 0.49), 0.04)]
    pillar = [prism(circle(8, 0.4), 3.0), box(1, 1, 0.3, (-0.5, -0.5, -0.31)), box(1, 1, 0.3, (-0.5, -0.5, 3.01))]
    lamp = [prism(circle(6, 0.1), 2.5), prism(circle(6, 0.3, phase=0.5), 0.5, 1.4).moved(np.eye(3), (0, 0, 2.6))]
    post = [prism(circle(4, 0.2), 1.6, 0.8)]
    bench = [box(2, 0.5, 0.1, (0, 0, 0.6)), box(0.15, 0.5, 0.59), box(0.15, 0.5, 0.59, (1.85, 0, 0))]
    kinds = [(crate, 8, 2), (barrel, 6, 2), (pillar, 7, 2), (lamp, 5, 2), (post, 9, 1), (bench, 5, 2)]
    props = [prop for prop, n, _ in kinds for _ in range(n)]
    matrices = [turn(random) for _ in props]
    placed = [part.moved(matrix, (8.0 * k, 0, 0)) for k, (prop, matrix) in enumerate(zip(props, matrices)) for part in prop]
    return placed, sum(n_places for _, _, n_places in kinds)


def single_gear(random, teeth=24):
    """A gear that is one solid: its caps are rings of quads, its teeth are no parts of their own."""
    n = 4 * teeth
    radius = np.tile([2.0, 2.0, 2.4, 2.4], teeth)
    angle = 2 * np.pi * np.arange(n) / n
    ring = lambda r, z: np.column_stack([r * np.cos(angle), r * np.sin(angle), np.full(n, z)])
    positions = np.concatenate([ring(0.6 * np.ones(n), 0), ring(radius, 0), ring(radius, 0.8), ring(0.6 * np.ones(n), 0.8)])
    at = lambda row, k: n * (row % 4) + k % n
    return [Part(positions, [[at(r, k), at(r, k + 1), at(r + 1, k + 1), at(r + 1, k)][::-1] for r in range(4) for k in range(n)])], None


def single_stairs(random, n=10):
    """A flight of stairs that is one solid: both of its sides are one polygon."""
    profile = [(0.0, 0.0)]
    for k in range(n):
        profile += [(k, 0.3 * (k + 1)), (k + 1, 0.3 * (k + 1))]
    profile.append((n, 0.0))
    return [prism(profile[::-1], 3.0)], None


MODELS = {"500 cubes": cubes, "500 cubes of quads, renumbered": quad_cubes, "gear of parts": gear, "stairs of parts": stairs,
          "studs": studs, "chain": chain, "kit of 40 props": kit, "gear, one solid": single_gear, "stairs, one solid": single_stairs}


def near_misses(random):
    """Ten shapes, each twice, once 1 % longer and once as a mirror image: (parts, places if identical, places if mirrored)."""
    parts = []
    for k in range(10):
        shape = bracket(1.0 + 0.15 * k, 0.17 + 0.02 * k).triangulated()
        longer = shape.moved(np.diag([1.01, 1, 1])) if k % 2 else shape.moved(np.diag([1, 1, 1.01]))
        parts += [shape, shape, longer, shape.moved(np.diag([-1, 1, 1]))]
    return scattered(parts, random), 30, 20


# Squares with UVs, for rules.


def squares(random, n=12):
    """Rectangles of several materials, colors and densities that fill part of the square: a dict each."""
    found = []
    kinds = ["wood", "glass", "steel"]
    colors = [(1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0), (1.0, 1.0, 1.0)]
    for k in range(n):
        column, row = k % 4, k // 4
        low = np.array([0.03 + 0.24 * column, 0.05 + 0.3 * row]) + 0.02 * random.random(2)
        size = np.array([0.1 + 0.09 * random.random(), 0.1 + 0.12 * random.random()])
        density = [1.0, 2.0, 0.5][(k * 7) % 3] * (1 + 0.2 * random.random())
        found.append({"low": low, "size": size, "density": density, "material": kinds[k % 3], "color": colors[k // 3],
                      "at": np.array([3.0 * k, 0, 0])})
    return found


# Odd UVs.


def odd_uvs():
    """UV sets that nobody would make on purpose: positions, polygons and UVs each."""
    part = grid(4, 4, lambda u, v: (u, v, 0.1 * u * v))
    plain = [part.positions[polygon][:, :2] for polygon in part.polygons]
    maps = {
        "zero": lambda p: 0 * p, "on a line": lambda p: p * (1, 0), "huge": lambda p: 1e30 * p, "tiny": lambda p: 1e-30 * p,
        "far": lambda p: p + 1e6, "negative": lambda p: -p, "mirrored": lambda p: p * (-1, 1), "tiled": lambda p: 7.3 * p,
        "folded over": lambda p: np.abs(p - (0.5, 0)), "one spot per face": lambda p: 0 * p + p[0], "NaN": lambda p: p + np.nan,
        "infinite": lambda p: p + np.inf, "each face by itself": lambda p: 0.9 * p + 0.1 * p.mean(0),
        "all faces in one place": lambda p: p - p.min(0),
    }
    found = {name: [of(uv) for uv in plain] for name, of in maps.items()}
    found["a face of NaN"] = [plain[0] + np.nan, *plain[1:]]
    found["a face without UVs"] = [None, *plain[1:]]
    found["half of the faces without UVs"] = [None if k % 2 else uv for k, uv in enumerate(plain)]
    return {name: (part.positions, part.polygons, uvs) for name, uvs in found.items()}


# Meshes of polygons.


def grid(n, m, of, is_closed=(False, False)):
    """Quads over `of`, a map of the unit square; sides can be glued."""
    us, vs = ((np.arange(k + (not closed)) / k) for k, closed in zip((n, m), is_closed))
    positions = [of(u, v) for u in us for v in vs]
    at = lambda i, j: (i % len(us)) * len(vs) + j % len(vs)
    return Part(positions, [[at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)] for i in range(n) for j in range(m)])


def quad_sphere(n, shape=lambda p: p):
    """A cube's grid of quads, drawn onto a sphere and then by `shape`."""
    number, positions, polygons = {}, [], []

    def vertex(p):
        key = tuple(np.round(p, 9))
        if key not in number:
            number[key] = len(positions)
            positions.append(shape(np.array(p) / np.linalg.norm(p)))
        return number[key]

    steps = np.linspace(-1, 1, n + 1)
    for axis in range(3):
        for side in (-1, 1):
            place = lambda a, b: np.roll([side, *((a, b) if side > 0 else (b, a))], axis)
            for a, b in zip(steps, steps[1:]):
                polygons += [[vertex(place(x, y)) for x, y in ((a, c), (b, c), (b, d), (a, d))] for c, d in zip(steps, steps[1:])]
    return Part(positions, polygons)


def joined(parts):
    first = np.cumsum([0] + [len(part.positions) for part in parts])
    polygons = [[int(v + n) for v in polygon] for part, n in zip(parts, first) for polygon in part.polygons]
    return Part(np.concatenate([part.positions for part in parts]), polygons)


def polygon_meshes(random):
    """20 meshes of quads, some with other polygons."""
    tau = 2 * np.pi
    ball = lambda amplitude, k: lambda p: p * (1 + amplitude * np.sin(k * p[0]) * np.cos(k * p[1] + p[2]))
    rough = random.normal(size=(41, 41))
    tube = lambda u, v: (np.cos(tau * u) * (2 + 0.5 * np.cos(tau * v)), np.sin(tau * u) * (2 + 0.5 * np.cos(tau * v)), 0.5 * np.sin(tau * v))
    helix = lambda u, v: (np.cos(3 * tau * u) * (2 + 0.3 * np.cos(tau * v)), np.sin(3 * tau * u) * (2 + 0.3 * np.cos(tau * v)), 3 * u + 0.3 * np.sin(tau * v))
    bent = lambda u, v: (np.cos(tau * v), np.sin(tau * v) + 4 * np.cos(2 * u), 4 * np.sin(2 * u))
    vase = [(0.02, 0), (0.8, 0), (1.2, 0.8), (0.7, 1.8), (0.5, 2.4), (0.8, 2.8), (0.7, 2.8), (0.4, 2.4), (0.5, 1.0), (0.02, 0.2)]
    letter = [(0, 0), (1, 0), (1, 2), (2, 2), (2, 0), (3, 0), (3, 5), (2, 5), (2, 3), (1, 3), (1, 5), (0, 5)]
    return {
        "cube": quad_sphere(1, lambda p: np.sqrt(3) * p),
        "fine cube": quad_sphere(8, lambda p: p / np.abs(p).max()),
        "sphere": quad_sphere(12),
        "blob": quad_sphere(20, ball(0.3, 4)),
        "spiky blob": quad_sphere(24, ball(0.6, 9)),
        "long blob": quad_sphere(16, lambda p: p * (1, 1, 6) + (np.sin(2 * p[2]), 0, 0)),
        "torus": grid(48, 16, tube, (True, True)),
        "helix": grid(120, 10, helix),
        "bent tube": grid(24, 20, bent),
        "flat grid": grid(20, 20, lambda u, v: (u, v, 0)),
        "terrain": grid(40, 40, lambda u, v: (8 * u, 8 * v, np.sin(5 * u) * np.cos(7 * v) + 0.05 * rough[round(40 * u), round(40 * v)])),
        "rough terrain": grid(30, 30, lambda u, v: (6 * u, 6 * v, 0.35 * rough[round(30 * u), round(30 * v)])),
        "vase": revolved(vase, 32),
        "twelve-sided prism": prism(circle(12), 3.0),
        "stairs": single_stairs(random)[0][0],
        "letter": prism(letter, 0.8),
        "gear": single_gear(random)[0][0],
        "cone of quads": revolved([(0.0001 + 0.1 * k, 3 - 0.3 * k) for k in range(10)], 24),
        "quads and triangles": joined([quad_sphere(6, ball(0.2, 3)), grid(8, 8, bent).triangulated()]),
        "saddle": grid(24, 24, lambda u, v: (2 * u - 1, 2 * v - 1, (2 * u - 1) ** 2 - (2 * v - 1) ** 2)),
        "kit of 40 props": joined(kit(random)[0]),
    }
