"""Figure 20: bars twisted by turns of one end, and how many of the turns the map keeps.

The turns of a map are the sum over neighboring layers of the rotation that best takes one to the next, at most 180°, of which
the part about the bar's own axis counts: the twist, exact for a helix; what a coiled bar lacks of the turns applied is in its
coil. An element without inversion can hold no more than 90° between its layers. What a bar can hold with its energy at a minimum is less, and `limit`
measures it: the bar starts as a straight screw, is settled, turned a little further as a screw, and so on, until a minimum with
these turns is not found any more. Beyond, no method that minimizes ends with all turns, and none that keeps elements from
inverting loses one turn alone: they go in pairs. A bar that is stretched as it is turned does not buckle, and keeps them:
`stretched` turns the far end of bars by one handle of `deform`, and compares what its report says is left with a count of ours.
"""
import json

import numpy as np

from problems import read_mesh, read_positions, run, solve, table
from published import FIGURES

# Of turns that were applied a map has lost some if it has less by this: turns are lost in pairs.
LOST = 1.2

# The paper's for this figure.
BETA = 0.01

# Turns by which a screw goes on.
SCREW_STEP = 1 / 24

# Of what is counted here, that a report may differ by.
AGREES = 0.01

# Slabs that bars without layers are counted in: for 7 turns less than 60 degrees each.
SLABS = 48

STRETCHED_HEADER = ("bar", "tets", "energy", "stretched to", "turns asked", "turns left, counted here", "turns left, by the report",
                    "end", "it", "fact", "CPU s", "smallest", "inverted", "warned")

HEADER = ("bar", "energy", "β", "turns applied", "° per layer", "turns kept", "largest ° between layers", "end", "it", "fact", "CPU s",
          "E", "smallest", "inverted", "authors' code: turns kept · it · s")


def bar(path, length, width):
    """Writes a bar of unit cubes, `length` along x and `width` across, six Kuhn tetrahedra each, as a .tet file."""
    size = np.array([length, width, width]) + 1
    vertices = np.stack(np.meshgrid(*map(np.arange, size), indexing="ij"), -1).reshape(-1, 3)
    number = lambda p: np.ravel_multi_index(tuple(np.moveaxis(p, -1, 0)), size)
    corners = np.stack(np.meshgrid(*map(np.arange, size - 1), indexing="ij"), -1).reshape(-1, 3)
    steps = np.eye(3, dtype=int)
    tets = []
    for a, b, c in [(0, 1, 2), (1, 2, 0), (2, 0, 1), (0, 2, 1), (2, 1, 0), (1, 0, 2)]:
        path_of = np.cumsum([np.zeros(3, int), steps[a], steps[b], steps[c]], 0)
        tet = number(corners[:, None] + path_of[None])
        is_even = (a, b, c) in ((0, 1, 2), (1, 2, 0), (2, 0, 1))
        tets.append(tet if is_even else tet[:, [0, 1, 3, 2]])
    rows = [f"{len(vertices)} {6 * len(corners)}"]
    rows += [" ".join(map(str, row)) for row in vertices.tolist() + np.concatenate(tets).tolist()]
    path.write_text("\n".join(rows) + "\n")
    return path


def screw(x, turns):
    """The positions `x` of a bar along the x axis, every layer turned about the axis in proportion to its rest place."""
    center = 0.5 * (x[:, 1:].min(0) + x[:, 1:].max(0))
    return rotated(x, 2 * np.pi * turns * x[:, 0] / x[:, 0].max(), center)


def rotated(x, angle, center):
    y, z = (x[:, 1:] - center).T
    return np.stack([x[:, 0], center[0] + np.cos(angle) * y - np.sin(angle) * z, center[1] + np.sin(angle) * y + np.cos(angle) * z], 1)


def turns(rest, x, layers=None):
    """The turns of a map of a bar along x, and the largest rotation between neighboring layers in degrees; `layers` are lists of
    vertices, by default the unit layers of its grid."""
    if layers is None:
        layers = [np.flatnonzero(np.abs(rest[:, 0] - place) < 0.5) for place in range(round(rest[:, 0].max()) + 1)]
    frames = [rotation(rest[members] - rest[members].mean(0), x[members] - x[members].mean(0)) for members in layers]
    angles = [np.degrees(rotation_vector(first.T @ second)[0]) for first, second in zip(frames, frames[1:])]
    return sum(angles) / 360, np.abs(angles).max()


def rotation(arms, at):
    """The rotation that best takes `arms` to `at` (Kabsch)."""
    u, _, v = np.linalg.svd(at.T @ arms)
    return u @ np.diag([1, 1, np.linalg.det(u @ v)]) @ v


