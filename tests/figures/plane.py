"""Figures of planar deformations: 2, 9, 10 and 19."""
import numpy as np

from figure import Figure
from maps import conformal, distance, flips, pulled, sizes
from paint import column, common_box, planar, row
from shapes import FEET, HANDS, HEAD, disk, rectangle, woody
from work import require

NEAR = 1e-6


def rings_of(pulls):
    return [sorted(pull) for pull in pulls]


def both(work, name, mesh, pull, energy, fault, **keys):
    """The map without a barrier and with the paper's."""
    kind = "none" if fault == "barrier off" else "spline"
    without = work.solve(f"{name}-none", mesh, pull, energy, "none", **keys)
    return without, work.solve(f"{name}-spline", mesh, pull, energy, kind, **keys)


def require_pair(mesh, pull, without, ours, what, least=1):
    """Inverted triangles without the barrier, none with it, and all handles where they should be; how many there were."""
    n_without, n_ours = flips(without.x, mesh[2]), flips(ours.x, mesh[2])
    require(n_without >= least, f"{what}: {n_without} inverted without a barrier")
    require(n_ours == 0, f"{what}: {n_ours} inverted with the barrier")
    away = distance(ours.x, pull)
    require(away < NEAR, f"{what}: a handle is {away:.3g} from its target")
    return n_without


def moved(fault, pull, rest):
    """With the fault, the handles stop a tenth of their way short of their targets."""
    if fault != "wrong handle":
        return pull
    return {v: .9 * np.asarray(to) + .1 * rest[v] for v, to in pull.items()}


def squeeze(mesh):
    """The head pressed into the body, between hands and feet that are held."""
    x = mesh[1]
    return [pulled(x, (place, (0, 0))) for place in (*HANDS, *FEET)] + [pulled(x, (HEAD, np.array([0, -.78])), radius=.1)]


def merged(parts):
    return {v: to for part in parts for v, to in part.items()}


def make2(work, fault):
    mesh = woody(work)
    parts = squeeze(mesh)
    pull = merged(parts)
    without, ours = both(work, "arap", mesh, moved(fault, pull, mesh[1]), "arap", fault)
    return mesh, parts, pull, without, ours


def check2(made):
    mesh, _, pull, without, ours = made
    n = require_pair(mesh, pull, without, ours, "ARAP")
    return f"{len(mesh[2])} triangles; inverted without {n}, with the barrier 0; handles within {distance(ours.x, pull):.0e}"


def draw2(made):
    """The maps, and a close-up of the body."""
    mesh, parts, _, without, ours = made
    rings, box = rings_of(parts), common_box(mesh[1], without.x, ours.x)
    near = without.x[mesh[2][sizes(without.x, mesh[2]) <= 0]].reshape(-1, 2)
    center = np.median(near, 0)
    close = (center - .2, center + .2)
    show = lambda title, x: (title, planar(mesh, x, rings, box, width=250, height=300))
    zoom = lambda title, x: (title, planar(mesh, x, [], close, width=300))
    return row([show("ARAP", without.x), zoom("close-up", without.x), show("rest", mesh[1]), show("our method", ours.x),
                zoom("close-up", ours.x)])


ENERGIES = {"dirichlet": "Dirichlet", "laplacian": "biharmonic", "green": "Green's strain", "arap": "ARAP"}


def pulls9(square, puppet):
    """A square whose middle is pulled toward a corner, and the puppet of figure 2."""
    x = square[1]
    parts = [pulled(x, (corner, (0, 0)), radius=.05) for corner in ((0, 0), (0, 1), (1, 0), (1, 1))]
    return parts + [pulled(x, ((.5, .5), (.43, .4)), radius=.09)], squeeze(puppet)


def make9(work, fault):
    meshes = rectangle("square", 24, 24), woody(work, 1500)
    cases = []
    for mesh, parts in zip(meshes, pulls9(*meshes)):
        pull = merged(parts)
        runs = {energy: both(work, f"{mesh[0]}-{energy}", mesh, moved(fault, pull, mesh[1]), energy, fault) for energy in ENERGIES}
        cases.append((mesh, parts, pull, runs))
    return cases


