"""One example for each command that computes: its input, its command line, and a picture of its result.

    python tests/examples/commands --unwrapd BIN [--out DIR] [--picture P.png] [COMMAND...]

runs them, each in a folder DIR/COMMAND, and fails where a command does not end as it should. `--picture` draws the results, one
row each. Needs numpy and pillow.
"""
import argparse
import json
import sys
import tempfile
from pathlib import Path

import numpy as np
from PIL import Image

TESTS = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(TESTS / "figures"))
from charts import SIDE, png, scene  # noqa: E402
from paint import BLUE, column, common_box, planar, row  # noqa: E402
from shapes import rectangle  # noqa: E402
from work import Work, positions, read_obj  # noqa: E402

ASSETS = TESTS / "assets"


def handles(work, list_name="handles", *those):
    return work.named(f"{list_name}.json", json.dumps({list_name: those}))


def shown(path, width=260):
    """A picture file, shrunk."""
    picture = Image.open(path).convert("RGBA")
    on_white = Image.new("RGBA", picture.size, "white")
    on_white.alpha_composite(picture)
    return on_white.convert("RGB").resize((width, round(width * picture.height / picture.width)))


def map_of(work, file, dots=()):
    """The UVs of an OBJ, red where angles are distorted."""
    x, triangles, uv = read_obj(work.folder / file)
    flat = np.arange(3 * len(triangles)).reshape(-1, 3)
    a, b, c = (x[triangles[:, k]] for k in range(3))
    long = np.linalg.norm(b - a, axis=1)
    along = np.einsum("nd,nd->n", b - a, c - a) / long
    up = np.sqrt(np.maximum(((c - a) ** 2).sum(1) - along ** 2, 1e-30))
    rest = np.stack([np.stack([0 * long, 0 * long], 1), np.stack([long, 0 * long], 1), np.stack([along, up], 1)], 1).reshape(-1, 2)
    return planar(("", rest, flat), uv.reshape(-1, 2), [], ((0, 0), (1, 1)), width=240, outline=False, dots=[(d, 4, BLUE) for d in dots])


def spot(work):
    """The cow, unwrapped."""
    work.run("unwrap", ASSETS / "spot.ply", "-o", "spot.obj", "--layout", "layout.png", "--resolution", 512)


def unwrap(work):
    spot(work)
    return [("spot.ply, unwrapped: its layout", lambda: shown(work.folder / "layout.png"))]


def repack(work):
    spot(work)
    work.run("repack", "spot.obj", "-o", "packed.obj", "--padding", 16, "--rotate", "none")
    return [("as it was", lambda: map_of(work, "spot.obj")), ("with more padding", lambda: map_of(work, "packed.obj"))]


def measure(work):
    spot(work)
    work.run("measure", "spot.obj", flags=())
    return [("measured: its angles", lambda: map_of(work, "spot.obj"))]


def verify(work):
    spot(work)
    work.run("verify", "spot.obj", flags=())
    # A face that is turned over is found.
    text = (work.folder / "spot.obj").read_text().splitlines()
    first = next(k for k, line in enumerate(text) if line.startswith("vt "))
    text[first] = "vt 0.9 0.9"
    work.named("torn.obj", "\n".join(text) + "\n")
    work.run("verify", "torn.obj", statuses=(4,), flags=())
    return [("proven", lambda: map_of(work, "spot.obj")), ("refused: a corner astray", lambda: map_of(work, "torn.obj"))]


def batch(work):
    folder = work.folder / "meshes"
    folder.mkdir(exist_ok=True)
    for name in ("spot.ply", "cat_head.obj"):
        (folder / name).write_bytes((ASSETS / name).read_bytes())
    work.run("batch", "meshes", "-o", "atlases", "--layout", flags=())
    pictures = sorted((work.folder / "atlases").rglob("*layout*.png"))
    return [(path.name, lambda path=path: shown(path, 240)) for path in pictures]


def cloth(columns=40, rows=24):
    """A sheet of the plane."""
    return rectangle("cloth", columns, rows, 4.0)


def deform(work):
    mesh = cloth()
    file = work.mesh(*mesh)
    those = handles(work, "handles", {"low": [0, 0], "high": [.1, 2.4], "to": [.05, 1.2]},
                    {"line": [[2, 0], [2, 2.4]], "to": [[2, .4], [2.6, 1.2], [2, 2]]},
                    {"center": [3.6, 1.2], "radius": .3, "to": [4.2, 1.2], "turn": 60},
                    {"at": [1.03, 2.3], "to": [1.0, 3.2], "weight": 5})
    work.run("deform", file, "--handles", those, "-o", "out.txt")
    return [("a box held, a line bent, a disc turned, a point softly pulled",
             lambda: planar(mesh, positions(work.folder / "out.txt")[:, :2], width=380))]


