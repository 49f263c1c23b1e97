"""Figure 20: a bar twisted seven times, and the turns that its map keeps."""
import numpy as np

from figure import Figure
from maps import distance, flips
from paint import column, row, solid
from plane import NEAR
from shapes import bar
from solids import spun
from work import DONE, INVERTED, UNREACHABLE, require

TURNS, STEP = 7, 15


def turns(rest, x):
    """The turns of a map of a bar: the rotations from layer to layer that fit best, added; and the largest, in degrees."""
    layers, angles = np.unique(np.round(rest[:, 0], 9)), []
    frames = []
    for place in layers:
        members = np.flatnonzero(np.abs(rest[:, 0] - place) < 1e-6)
        arms = rest[members, 1:] - rest[members, 1:].mean(0)
        frames.append(np.linalg.pinv(arms) @ (x[members] - x[members].mean(0)))
    for (a0, b0), (a1, b1) in zip(frames, frames[1:]):
        angles.append(np.degrees(np.arctan2(a0 @ b1 - b0 @ a1, a0 @ a1 + b0 @ b1)))
    return sum(angles) / 360, np.abs(angles).max()


def stations(x, stretch):
    """The held end, and the other drawn out along the axis first, then turned by 15 degrees at a time."""
    length = x[:, 0].max()
    left, right = np.flatnonzero(x[:, 0] == 0), np.flatnonzero(x[:, 0] == length)
    for share in (0.5, 1.0):
        yield {**{int(v): x[v] for v in left}, **{int(v): x[v] + [share * (stretch - 1) * length, 0, 0] for v in right}}
    for degrees in range(STEP, 360 * TURNS + 1, STEP):
        to = spun(x[right], np.zeros(3), 0, degrees) + [(stretch - 1) * length, 0, 0]
        yield {**{int(v): x[v] for v in left}, **{int(v): p for v, p in zip(right, to)}}


def twisted(work, name, mesh, kind, beta, stretch, fault=None):
    way = list(stations(mesh[1], stretch))
    if fault == "wrong handle":
        way = way[:-24]
    return work.solve(name, mesh, way[-1], "green", kind, sequence=way, beta=beta, statuses=(DONE, INVERTED, UNREACHABLE)), way


def make20(work, fault):
    mesh = bar(48, 3)
    strong = 100.0
    kind = "none" if fault == "barrier off" else "spline"
    without, way = twisted(work, "none", mesh, "none", strong, 1.4)
    ours, _ = twisted(work, "none" if kind == "none" else "ours", mesh, kind, strong, 1.4, fault)
    return mesh, way[-1], without, ours


def check20(made):
    mesh, pull, without, ours = made
    require(flips(without.x, mesh[2]) > 0, "none inverted without the barrier")
    require(flips(ours.x, mesh[2]) == 0, f"{flips(ours.x, mesh[2])} inverted with the barrier")
    require(distance(ours.x, pull) < NEAR, "the end is not where it should be")
    (kept, largest), (lost, _) = turns(mesh[1], ours.x), turns(mesh[1], without.x)
    require(abs(kept) > 6.6, f"{abs(kept):.2f} turns are left")
    return (f"inverted without {flips(without.x, mesh[2])} (the paper 135), with 0; turns kept {abs(kept):.2f} of {TURNS}, "
            f"without the barrier {abs(lost):.2f}; largest angle between layers {largest:.0f}°")


def draw20(made):
    mesh, _, without, ours = made
    view, box = (8, 20), np.array([[0, -3, -3], [68, 3, 3], [68, -3, 3], [0, 3, -3]])
    show = lambda x: solid(x, mesh[2], view, box=box, width=680, height=90)
    return column([row([("rest", show(mesh[1]))]), row([("Green's strain without the barrier", show(without.x))]),
                   row([("with the barrier, drawn out 1.4 times", show(ours.x))])])


FIGURES = [
    Figure(20, "twisted bar", "A bar drawn out 1.4 times and twisted seven times, Green's strain, without and with the barrier.",
           make20, check20, draw20, ("barrier off", "wrong handle")),
]
