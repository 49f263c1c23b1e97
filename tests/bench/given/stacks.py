"""Parts that repeat: how many places they take, what coincides, what is gained, and what is refused."""
from collections import Counter

import numpy as np

from files import Mesh, obj_mesh, read_obj, write_obj
from judge import Islands, areas
from scenes import MODELS, near_misses

SIDE = 1024
STEP = 2.0**-23


def write_parts(path, parts):
    """Writes parts as one OBJ. Returns for each part its range of polygons."""
    positions, polygons, materials, ranges = [], [], [], []
    for part in parts:
        first = len(positions)
        begin = len(polygons)
        positions += part.positions.tolist()
        polygons += [[int(v) + first for v in polygon] for polygon in part.polygons]
        materials += [part.material or "all"] * len(part.polygons)
        ranges.append((begin, len(polygons)))
    write_obj(path, positions, polygons, materials=materials)
    return ranges


def doubled(uv):
    """The doubled area of a polygon (n, 2), positive if it is counterclockwise."""
    x, y = (uv - uv[0]).T
    return (x * np.roll(y, -1) - y * np.roll(x, -1)).sum()


def outline(polygons):
    """Directed edges around polygons of UVs, each counterclockwise; edges that run both ways cancel."""
    edges = Counter()
    for uv in polygons:
        corners = [tuple(p) for p in (uv if doubled(uv) > 0 else uv[::-1]).tolist()]
        for edge in zip(corners, corners[1:] + corners[:1]):
            if edges[edge[::-1]] > 0:
                edges[edge[::-1]] -= 1
            else:
                edges[edge] += 1
    return frozenset((edge, n) for edge, n in edges.items() if n)


def places(path, ranges):
    """The number of parts that do not coincide with an earlier one."""
    obj = read_obj(path)
    uvs = [obj.uvs[texcoords] for texcoords in obj.texcoords]
    return len({outline(uvs[begin:end]) for begin, end in ranges})


def recomputed(path):
    """Stacks, islands in them, texels that they gain, and islands that overlap others than those of their stack."""
    mesh = obj_mesh(path)
    islands = Islands(mesh)
    stacks = islands.stacks()
    area = np.zeros(len(islands))
    np.add.at(area, islands.of_face, areas(mesh.uv))
    gained = sum(area[stack[0]] * (len(stack) - 1) for stack in stacks) * SIDE**2
    overlapping = islands.overlapping(without=[k for stack in stacks for k in stack[1:]])
    return len(stacks), sum(map(len, stacks)), gained, len(overlapping)


def shown(program, name, parts, wanted, stacking, folder, *options):
    """One line of the table. Returns the number of faults."""
    given, out = folder / "parts.obj", folder / "stacked.obj"
    ranges = write_parts(given, parts)
    report, status = program.written("unwrap", given, out, "--stack", stacking, "--resolution", SIDE, *options)
    if report is None:
        print(f"{name} | {stacking} | refused")
        return 1
    said = report["groups"][0].get("stacks") or {"stacks": 0, "charts": 0, "texels_gained": 0}
    plain, _ = program.written("unwrap", given, folder / "plain.obj", "--resolution", SIDE, *options)
    density = report["groups"][0]["texels_per_unit"] / plain["groups"][0]["texels_per_unit"]
    n_stacks, n_islands, gained, overlapping = recomputed(out)
    accepted, refused = (program.verified(out, option)[1] for option in ("--stacks", "--bijective"))
    found = places(out, ranges)
    is_same = (said["stacks"], said["charts"]) == (n_stacks, n_islands) and abs(said["texels_gained"] - gained) <= 1e-3 * gained + 1
    faults = [wanted is not None and found != wanted, not is_same, overlapping > 0, accepted != 0,
              refused != (4 if n_stacks else 0), status != 0]
    print(f"{name} | {stacking} | {len(parts)} | {found} | {'-' if wanted is None else wanted} | {n_islands} in {n_stacks} | "
          f"{gained:.0f} | {said['texels_gained']:.0f} | {density:.2f} | {overlapping} | {accepted} | {refused} | "
          f"{report['seconds']['unwrap']:.2f}", flush=True)
    return sum(faults)


# Overlaps that nobody wants, planted in a file with stacks.