def solve(work):
    mesh = cloth()
    file = work.mesh(*mesh)
    x = mesh[1]
    left, right = np.flatnonzero(x[:, 0] == 0), np.flatnonzero(x[:, 0] == 4)
    problem = {"mesh": file, "energy": "symmetric-dirichlet", "barrier": "none", "handles": [*left.tolist(), *right.tolist()],
               "targets": [*x[left].tolist(), *(x[right] * [1, -1] + [.6, 2.4]).tolist()]}
    work.run("solve", work.named("problem.json", json.dumps(problem)), "-o", "out.txt")
    return [("one end turned over", lambda: planar(mesh, positions(work.folder / "out.txt")[:, :2], width=380))]


def untangle(work):
    _, x, triangles = mesh = cloth(16, 10)
    folded = x.copy()
    inner = (x > .3).all(1) & (x[:, 0] < 3.7) & (x[:, 1] < 2.2)
    folded[inner] += np.random.default_rng(1).normal(0, .22, (int(inner.sum()), 2))
    work.run("untangle", work.mesh("folded", folded, triangles), "-o", "out.txt")
    box = common_box(x)
    return [("folded", lambda: planar(mesh, folded, (), box, width=300)),
            ("untangled", lambda: planar(mesh, positions(work.folder / "out.txt")[:, :2], (), box, width=300))]


def warp(work):
    picture = work.named("picture.png", png(scene()))
    line = [[0, SIDE / 2], [SIDE, SIDE / 2]]
    bow = [[0, SIDE / 2], [SIDE / 4, .36 * SIDE], [SIDE / 2, SIDE / 2], [.75 * SIDE, .64 * SIDE], [SIDE, SIDE / 2]]
    those = handles(work, "handles", {"line": line, "to": bow}, {"outline": [[150, 30], [210, 30], [180, 80]], "to": [170, 50], "turn": 40},
                    {"at": [60, 190], "to": [40, 215], "weight": 1})
    work.run("warp", picture, "--handles", those, "-o", "out.png", "--fix-border")
    return [("a picture", lambda: shown(work.folder / picture)), ("a line bent, an outline turned, a point softly pulled",
                                                                    lambda: shown(work.folder / "out.png"))]


def edit_uv(work):
    work.run("unwrap", ASSETS / "cat_head.obj", "-o", "cat.obj", "--cut", "disk")
    at = read_obj(work.folder / "cat.obj")[2].reshape(-1, 2)
    middle = .5 * (at.min(0) + at.max(0))
    those = handles(work, "anchors", {"center": middle.tolist(), "radius": .1, "to": middle.tolist(), "turn": 90},
                    {"line": [[.3, .3], [.3, .7]], "to": [[.3, .3], [.22, .5], [.3, .7]], "weight": 100})
    work.run("edit-uv", "cat.obj", "--anchors", those, "-o", "out.obj")
    return [("the map of cat_head.obj", lambda: map_of(work, "cat.obj")), ("a disc turned, a line softly bent", lambda: map_of(work, "out.obj"))]


def texture_map(work):
    work.run("unwrap", ASSETS / "cat_head.obj", "-o", "cat.obj", "--cut", "disk")
    to = [[.42, .55], [.6, .5]]
    those = handles(work, "points", {"at": [.4, .5], "to": to[0]}, {"at": [.6, .52], "to": to[1]})
    work.run("texture-map", "cat.obj", "--points", those, "-o", "out.obj")
    return [("the map of cat_head.obj", lambda: map_of(work, "cat.obj")), ("two points aligned, the border fixed", lambda: map_of(work, "out.obj", to))]


EXAMPLES = {"unwrap": unwrap, "repack": repack, "measure": measure, "verify": verify, "batch": batch, "deform": deform, "solve": solve,
            "untangle": untangle, "warp": warp, "edit-uv": edit_uv, "texture-map": texture_map}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--unwrapd", required=True, type=Path)
    parser.add_argument("--out", type=Path)
    parser.add_argument("--picture", type=Path)
    parser.add_argument("commands", nargs="*", metavar="COMMAND")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as temporary:
        rows = []
        for name in arguments.commands or EXAMPLES:
            work = Work(arguments.unwrapd, (arguments.out or Path(temporary)) / name)
            pictures = EXAMPLES[name](work)
            print(f"{name}: " + "; ".join(work.commands), flush=True)
            if arguments.picture:
                rows.append(row([(f"{name}: {title}" if k == 0 else title, draw()) for k, (title, draw) in enumerate(pictures)]))
        if arguments.picture:
            column(rows, 14).quantize(128).save(arguments.picture, optimize=True)


if __name__ == "__main__":
    main()
