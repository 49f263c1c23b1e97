"""Figures of deformations of space: 1, 5, 11, 13 and 14."""
import numpy as np

from figure import Figure
from maps import distance, flips, sizes
from modeled import dinosaur, filled
from paint import YELLOW, common_box, planar, row, solid, surface
from plane import NEAR, check2, make2, moved, require_pair
from shapes import Voxels, around, turned
from work import require

ROD_RADIUS, ROD_LENGTH = 1.0, 8.0


def spun(points, center, axis, degrees):
    """Points turned about an axis (0, 1, 2) through a center."""
    a, (i, j) = np.radians(degrees), [k for k in range(3) if k != axis]
    out = points - center
    y, z = out[:, i].copy(), out[:, j].copy()
    out[:, i], out[:, j] = np.cos(a) * y - np.sin(a) * z, np.sin(a) * y + np.cos(a) * z
    return out + center


def rod(cells=4):
    """Cubes around a cylinder along x, and the cylinder."""
    side = 2 * ROD_RADIUS / cells
    voxels = Voxels(np.ones((round(ROD_LENGTH / side), cells, cells), bool), [0, -ROD_RADIUS, -ROD_RADIUS], side)
    heights = np.linspace(0, ROD_LENGTH, 60)
    x, triangles = turned([(0, 0), *((.98 * ROD_RADIUS, h) for h in heights), (0, ROD_LENGTH)], 36)
    return voxels, x[:, [1, 2, 0]], triangles


def ends_moved(x, carry):
    """Both ends of a rod as handles, two layers each: the left held, the right where `carry` takes it."""
    layers = np.unique(np.round(x[:, 0], 9))
    left, right = np.flatnonzero(x[:, 0] <= layers[1] + 1e-6), np.flatnonzero(x[:, 0] >= layers[-2] - 1e-6)
    return {**{int(v): x[v] for v in left}, **{int(v): to for v, to in zip(right, carry(x[right]))}}


def make5(work, fault):
    voxels, x, triangles = rod()
    pull = ends_moved(voxels.x, lambda p: p + [4.0, 0, 0])
    out = "frames" if fault is None else f"frames-{fault[:5]}"
    kind = "none" if fault == "barrier off" else "spline"
    run = work.solve("stretch", ("rod", voxels.x, voxels.tets), moved(fault, pull, voxels.x), "arap", kind, "--frames", out)
    if fault == "an iterate inverted":
        run.frames[1][voxels.tets[0, 3]] = 2 * run.frames[1][voxels.tets[0, 0]] - run.frames[1][voxels.tets[0, 3]]
    return voxels, x, triangles, pull, run


def check5(made):
    voxels, _, _, pull, run = made
    require(distance(run.x, pull) < NEAR, f"the cap is {distance(run.x, pull):.2g} from its place")
    require(all(flips(frame, voxels.tets) == 0 for frame in run.frames), "an iterate is inverted")
    settled = [row["energy"] + row["barrier"] for row in run.trace[1:]]
    require(all(b <= a * (1 + 1e-9) for a, b in zip(settled, settled[1:])), f"the energy rises: {settled}")
    require(run.report["iterations"] <= 12, f"{run.report['iterations']} iterations")
    return f"{run.report['iterations']} iterations, the energy falls in each, none inverted (the paper 4; KNITRO 1512, quoted)"


def draw5(made):
    voxels, x, triangles, _, run = made
    box = common_box(voxels.x, run.x)
    corners = np.stack(np.meshgrid(*zip(*box)), -1).reshape(-1, 3)
    chosen = sorted({0, 1, 2, len(run.frames) - 1})
    pictures = [(f"iterate {k}", surface([(voxels.carried(x, run.frames[k]), triangles, (150, 185, 220))], (15, 12), corners, 230, 110,
                                         (60, 70, 90, 90))) for k in chosen]
    return row(pictures)


def make11(work, fault):
    voxels, x, triangles = rod()
    bent = lambda p: spun(p - [ROD_LENGTH, 0, 0], 0, 2, 170) + [2.2, 3.6, 0]
    pull = ends_moved(voxels.x, bent)
    mesh, runs = ("rod", voxels.x, voxels.tets), {}
    stations = [ends_moved(voxels.x, lambda p, t=t: spun(p - [ROD_LENGTH, 0, 0], 0, 2, 170 * t) +
                           [ROD_LENGTH + t * (2.2 - ROD_LENGTH), 3.6 * np.sin(t * np.pi / 2), 0]) for t in (.25, .5, .75, 1)]
    for energy in ("green", "arap"):
        for kind in ("none", "spline"):
            use = "none" if fault == "barrier off" else kind
            last = [*stations[:-1], moved(fault, pull, voxels.x)]
            runs[energy, kind] = work.solve(f"bend-{energy}-{kind}", mesh, last[-1], energy, use, sequence=last)
    return voxels, x, triangles, pull, runs


