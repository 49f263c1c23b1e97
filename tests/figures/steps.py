"""Figures of the paper's iteration: 8 and 21."""
import numpy as np

from figure import Figure
from maps import distance, flips, pulled
from paint import BLUE, GREEN, MAGENTA, column, common_box, planar, row
from plane import NEAR, merged
from shapes import FEET, HANDS, HEAD, rectangle, woody
from work import DONE, ENDED_EARLY, INVERTED, UNREACHABLE, require

ANY = (DONE, INVERTED, UNREACHABLE, ENDED_EARLY)


def make8(work, fault):
    mesh = rectangle("square12", 12, 12)
    x = mesh[1]
    vertex = int(np.argmin(np.linalg.norm(x - [.25, .5], axis=1)))
    side = {int(v): x[v] for v in np.flatnonzero((x[:, 0] == 0) | (x[:, 0] == 1) | (x[:, 1] == 0) | (x[:, 1] == 1))}
    target = np.array([.8, .5])
    frames = "frames" if fault is None else f"frames-{fault[:8]}".replace(" ", "-")
    run = work.solve("substeps", mesh, {**side, vertex: target if fault != "wrong handle" else target - [.1, 0]}, "green", "spline",
                     "--method", "levenberg", "--frames", frames, statuses=ANY, substepping=fault != "substepping off",
                     alpha_update=True, max_iter=400)
    return mesh, vertex, target, run


def between(made):
    """Of every step the handle, and the target on its way by equation 11."""
    _, vertex, target, run = made
    for k, step in enumerate(run.trace[1:], 1):
        at = run.frames[k - 1][vertex]
        yield k, at, at + (target - at) / (1 + step["mu"] ** 2)


def check8(made):
    mesh, vertex, target, run = made
    require(all(flips(frame, mesh[2]) == 0 for frame in run.frames), "an iterate is inverted")
    # What the trace calls the constraint is α‖Cv − t‖², in other units than its residual ‖Cv − d‖².
    # They differ where t is not d.
    weight = [step["constraint"] / max(step["alpha"] * step["residual"], 1e-300) for step in run.trace]
    relaxed = [k for k, w in enumerate(weight) if run.trace[k]["mu"] >= 1 and w < .5 * weight[0]]
    require(len(relaxed) >= 2, f"the target retreats in {len(relaxed)} steps")
    away = float(np.linalg.norm(run.x[vertex] - target))
    require(away < 1e-4, f"the handle ends {away:.2g} from its target")
    return f"{len(run.trace) - 1} steps, in {len(relaxed)} of which the target retreats; the handle ends {away:.0e} away, none inverted"


def draw8(made):
    mesh, vertex, target, run = made
    steps = list(between(made))
    relaxed = [s for s in steps if np.linalg.norm(s[2] - target) > 1e-6]
    chosen = [relaxed[0], relaxed[len(relaxed) // 2], relaxed[-1], steps[-1]]
    box = ((.3, .25), (1, .75))
    marks = lambda at, to: [(target, 8, BLUE), (to, 9, MAGENTA), (at, 5, GREEN)]
    return row([(f"step {k}", planar(mesh, run.frames[k - 1], [], box, width=250, dots=marks(at, to))) for k, at, to in chosen])


def bend(mesh):
    """The head bent to the side and a hand brought down, feet held: the deformation of the comparison."""
    x = mesh[1]
    return [pulled(x, (FEET[0], (0, 0))), pulled(x, (FEET[1], (0, 0))), pulled(x, (HANDS[0], (.75, -.55), 60)),
            pulled(x, (HANDS[1], (-.55, .3), 60)), pulled(x, (HEAD, (.2, -.35), -40))]


def make21(work, fault):
    rows = []
    failures = [(4900, "no alpha update, Neo-Hookean", "neohookean", {"substepping": True, "alpha_update": False}),
                (12200, "no substepping", "spline", {"substepping": False, "alpha_update": True})]
    for n, title, barrier, switches in failures:
        mesh = woody(work, n)
        parts = bend(mesh)
        pull = merged(parts)
        ours = work.solve(f"ours-{n}", mesh, pull, "green", "none" if fault == "barrier off" else "spline", beta=100.0)
        if fault == "nothing disabled":
            failed = ours
        else:
            failed = work.solve(f"failed-{n}", mesh, pull, "green", barrier, "--method", "levenberg", statuses=ANY, beta=100.0,
                                alpha0=1.0 if not switches["alpha_update"] else 1e8, max_iter=60, **switches)
        rows.append((mesh, parts, pull, title, ours, failed))
    return rows


def check21(made):
    says = []
    for mesh, _, pull, title, ours, failed in made:
        require(flips(ours.x, mesh[2]) == 0 and distance(ours.x, pull) < NEAR, f"{len(mesh[2])} triangles: ours is inverted or away")
        away = distance(failed.x, pull)
        require(away > 1e-2, f"{title}: the handles come as near as {away:.2g}")
        says.append(f"{len(mesh[2])} triangles: ours within {distance(ours.x, pull):.0e} in {ours.report['iterations']} iterations; "
                    f"{title}: {away:.2f} away after {failed.report['iterations']}")
    return "; ".join(says)


def draw21(made):
    rows = []
    for mesh, parts, pull, title, ours, failed in made:
        rings, box = [sorted(p) for p in parts], common_box(mesh[1], ours.x, failed.x)
        dots = [(np.mean([pull[v] for v in part], 0), 3, MAGENTA) for part in parts]
        show = lambda t, x: (t, planar(mesh, x, rings, box, width=260, edge=(60, 64, 80, 30), dots=dots))
        rows.append(row([show(f"{len(mesh[2])} triangles", mesh[1]), show("ours", ours.x), show(title, failed.x)]))
    return column(rows)


FIGURES = [
    Figure(8, "substepping", "Steps of the iteration: handle (green), target (blue) and the target on its way (magenta).",
           make8, check8, draw8, ("substepping off", "wrong handle")),
    Figure(21, "two failures", "Two meshes; right, what fails without the update of α and without substepping.", make21, check21, draw21,
           ("barrier off", "nothing disabled")),
]