def planted(islands, uv, stacks, lone, number):
    """UVs with one unwanted overlap, and its name."""
    uv = uv.copy()
    stack = stacks[number // 5 % len(stacks)]
    # The largest islands take the overlaps, so that they have room for them.
    faces = islands.of_face == stack[-1]
    points = uv[faces]
    middle = points.reshape(-1, 2).mean(0)
    kind = number % 5
    if kind == 0:
        uv[faces] += (STEP, 0)
        return uv, "one of a stack moved by a step of the grid"
    if kind == 1:
        uv[faces] = middle + 0.999 * (points - middle)
        return uv, "one of a stack smaller by 0.1 %"
    if kind == 2:
        other = stacks[(number // 5 + 1) % len(stacks)]
        all_of_other = np.isin(islands.of_face, other)
        uv[all_of_other] += middle - uv[all_of_other].reshape(-1, 2).mean(0)
        return uv, "a whole stack moved onto another one"
    if kind == 3:
        border = np.array([corner for edge, _ in islands.outlines()[stack[-1]] for corner in edge[:1]])
        corner = border[number % len(border)]
        at = (points == corner).all(2)
        points[at] += STEP * np.sign(middle - corner)
        uv[faces] = points
        return uv, "one vertex on the border of one of a stack moved by a step"
    own = islands.of_face == lone
    uv[own] += middle - uv[own].reshape(-1, 2).mean(0)
    return uv, "an island that is in no stack moved onto one"


def plants(program, folder):
    """Returns the number of overlaps that are not rejected."""
    parts, _ = MODELS["kit of 40 props"](np.random.default_rng(5))
    # A part that is there once.
    parts.append(parts[0].moved(np.diag([3.0, 1.0, 1.7]), (0, 40, 0)))
    given, out, changed = folder / "kit.obj", folder / "kit-stacked.obj", folder / "planted.obj"
    write_parts(given, [part.triangulated() for part in parts])
    program.written("unwrap", given, out, "--stack", "identical")
    mesh = obj_mesh(out)
    islands = Islands(mesh)
    area = np.bincount(islands.of_face, areas(mesh.uv), len(islands))
    stacks = sorted(islands.stacks(), key=lambda stack: -area[stack[0]])[:6]
    stacked = {k for stack in islands.stacks() for k in stack}
    lone = max((k for k in range(len(islands)) if k not in stacked), key=lambda k: area[k])
    write = lambda uv: write_obj(changed, mesh.positions, mesh.faces.tolist(), uv)
    write(mesh.uv)
    faults = program.verified(changed, "--stacks")[1] != 0
    missed = 0
    for number in range(20):
        uv, name = planted(islands, mesh.uv, stacks, lone, number)
        write(uv)
        again = Islands(Mesh(mesh.positions, mesh.faces, uv))
        n_overlapping = len(again.overlapping(without=[k for stack in again.stacks() for k in stack[1:]]))
        judgment, status = program.verified(changed, "--stacks")
        is_rejected = status == 4 and "triangles overlapping" in judgment["lacking"]
        missed += not is_rejected
        print(f"  {name}: {n_overlapping} islands overlap; exit {status}, {judgment['lacking']}")
        faults += not is_rejected or n_overlapping == 0
    print(f"overlaps rejected: {20 - missed} of 20")
    return faults


def run(program, _before, files, folder):
    faults = 0
    print("model | stack | parts | places | expected | islands stacked | texels gained | said | density over off | overlapping | "
          "verify --stacks | --bijective | s")
    for name, model in MODELS.items():
        for stacking in ("identical", "mirrored"):
            parts, wanted = model(np.random.default_rng(3))
            faults += shown(program, name, parts, wanted, stacking, folder)
            if wanted is None:
                faults += shown(program, f"{name}, --cut fast", parts, wanted, stacking, folder, "--cut", "fast")
    parts, identical, mirrored = near_misses(np.random.default_rng(4))
    for stacking, wanted in (("identical", identical), ("mirrored", mirrored)):
        faults += shown(program, "near misses", parts, wanted, stacking, folder)
    for path in files:
        for stacking in ("identical", "mirrored"):
            obj = read_obj(path)
            whole = type("Whole", (), {"positions": obj.positions, "polygons": obj.corners, "material": ""})
            faults += shown(program, path.stem, [whole], None, stacking, folder)
            faults += shown(program, f"{path.stem}, --cut fast", [whole], None, stacking, folder, "--cut", "fast")
    return faults + plants(program, folder)