def check9(made):
    counts = []
    for mesh, _, pull, runs in made:
        counts.append([require_pair(mesh, pull, *pair, f"{mesh[0]}, {energy}") for energy, pair in runs.items()])
    return f"inverted without the barrier, {', '.join(ENERGIES.values())}: {counts[0]} and {counts[1]}; with it 0 in all 8"


def draw9(made):
    rows = []
    for mesh, parts, _, runs in made:
        box = common_box(*(pair[1].x for pair in runs.values()), *(pair[0].x for pair in runs.values()))
        for k, what in enumerate(("", ", ours")):
            rows.append(row([(ENERGIES[e] + what, planar(mesh, pair[k].x, rings_of(parts), box, width=210)) for e, pair in runs.items()]))
    return column(rows)


def make10(work, fault):
    mesh = rectangle("square20", 20, 20)
    x = mesh[1]
    side = {int(v): x[v] for v in np.flatnonzero((x[:, 0] == 0) | (x[:, 0] == 1) | (x[:, 1] == 0) | (x[:, 1] == 1))}
    knob = pulled(x, ((.35, .5), (.37, 0)), radius=.08)
    pull = {**side, **knob}
    runs = {energy: both(work, energy, mesh, moved(fault, pull, mesh[1]), energy, fault) for energy in ("dirichlet", "laplacian")}
    return mesh, knob, pull, runs


def check10(made):
    mesh, _, pull, runs = made
    counts = {energy: require_pair(mesh, pull, *pair, energy, least=0) for energy, pair in runs.items()}
    require(counts["dirichlet"] > 1.5 * counts["laplacian"], f"less prominent with the Laplacian: {counts}")
    return f"inverted without the barrier: Dirichlet {counts['dirichlet']}, Laplacian {counts['laplacian']}; with it 0 and 0"


def draw10(made):
    mesh, knob, _, runs = made
    titles = {"dirichlet": "Dirichlet", "laplacian": "Laplacian"}
    return row([(titles[e] + what, planar(mesh, pair[k].x, [sorted(knob)], width=240)) for e, pair in runs.items()
                for k, what in enumerate(("", ", our barrier"))])


def make19(work, fault):
    mesh = woody(work)
    x = mesh[1]
    parts = [pulled(x, (place, (0, 0)), radius=.1) for place in (HEAD, (0, .3))]
    for hand, foot in zip(HANDS, FEET[::-1]):
        parts += [pulled(x, (hand, foot - hand), radius=.1), pulled(x, (foot, hand - foot), radius=.1)]
    pull = merged(parts)
    without, ours = both(work, "swap", mesh, moved(fault, pull, mesh[1]), "arap", fault)
    return mesh, parts, pull, without, ours


def check19(made):
    mesh, _, pull, without, ours = made
    n = require_pair(mesh, pull, without, ours, "swap", least=50)
    worst = conformal(mesh[1], ours.x, mesh[2]).max()
    error = sum(float(np.sum((ours.x[v] - to) ** 2)) for v, to in pull.items())
    require(error < 1e-12, f"constraint error {error:.2g}")
    return f"inverted without {n} (the paper 512), with 0; constraint error {error:.1e} (2.6e-16); largest distortion {worst:.0f}"


FIGURES = [
    Figure(2, "2D deformation", "ARAP alone (left), the rest pose and the barrier (right); red by angular distortion, inverted yellow.",
           make2, check2, draw2, ("barrier off", "wrong handle")),
    Figure(9, "energies", "Four energies on two meshes, without and with the barrier.", make9, check9, draw9,
           ("barrier off", "wrong handle")),
    Figure(10, "Dirichlet and Laplacian", "A simple pull, without and with the barrier.", make10, check10, draw10,
           ("barrier off", "wrong handle")),
    Figure(19, "arms and legs swapped", "Hands and feet change places, head and chest are held; ARAP without and with the barrier.",
           make19, check19, draw2, ("barrier off", "wrong handle")),
]
