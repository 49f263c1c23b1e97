"""Islands, their faults, overlaps and stacks, from positions, triangles and UVs alone. Signs are exact."""
from collections import Counter, defaultdict
from fractions import Fraction

import numpy as np
from shapely import STRtree, box

# Ends of an edge agree up to this share of the UV extent, as the documentation of the certificate says.
UV_TOLERANCE = 1e-7
# Rounding of a doubled area in f64, relative to the sum of the products' sizes: a few units of 2^-53.
ROUNDING = 1e-15
# Pairs of triangles in one array.
CHUNK = 400_000


def signs(a, b, c):
    """Signs of the doubled areas of triangles, arrays of points (n, 2)."""
    p, q = (b[:, 0] - a[:, 0]) * (c[:, 1] - a[:, 1]), (b[:, 1] - a[:, 1]) * (c[:, 0] - a[:, 0])
    sign = np.sign(p - q).astype(int)
    # Differences round, too, relative to the coordinates.
    size = np.abs(np.concatenate([a, b, c], 1)).max(1)
    reach = np.abs(np.concatenate([b - a, c - a], 1)).max(1)
    doubt = np.abs(p - q) <= ROUNDING * (np.abs(p) + np.abs(q) + size * reach)
    for k in np.flatnonzero(doubt):
        (ax, ay), (bx, by), (cx, cy) = ([Fraction(float(x)) for x in point[k]] for point in (a, b, c))
        exact = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
        sign[k] = (exact > 0) - (exact < 0)
    return sign


def areas(uv):
    e, f = uv[:, 1] - uv[:, 0], uv[:, 2] - uv[:, 0]
    return 0.5 * np.abs(e[:, 0] * f[:, 1] - e[:, 1] * f[:, 0])


def areas_3d(positions, faces):
    a, b, c = (positions[faces[:, k]] for k in range(3))
    return 0.5 * np.linalg.norm(np.cross(b - a, c - a), axis=1)