def rotation_vector(r):
    """The axis of a rotation, as long as its angle."""
    w, v = np.linalg.eigh(rotor(r))
    x, y, z, c = v[:, np.argmax(w)] * (1 if v[3, np.argmax(w)] >= 0 else -1)
    sine = np.linalg.norm([x, y, z])
    return np.array([x, y, z]) * (2 * np.arctan2(sine, c) / sine if sine > 0 else 2)


def rotor(r):
    """The symmetric matrix whose eigenvector to the largest eigenvalue is the unit quaternion (x, y, z, w) of a rotation."""
    k = np.empty((4, 4))
    k[:3, :3] = r + r.T - np.trace(r) * np.eye(3)
    k[3, :3] = k[:3, 3] = r[2, 1] - r[1, 2], r[0, 2] - r[2, 0], r[1, 0] - r[0, 1]
    k[3, 3] = np.trace(r)
    return k


def write_positions(path, x):
    path.write_text("\n".join(" ".join(map(repr, row)) for row in x.tolist()) + "\n")


def ends(rest):
    """The vertices of both end layers."""
    return np.flatnonzero((rest[:, 0] == 0) | (rest[:, 0] == rest[:, 0].max()))


def problem_keys(mesh, energy, beta, rest):
    return {"mesh": str(mesh), "energy": energy, "barrier": "spline", "beta": beta, "handles": ends(rest).tolist()}


def row(name, keys, rest, applied, report, positions, work, authors="–"):
    kept, largest = turns(rest, np.array(read_positions(positions)))
    iterations, factorizations, seconds = work
    return (name, keys["energy"], keys["beta"], f"{applied:.2f}", f"{360 * applied / rest[:, 0].max():.1f}", f"{abs(kept):.2f}",
            f"{largest:.0f}", report["status"], iterations, factorizations, f"{seconds:.1f}", f"{report['energy']:.5g}",
            f"{report['smallest']:.4f}", report["inverted"], authors)


def limit(program, folder, mesh, energy, beta, first):
    """How far a straight screw can be turned and settled before it loses turns: the last that kept them, as a row."""
    rest = np.array(read_mesh(mesh)[0])
    keys = problem_keys(mesh, energy, beta, rest)
    held, center = ends(rest), 0.5 * (rest[:, 1:].min(0) + rest[:, 1:].max(0))
    x, applied, work = screw(rest, first), first, np.zeros(3)
    last = (f"{mesh.stem}, as a screw", energy, beta, f"less than {first:.2f}") + ("–",) * (len(HEADER) - 4)
    while True:
        x[held] = screw(rest, applied)[held]
        write_positions(folder / "start.txt", x)
        problem = folder / "screw.json"
        problem.write_text(json.dumps(keys | {"initial": "start.txt", "targets": x[held].tolist()}))
        report, positions, seconds = solve(program, problem, folder)
        x = np.array(read_positions(positions))
        work += report["iterations"], report["factorizations"], seconds
        if abs(turns(rest, x)[0]) < applied - LOST:
            return last
        last = row(f"{mesh.stem}, as a screw", keys, rest, applied, report, positions, (int(work[0]), int(work[1]), work[2]))
        x = rotated(x, 2 * np.pi * SCREW_STEP * rest[:, 0] / rest[:, 0].max(), center)
        applied += SCREW_STEP


def twisted(program, folder, mesh, energy, n_turns, beta=BETA, chunk=48, degrees=15.0):
    """Rows of a bar whose x = 0 end is turned in steps of `degrees`, each settled before the next; a row each `chunk` steps."""
    rest = np.array(read_mesh(mesh)[0])
    keys = problem_keys(mesh, energy, beta, rest)
    held, center = ends(rest), 0.5 * (rest[:, 1:].min(0) + rest[:, 1:].max(0))
    turned = rest[held][:, 0] == 0
    x, work, n_steps = rest, np.zeros(3), round(360 * n_turns / degrees)
    for begin in range(0, n_steps, chunk):
        stations = []
        for step in range(begin + 1, min(begin + chunk, n_steps) + 1):
            angle = np.where(turned, np.radians(degrees * step), 0.0)
            stations.append(rotated(rest[held], angle, center).tolist())
        write_positions(folder / "start.txt", x)
        problem = folder / "twist.json"
        problem.write_text(json.dumps(keys | {"initial": "start.txt", "sequence": stations, "targets": stations[-1]}))
        report, positions, seconds = solve(program, problem, folder)
        x = np.array(read_positions(positions))
        work += report["iterations"], report["factorizations"], seconds
        applied = min(begin + chunk, n_steps) * degrees / 360
        yield row(mesh.stem, keys, rest, applied, report, positions, (int(work[0]), int(work[1]), work[2]))


