"""Figures of the barrier itself: 3, 4, 6 and 7."""
import numpy as np

from figure import Figure
from maps import border, distance, flips, green, pulled, sizes
from paint import BLUE, INK, column, common_box, planar, plot, row
from plane import NEAR, merged, moved
from shapes import rectangle
from work import require

BETAS = (0.01, 1.0, 100.0, 1e4)
NAMES = {"none": "no barrier", "spline": "inverse spline", "auglog": "augmented log", "neohookean": "Neo-Hookean", "log": "log"}
COLORS = {"spline": (205, 30, 35), "auglog": BLUE, "neohookean": (30, 150, 70)}
TRIANGLE = ("triangle", np.array([[0., 0.], [1., 0.], [0., 1.]]), np.array([[0, 1, 2]]))


def make3(work, fault):
    mesh = rectangle("square16", 16, 16)
    x = mesh[1]
    parts = [{int(v): x[v] for v in np.unique(border(mesh[2]))}, pulled(x, ((.375, .5), (.34, 0)), radius=.1)]
    pull = merged(parts)
    to = moved(fault, pull, x)
    runs = {}
    for energy in ("green", "arap"):
        runs[energy] = [work.solve(f"{energy}-none", mesh, to, energy, "none")]
        for beta in BETAS:
            kind = "none" if fault == "barrier off" else "spline"
            runs[energy].append(work.solve(f"{energy}-{beta:g}", mesh, to, energy, kind, beta=beta))
    return mesh, parts, pull, runs


def shrinkage(mesh, x):
    """How far triangles are from keeping their rest size, where they lost some: the mean square."""
    ratio = sizes(x, mesh[2]) / sizes(mesh[1], mesh[2])
    return float(np.mean(np.minimum(ratio - 1, 0) ** 2))


def check3(made):
    mesh, _, pull, runs = made
    says = []
    for energy, maps in runs.items():
        require(flips(maps[0].x, mesh[2]) > 0, f"{energy}: none inverted without a barrier")
        for beta, run in zip(BETAS, maps[1:]):
            require(flips(run.x, mesh[2]) == 0, f"{energy}: inverted at β = {beta:g}")
            require(distance(run.x, pull) < NEAR, f"{energy}, β = {beta:g}: a handle is {distance(run.x, pull):.2g} away")
        lost = [shrinkage(mesh, run.x) for run in maps]
        require(all(b < a for a, b in zip(lost, lost[1:])), f"{energy}: a stronger barrier does not keep areas better: {lost}")
        says.append(f"{energy} {flips(maps[0].x, mesh[2])} inverted, area lost {lost[0]:.2g} → {lost[-1]:.2g}")
    return "β = none, .01, 1, 100, 10⁴: " + "; ".join(says)


def draw3(made):
    mesh, parts, _, runs = made
    titles = ("no barrier", *(f"β = {beta:g}" for beta in BETAS))
    names = {"green": "Green", "arap": "ARAP"}
    return column([row([(f"{names[energy]}, {title.replace('β', 'beta')}", planar(mesh, run.x, [sorted(parts[1])], width=190))
                        for title, run in zip(titles, maps)]) for energy, maps in runs.items()])


def barrier_at(work, ratio, kind, support=1.0):
    """φ of one triangle that all three handles hold at this share of its rest area, as `solve` reports it; β = 1."""
    pull = dict(enumerate(TRIANGLE[1] * [ratio, 1]))
    run = work.solve(f"{kind}-s{support:g}-{ratio:g}", TRIANGLE, pull, "dirichlet", kind, beta=1.0, gamma=support, eps=0.0)
    require(abs(sizes(run.x, TRIANGLE[2])[0] / 0.5 - ratio) < 1e-9, "the triangle is not where its handles hold it")
    return float(run.report["barrier"])


def spline(x, s):
    """Equations 5 and 6 for an element of rest size 1."""
    x = np.asarray(x, float)
    return np.where(x < s, 1 / ((x / s) ** 3 - 3 * (x / s) ** 2 + 3 * x / s) - 1, 0.0)


SUPPORTS = {0.25: (230, 140, 20), 0.5: (30, 150, 70), 1.0: (205, 30, 35)}
SHARES = (.05, .1, .2, .35, .5, .7, .9, 1.1)


def make4(work, fault):
    wrong = 2.0 if fault == "another support" else 1.0
    return {s: [barrier_at(work, share, "none" if fault == "barrier off" else "spline", s * wrong) for share in SHARES] for s in SUPPORTS}


def check4(made):
    for s, values in made.items():
        expected = spline(SHARES, s)
        worst = float(np.abs(np.array(values) - expected).max() / expected.max())
        require(worst < 1e-6, f"s = {s}: differs from equation 6 by {worst:.2g}")
        require(all(b <= a for a, b in zip(values, values[1:])), f"s = {s}: does not rise toward 0")
        require(all(v == 0 for v, x in zip(values, SHARES) if x >= s), f"s = {s}: felt beyond the support")
    return f"{len(SHARES)} areas × s = {', '.join(map(str, made))}: equation 6 within 1e-6; 0 from s on"


