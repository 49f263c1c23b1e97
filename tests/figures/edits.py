"""Figures of maps that are edited: 16 and 17."""
import json
from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw

from figure import Figure
from maps import border, crossings, pulled, sizes
from modeled import CROWN, cut_bust
from paint import BLUE, column, common_box, planar, row, surface
from plane import merged
from shapes import filled, rounded
from work import read_obj, require

MITTEN = [(0, 0), (.3, -.02), (.6, 0), (.72, .16), (1.2, .64), (1.17, .82), (.98, .8), (.68, .52),
          (.64, 1.05), (.35, 1.3), (.06, 1.05), (0, .5)]
BASE, TIP, HALFWAY = np.array([.62, .26]), np.array([1.1, .73]), np.array([.88, .5])
PALM = np.array([[.15, .1], [.45, .1], [.2, .9], [.45, .9], [.33, 1.15]])


def spun(points, degrees):
    a = np.radians(degrees)
    return (points - BASE) @ np.array([[np.cos(a), np.sin(a)], [-np.sin(a), np.cos(a)]]) + BASE


def glove(work):
    """A mitten whose thumb lies over its palm, without touching it: a surface that no map without distortion keeps from overlapping."""
    mesh = filled(work, "mitten", rounded(MITTEN), 3000)
    x = mesh[1]
    parts = [pulled(x, (p, (0, 0)), radius=.05) for p in PALM]
    parts += [pulled(x, (p, spun(p, 75) - p, 75), radius=.07) for p in (TIP, HALFWAY)]
    over = work.solve("fold", mesh, merged(parts), "arap").x
    height = .35 * np.maximum(x[:, 0] - .66, 0)
    return mesh, np.column_stack([over, height])


def by_vertex(path):
    """Positions, triangles and the place in the texture of every vertex; one chart without seams."""
    x, triangles, uv = read_obj(path)
    at = np.zeros((len(x), 2))
    at[triangles] = uv
    return x, triangles, at


def nearest(x, point):
    return int(np.argmin(np.linalg.norm(x - point, axis=1)))


def make16(work, fault):
    mesh, bent = glove(work)
    file = work.mesh("glove", bent, mesh[2])
    kind = "none" if fault == "barrier off" else "inverse-spline"
    work.run("unwrap", file, "--cut", "disk", "--pin", 2, "--energy", "lscm", "--barrier", kind, "-o", f"map-{kind}.obj", statuses=(0, 4))
    x, triangles, uv = by_vertex(work.folder / f"map-{kind}.obj")
    order = [nearest(x, p) for p in bent]
    # The similarity that takes the mitten's palm to the map's: complex least squares.
    palm = np.flatnonzero(mesh[1][:, 0] < .5)
    z, w = mesh[1][palm] @ [1, 1j], uv[np.array(order)[palm]] @ [1, 1j]
    mirrored = sizes(uv, triangles).sum() < 0
    z = z.conj() if mirrored else z
    a, b = np.linalg.lstsq(np.stack([z, np.ones_like(z)], 1), w, rcond=None)[0]

    def placed(p):
        p = complex(*p)
        q = a * (p.conjugate() if mirrored else p) + b
        return [q.real, q.imag]

    handles = [nearest(mesh[1], p) for p in (*PALM, HALFWAY, TIP)]
    anchors = [{"at": uv[order[v]].tolist(), "to": uv[order[v]].tolist()} for v in handles[:len(PALM)]]
    if fault != "wrong handle":
        anchors += [{"at": uv[order[v]].tolist(), "to": placed(spun(mesh[1][v], -20))} for v in handles[len(PALM):]]
    points = work.named("anchors.json", json.dumps({"anchors": anchors}))
    edited = f"edited-{Path(points).stem}-{kind}.obj"
    work.run("edit-uv", f"map-{kind}.obj", "--anchors", points, "--energy", "lscm", "-o", edited, statuses=(0, 4))
    return x, triangles, uv, by_vertex(work.folder / edited)[2], anchors


