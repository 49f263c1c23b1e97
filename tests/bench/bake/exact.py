#!/usr/bin/env python3
"""Texels that `unwrapd repack --rebake` must copy, and every kind of picture that it reads, judged from the written files.

    python3 tests/bench/bake/exact.py [--unwrapd target/release/unwrapd] [--pictures FOLDER]

Needs numpy and pillow. Two quads with noise textures are put at other places, by whole texels, quarter turns, a flip and half a texel.
The judge takes old and new UVs from the files alone: the two affine maps of each face give the old place of every texel whose center
the face contains, and the texels that filtering reads beside it. Prints how many of these texels are equal, byte for byte, and the
largest difference. Vertex colors are compared with their bilinear values, and all texels around them with the nearest chart.
"""
import argparse
import io
import json
import struct
import subprocess
import tempfile
import zlib
from pathlib import Path

import numpy as np
from PIL import Image

from surfaces import Glb, corners, linear, srgb

SIDE = 128
KTX2 = Path(__file__).parents[2] / "assets" / "ktx2"
#: Corners of two quads in texels, the first corner at the origin of the quad.
QUADS = [(8, 8, 40, 56), (64, 16, 48, 32)]


# Files.

def noise(side, bits=8):
    top = 2 ** bits
    return np.random.default_rng(5).integers(0, top, (side, side, 4), dtype=np.uint16 if bits == 16 else np.uint8)


def png_16(pixels):
    """A PNG of 16 bits per channel, which pillow cannot write."""
    height, width = pixels.shape[:2]
    rows = b"".join(b"\0" + row.astype(">u2").tobytes() for row in pixels)
    chunk = lambda kind, data: struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    header = struct.pack(">IIBBBBB", width, height, 16, 6, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b"")


def read_png_16(data):
    """The pixels of a PNG of 16 bits per channel."""
    width, height, bits, kind = struct.unpack(">IIBB", data[16:26])
    assert (bits, kind) == (16, 6), f"{bits} bits, color type {kind}"
    at, packed = 8, b""
    while at < len(data):
        length, name = struct.unpack(">I4s", data[at:at + 8])
        packed += data[at + 8:at + 8 + length] if name == b"IDAT" else b""
        at += 12 + length
    raw, stride = np.frombuffer(zlib.decompress(packed), np.uint8).reshape(height, -1), 8
    last, rows = np.zeros(width * stride, int), []
    for line in raw:
        row = unfiltered(line[0], line[1:].astype(int), last, stride)
        rows.append(row)
        last = row
    return np.array(rows, np.uint8).view(">u2").reshape(height, width, 4)


def unfiltered(method, line, above, stride):
    row = np.zeros(len(line), int)
    for k in range(len(line)):
        a = row[k - stride] if k >= stride else 0
        b, c = above[k], above[k - stride] if k >= stride else 0
        if method == 4:
            p = a + b - c
            guess = min((abs(p - a), 0, a), (abs(p - b), 1, b), (abs(p - c), 2, c))[2]
        else:
            guess = [0, a, b, (a + b) // 2][method]
        row[k] = (line[k] + guess) & 255
    return row


def file_of(pixels, format):
    out = io.BytesIO()
    Image.fromarray(pixels).save(out, format, lossless=True)
    return out.getvalue()


def glb(path, quads, image=None, media="image/png", extension=None, transform=None, side=SIDE, colors=None):
    """A file with one mesh of quads, each an island; UVs in texels of `side`."""
    views, accessors, data = [], [], b""

    def view(content):
        nonlocal data
        data += b"\0" * (-len(data) % 4)
        views.append({"buffer": 0, "byteOffset": len(data), "byteLength": len(content)})
        data += content
        return len(views) - 1

    def accessor(array, kind, component):
        accessors.append({"bufferView": view(array.tobytes()), "componentType": component, "count": len(array), "type": kind})
        if kind == "VEC3":
            accessors[-1].update(min=array.min(0).tolist(), max=array.max(0).tolist())
        return len(accessors) - 1

    unit = np.array([[0, 0], [1, 0], [1, 1], [0, 1]], np.float32)
    flat = [unit * [w, h] + [x, y] for x, y, w, h in quads]
    positions = np.concatenate([np.c_[quad, np.full(4, 40.0 * k)] for k, quad in enumerate(flat)]).astype(np.float32)
    indices = np.concatenate([np.array([0, 1, 2, 0, 2, 3]) + 4 * k for k in range(len(flat))]).astype(np.uint16)
    primitive = {"attributes": {"POSITION": accessor(positions, "VEC3", 5126)}, "indices": accessor(indices, "SCALAR", 5123), "material": 0}
    primitive["attributes"]["TEXCOORD_0"] = accessor((np.concatenate(flat) / side).astype(np.float32), "VEC2", 5126)
    if colors is not None:
        primitive["attributes"]["COLOR_0"] = accessor(colors.astype(np.float32), "VEC3", 5126)
    document = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
                "meshes": [{"primitives": [primitive]}], "materials": [{}]}
    if image is not None:
        info = {"index": 0}
        if transform:
            info["extensions"] = {"KHR_texture_transform": transform}
            document["extensionsUsed"] = ["KHR_texture_transform"]
        document["materials"] = [{"pbrMetallicRoughness": {"baseColorTexture": info}}]
        document["images"] = [{"bufferView": view(image), "mimeType": media}]
        document["textures"] = [{"extensions": {extension: {"source": 0}}} if extension else {"source": 0}]
        if extension:
            document["extensionsUsed"] = document["extensionsRequired"] = [extension]
    document.update(bufferViews=views, accessors=accessors, buffers=[{"byteLength": len(data)}])
    text = json.dumps(document).encode()
    text, data = text + b" " * (-len(text) % 4), data + b"\0" * (-len(data) % 4)
    chunks = struct.pack("<II", len(text), 0x4E4F534A) + text + struct.pack("<II", len(data), 0x004E4942) + data
    path.write_bytes(struct.pack("<III", 0x46546C67, 2, 12 + len(chunks)) + chunks)
    return path