def check11(made):
    voxels, _, _, pull, runs = made
    mesh = ("rod", voxels.x, voxels.tets)
    n = require_pair(mesh, pull, runs["green", "none"], runs["green", "spline"], "Green's strain")
    require(flips(runs["arap", "spline"].x, voxels.tets) == 0, "ARAP with the barrier: inverted")
    return f"Green's strain collapses without the barrier: {n} of {len(voxels.tets)} tetrahedra inverted; with it 0, ARAP 0"


TITLES = {"green": "Green's strain", "arap": "ARAP"}


def draw11(made):
    voxels, x, triangles, _, runs = made
    box = np.stack(np.meshgrid(*zip(*common_box(voxels.x, *(run.x for run in runs.values())))), -1).reshape(-1, 3)
    show = lambda at: surface([(voxels.carried(x, at), triangles, (150, 185, 220))], (8, 12), box, 210, 210, (60, 70, 90, 70))
    return row([("rest", show(voxels.x)), *((TITLES[e] + (", barrier" if k == "spline" else ", none"), show(run.x))
                                            for (e, k), run in runs.items())])


def dino():
    """A dinosaur of tetrahedra, its feet, its head and the end of its tail as vertices."""
    x, tets = filled(dinosaur, (-2.1, -.2, -.8), (3.2, 2.9, .8), .133)
    return (("dino", x, tets), np.flatnonzero(x[:, 1] < .22), np.flatnonzero((x[:, 0] < -1.25) & (x[:, 1] > 2.2)),
            np.flatnonzero(x[:, 0] > 2.35))


def make13(work, fault):
    mesh, feet, head, tail = dino()
    x = mesh[1]
    # The head bows to the ground in front, the tail rises over the back.
    pull = {int(v): x[v] for v in feet}
    pull |= zip(head.tolist(), spun(x[head], x[head].mean(0), 2, 100) + [-.75, -1.75, .1])
    pull |= zip(tail.tolist(), spun(x[tail], x[tail].mean(0), 2, 150) + [-1.6, 1.75, 0])
    to = moved(fault, pull, x)
    kind = "none" if fault == "barrier off" else "spline"
    runs = [work.solve(f"green-{k}", mesh, to, "green", k if i == 0 else kind) for i, k in enumerate(("none", "spline"))]
    return mesh, (feet, head, tail), pull, runs


def check13(made):
    mesh, _, pull, (without, ours) = made
    n = require_pair(mesh, pull, without, ours, "Green's strain", 20)
    return f"{len(mesh[2])} tetrahedra (the paper 13052); inverted without {n}, with 0; {ours.report['iterations']} iterations (26)"


def draw13(made):
    (_, x, tets), handles, _, (without, ours) = made
    box = np.stack(np.meshgrid(*zip(*common_box(x, ours.x))), -1).reshape(-1, 3)
    view, held = (25, 10), np.isin(tets, np.concatenate(handles)).all(1)
    show = lambda at: solid(at, tets, view, box=box, width=330, height=300, held=held)
    return row([(t, show(at)) for t, at in (("rest", x), ("Green's strain", without.x), ("with the barrier", ours.x))])


SHELLS = ((1.0, (215, 40, 30)), (.82, (245, 120, 60)), (.5, (250, 200, 90)), (.22, (90, 150, 60)))


def fruit():
    """Nested surfaces of revolution, a tomato's skin, flesh, core and seeds, in 2250 cubes or so."""
    a = np.linspace(0, np.pi, 33)
    profile = np.stack([1.08 * np.sin(a), .82 * np.cos(a) - .16 * np.exp(-8 * a ** 2)], 1)
    profile[[0, -1], 0] = 0
    parts = [turned(profile * r, 44) for r, _ in SHELLS]
    return around(np.concatenate([x for x, _ in parts] + [turned(profile, 200)[0]]), 15), parts


