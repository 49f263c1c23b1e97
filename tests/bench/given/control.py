"""One scene for each rule for islands, judged from the UVs before and after."""
import numpy as np

from files import Gltf, Mesh, write_glb
from judge import Islands, areas, areas_3d, fit
from scenes import kit, squares

SIDE = 1024
STEP = 2.0**-23
# Half of the padding of 2 texels, less a step of the grid.
MARGIN = 1 / SIDE - STEP
TRIM = (0.25, 0.5, 1.0, 1.0)
EXACT = 1e-3


class Scene:
    """Islands in a GLB, each a grid of quads, in one primitive per material."""

    def __init__(self, path):
        self.path, self.squares = path, squares(np.random.default_rng(6))
        primitives = {}
        for k, square in enumerate(self.squares):
            n = 3
            at = np.array([(i / n, j / n) for i in range(n + 1) for j in range(n + 1)])
            uv = square["low"] + at * square["size"]
            space = np.column_stack([at * square["size"] * 10 / square["density"], 0.2 * np.sin(3 * at[:, 0])]) + square["at"]
            quads = [(i * (n + 1) + j, (i + 1) * (n + 1) + j, (i + 1) * (n + 1) + j + 1, i * (n + 1) + j + 1)
                     for i in range(n) for j in range(n)]
            # v points down, so faces seen from the front are clockwise in these numbers.
            faces = [t for a, b, c, d in quads for t in ((a, c, b), (a, d, c))]
            own = primitives.setdefault(square["material"], {"positions": [], "uv": [], "colors": [], "faces": [], "owner": []})
            first = len(own["positions"])
            own["faces"] += [[v + first for v in face] for face in faces]
            own["owner"] += [k] * len(faces)
            for name, values in (("positions", space), ("uv", uv), ("colors", [square["color"]] * len(at))):
                own[name] += np.asarray(values).tolist()
        self.materials = list(primitives)
        self.owner = np.concatenate([primitives[name]["owner"] for name in self.materials])
        self.first_face = {}
        for number, name in enumerate(self.materials):
            for face, k in enumerate(primitives[name]["owner"]):
                self.first_face.setdefault(k, (number, face))
        write_glb(path, [{**primitives[name], "material": name} for name in self.materials])
        self.before = read(path)

    def of(self, **wanted):
        """Numbers of the islands with these attributes."""
        return [k for k, square in enumerate(self.squares) if all(square[key] == value for key, value in wanted.items())]


def read(path):
    """All faces of a GLB: where they are in space, and their UVs."""
    gltf = Gltf(path)
    positions, faces, uv = [], [], []
    for _, primitive, points, triangles in gltf.primitives():
        texcoords = gltf.accessor(primitive["attributes"]["TEXCOORD_0"])
        faces.append(triangles + sum(map(len, positions)))
        positions.append(points)
        uv.append(texcoords[triangles])
    return Mesh(np.concatenate(positions), np.concatenate(faces), np.concatenate(uv))


class Result:
    def __init__(self, scene, program, command, rules, *options):
        out = scene.path.with_name("out.glb")
        given = [word for rule in rules for word in ("--control", rule)]
        self.scene, self.rules = scene, rules
        self.report, self.status = program.written(command, scene.path, out, "--group-by", "scene", "--stack", "off", *given, *options)
        if self.report is None:
            return
        after = read(out)
        key = lambda mesh: [tuple(map(tuple, corners)) for corners in mesh.positions[mesh.faces].tolist()]
        number = {corners: k for k, corners in enumerate(key(after))}
        order = [number[corners] for corners in key(scene.before)]
        self.mesh = Mesh(after.positions, after.faces[order], after.uv[order])
        self.islands = Islands(self.mesh)
        self.density = np.sqrt(SIDE**2 * self._sum(areas(self.mesh.uv)) / self._sum(areas_3d(self.mesh.positions, self.mesh.faces)))
        self.density_before = np.sqrt(SIDE**2 * self._sum(areas(scene.before.uv)) / self._sum(areas_3d(self.mesh.positions, self.mesh.faces)))

    def _sum(self, values):
        return np.bincount(self.scene.owner, values, len(self.scene.squares))

    def uv(self, k):
        return self.mesh.uv[self.scene.owner == k].reshape(-1, 2)

    def uv_before(self, k):
        return self.scene.before.uv[self.scene.owner == k].reshape(-1, 2)

    def is_same(self, k):
        return bool((self.uv(k).astype(np.float32) == self.uv_before(k).astype(np.float32)).all())

    def is_inside(self, k, low, high):
        uv = self.uv(k)
        return bool((uv >= np.add(low, MARGIN)).all() and (uv <= np.subtract(high, MARGIN)).all())

    def is_sound(self):
        """Whether nothing overlaps, everything is certified, and the report names the islands that change, no others."""
        return not self.islands.overlapping() and self.status == 0 and self._is_named()

    def _is_named(self):
        first = {}
        for face, k in enumerate(self.scene.owner):
            first.setdefault(int(k), face)
        for rule in self.report["groups"][0]["rules"]:
            if rule.get("changed") is None:
                continue
            said = {island["face"] for island in rule["changed"]}
            ratio = np.abs(self.density / self.density_before - 1)
            surely = {first[k] for k in selected(self.scene, rule["rule"]) if ratio[k] > 1.01 * EXACT}
            maybe = {first[k] for k in selected(self.scene, rule["rule"]) if ratio[k] > 0.99 * EXACT}
            if not surely <= said <= maybe:
                return False
        return True