def draw4(made):
    x = np.linspace(.01, 1.2, 400)
    curves = {f"s = {s:g}": (np.stack([x, spline(x, s)], 1), SUPPORTS[s], False) for s in made}
    curves |= {" " * k: (np.stack([SHARES, values], 1), INK, True) for k, (s, values) in enumerate(made.items(), 1)}
    return plot(curves, ((0, 0), (1.2, 8)), 420, 300, ("area / rest area", "barrier; dots: unwrapd solve"))


PLACES = (.1, .2, .4, .7, .9, 1., 1.2, 1.5, 2., 2.5, 3.)


def make6(work, fault):
    wrong = {"barriers exchanged": {"spline": "auglog", "auglog": "spline"}, "barrier off": {"spline": "none"}}.get(fault, {})
    return {kind: [barrier_at(work, place, wrong.get(kind, kind)) for place in PLACES] for kind in COLORS}


def check6(made):
    for kind, values in made.items():
        at = dict(zip(PLACES, values))
        require(abs(at[1.]) < 1e-9, f"{kind}: not 0 at rest")
        require(at[.1] > at[.4] > at[.7] > 0, f"{kind}: does not rise toward 0")
        stretched = [at[p] for p in PLACES if p > 1]
        compact = all(v == 0 for v in stretched)
        require(compact == (kind == "spline"), f"{kind}: stretched elements {'do not ' if compact else ''}feel it")
    return f"only the inverse spline is 0 from rest on; at three times the area {', '.join(f'{k} {v[-1]:.2f}' for k, v in made.items())}"


def draw6(made):
    curves = {NAMES[k]: (np.stack([PLACES, v], 1), COLORS[k], False) for k, v in made.items()}
    curves |= {" " * i: (np.stack([PLACES, v], 1), COLORS[k], True) for i, (k, v) in enumerate(made.items(), 1)}
    return plot(curves, ((0, 0), (3, 3)), 420, 300, ("area / rest area", "barrier, by unwrapd solve"))


def make7(work, fault):
    mesh = rectangle("strip", 20, 10)
    x = mesh[1]
    ends = [np.flatnonzero(x[:, 0] == side) for side in (0, 1)]
    pull = {int(v): x[v] + [.8 * k, 0] for k, end in enumerate(ends) for v in end}
    kinds = {"none": "none", "auglog": "auglog", "spline": "auglog" if fault == "barriers exchanged" else "spline"}
    to = moved(fault, pull, x)
    return mesh, ends, pull, {kind: work.solve(f"stretch-{kind}", mesh, to, "green", use, beta=100.0) for kind, use in kinds.items()}


def check7(made):
    mesh, _, pull, runs = made
    for kind, run in runs.items():
        require(flips(run.x, mesh[2]) == 0, f"{kind}: inverted")
        require(distance(run.x, pull) < NEAR, f"{kind}: a handle is {distance(run.x, pull):.2g} away")
    e = {kind: green(mesh[1], run.x, mesh[2]) for kind, run in runs.items()}
    spread = {kind: float(np.abs(run.x - runs["none"].x).max()) for kind, run in runs.items()}
    bias = {kind: e[kind] / e["none"] - 1 for kind in ("spline", "auglog")}
    require(bias["spline"] < 0.1 * bias["auglog"] and bias["auglog"] > 0.1, f"bias of the energy: {bias}")
    require(spread["spline"] < 0.2 * spread["auglog"], f"bias of the shape: {spread}")
    log, ours = (100 * bias[kind] for kind in ("auglog", "spline"))
    return f"Green's strain raised by {log:.1f} % with the augmented log, {ours:.2g} % with the inverse spline"


def draw7(made):
    mesh, ends, _, runs = made
    box = common_box(*(run.x for run in runs.values()))
    return row([(NAMES[kind], planar(mesh, run.x, [], box, width=260, scale=(2, 6))) for kind, run in runs.items()])


FIGURES = [
    Figure(3, "barrier strength", "Green's strain and ARAP under barriers of different strength β.", make3, check3, draw3,
           ("barrier off", "wrong handle")),
    Figure(4, "barrier and support", "The barrier over an element's area for three values of s.", make4, check4, draw4,
           ("barrier off", "another support")),
    Figure(6, "barrier functions", "Three barriers; only the inverse spline has compact support.", make6, check6, draw6,
           ("barrier off", "barriers exchanged")),
    Figure(7, "bias", "Green's strain with the augmented log barrier and with the inverse spline.", make7, check7, draw7,
           ("barriers exchanged", "wrong handle")),
]