class Islands:
    """Islands of a mesh in the order of their first faces."""

    def __init__(self, mesh):
        usable = np.isfinite(mesh.uv).all((1, 2)) & np.isfinite(mesh.positions[mesh.faces]).all((1, 2))
        self.usable = usable
        self.uv = np.where(usable[:, None, None], mesh.uv, 0.0)
        positions = np.where(np.isfinite(mesh.positions).all(1)[:, None], mesh.positions, 0.0) + 0.0
        _, welded = np.unique(positions, axis=0, return_inverse=True)
        self.faces = welded.reshape(-1)[mesh.faces]
        a, b, c = self.faces.T
        self.repeats = (a == b) | (b == c) | (c == a)
        self.sign = signs(self.uv[:, 0], self.uv[:, 1], self.uv[:, 2])
        self._label(list(self._links()))

    def _links(self):
        """Pairs of faces that have an edge and its UVs in common, and whether both run along it in one direction."""
        extent = max(np.ptp(self.uv.reshape(-1, 2), axis=0).max(), 1e-100)
        around = defaultdict(list)
        for face, corners in enumerate(self.faces.tolist()):
            uv = self.uv[face].tolist()
            for k in range(3):
                (v, w), (p, q) = (corners[k], corners[(k + 1) % 3]), (uv[k], uv[(k + 1) % 3])
                if v < w:
                    around[v, w].append((face, p + q, True))
                elif w < v:
                    around[w, v].append((face, q + p, False))
        for uses in around.values():
            for i, (face, uv, way) in enumerate(uses):
                for other, uvs, way_of_other in uses[:i]:
                    if all(abs(x - y) <= UV_TOLERANCE * extent for x, y in zip(uv, uvs)):
                        yield face, other, way == way_of_other

    def _label(self, links):
        neighbors = defaultdict(list)
        for face, other, against in links:
            neighbors[face].append((other, against))
            neighbors[other].append((face, against))
        n = len(self.faces)
        self.of_face, self.winding = np.full(n, -1), np.ones(n, int)
        self.twisted = []
        for start in range(n):
            if self.of_face[start] >= 0:
                continue
            island, stack = len(self.twisted), [start]
            self.twisted.append(False)
            self.of_face[start] = island
            while stack:
                face = stack.pop()
                for other, against in neighbors[face]:
                    winding = -self.winding[face] if against else self.winding[face]
                    if self.of_face[other] < 0:
                        self.of_face[other], self.winding[other] = island, winding
                        stack.append(other)
                    elif self.winding[other] != winding:
                        self.twisted[island] = True
        for island in np.flatnonzero(self.twisted):
            self.winding[self.of_face == island] = 1

    def __len__(self):
        return len(self.twisted)

    def members(self):
        order = np.argsort(self.of_face, kind="stable")
        return np.split(order, np.flatnonzero(np.diff(self.of_face[order])) + 1)

    def outlines(self):
        """The directed edges around each island, its faces counterclockwise; edges that run both ways cancel."""
        found = []
        for faces in self.members():
            edges = Counter()
            for face in faces[self.sign[faces] != 0]:
                corners = [tuple(uv) for uv in (self.uv[face] + 0.0).tolist()][::int(self.sign[face])]
                for k in range(3):
                    edge = corners[k], corners[(k + 1) % 3]
                    if edges[edge[::-1]] > 0:
                        edges[edge[::-1]] -= 1
                    else:
                        edges[edge] += 1
            found.append(tuple(sorted((edge, n) for edge, n in edges.items() if n)))
        return found

    def stacks(self):
        """Islands that coincide: lists of two and more."""
        together = defaultdict(list)
        for island, outline in enumerate(self.outlines()):
            if outline:
                together[outline].append(island)
        return [islands for islands in together.values() if len(islands) > 1]

    def overlapping(self, without=()):
        """Islands that overlap themselves or others; the islands of `without` are left out."""
        of_island = np.isin(self.of_face, list(without))
        faces = np.flatnonzero((self.sign != 0) & ~of_island)
        uv = np.where((self.sign[faces] > 0)[:, None, None], self.uv[faces], self.uv[faces][:, ::-1])
        island = self.of_face[faces]
        found = set()
        for first, second in candidates(uv, island, found):
            meets = intersect(uv[first], uv[second])
            found |= set(island[first[meets]]) | set(island[second[meets]])
        return {int(k) for k in found}

    def facts(self, overlapping):
        """(first face, fault) of each island that counts, in order; the fault is None for a sound one."""
        judged = self.usable & ~self.repeats
        result = []
        for island, faces in enumerate(self.members()):
            own = faces[~(self.usable[faces] & self.repeats[faces])]
            if not len(own):
                continue
            sign = self.sign * self.winding
            counted = faces[judged[faces]]
            area = (sign[counted] * areas(self.uv[counted])).sum()
            major = np.sign(area) or np.sign(sign[counted].sum())
            flat = self.repeats & self.usable
            flipped = (sign[faces] != major) & ((sign[faces] != 0) | ~flat[faces]) | ~self.usable[faces]
            low, high = self.uv[own].min((0, 1)), self.uv[own].max((0, 1))
            if not (sign[own] != 0).any():
                fault = "without_area"
            elif flipped.any() or self.twisted[island]:
                fault = "folded"
            elif island in overlapping:
                fault = "overlapping"
            elif (high - low > 1).any():
                fault = "tiled"
            elif (low < 0).any() or (high > 1).any():
                fault = "outside"
            else:
                fault = None
            result.append((int(own[0]), fault))
        return result


def candidates(uv, island, found):
    """Pairs of triangles whose boxes intersect, but for pairs of islands that are `found` already."""
    low, high = uv.min(1), uv.max(1)
    boxes = box(low[:, 0], low[:, 1], high[:, 0], high[:, 1])
    tree = STRtree(boxes)
    for begin in range(0, len(uv), 500):
        own = np.arange(begin, min(begin + 500, len(uv)))
        first, second = tree.query(boxes[own])
        first = own[first]
        known = np.isin(island, list(found))
        wanted = (first < second) & ~(known[first] & known[second])
        first, second = first[wanted], second[wanted]
        for start in range(0, len(first), CHUNK):
            yield first[start:start + CHUNK], second[start:start + CHUNK]


def intersect(p, q):
    """Whether the interiors of counterclockwise triangles intersect: unless an edge of one has the other on its right."""
    apart = np.zeros(len(p), bool)
    for one, other in ((p, q), (q, p)):
        for k in range(3):
            right = np.ones(len(p), bool)
            for corner in range(3):
                left = np.flatnonzero(right & ~apart)
                right[left] = signs(one[left, k], one[left, (k + 1) % 3], other[left, corner]) <= 0
            apart |= right
    return ~apart


def fit(before, after):
    """The similarity of the plane that maps points (n, 2) best: its scale, whether it mirrors, the largest distance left."""
    p, q = (x[:, 0] + 1j * x[:, 1] for x in (before, after))
    p, q = p - p.mean(), q - q.mean()
    best = None
    for mirrored, points in ((False, p), (True, p.conj())):
        turn = np.vdot(points, q) / max(np.vdot(points, points).real, 1e-300)
        left = np.abs(q - turn * points).max()
        if best is None or left < best[2]:
            best = abs(turn), mirrored, left
    return best