def check16(made):
    _, triangles, before, after, anchors = made
    sign = np.sign(sizes(before, triangles).sum())
    for name, uv in (("the map", before), ("the edited map", after)):
        n = int((sign * sizes(uv, triangles) <= 0).sum())
        require(n == 0, f"{name}: {n} inverted")
    sides = border(triangles)
    n_before, n_after = crossings(before, sides), crossings(after, sides)
    require(n_before > 0, "the thumb does not overlap the palm")
    require(n_after == 0, f"the edited border crosses itself {n_after} times")
    return f"{len(triangles)} triangles, none inverted; crossings of the border {n_before} → {n_after} by {len(anchors)} handles"


def draw16(made):
    x, triangles, before, after, anchors = made
    show = lambda title, uv: (title, planar(("", before, triangles), uv, [], common_box(before, after), width=260, scale=(2, 4),
                                            dots=[(a["to" if uv is after else "at"], 5, BLUE) for a in anchors]))
    return row([("surface", surface([(x, triangles, (225, 190, 160))], (20, 35), width=240, height=260)),
                show("LSCM with the barrier: the thumb overlaps", before), show("edited", after)])


# Where the head has its eyes, nose, mouth, cheeks, brow and ears, seen from the front, and where the picture of the tiger has them.
FEATURES = {(-.27, .11): (.36, .44), (.27, .11): (.64, .44), (0, -.2): (.5, .6), (0, -.48): (.5, .74), (-.5, -.2): (.2, .62),
            (.5, -.2): (.8, .62), (0, .5): (.5, .2), (-.87, -.05): (.24, .2), (.87, -.05): (.76, .2), (0, -.8): (.5, .9)}


# Side of the picture, in shorter sides of the map.
SHARE = .75


def tiger(size=512):
    """A tiger's face, drawn."""
    picture = Image.new("RGB", (size, size), (232, 140, 42))
    pen = ImageDraw.Draw(picture)
    at = lambda *p: [(x * size, y * size) for x, y in p]
    disc = lambda x, y, r, color, q=1.0: pen.ellipse(at((x - r, y - r * q), (x + r, y + r * q)), color)
    for side in (-1, 1):
        put = lambda u, v, side=side: (.5 + side * u, v)
        for k in range(7):
            y = .06 + .13 * k
            pen.polygon(at(put(.5, y), put(.5, y + .05), put(.3, y + .07)), (35, 25, 20))
        for k in range(3):
            pen.polygon(at(put(.02, .1 + .07 * k), put(.15, .08 + .07 * k), put(.02, .13 + .07 * k)), (35, 25, 20))
        disc(*put(.26, .2), .07, (250, 225, 200))
        disc(*put(.26, .2), .04, (60, 40, 35))
        disc(*put(.3, .62), .09, (250, 240, 225))
        disc(*put(.14, .44), .075, (250, 245, 235))
        disc(*put(.14, .44), .045, (95, 160, 60))
        disc(*put(.14, .44), .02, (15, 15, 15), 1.8)
        disc(*put(.07, .68), .085, (252, 246, 236))
    pen.polygon(at((.43, .57), (.57, .57), (.5, .65)), (215, 110, 120))
    pen.line(at((.5, .65), (.5, .72)), (30, 20, 20), 6)
    for side in (-1, 1):
        pen.arc(at((.5 + (side - 1) * .06, .68), (.5 + (side + 1) * .06, .78)), 0, 180, (30, 20, 20), 6)
    return picture


