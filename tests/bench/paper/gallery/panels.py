"""What a panel of a figure can show. Each function returns a function that draws on an axis from the files of a folder and
returns a remark for the title."""
import csv
import json

import matplotlib.image
import numpy as np
from matplotlib.collections import LineCollection, PolyCollection

import meshes
import raster

FILL, EDGE, INVERTED = "#f3dfb9", "#6b5a3a", "#d62728"


def planar(name, rest=None, handles=None, conformal=False, box=None):
    """A planar mesh; inverted triangles red. With `rest`, its file, `conformal` colors by σ₁/σ₂ up to 5; `handles` are places
    to mark; `box` the part of the plane to show."""
    def draw(axis, folder):
        mesh = meshes.read(folder / name)
        corners = mesh.positions[:, :2][mesh.triangles]
        areas = mesh.areas()
        colors = np.where((areas > 0)[:, None], *(np.array(matplotlib.colors.to_rgb(c)) for c in (FILL, INVERTED)))
        remark = f"{(areas <= 0).sum()} inverted"
        if conformal:
            before = meshes.read(folder / rest).positions[:, :2][mesh.triangles]
            s = meshes.singular_values(before, corners)
            ratio = s[:, 0] / np.abs(s[:, 1])
            colors = matplotlib.colormaps["viridis"](np.clip((ratio - 1) / 4, 0, 1))
            remark += f", σ₁/σ₂ max {ratio.max():.3g}, mean {ratio.mean():.3g}"
        width = min(0.5, 30 / np.sqrt(len(areas)) * 0.4)
        axis.add_collection(PolyCollection(corners, facecolors=colors, edgecolors=EDGE, linewidths=width))
        bad = corners[areas <= 0]
        axis.add_collection(PolyCollection(bad, facecolors=INVERTED, edgecolors=INVERTED, linewidths=0.8))
        if handles is not None:
            axis.plot(*np.array(handles).T, "o", color="#1f77b4", markersize=4)
        fit(axis, corners.reshape(-1, 2) if box is None else np.array(box))
        return remark
    return draw


def fit(axis, points):
    low, high = points.min(0), points.max(0)
    margin = 0.04 * (high - low).max()
    axis.set_xlim(low[0] - margin, high[0] + margin)
    axis.set_ylim(low[1] - margin, high[1] + margin)
    axis.set_aspect("equal")
    axis.axis("off")


def surface(name, view=(30, 15), frame=(), texture=None, color=raster.CLAY, wire=0.25):
    """A surface in space, at the scale at which those of `frame` fit too. `texture` is a number of checks or the name of a picture, laid by the file's UVs."""
    def draw(axis, folder):
        mesh = meshes.read(folder / name)
        options = {"view": view, "color": np.array(color), "frame": [meshes.read(folder / f) for f in frame]}
        if isinstance(texture, int):
            options |= {"uvs": mesh.uvs, "texture": raster.checkerboard(texture)}
        elif texture:
            pixels = matplotlib.image.imread(folder / texture)
            options |= {"uvs": mesh.uvs, "texture": raster.image(pixels)}
        axis.imshow(raster.render(mesh, wire=0.0 if texture else wire, **options))
        axis.axis("off")
        return None if mesh.tets is None else f"{(mesh.volumes() <= 0).sum()} inverted"
    return draw


def bar(name, rest):
    """A twisted bar along x, and how many turns it holds."""
    def draw(axis, folder):
        mesh, before = meshes.read(folder / name), meshes.read(folder / rest)
        picture = raster.render(mesh, (0, 25), size=1000, wire=0.35)
        rows = np.flatnonzero((picture < 1).any((1, 2)))
        axis.imshow(picture[rows[0] - 4:rows[-1] + 5])
        axis.axis("off")
        remark = f"{(mesh.volumes() <= 0).sum()} inverted, {abs(meshes.turns(before.positions, mesh.positions)):.2f} turns"
        return remark
    return draw


def section(name, box, axis_of_cut=2, at=0.0):
    """Where the two halves of a file's triangles, in two colors, meet a plane square to an axis."""
    def draw(axis, folder):
        mesh = meshes.read(folder / name)
        for half, color in zip(np.split(mesh.triangles, 2), ("#b5442c", "#2c6fb5")):
            lines = cut(meshes.Mesh(mesh.positions, half), axis_of_cut, at)
            axis.add_collection(LineCollection(lines, colors=color, linewidths=1.6))
        fit(axis, np.array(box))
    return draw


def cut(mesh, axis, at):
    """The segments (n, 2, 2) in which triangles meet a plane."""
    others = [k for k in range(3) if k != axis]
    segments = []
    for corners in mesh.positions[mesh.triangles]:
        height = corners[:, axis] - at - 1e-9
        ends = [corners[a] + (corners[b] - corners[a]) * height[a] / (height[a] - height[b])
                for a, b in ((0, 1), (1, 2), (2, 0)) if height[a] * height[b] < 0]
        if len(ends) == 2:
            segments.append([end[others] for end in ends])
    return np.array(segments)


def layout(name, anchors=None, box=None):
    """The UVs of a file; flipped triangles red, as most of the chart's area is oriented."""
    def draw(axis, folder):
        uvs = meshes.read(folder / name).uvs
        areas = meshes.signed_areas(uvs)
        flipped = areas * np.sign(areas.sum()) <= 0
        width = min(0.4, 12 / np.sqrt(len(areas)) * 0.4)
        axis.add_collection(PolyCollection(uvs, facecolors=FILL, edgecolors=EDGE, linewidths=width, alpha=0.75))
        axis.add_collection(PolyCollection(uvs[flipped], facecolors=INVERTED, edgecolors=INVERTED, linewidths=1.5))
        if anchors is not None:
            for start, end in anchors:
                axis.annotate("", end, start, arrowprops={"arrowstyle": "->", "color": "#1f77b4", "lw": 1.6})
        fit(axis, uvs.reshape(-1, 2) if box is None else np.array(box))
        return f"{flipped.sum()} flipped"
    return draw


def picture(name, handles=None):
    """A picture, with arrows from handles to their targets."""
    def draw(axis, folder):
        pixels = matplotlib.image.imread(folder / name)
        if pixels.shape[-1] == 4:
            pixels = pixels[..., :3] * pixels[..., 3:] + (1 - pixels[..., 3:])
        axis.imshow(pixels)
        for handle in json.loads((folder / handles).read_text())["handles"] if handles else []:
            axis.annotate("", handle["to"], handle["at"], arrowprops={"arrowstyle": "->", "color": "#d62728", "lw": 2})
        axis.axis("off")
    return draw


def traces(named, columns=("energy", "residual")):
    """Columns of the files that `--trace` wrote, over the iterations."""
    def draw(axis, folder):
        for (label, name), color in zip(named.items(), ("#1f77b4", "#d62728", "#2ca02c", "#9467bd")):
            rows = list(csv.DictReader((folder / name).open()))
            for column, style in zip(columns, ("-", ":")):
                points = [(int(r["iteration"]), float(r[column])) for r in rows if r[column] not in ("", "inf", "NaN")]
                points = [(i, y) for i, y in points if y > 0]
                if points:
                    axis.plot(*zip(*points), style, color=color, label=f"{label}: {column}")
        axis.set_yscale("log")
        axis.set_xscale("symlog", linthresh=10)
        axis.set_xlim(left=0)
        axis.set_xlabel("iteration")
        axis.grid(alpha=0.3)
        axis.legend(fontsize=7)
    return draw
