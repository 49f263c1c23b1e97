"""Figures of pictures and of parameterizations: 12, 15, 16, 17 and 18."""
import io
import json

import numpy as np
from PIL import Image, ImageDraw

from figure import Figure
from maps import area_distortion, conformal, distance, flips, pulled, sizes
from modeled import NAPE, cut_bust
from paint import BLUE, column, common_box, planar, row, surface
from plane import NEAR, both, merged, moved, rings_of
from shapes import disk
from work import read_obj, require

SIDE = 240
PULLS = (((75, 80), (100, 66)), ((175, 85), (150, 130)), ((110, 185), (90, 150)))


def png(pixels):
    file = io.BytesIO()
    Image.fromarray(pixels).save(file, "PNG")
    return file.getvalue()


def scene():
    """Squares and rings, the handles' places among them."""
    y, x = np.mgrid[0:SIDE, 0:SIDE]
    odd = ((x // 20 + y // 20) % 2)[..., None]
    tint = np.stack([70 + x * .7, 110 + 0 * x, 230 - y * .7], -1)
    pixels = np.where(odd == 1, tint, 245).astype(np.uint8)
    picture = Image.fromarray(pixels)
    for r in (40, 80):
        ImageDraw.Draw(picture).ellipse((120 - r, 120 - r, 120 + r, 120 + r), outline=(30, 30, 40), width=4)
    return np.array(picture)


def make12(work, fault):
    y, x = np.mgrid[0:SIDE, 0:SIDE]
    coordinates = np.stack([x, y, 0 * x], -1).astype(np.uint8)
    pulls = [(a, b) for a, b in PULLS]
    if fault == "wrong handle":
        pulls[0] = (pulls[0][0], (60, 130))
    handles = work.named("handles.json", json.dumps({"handles": [{"at": a, "to": b} for a, b in pulls]}))
    options = ["--fix-border"] + (["--barrier", "none", "--energy", "green"] if fault == "barrier off" else [])
    out = {}
    for name, pixels in (("scene", scene()), ("coordinates", coordinates)):
        file, result = work.named(f"{name}.png", png(pixels)), f"{name}-out{'-' + fault[:5] if fault else ''}.png"
        work.run("warp", file, "--handles", handles, "-o", result, "--grid", 30, *options, statuses=(0, 4))
        out[name] = np.array(Image.open(work.folder / result).convert("RGB"))
    return out


def check12(made):
    """The picture of coordinates shows where every pixel comes from: the inverse map."""
    back = made["coordinates"][..., :2].astype(float)
    for at, to in PULLS:
        away = np.abs(back[to[1] - 1:to[1] + 2, to[0] - 1:to[0] + 2] - at).max(2).min()
        require(away < 5, f"at {to} is what was {away:.0f} pixels from {at}")
    ramp = np.arange(SIDE)
    for side in (back[0, :, 0], back[-1, :, 0], back[:, 0, 1], back[:, -1, 1]):
        require(np.abs(side - ramp).max() <= 2, "the border moved")
    smooth = back[::8, ::8]
    du, dv = np.diff(smooth, axis=1)[:-1], np.diff(smooth, axis=0)[:, :-1]
    det = du[..., 0] * dv[..., 1] - du[..., 1] * dv[..., 0]
    # Coordinates are whole numbers, so that a determinant near 0 may come out a little below.
    folded = float((det < -4).mean())
    require(folded == 0, f"{100 * folded:.1f} % of the picture is folded")
    return f"{len(PULLS)} handles at their pixels, the border still; no square of 8 pixels folded"


def draw12(made):
    before = Image.fromarray(scene())
    after = Image.fromarray(made["scene"])
    for picture, k in ((before, 0), (after, 1)):
        pen = ImageDraw.Draw(picture)
        pen.rectangle((0, 0, SIDE - 1, SIDE - 1), outline=BLUE, width=3)
        for pull in PULLS:
            (x, y), (u, v) = pull
            if not k:
                pen.line((x, y, u, v), fill=BLUE, width=2)
            pen.ellipse((pull[k][0] - 5, pull[k][1] - 5, pull[k][0] + 5, pull[k][1] + 5), outline=BLUE, width=3, fill="white")
    return row([("picture, handles and their ways", before), ("warped, ARAP, border fixed", after)])


def laid_flat(x, triangles):
    """Every triangle of a surface in a plane of its own: positions of three vertices each, and the triangles."""
    a, b, c = (x[triangles[:, k]] for k in range(3))
    long = np.linalg.norm(b - a, axis=1)
    along = np.einsum("nd,nd->n", b - a, c - a) / long
    up = np.sqrt(np.maximum(((c - a) ** 2).sum(1) - along ** 2, 1e-30))
    zero = np.zeros_like(long)
    flat = np.stack([np.stack([zero, zero], 1), np.stack([long, zero], 1), np.stack([along, up], 1)], 1)
    return flat.reshape(-1, 2), np.arange(3 * len(triangles)).reshape(-1, 3)


def chart(path):
    """A written file: surface, flat triangles at rest and in the texture scaled to the surface's area."""
    x, triangles, uv = read_obj(path)
    rest, corners = laid_flat(x, triangles)
    at = uv.reshape(-1, 2)
    inverted = sizes(at, corners)
    if np.sign(inverted).sum() < 0:
        at = at * [-1, 1]
    at = at * np.sqrt(sizes(rest, corners).sum() / abs(sizes(at, corners).sum()))
    return x, triangles, rest, corners, at


def make15(work, fault):
    x, triangles, path = cut_bust(NAPE)
    file = work.mesh("head", x, triangles)
    charts = {"path": path}
    for kind in ("none", "inverse-spline"):
        use = "none" if fault == "barrier off" else kind
        if fault == "another energy" and kind != "none":
            options = ("--energy", "lscm")
        else:
            options = ("--energy", "arap")
        out = f"{kind}-{use}{options[1]}.obj"
        work.run("unwrap", file, "--cut", "disk", "--pin", 2, *options, "--barrier", use, "-o", out, statuses=(0, 4))
        charts[kind] = chart(work.folder / out)
    return charts


def check15(made):
    made = {kind: chart for kind, chart in made.items() if kind != "path"}
    n = {kind: flips(at, corners) for kind, (_, _, _, corners, at) in made.items()}
    require(n["none"] > 0, "none inverted without the barrier")
    require(n["inverse-spline"] == 0, f"{n['inverse-spline']} inverted with the barrier")
    area = {kind: area_distortion(rest, at, corners) for kind, (_, _, rest, corners, at) in made.items()}
    require(area["inverse-spline"] < area["none"], f"the area distortion is not lower: {area}")
    return (f"{len(made['none'][1])} triangles (Bimba 11253); inverted without {n['none']}, with 0; "
            f"mean area distortion {area['none']:.3f} → {area['inverse-spline']:.3f}")


def draw15(made):
    x, triangles = made["none"][:2]
    path = made.pop("path")
    shown = lambda view: surface([(x, triangles, (222, 205, 185))], view, width=200, height=290, curves=[(path, (200, 30, 30))])
    columns = [column([shown((20, 6)), shown((-150, 6))])]
    for kind, (_, _, rest, corners, at) in made.items():
        title = "ARAP" if kind == "none" else "ARAP with the barrier"
        ratio = np.abs(sizes(at, corners)) / sizes(rest, corners)
        show = lambda values, at=at, rest=rest, corners=corners: planar(
            ("", rest, corners), at, [], common_box(at), width=390, height=290, edge=(60, 64, 80, 25), outline=False, values=values)
        angles = row([(f"{title}: angles", show((conformal(rest, at, corners), 2, 6)))])
        areas = row([("areas", show((ratio + 1 / np.maximum(ratio, 1e-6), 2, 4)))])
        columns.append(column([angles, areas]))
    return row([("the head and the path of the cut", columns[0]), ("", columns[1]), ("", columns[2])])


def make18(work, fault):
    mesh = disk(work)
    x = mesh[1]
    cases = []
    for share, bound in ((.6, 8.0), (1.0, 12.0)):
        parts = [pulled(x, ((0, -.75), (0, .95 * share)), radius=.04), pulled(x, ((-.6, .35), (-.5 * share, .25 * share)), radius=.04),
                 pulled(x, ((.6, .35), (.5 * share, .25 * share)), radius=.04)]
        pull = merged(parts)
        without, ours = both(work, f"pull{share:g}", mesh, moved(fault, pull, mesh[1]), "arap", fault)
        cases.append((mesh, parts, pull, without, ours))
    return cases


def check18(made):
    says = []
    for (mesh, _, pull, without, ours), published in zip(made, (69, 149)):
        require(flips(without.x, mesh[2]) > 0, "ARAP has no spike")
        require(flips(ours.x, mesh[2]) == 0, "inverted with the barrier")
        require(distance(ours.x, pull) < NEAR, f"a handle is {distance(ours.x, pull):.2g} away")
        d = conformal(mesh[1], ours.x, mesh[2])
        handles = np.array(list(pull.values()))
        places = ours.x[mesh[2]].mean(1)
        near = np.linalg.norm(places[:, None] - handles[None], axis=2).min(1) < .15
        require(np.quantile(d[near], .9) > 1.5 * np.quantile(d[~near], .9), "the distortion is not around the handles")
        says.append(f"inverted {flips(without.x, mesh[2])} → 0, largest distortion {d.max():.0f} ({published})")
    require(conformal(made[1][0][1], made[1][4].x, made[1][0][2]).max() > conformal(made[0][0][1], made[0][4].x, made[0][0][2]).max(),
            "the larger pull distorts less")
    return "; ".join(says) + "; Lipman's method is quoted, not run"


def draw18(made):
    rows = []
    for mesh, parts, _, without, ours in made:
        box = common_box(mesh[1], ours.x, without.x)
        show = lambda t, x: (t, planar(mesh, x, rings_of(parts), box, scale=(2, 15), width=250))
        rows.append(row([show("rest", mesh[1]), show("ARAP", without.x), show("our method", ours.x)]))
    return column(rows)


FIGURES = [
    Figure(12, "warped picture", "ARAP on a regular mesh with a picture, the border fixed.", make12, check12, draw12,
           ("barrier off", "wrong handle")),
    Figure(15, "parameterization", "ARAP from Tutte's map, without and with the barrier; angles red, areas beside.",
           make15, check15, draw15, ("barrier off", "another energy")),
    Figure(18, "pulled disk", "Three handles, pulled a little (top) and far (bottom): ARAP's spikes, and the barrier's map.",
           make18, check18, draw18, ("barrier off", "wrong handle")),
]