# Judging.

def new_image(written):
    """Bytes of the base-color texture of the only material."""
    info = written.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]
    texture = written.json["textures"][info["index"]]
    source = texture.get("source", texture.get("extensions", {}).get("EXT_texture_webp", {}).get("source"))
    return written.view(written.json["images"][source]["bufferView"])[0]


def pixels_of(data):
    if data[:4] == b"\x89PNG" and data[24] == 16:
        return read_png_16(data)
    return np.asarray(Image.open(io.BytesIO(data)).convert("RGBA"))


def affine(source, target):
    """The map from a triangle to another, as a matrix of 2 × 3."""
    return np.linalg.solve(np.c_[source, np.ones(3)], target).T


def seen(triangle, side, reach):
    """Texels whose centers are in a triangle, or nearer to it than `reach` along each axis."""
    y, x = np.mgrid[0:side, 0:side] + 0.5
    inside = np.zeros((side, side), bool)
    steps = [0] if reach == 0 else [-reach, 0, reach]
    e, f = triangle[1] - triangle[0], triangle[2] - triangle[0]
    area = e[0] * f[1] - e[1] * f[0]
    for dx in steps:
        for dy in steps:
            px, py = x + dx - triangle[0][0], y + dy - triangle[0][1]
            s, t = (px * f[1] - py * f[0]) / area, (e[0] * py - e[1] * px) / area
            inside |= (s >= 0) & (t >= 0) & (s + t <= 1)
    return np.argwhere(inside)


def compared(before, after, old, new, place=lambda uv: uv):
    """Counts of texels that faces or filtering read and of equal ones, and the largest difference."""
    was, now = (corners(file, file.json["meshes"][0]["primitives"][0], "TEXCOORD_0") for file in (before, after))
    side_old, side_new = old.shape[0], new.shape[0]
    n, equal, most = 0, 0, 0
    for a, b in zip(now * side_new, place(was) * side_old):
        back = affine(a, b)
        texels = seen(a, side_new, 0.99)
        places = np.c_[texels[:, ::-1] + 0.5, np.ones(len(texels))] @ back.T
        x, y = (np.floor(places + 1e-3).astype(int) % side_old).T
        apart = np.abs(new[texels[:, 0], texels[:, 1]].astype(int) - old[y, x].astype(int)).max(1)
        n, equal, most = n + len(apart), equal + (apart == 0).sum(), max(most, apart.max())
    return n, equal, most


