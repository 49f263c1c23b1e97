#!/usr/bin/env python3
"""Bakes detailed textures through atlases of `unwrapd unwrap`, uvunwrap and xatlas, and compares renderings with the source.

    python3 tests/bench/bake --unwrapd target/release/unwrapd [--pictures FOLDER] FILE...

The interpreter needs numpy, pillow, uvunwrap and xatlas from PyPI. A glTF with a base color texture is judged by that
texture, every other mesh by a procedural one, a function of space with detail down to the texels of a full atlas. All tools get
the same faces, welded where positions are equal, one atlas per mesh, and a gap of 2 texels at 1024 (uvunwrap `padding=1`,
xatlas `resolution=1024, padding=2`). The same baker fills 1024² texels of 8 bits through each atlas: at the texels' centers, and
at the nearest points of charts for those that bilinear filtering reads beside them. The surface is seen from the eight corners
of a cube, in pictures of 1024², as the source has it and with each texture, sampled bilinearly; PSNR is over all pixels that
show the surface.
"""
import argparse
import statistics
import sys
import tempfile
from pathlib import Path

import numpy as np
from PIL import Image

sys.path.insert(0, str(Path(__file__).parent))
from raster import covered, visible  # noqa: E402
from surfaces import Procedural, Textured, bilinear, blended, corners, linear, srgb, unwrapped  # noqa: E402

SIDE = 1024
VIEWS = [np.array([x, y, z]) / 3 ** 0.5 for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]


def uvunwrap_uvs(positions, faces):
    import uvunwrap
    mesh = uvunwrap.Mesh(positions, faces.astype(np.uint32))
    return np.array(uvunwrap.generate([mesh], padding=1).meshes[0].corner_uvs).reshape(-1, 3, 2)


def xatlas_uvs(positions, faces):
    import xatlas
    atlas = xatlas.Atlas()
    atlas.add_mesh(positions, faces.astype(np.uint32))
    options = xatlas.PackOptions()
    options.resolution, options.padding = SIDE, 2
    atlas.generate(pack_options=options)
    _, indices, uv = atlas[0]
    return np.asarray(uv, float)[indices]


PEERS = {"uvunwrap": uvunwrap_uvs, "xatlas": xatlas_uvs}


def seen(positions):
    """What each view shows: faces, weights and pixels."""
    center = 0.5 * (positions.min((0, 1)) + positions.max((0, 1)))
    radius = np.linalg.norm(positions - center, axis=2).max()
    for direction in VIEWS:
        right = np.cross([0, 1, 0], direction)
        right /= np.linalg.norm(right)
        up = np.cross(direction, right)
        local = (positions - center) / radius
        plane = np.stack([local @ right, -(local @ up)], 2)
        yield visible((plane + 1) * 0.5 * SIDE, -(local @ direction), SIDE)


def baked(uv, source):
    """The texture of SIDE² texels, 8 bits, for UVs with v down."""
    texture = np.zeros((SIDE * SIDE, 3))
    faces, weights, at = covered(uv * SIDE, SIDE)
    texture[at] = np.round(source.colors(faces, weights))
    return texture.reshape(SIDE, SIDE, 3)


def psnr(errors):
    return 10 * np.log10(255 ** 2 / max(np.mean(np.concatenate(errors) ** 2), 1e-9))


def compared(name, positions, source, atlases, pictures):
    """PSNR by tool; `atlases`: UVs (n, 3, 2) with v down."""
    textures = {tool: baked(uv, source) for tool, uv in atlases.items()}
    errors = {tool: [] for tool in atlases}
    for number, (faces, weights, pixels) in enumerate(seen(positions)):
        truth = source.colors(faces, weights)
        shown = {"source": truth}
        for tool, uv in atlases.items():
            value = bilinear(linear(textures[tool]), blended(weights, uv[faces]))
            shown[tool] = srgb(value)
            errors[tool].append(shown[tool] - truth)
        if pictures and number == 7:
            save(pictures, name, shown, pixels, textures)
    return {tool: psnr(of_tool) for tool, of_tool in errors.items()}