def selected(scene, rule):
    selector = rule.rsplit(":", 1)[0]
    if selector == "all":
        return range(len(scene.squares))
    kind, value = selector.split("=", 1)
    if kind == "material":
        return scene.of(material=value)
    if kind == "color":
        return scene.of(color=tuple(int(value[i:i + 2], 16) / 255 for i in (0, 2, 4)))
    return [k for k, face in scene.first_face.items() if f"{face[0]}/{face[1]}" in value.split(",")]


def name(scene, islands):
    return "faces=" + ",".join("{}/{}".format(*scene.first_face[k]) for k in islands)


def near(found, wanted):
    """The largest relative difference."""
    return float(np.abs(np.asarray(found) / wanted - 1).max())


def locked(program, scene, command, options):
    listed = [1, 6, 11]
    for selector, islands in (("material=glass", scene.of(material="glass")), ("color=ff0000", scene.of(color=(1.0, 0.0, 0.0))),
                              (name(scene, listed), listed)):
        result = Result(scene, program, command, [f"{selector}: lock"], *options)
        same = [k for k in range(len(scene.squares)) if result.report and result.is_same(k)]
        yield f"lock {selector}", same == islands and result.is_sound(), f"bit-equal {len(same)} of {len(islands)}"


def grouped(program, scene, command, options):
    listed = [2, 5, 7]
    for selector, islands in (("material=wood", scene.of(material="wood")), ("color=0000ff", scene.of(color=(0.0, 0.0, 1.0))),
                              (name(scene, listed), listed)):
        result = Result(scene, program, command, [f"{selector}: group"], *options)
        if result.report is None:
            yield f"group {selector}", False, "refused"
            continue
        all_of = lambda uv: np.concatenate([uv(k) for k in islands])
        _, mirrored, left = fit(all_of(result.uv_before), all_of(result.uv))
        yield f"group {selector}", left <= STEP and not mirrored and result.is_sound(), f"off by {left / STEP:.2f} steps of the grid"


def confined(program, scene, command, options):
    # A rectangle of a glTF has v down.
    box = "trim=" + ",".join(map(str, TRIM))
    for selector, islands in (("material=glass", scene.of(material="glass")), ("color=00ff00", scene.of(color=(0.0, 1.0, 0.0)))):
        result = Result(scene, program, command, [f"{selector}: in trim"], *options, "--rectangle", box)
        inside = [k for k in islands if result.report and result.is_inside(k, TRIM[:2], TRIM[2:])]
        yield f"in rectangle {selector}", inside == islands and result.is_sound(), f"inside {len(inside)} of {len(islands)}"
        result = Result(scene, program, command, [f"{selector}: in 1002", "material=steel: in 1003"], *options, "--pages", 3)
        on = lambda k, page: result.report and result.is_inside(k, (page, 0), (page + 1, 1))
        # A later rule replaces an earlier one.
        second = [k for k in islands if scene.squares[k]["material"] != "steel"]
        wanted = [(k, 1) for k in second] + [(k, 2) for k in scene.of(material="steel")]
        good = sum(bool(on(*each)) for each in wanted)
        yield f"in tile {selector}", good == len(wanted) and result.is_sound(), f"on their tiles {good} of {len(wanted)}"