class Bench:
    def __init__(self, unwrapd, folder, pictures):
        self.unwrapd, self.folder, self.pictures = unwrapd, folder, pictures

    def run(self, command, source, *options):
        """The written file and its report; the exit status and the messages."""
        out = self.folder / "out.glb"
        report = self.folder / "report.json"
        call = [self.unwrapd, command, source, "-o", out, "--report", report, "--resolution", str(SIDE), *options]
        done = subprocess.run(call, capture_output=True, text=True)
        if done.returncode not in (0, 7):
            raise SystemExit(f"{call}\n{done.stderr}")
        return Glb(out), json.loads(report.read_text()), done

    def moved(self, name, islands, image, decoded, place=lambda uv: uv, **kind):
        """A texture whose islands are put somewhere; None packs them, with their sizes kept."""
        quads = QUADS if islands else [(x + 0.3, y + 0.6, w, h) for x, y, w, h in QUADS]
        source = glb(self.folder / "in.glb", quads, image, **kind)
        placed = self.folder / "islands.json"
        placing = ["--control", "all: density keep", "--rotate", "quarter"]
        if islands:
            placed.write_text(json.dumps({"islands": [{"primitive": 0, "face": 2 * k, **island} for k, island in enumerate(islands)]}))
            placing = ["--islands", placed]
        written, report, done = self.run("repack", source, *placing, "--rebake", "--bake-size", str(SIDE))
        assert done.returncode == 0, done.stderr
        data = new_image(written)
        new = pixels_of(data)
        if self.pictures:
            (self.pictures / f"{name.replace(' ', '_')}.png").write_bytes(data)
        n, equal, most = compared(Glb(source), written, decoded, new, place)
        kinds = {b"\x89PNG": "PNG", b"RIFF": "WebP", b"\xff\xd8\xff": "JPEG"}
        format = next(value for key, value in kinds.items() if data.startswith(key))
        bits = 16 if new.dtype.itemsize == 2 else 8
        print(f"{name:28} | {n:6} | {equal:6} | {most:5} | {format} {bits} bits")
        return n, equal, most


def texels(x, y):
    return [x / SIDE, y / SIDE]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--unwrapd", default="target/release/unwrapd")
    parser.add_argument("--pictures", type=Path)
    arguments = parser.parse_args()
    failed = []
    with tempfile.TemporaryDirectory() as folder:
        bench = Bench(arguments.unwrapd, Path(folder), arguments.pictures)
        copies(bench, failed)
        vertex_colors(bench, failed)
        tiled(bench, failed)
    if failed:
        raise SystemExit(f"failed: {', '.join(failed)}")


def copies(bench, failed):
    flat = noise(SIDE)
    moves = {
        "still": [{}, {}],
        "whole texels": [{"move": texels(3, 20)}, {"move": texels(-5, 60)}],
        "quarter turn": [{"turn": 90, "pivot": texels(28, 36), "move": texels(8, 0)}, {"turn": 270, "pivot": texels(88, 32), "move": texels(0, 60)}],
        "packed, sizes kept": None,
        "half turn": [{"turn": 180, "pivot": texels(28, 36)}, {"turn": 180, "pivot": texels(88, 32), "move": texels(2, 2)}],
    }
    print("case                         | texels |  equal |  most | written as")
    rows = {name: bench.moved(name, islands, file_of(flat, "PNG"), flat) for name, islands in moves.items()}
    shift = moves["whole texels"]
    flip = {"scale": [-1, 1], "offset": [1, 0]}
    mirrored = lambda uv: uv * [-1, 1] + [1, 0]
    rows["flip"] = bench.moved("flip", shift, file_of(flat, "PNG"), flat, mirrored, transform=flip)
    deep = noise(SIDE, 16)
    rows["16 bits"] = bench.moved("16 bits", shift, png_16(deep), deep)
    webp = file_of(flat | np.array([0, 0, 0, 255], np.uint8), "WEBP")
    rows["WebP"] = bench.moved("WebP", shift, webp, pixels_of(webp), media="image/webp", extension="EXT_texture_webp")
    failed += [name for name, (n, equal, _) in rows.items() if n == 0 or equal < n]
    # A check that can fail: half a texel is resampled.
    n, equal, _ = bench.moved("half a texel", [{"move": texels(3.5, 20)}, {"move": texels(-5, 60.5)}], file_of(flat, "PNG"), flat)
    failed += ["half a texel"] if equal > n // 2 else []
    ktx2(bench, failed)