def save(folder, name, shown, pixels, textures):
    for tool, values in shown.items():
        picture = np.zeros((SIDE * SIDE, 3), np.uint8)
        picture[pixels] = np.round(values).astype(np.uint8)
        Image.fromarray(picture.reshape(SIDE, SIDE, 3)).save(folder / f"{name}-{tool}.png")
    for tool, texture in textures.items():
        Image.fromarray(texture.astype(np.uint8)).save(folder / f"{name}-{tool}-texture.png")


def fill(uv):
    """The share of the square that charts cover."""
    e, f = uv[:, 1] - uv[:, 0], uv[:, 2] - uv[:, 0]
    return 0.5 * np.abs(e[:, 0] * f[:, 1] - e[:, 1] * f[:, 0]).sum()


def meshes_of(path, unwrapd, folder):
    """Per mesh of a file: its name, its corners, its source and our UVs."""
    glb, report = unwrapped(unwrapd, path, folder / "ours.glb")
    sets = {(note["mesh"], note["primitive"]): note["texcoord"] for note in report["written"]["primitives"]}
    for number, mesh in enumerate(glb.json["meshes"]):
        primitives = [p for k, p in enumerate(mesh["primitives"]) if (number, k) in sets]
        if not primitives:
            continue
        of = lambda attribute: np.concatenate([corners(glb, p, attribute) for p in primitives])
        positions, uv = of("POSITION"), of(f"TEXCOORD_{sets[number, mesh['primitives'].index(primitives[0])]}")
        textured = Textured(glb, primitives)
        has_texture = any(part for _, _, part in textured.parts)
        if has_texture or path.suffix not in (".glb", ".gltf"):
            name = path.stem if len(glb.json["meshes"]) == 1 else f"{path.stem}-{number}"
            yield name, positions, textured if has_texture else Procedural(positions), uv


def judged(name, positions, source, ours, pictures):
    points, index = np.unique(positions.reshape(-1, 3).astype(np.float32), axis=0, return_inverse=True)
    faces = index.reshape(-1, 3)
    proper = (faces[:, 0] != faces[:, 1]) & (faces[:, 1] != faces[:, 2]) & (faces[:, 2] != faces[:, 0])
    atlases = {"unwrapd": ours}
    for tool, uvs in PEERS.items():
        uv = np.zeros_like(ours)
        # Both have v up, the textures here v down; it only has to be the same on both ways.
        uv[proper] = uvs(points, faces[proper])
        atlases[tool] = uv
    row = compared(name, positions, source, atlases, pictures)
    fills = " ".join(f"{fill(uv):.3f}" for uv in atlases.values())
    print(f"{name:28} | {type(source).__name__:10} | " + " | ".join(f"{row[t]:6.2f}" for t in atlases) +
          f" | {row['unwrapd'] - row['uvunwrap']:+6.2f} | {row['unwrapd'] - row['xatlas']:+6.2f} | {fills}", flush=True)
    return row


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("files", nargs="+", type=Path)
    parser.add_argument("--unwrapd", default="target/release/unwrapd")
    parser.add_argument("--pictures", type=Path)
    arguments = parser.parse_args()
    print("mesh | texture | PSNR dB: unwrapd | uvunwrap | xatlas | over uvunwrap | over xatlas | shares of the square")
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        for path in arguments.files:
            for mesh in meshes_of(path, arguments.unwrapd, Path(folder)):
                rows.append(judged(*mesh, arguments.pictures))
    for tool in PEERS:
        gains = [row["unwrapd"] - row[tool] for row in rows]
        print(f"over {tool}: median {statistics.median(gains):+.2f} dB, least {min(gains):+.2f}, most {max(gains):+.2f}")


if __name__ == "__main__":
    main()
