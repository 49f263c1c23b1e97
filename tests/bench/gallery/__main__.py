#!/usr/bin/env python3
"""Draws atlases of `unwrapd unwrap`, uvunwrap, xatlas and Blender side by side, and the meshes with a checkerboard through them.

    python3 tests/bench/gallery --judge path/to/uvmetrics.py --unwrapd target/release/unwrapd --data DIR --out P.png [NAME...]

DIR holds the meshes of the table below, whose licenses allow the pictures to be passed on. JUDGE and the interpreter are those of
`tests/bench/atlas.py`, and scipy and pillow from PyPI. Charts have the same colors in the square and on the mesh, where
thin lines are seams; the squares of the checkerboard are as large on a mesh with each tool. Underneath, by the judge: charts,
seam length over the square root of the area, mean symmetric Dirichlet energy, share of the square. unwrapd and uvunwrap keep 2
texels at 1024 between charts, xatlas by default 1.
"""
import argparse
import sys
import tempfile
from pathlib import Path
from types import SimpleNamespace

from PIL import Image, ImageDraw, ImageFont

sys.path[:0] = [str(Path(__file__).parent), str(Path(__file__).parents[1])]
import atlas  # noqa: E402
from atlases import Atlas  # noqa: E402
from drawing import layout, surface  # noqa: E402

# File, view (azimuth, elevation, axis that points up), and who made it under which license.
MESHES = {
    "Spot": ("closed/spot.ply", (150, 12, "y"), "Keenan Crane, CC0"),
    "Human": ("closed/human_neutral.obj", (20, 5, "y"), "Max Planck Society via SMPL-X, CC BY 4.0"),
    "Koala": ("closed/koala.obj", (40, 12, "y"), "YahooJAPAN, CC BY 3.0"),
    "Beetle": ("closed/beetle.obj", (40, 20, "y"), "Geometry Collective, MIT"),
    "Boot": ("closed/boot.obj", (60, 15, "y"), "inciprocal, CC BY 4.0"),
    "Plane": ("closed/plane_holes.obj", (40, 30, "z"), "YahooJAPAN, CC BY 3.0"),
    "Fox": ("gltf/Fox.glb", (60, 10, "y"), "PixelMannen, CC0"),
    "Cube": ("hard/cube.obj", (30, 25, "y"), "CC0"),
    "Cylinder": ("hard/cylinder.obj", (30, 25, "z"), "CC0"),
    "Bracket": ("hard/bracket.obj", (40, 25, "z"), "CC0"),
    "Nut": ("hard/nut.obj", (20, 35, "z"), "CC0"),
    "Gear": ("hard/gear.obj", (20, 40, "z"), "CC0"),
    "Mug": ("hard/mug.obj", (60, 20, "z"), "CC0"),
    "Hand": ("disk/hand_lowres.obj", (20, 10, "y"), "Max Planck Society via SMPL, CC BY 4.0"),
}
TOOLS = {"unwrapd": "unwrapd", "uvunwrap, gap 2": "uvunwrap", "xatlas": "xatlas", "Blender": "Blender, Smart UV Project"}
SIDE, MARGIN, LINE, CHECKS, COLORS = 252, 16, 32, 24, 96
FONTS = Path("/usr/share/fonts/truetype/dejavu")


def font(size, bold=False):
    return ImageFont.truetype(str(FONTS / ("DejaVuSans-Bold.ttf" if bold else "DejaVuSans.ttf")), size)


def atlases_of(arguments, path, folder):
    """Per tool the judge's figures and the atlas."""
    figures = atlas.ours(arguments, path, folder)
    positions, faces, uv = atlas.read_obj(folder / "ours.obj")
    yield "unwrapd", figures, Atlas(positions, faces, uv)
    for tool in arguments.tools[1:]:
        figures = atlas.theirs(arguments, tool, positions, faces, folder)
        yield TOOLS[tool], figures, Atlas(*atlas.read_obj(folder / "theirs.obj"))


def cell(figures, charts, view, in_seconds):
    """The mesh, beside it the square, and the figures under both, the last of which is the covered share or the CPU seconds."""
    picture = Image.new("RGB", (2 * SIDE + MARGIN, SIDE + LINE), "white")
    picture.paste(surface(charts, SIDE, CHECKS, view), (0, 0))
    picture.paste(layout(charts, SIDE, CHECKS), (SIDE + MARGIN, 0))
    pen = ImageDraw.Draw(picture)
    plural = "" if figures["charts"] == 1 else "s"
    text = (f"{figures['charts']} chart{plural} · seam {figures['seam']:.1f} · E {figures['E']:.2f} · "
            + (f"{figures['cpu']:.1f} s" if in_seconds else f"fill {100 * figures['fill']:.0f} %"))
    pen.text((picture.width / 2, SIDE + LINE / 2 + 3), text, "#333", font(21), "mm")
    return picture


def row(arguments, name, folder):
    """What stands above it, and the cells of all tools."""
    file, view, credit = MESHES[name]
    cells = []
    for tool, figures, charts in atlases_of(arguments, arguments.data / file, folder):
        print(f"{name:8} | {tool:8} | {figures['charts']:4} | {figures['seam']:5.2f} | {figures['E']:.3f} | {figures['fill']:.3f}",
              flush=True)
        cells.append(cell(figures, charts, view, arguments.seconds))
    return f"{name}, {len(charts.faces):,} faces · {credit}", cells


def sheet(rows, tools):
    """All cells under the names of the tools."""
    wide, high = rows[0][1][0].size
    step, pitch = wide + 2 * MARGIN, high + LINE + MARGIN
    picture = Image.new("RGB", (len(tools) * step, len(rows) * pitch + 2 * LINE), "white")
    pen = ImageDraw.Draw(picture)
    for k, tool in enumerate(TOOLS[name] for name in tools):
        pen.text((k * step + step / 2, LINE), tool, "black", font(26, k == 0), "mm")
    for j, (title, cells) in enumerate(rows):
        top = 3 * LINE + j * pitch
        pen.text((MARGIN, top - 6), title, "#777", font(17), "ls")
        for k, picture_of_cell in enumerate(cells):
            picture.paste(picture_of_cell, (k * step + MARGIN, top))
    return picture


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", default=list(MESHES), metavar="NAME")
    parser.add_argument("--judge", required=True, type=Path)
    parser.add_argument("--unwrapd", default="target/release/unwrapd")
    parser.add_argument("--data", required=True, type=Path)
    parser.add_argument("--out", required=True, type=Path)
    parser.add_argument("--tools", nargs="+", choices=TOOLS, default=list(TOOLS)[:3], help="unwrapd first")
    parser.add_argument("--seconds", action="store_true", help="show the CPU seconds in place of the covered share")
    arguments = SimpleNamespace(**vars(parser.parse_args()), options=[])
    print("mesh | tool | charts | seam | E | fill")
    with tempfile.TemporaryDirectory() as folder:
        rows = [row(arguments, name, Path(folder)) for name in arguments.names]
    sheet(rows, arguments.tools).quantize(COLORS, Image.Quantize.MEDIANCUT, kmeans=5, dither=Image.Dither.NONE).save(arguments.out, optimize=True)


if __name__ == "__main__":
    main()