def make17(work, fault):
    # The map of 46 thousand triangles is made once: faults are planted in the result.
    if not (work.folder / "flat.obj").exists():
        file = work.mesh("head", *cut_bust(CROWN, 1)[:2])
        work.run("unwrap", file, "--cut", "disk", "-o", "flat.obj", statuses=(0, 4))
    x, triangles, uv = by_vertex(work.folder / "flat.obj")
    # Each feature is the foremost vertex near its place as seen from the front.
    vertices = []
    for place in FEATURES:
        near = np.flatnonzero(np.linalg.norm(x[:, :2] - place, axis=1) < .05)
        vertices.append(int(near[np.argmax(x[near, 2])]))
    # The picture is as large as the map, its middle on the middle of the map, and as upright as the face.
    z, w = np.array([[u, 1 - v] for u, v in FEATURES.values()]) @ [1, 1j], uv[vertices] @ [1, 1j]
    turn = np.vdot(z - z.mean(), w - w.mean())
    a = turn / abs(turn) * SHARE * np.ptp(uv, 0).min()
    b = uv.mean(0) @ [1, 1j] - a * (.5 + .5j)
    to = [[float((a * p + b).real), float((a * p + b).imag)] for p in z]
    handles = {"points": [{"at": uv[v].tolist(), "to": p} for v, p in zip(vertices, to)]}
    points = work.named("points.json", json.dumps(handles))
    if not (work.folder / "aligned.obj").exists():
        work.run("texture-map", "flat.obj", "--points", points, "-o", "aligned.obj")
    after = by_vertex(work.folder / "aligned.obj")[2]
    if fault == "a feature astray":
        after[vertices[0]] += 2e-5
    if fault == "a triangle inverted":
        a0, b0, c0 = triangles[np.flatnonzero(~np.isin(triangles, vertices).any(1))[0]]
        after[a0] = after[b0] + after[c0] - after[a0]
    if fault == "border moved":
        after[border(triangles)[0][0]] *= 1.0001
    return x, triangles, uv, after, vertices, to, (a, b)


def check17(made):
    _, triangles, before, after, vertices, to, _ = made
    sign = np.sign(sizes(before, triangles).sum())
    n = int((sign * sizes(after, triangles) <= 0).sum())
    require(n == 0, f"{n} inverted")
    away = float(np.linalg.norm(after[vertices] - to, axis=1).max())
    require(away < 1e-5, f"a feature is {away:.2g} from its place in the picture")
    sides = border(triangles)
    still = float(np.abs(after - before)[np.unique(sides)].max())
    require(still < 1e-6, f"the border moved by {still:.2g}")
    require(crossings(after, sides) == 0, "the border crosses itself")
    moved = np.linalg.norm(after - before, axis=1)[vertices] / np.ptp(before, 0).max()
    return (f"{len(triangles)} triangles (the paper 46384), none inverted, {len(to)} features moved by up to {moved.max():.2f} of the map "
            f"and in place within {away:.0e}; the border still: bijective")


def draw17(made):
    x, triangles, before, after, vertices, to, (a, b) = made
    picture = tiger()
    pixels, size = np.array(picture), picture.width

    def painted(uv, view):
        z = (uv[triangles].mean(1) @ [1, 1j] - b) / a
        place = np.stack([1 - z.imag, z.real], 1) * size
        inside = ((place >= 0) & (place < size)).all(1)[:, None]
        row_column = np.clip(place, 0, size - 1).astype(int)
        colors = np.where(inside, pixels[row_column[:, 0], row_column[:, 1]], (225, 205, 180))
        return surface([(x, triangles, colors)], view, width=250, height=300)
    show = lambda uv, dots: planar(("", before, triangles), uv, [], common_box(before), width=300, scale=(2, 8), edge=None,
                                   dots=[(p, 4, BLUE) for p in dots])
    over = lambda uv: painted(uv, (0, 4))
    return column([row([("the picture", picture.resize((300, 300))), ("the map and the head's features", show(before, before[vertices])),
                        ("aligned, the border fixed", show(after, after[vertices]))]),
                   row([("before", over(before)), ("aligned", over(after)), ("from the side", painted(after, (35, 6)))])])


FIGURES = [
    Figure(16, "overlap removed", "LSCM with the barrier overlaps itself; a few handles resolve it.", make16, check16, draw16,
           ("wrong handle",)),
    Figure(17, "texture aligned", "A head's features aligned with a tiger's, ARAP, the border of the map fixed.", make17, check17, draw17,
           ("a feature astray", "a triangle inverted", "border moved")),
]
