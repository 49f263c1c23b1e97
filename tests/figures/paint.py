"""Pictures: planar maps, curves and surfaces, drawn twice as large and shrunk."""
import numpy as np
from PIL import Image, ImageDraw, ImageFont

from maps import border, conformal, sizes

TWICE, YELLOW, BLUE, INK = 2, (250, 205, 20), (25, 90, 200), (40, 42, 50)
MAGENTA, GREEN = (200, 30, 160), (30, 150, 70)
CALM, HOT = np.array([238, 240, 244]), np.array([205, 30, 35])
LIGHT = np.array([-.4, .6, .7]) / np.linalg.norm([-.4, .6, .7])


def font(size):
    return ImageFont.load_default(size)


def heat(values, low, high):
    """Colors from calm to hot, linear from `low` to `high`."""
    t = np.clip((values - low) / (high - low), 0, 1)[:, None]
    return np.round(CALM + t * (HOT - CALM)).astype(int)


class Sheet:
    """A white picture of a box of the plane, y up."""

    def __init__(self, box, width=300, height=None):
        low, high = (np.asarray(v, float) for v in box)
        self.scale = TWICE * .94 * min(width / (high - low)[0], (height or 10 ** 9) / (high - low)[1])
        height = height or int(np.ceil((high - low)[1] * self.scale / TWICE / .94))
        self.size, self.center = (TWICE * width, TWICE * height), (low + high) / 2
        self.picture = Image.new("RGB", self.size, "white")
        self.pen = ImageDraw.Draw(self.picture, "RGBA")

    def at(self, points):
        return (np.asarray(points, float) - self.center) * self.scale * [1, -1] + np.array(self.size) / 2

    def polygons(self, corners, colors, edge=None):
        for shape, color in zip(self.at(corners).tolist(), np.asarray(colors).tolist()):
            self.pen.polygon([tuple(p) for p in shape], tuple(color), outline=edge)

    def line(self, points, color, width=2):
        self.pen.line([tuple(p) for p in self.at(points).tolist()], color, width * TWICE // 2, joint="curve")

    def dot(self, point, radius, color, ring=False):
        x, y = self.at(point)
        r = radius * TWICE
        box = (x - r, y - r, x + r, y + r)
        self.pen.ellipse(box, None if ring else color, color, width=2 * TWICE if ring else 1)

    def text(self, point, words, size=12, color=INK, anchor="mm"):
        self.pen.text(tuple(self.at(point)), words, color, font(size * TWICE), anchor)

    def done(self):
        return self.picture.resize((self.size[0] // TWICE, self.size[1] // TWICE), Image.Resampling.LANCZOS)


def common_box(*sets):
    points = np.concatenate(sets)
    return points.min(0), points.max(0)


def planar(mesh, x, rings=(), box=None, scale=(2, 6), width=300, height=None, edge=(60, 64, 80, 70), dots=(),
           outline=True, values=None):
    """A map of a planar mesh: red by conformal distortion, inverted triangles yellow and on top; `rings` of vertices are handles."""
    _, rest, triangles = mesh
    sheet = Sheet(box or common_box(x), width, height)
    inverted = sizes(x, triangles) <= 0
    colors = heat(*(values or (conformal(rest, x, triangles), *scale)))
    sheet.polygons(x[triangles[~inverted]], colors[~inverted], edge)
    for a, b in border(triangles) if outline else ():
        sheet.line(x[[a, b]], INK, 1)
    sheet.polygons(x[triangles[inverted]], np.tile(YELLOW, (inverted.sum(), 1)), (150, 110, 0, 160))
    for ring in rings:
        points = x[ring]
        center = points.mean(0)
        reach = np.linalg.norm(points - center, axis=1).max() * sheet.scale / TWICE
        sheet.dot(center, max(reach + 2, 5), BLUE, ring=True)
    for dot in dots:
        sheet.dot(*dot)
    return sheet.done()


def surface(parts, view=(30, 15), box=None, width=300, height=300, rim=None, curves=()):
    """Surfaces (positions, triangles, colors of one or of all triangles, with alpha) seen from azimuth and elevation, far ones first,
    and curves (points, color) where they are not hidden."""
    a, e = np.radians(view)
    frame = np.array([[np.cos(a), 0, -np.sin(a)], [-np.sin(e) * np.sin(a), np.cos(e), -np.sin(e) * np.cos(a)],
                      [np.cos(e) * np.sin(a), np.sin(e), np.cos(e) * np.cos(a)]])
    seen = [x @ frame.T for x, _, _ in parts]
    around = np.concatenate(seen if box is None else [np.asarray(box) @ frame.T])
    sheet = Sheet((around.min(0)[:2], around.max(0)[:2]), width, height)
    shapes, colors, depths = [], [], []
    for y, (x, triangles, color) in zip(seen, parts):
        faces = np.cross(y[triangles[:, 1]] - y[triangles[:, 0]], y[triangles[:, 2]] - y[triangles[:, 0]])
        normals = np.zeros_like(y)
        for k in range(3):
            np.add.at(normals, triangles[:, k], faces)
        normals = normals[triangles].mean(1)
        normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-12)
        normals *= np.where(faces[:, 2:] < 0, -np.sign(np.sum(normals * faces, 1, keepdims=True)),
                            np.sign(np.sum(normals * faces, 1, keepdims=True)))
        light = .48 + .55 * np.clip(normals @ LIGHT, 0, 1)
        color = np.broadcast_to(color, (len(triangles), len(np.atleast_2d(color)[0])))
        lit = np.clip(color[:, :3] * light[:, None], 0, 255)
        colors.append(np.column_stack([lit, color[:, 3] if color.shape[1] == 4 else np.full(len(color), 255)]).astype(int))
        shapes.append(y[triangles][:, :, :2])
        depths.append(y[triangles][:, :, 2].mean(1))
    shapes, colors, depths = map(np.concatenate, (shapes, colors, depths))
    # A curve is drawn as thin ribbons, a little before the surface on which it lies.
    for points, color in curves:
        y = points @ frame.T
        reach = np.ptp(y, 0).max()
        for a, b in zip(y, y[1:]):
            aside = np.array([a[1] - b[1], b[0] - a[0]])
            aside = .006 * reach * aside / max(np.linalg.norm(aside), 1e-12)
            shapes = np.concatenate([shapes, [[a[:2] - aside, a[:2] + aside, b[:2] + aside], [a[:2] - aside, b[:2] + aside, b[:2] - aside]]])
            colors = np.concatenate([colors, [[*color, 255]] * 2])
            depths = np.concatenate([depths, [max(a[2], b[2]) + .02 * reach] * 2])
    order = np.argsort(depths)
    sheet.polygons(shapes[order], colors[order], rim)
    return sheet.done()


def skin(x, tets):
    """Triangles on the border of tetrahedra, seen from outside counterclockwise."""
    faces = np.concatenate([tets[:, [1, 2, 3]], tets[:, [0, 3, 2]], tets[:, [0, 1, 3]], tets[:, [0, 2, 1]]])
    _, first, count = np.unique(np.sort(faces, 1), axis=0, return_index=True, return_counts=True)
    return faces[first[count == 1]]


def solid(x, tets, view=(30, 15), color=(150, 185, 220), held=None, **more):
    """Tetrahedra from outside, those that are held blue, the inverted ones yellow."""
    bad = tets[sizes(x, tets) <= 0]
    outside = skin(x, tets)
    colors = np.tile(color, (len(outside), 1))
    if held is not None:
        colors[np.isin(outside, tets[held]).all(1)] = (70, 110, 205)
    parts = [(x, outside, colors)]
    if len(bad):
        parts.append((x, np.concatenate([bad[:, list(k)] for k in ((1, 2, 3), (0, 3, 2), (0, 1, 3), (0, 2, 1))]), YELLOW))
    return surface(parts, view, rim=(50, 60, 80, 60), **more)


def plot(curves, box, width=320, height=240, names=("", "")):
    """Curves {name: (points, color, dots)} in a box ((x0, y0), (x1, y1))."""
    low, high = np.asarray(box, float)
    span = high - low
    sheet = Sheet(((0, 0), (1, height / width)), width, height)
    place = lambda p: np.array([.11, .1]) + (np.asarray(p, float) - low) / span * [.84, height / width - .16]
    sheet.line([place(low), place((high[0], low[1]))], INK)
    sheet.line([place(low), place((low[0], high[1]))], INK)
    for t in np.linspace(0, 1, 5):
        x, y = low + t * span
        sheet.text(place((x, low[1])) - [0, .035], f"{x:.3g}", 9)
        sheet.text(place((low[0], y)) - [.012, 0], f"{y:.3g}", 9, anchor="rm")
    for k, (name, (points, color, dots)) in enumerate(curves.items()):
        points = np.asarray(points, float)
        inside = points[(points[:, 1] <= high[1]) & (points[:, 1] >= low[1])]
        if dots:
            for point in inside:
                sheet.dot(place(point), 3, color)
        else:
            sheet.line(place(inside), color, 3)
        if name:
            sheet.text((.95, height / width - .06 - .05 * k), name, 11, color, "rm")
    sheet.text((.53, .022), names[0], 10)
    sheet.text((.11, height / width - .03), names[1], 10, anchor="lm")
    return sheet.done()


def row(pictures, gap=8):
    """Titled pictures (title, picture) beside each other."""
    height = max(p.height for _, p in pictures) + 18
    out = Image.new("RGB", (sum(p.width for _, p in pictures) + gap * (len(pictures) - 1), height), "white")
    left = 0
    for title, picture in pictures:
        out.paste(picture, (left, 18 + (height - 18 - picture.height) // 2))
        ImageDraw.Draw(out).text((left + picture.width / 2, 8), title, INK, font(12), "mm")
        left += picture.width + gap
    return out


def column(pictures, gap=6):
    out = Image.new("RGB", (max(p.width for p in pictures), sum(p.height for p in pictures) + gap * (len(pictures) - 1)), "white")
    top = 0
    for picture in pictures:
        out.paste(picture, (0, top))
        top += picture.height + gap
    return out