def end_ball(rest, axes, length, factor, degrees):
    """A handle that holds the far end of a bar (the near one if `factor` is none): a ball so large that it cuts straight."""
    low, high = rest.min(0), rest.max(0)
    radius, depth = 100 * length, 0.01 * length
    center = 0.5 * (low + high)
    center[0] = high[0] + radius - depth if factor else low[0] - radius + depth
    to = center + [length * ((factor or 1) - 1), 0, 0]
    # From along, across, across back to the axes of the file.
    given = lambda place: [place[axes.index(k)] for k in range(3)]
    handle = {"center": given(center), "radius": radius, "to": given(to)}
    return handle | ({"turn": degrees, "axis": given([1, 0, 0])} if degrees else {})


def stretched(program, folder, mesh, energy, n_turns, factor):
    """The row of a bar whose far end is turned about the bar and pulled away from the near one."""
    places, elements = read_mesh(mesh)
    places = np.array(places)
    along = int(np.ptp(places, axis=0).argmax())
    axes = [(along + k) % 3 for k in range(3)]
    rest = places[:, axes]
    length = np.ptp(rest[:, 0])
    handles, written, report = folder / "handles.json", folder / "stretched.txt", folder / "stretched.json"
    ends = [end_ball(rest, axes, length, None, 0), end_ball(rest, axes, length, factor, 360 * n_turns)]
    handles.write_text(json.dumps({"handles": ends}))
    seconds = run([program, "deform", mesh, "--handles", handles, "-o", written, "--report", report, "--energy", energy])
    said = json.loads(report.read_text())
    slabs = np.minimum((SLABS * (rest[:, 0] - rest[:, 0].min()) / length).astype(int), SLABS - 1)
    layers = [np.flatnonzero(slabs == slab) for slab in range(SLABS)]
    is_grid = np.allclose(rest[:, 0], rest[:, 0].round())
    counted = turns(rest, np.array(read_positions(written))[:, axes], None if is_grid else layers)[0]
    left = said["turns"][0]["left"]
    if abs(left - counted) > AGREES * n_turns:
        raise RuntimeError(f"{mesh.name}: the report has {left} turns, the positions {counted}")
    warned = ", ".join(warning["code"] for warning in said["warnings"]) or "–"
    return (mesh.stem, len(elements), energy, f"{factor:.2f}", n_turns, f"{counted:.3f}", f"{left:.3f}", said["status"],
            said["iterations"], said["factorizations"], f"{seconds:.1f}", f"{said['smallest']:.4f}", said["inverted"], warned)


def stretched_rows(arguments, folder):
    for name, energy, factor in arguments.stretched:
        yield stretched(arguments.unwrapd, folder, (arguments.reference / name).resolve(), energy, 7, factor)


def reference_rows(arguments, cases, folder):
    """The reference problems of twisted bars, each in one run."""
    for case in cases:
        if case["compare"] != "turns" or case["barrier"] == "none":
            continue
        problem = arguments.reference / case["problem"]
        keys = json.loads(problem.read_text())
        rest = np.array(read_mesh(problem.parent / keys["mesh"])[0])
        report, positions, seconds = solve(arguments.unwrapd, problem, folder)
        applied = 7 if "twist7" in case["name"] else 3
        authors = f"{abs(case.get('turns', float('nan'))):.0f} · {case['iterations']} · {case['cpu_loop_s']:.1f}"
        yield row(case["name"], keys, rest, applied, report, positions, (report["iterations"], report["factorizations"], seconds), authors)


def rows(arguments, cases, folder):
    yield from reference_rows(arguments, cases, folder)
    for name, energy, first in arguments.screws:
        if isinstance(name, int):
            mesh = bar(folder / f"bar_{name}x3x3.tet", name, 3)
        else:
            mesh = (arguments.reference / "meshes" / f"{name}.tet").resolve()
        yield limit(arguments.unwrapd, folder, mesh, energy, BETA, first)
    for length, width, n_turns, energy in arguments.long_bars:
        mesh = bar(folder / f"bar_{length}x{width}x{width}.tet", length, width)
        yield from twisted(arguments.unwrapd, folder, mesh, energy, n_turns)


def main(arguments, cases, folder):
    """Prints the table of reference problems, limits and long bars."""
    table("Bars turned seven times by `deform` while they are stretched", STRETCHED_HEADER, stretched_rows(arguments, folder))
    table(f"Figure 20: bars twisted (the paper: {FIGURES['20']})", HEADER, rows(arguments, cases, folder))