def ktx2(bench, failed):
    """Files of the reference encoder, of a picture that is known."""
    y, x = np.mgrid[0:64, 0:64]
    picture = np.stack([4 * x, 4 * y, (x // 8 + y // 8) % 2 * 200 + 20], 2)
    for name, least in (("etc1s", 25), ("uastc", 45)):
        image = (KTX2 / f"{name}.ktx2").read_bytes()
        source = glb(bench.folder / "in.glb", [(0, 0, 64, 64)], image, "image/ktx2", "KHR_texture_basisu", side=64)
        written, report, done = bench.run("repack", source, "--control", "all: lock", "--padding", "0", "--rebake", "--bake-size", "64")
        new = pixels_of(new_image(written))[..., :3]
        db = 10 * np.log10(255 ** 2 / np.mean((new.astype(float) - picture) ** 2))
        names = written.json.get("extensionsUsed", [])
        print(f"KTX2 {name}: {db:.1f} dB beside the picture that was encoded, written as PNG, extensions {names}, exit {done.returncode}")
        failed += [f"KTX2 {name}"] if db < least or done.returncode or names else []


def vertex_colors(bench, failed):
    """A quad of four colors without a texture, then with one: each texel is their product."""
    colors = np.array([[1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 0.2]])
    quad = [(32, 32, 64, 64)]
    for image in (None, file_of(np.full((4, 4, 4), 188, np.uint8) | np.array([0, 0, 0, 255], np.uint8), "PNG")):
        source = glb(bench.folder / "in.glb", quad, image, colors=colors)
        written, report, done = bench.run("unwrap", source, "--bake-colors", "--bake-size", str(SIDE), "--padding", "16")
        primitive = written.json["meshes"][0]["primitives"][0]
        new = pixels_of(new_image(written))[..., :3].astype(float)
        if bench.pictures:
            (bench.pictures / f"colors_{image is not None}.png").write_bytes(new_image(written))
        # Each face has linear colors, which the texture multiplies.
        positions, uv = (corners(written, primitive, name) for name in ("POSITION", "TEXCOORD_0"))
        of_vertex = {tuple(p): c for p, c in zip(Glb(source).accessor(0).tolist(), colors)}
        most, covered = 0, np.zeros((SIDE, SIDE), bool)
        for place, at in zip(positions, uv * SIDE):
            rgb = affine(at, np.array([of_vertex[tuple(p)] for p in place.tolist()]))
            texels = seen(at, SIDE, 0)
            wanted = np.c_[texels[:, ::-1] + 0.5, np.ones(len(texels))] @ rgb.T
            factor = 1 if image is None else ((188 / 255 + 0.055) / 1.055) ** 2.4
            got = new[texels[:, 0], texels[:, 1]]
            most = max(most, np.abs(got - srgb(factor * wanted)).max())
            covered[texels[:, 0], texels[:, 1]] = True
        # Beyond the chart every texel has the color of its border, as far as that changes within two texels.
        inside, around = np.argwhere(covered), np.argwhere(~covered)
        nearest = inside[[((inside - texel) ** 2).sum(1).argmin() for texel in around]]
        light = lambda texels: linear(new[texels[:, 0], texels[:, 1]])
        off = np.abs(light(around) - light(nearest)).max()
        gone = "COLOR_0" not in primitive["attributes"]
        print(f"vertex colors {'on a texture' if image else 'alone'}: {covered.sum()} texels, largest difference {most:.2f} of 255, "
              f"{len(around)} texels around it at most {off:.3f} of 1 off its border, attribute removed: {gone}, exit {done.returncode}")
        failed += ["vertex colors"] if most > 1.01 or off > 0.04 or len(around) == 0 or not gone or done.returncode else []


def tiled(bench, failed):
    source = glb(bench.folder / "in.glb", [(0, 0, 8 * SIDE, 4 * SIDE)], file_of(noise(SIDE), "PNG"))
    for options in ([], ["--bake-tiled"]):
        _, report, done = bench.run("unwrap", source, "--rebake", "--bake-size", "256", *options)
        lines = done.stderr.splitlines()
        warning = next(k for k, line in enumerate(lines) if "repeats" in line)
        begins = next(k for k, line in enumerate(lines) if line.endswith("  cut"))
        print(f"tiled {' '.join(options)}: exit {done.returncode}, before the work: {warning < begins}; {lines[warning]}")
        failed += ["tiled"] if warning > begins or bool(report["written"]["textures_baked"]) != bool(options) else []


if __name__ == "__main__":
    main()