def dense(program, scene, command, options):
    keeps = "keep" in options or command == "repack"
    glass, red = scene.of(material="glass"), scene.of(color=(1.0, 0.0, 0.0))
    for selector, islands in (("material=glass", glass), ("color=ff0000", red)):
        result = Result(scene, program, command, [f"{selector}: density 60"], *options)
        off = near(result.density[islands], 60) if result.report else np.inf
        yield f"density 60 {selector}", off < EXACT and result.is_sound(), f"off by {100 * off:.4f} %"
    result = Result(scene, program, command, ["all: density 40", "material=glass: density 70"], *options)
    wanted = np.where(np.isin(range(len(scene.squares)), glass), 70, 40)
    off = near(result.density, wanted) if result.report else np.inf
    yield "density of all, then of glass", off < EXACT and result.is_sound(), f"off by {100 * off:.4f} %"
    result = Result(scene, program, command, ["material=glass: scale 1.5"], *options)
    plain = Result(scene, program, command, ["material=glass: scale 1"], *options)
    if result.report and plain.report:
        # Beside the others, which have one factor.
        ratio = result.density / plain.density
        ratio /= np.median(np.delete(ratio, glass))
        off = near(ratio, np.where(np.isin(range(len(ratio)), glass), 1.5, 1))
    else:
        off = np.inf
    yield "scale 1.5 material=glass", off < EXACT and result.is_sound(), f"off by {100 * off:.4f} %"
    if not keeps:
        return
    result = Result(scene, program, command, ["material=glass: density keep"], *options)
    off = near(result.density[glass], result.density_before[glass]) if result.report else np.inf
    yield "density keep material=glass", off < EXACT and result.is_sound(), f"off by {100 * off:.4f} %"
    result = Result(scene, program, command, ["material=glass: density equal"], *options)
    off = np.ptp(result.density[glass]) / result.density[glass].mean() if result.report else np.inf
    yield "density equal material=glass", off < EXACT and result.is_sound(), f"apart by {100 * off:.4f} %"


def mapped_anew(program, folder):
    """The rules that make sense for new charts, on curved props of several materials."""
    path, out = folder / "kit.glb", folder / "out.glb"
    parts, _ = kit(np.random.default_rng(8))
    names = ["wood", "glass", "steel"]
    primitives = []
    for k, material in enumerate(names):
        own = [part.triangulated() for part in parts[k::3]]
        first = np.cumsum([0] + [len(part.positions) for part in own])
        primitives.append({"positions": np.concatenate([part.positions for part in own]), "material": material,
                           "faces": np.concatenate([np.array(part.polygons) + n for part, n in zip(own, first)])})
    write_glb(path, primitives)
    box = ["--rectangle", "trim=" + ",".join(map(str, TRIM))]
    scenes = [
        ("in rectangle", ["material=glass: in trim"], box, lambda by: inside(by["glass"], TRIM[:2], TRIM[2:])),
        ("in tile", ["material=glass: in 1002"], ["--pages", 2], lambda by: inside(by["glass"], (1, 0), (2, 1))),
        ("density 20", ["material=glass: density 20"], [], lambda by: near(by["glass"][2], 20)),
        ("density of two", ["material=glass: density 20", "material=steel: density 10"], [],
         lambda by: max(near(by["glass"][2], 20), near(by["steel"][2], 10))),
        ("scale 2", ["material=glass: scale 2"], [], lambda by: near(by["glass"][2] / by["wood"][2], 2)),
        ("rectangle and density", ["material=glass: in trim", "material=glass: density 15"], box,
         lambda by: max(near(by["glass"][2], 15), inside(by["glass"], TRIM[:2], TRIM[2:]))),
    ]
    for title, rules, options, off_by in scenes:
        given = [word for rule in rules for word in ("--control", rule)]
        report, status = program.written("unwrap", path, out, "--group-by", "scene", *given, *options)
        if report is None:
            yield title, False, "refused"
            continue
        gltf, by = Gltf(out), {}
        for _, primitive, points, triangles in gltf.primitives():
            uv = gltf.accessor(primitive["attributes"]["TEXCOORD_0"])[triangles]
            density = SIDE * np.sqrt(areas(uv).sum() / areas_3d(points, triangles).sum())
            by[gltf.json["materials"][primitive["material"]]["name"]] = uv, points, density
        off = off_by(by)
        overlapping = Islands(read(out)).overlapping()
        yield title, off < EXACT and status == 0 and not overlapping, f"off by {100 * off:.4f} %"


def inside(part, low, high):
    """0 if UVs keep half of the padding to the sides of a rectangle, otherwise how far they do not."""
    uv = part[0]
    return max(0.0, float((np.add(low, MARGIN) - uv).max()), float((uv - np.subtract(high, MARGIN)).max()))


def run(program, _before, _files, folder):
    faults = 0
    scene = Scene(folder / "squares.glb")
    commands = [("repack", "repack", []), ("unwrap, kept as given", "unwrap", ["--cut", "keep", "--kept-maps", "as-given"]),
                ("unwrap, kept", "unwrap", ["--cut", "keep"])]
    print("command | scene | as it should be | measured")
    for title, command, options in commands:
        tests = [confined, dense] if title == "unwrap, kept" else [locked, grouped, confined, dense]
        for test in tests:
            for what, is_good, measured in test(program, scene, command, options):
                faults += not is_good
                print(f"{title} | {what} | {'yes' if is_good else 'NO'} | {measured}", flush=True)
    for what, is_good, measured in mapped_anew(program, folder):
        faults += not is_good
        print(f"unwrap | {what} | {'yes' if is_good else 'NO'} | {measured}", flush=True)
    return faults