def make14(work, fault):
    voxels, parts = fruit()
    v = voxels.x
    bottom = np.flatnonzero(v[:, 1] < -.55)
    top = np.flatnonzero((v[:, 1] > .42) & (np.hypot(v[:, 0], v[:, 2]) < .45))
    to = spun(v[top], v[top].mean(0), 2, 30) + [.25, -.72, 0]
    pull = {**{int(k): v[k] for k in bottom}, **{int(k): p for k, p in zip(top, to)}}
    kind = "none" if fault == "barrier off" else "spline"
    mesh = ("fruit", v, voxels.tets)
    to = moved(fault, pull, v)
    runs = [work.solve(f"arap-{k}", mesh, to, "arap", k if i == 0 else kind) for i, k in enumerate(("none", "spline"))]
    return voxels, parts, pull, runs


def winding(points, x, triangles):
    """How often a closed surface goes around points."""
    a, b, c = (x[triangles[:, k]][None] - points[:, None] for k in range(3))
    la, lb, lc = (np.linalg.norm(v, axis=2) for v in (a, b, c))
    top = np.einsum("nmd,nmd->nm", a, np.cross(b, c))
    dot = lambda p, q: np.einsum("nmd,nmd->nm", p, q)
    return np.arctan2(top, la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb).sum(1) / (2 * np.pi)


def nested(voxels, parts, x):
    """The smallest winding of a shell about points of the next one inside: 1 if all are inside."""
    at = [(voxels.carried(p, x), triangles) for p, triangles in parts]
    sign = np.sign(winding(np.zeros((1, 3)) + parts[-1][0].mean(0), *parts[0])[0])
    return min(float((sign * winding(inner[::7], *outer)).min()) for outer, (inner, _) in zip(at, at[1:]))


def check14(made):
    voxels, parts, pull, (without, ours) = made
    n = require_pair(("fruit", voxels.x, voxels.tets), pull, without, ours, "ARAP", 5)
    inside = nested(voxels, parts, ours.x)
    require(inside > .9, f"an inner surface leaves the one around it: winding {inside:.2f}")
    return (f"{len(voxels.tets)} tetrahedra (the paper 13500); inverted without {n}, with 0; "
            f"all {len(parts)} surfaces stay inside each other (winding {inside:.2f})")


def see_through(voxels, parts, x, view=(25, 14), width=270):
    alpha = (70, 95, 150, 255)
    shapes = [(voxels.carried(p, x), triangles, (*color, a)) for (p, triangles), (_, color), a in zip(parts, SHELLS, alpha)]
    bad = voxels.tets[sizes(x, voxels.tets) <= 0]
    if len(bad):
        shapes.append((x, np.concatenate([bad[:, list(k)] for k in ((1, 2, 3), (0, 3, 2), (0, 1, 3), (0, 2, 1))]), (*YELLOW, 255)))
    box = np.stack(np.meshgrid([-1.2, 1.2], [-.85, .75], [-1.2, 1.2]), -1).reshape(-1, 3)
    return surface(shapes, view, box, width, round(.75 * width))


def draw14(made):
    voxels, parts, _, (without, ours) = made
    return row([("rest", see_through(voxels, parts, voxels.x)), ("ARAP", see_through(voxels, parts, without.x)),
                ("with the barrier", see_through(voxels, parts, ours.x))])


def make1(work, fault):
    return make2(work, fault), make14(work, fault)


def check1(made):
    return check2(made[0]) + " | in space: " + check14(made[1])


def draw1(made):
    (mesh, parts, _, without, ours), (voxels, inner, _, runs) = made
    rings, box = [sorted(p) for p in parts], common_box(without.x, ours.x)
    flat = [(t, planar(mesh, x, rings, box, width=200)) for t, x in (("ARAP: spillage", without.x), ("ours", ours.x))]
    show = lambda run: see_through(voxels, inner, run.x, width=250)
    return row([*flat, ("ARAP in space", show(runs[0])), ("ours in space", show(runs[1]))])


FIGURES = [
    Figure(1, "spikes and spillages", "ARAP inverts elements, yellow, in the plane and in space; with the barrier none.",
           make1, check1, draw1, ("barrier off", "wrong handle")),
    Figure(5, "iterates of a cylinder", "A cylinder stretched by its right cap: every iterate is valid, and the energy falls.",
           make5, check5, draw5, ("an iterate inverted", "wrong handle")),
    Figure(11, "bent cylinder", "A cylinder in a grid of cubes bent back, Green's strain and ARAP.", make11, check11, draw11,
           ("barrier off", "wrong handle")),
    Figure(13, "deformation of space", "Green's strain without and with the barrier; inverted tetrahedra yellow.", make13, check13, draw13,
           ("barrier off", "wrong handle")),
    Figure(14, "nested surfaces", "The inner surfaces of a fruit, see-through, do not intersect.", make14, check14, draw14,
           ("barrier off", "wrong handle")),
]
