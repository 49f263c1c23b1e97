"""Meshes as triangles with what covers them."""
import json
import struct
import subprocess
from pathlib import Path

import numpy as np
from PIL import Image

COMPONENTS = {5120: np.int8, 5121: np.uint8, 5122: np.int16, 5123: np.uint16, 5125: np.uint32, 5126: np.float32}
WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}


class Glb:
    """A GLB file as unwrapd writes it: one buffer, no compression."""

    def __init__(self, path):
        data = Path(path).read_bytes()
        length = struct.unpack_from("<I", data, 12)[0]
        self.json = json.loads(data[20:20 + length])
        self.bin = data[28 + length:]

    def view(self, index):
        view = self.json["bufferViews"][index]
        start = view.get("byteOffset", 0)
        return self.bin[start:start + view["byteLength"]], view.get("byteStride")

    def accessor(self, index):
        accessor = self.json["accessors"][index]
        kind, width = np.dtype(COMPONENTS[accessor["componentType"]]), WIDTHS[accessor["type"]]
        data, stride = self.view(accessor["bufferView"])
        stride = stride or kind.itemsize * width
        start, count = accessor.get("byteOffset", 0), accessor["count"]
        rows = np.lib.stride_tricks.as_strided(
            np.frombuffer(data, np.uint8, offset=start), (count, kind.itemsize * width), (stride, 1))
        values = np.ascontiguousarray(rows).view(kind).reshape(count, width)
        if accessor.get("normalized"):
            return np.maximum(values / np.iinfo(kind).max, -1.0)
        return values

    def image(self, index):
        import io
        image = self.json["images"][index]
        data, _ = self.view(image["bufferView"])
        return np.asarray(Image.open(io.BytesIO(data)).convert("RGBA"), np.float32)


def corners(glb, primitive, name):
    """An attribute at the corners of a primitive's triangles, (n, 3, width); None without it."""
    if name not in primitive["attributes"]:
        return None
    values = glb.accessor(primitive["attributes"][name]).astype(float)
    indices = glb.accessor(primitive["indices"])[:, 0] if "indices" in primitive else np.arange(len(values))
    return values[indices[:len(indices) // 3 * 3].astype(int)].reshape(-1, 3, values.shape[1])


def unwrapped(unwrapd, path, out, *options):
    """Runs unwrapd and reads what it wrote, with its report."""
    report = Path(out).with_suffix(".json")
    subprocess.run([unwrapd, "unwrap", path, "-o", out, "--report", report, *options], check=True, capture_output=True)
    return Glb(out), json.loads(report.read_text())


def linear(srgb):
    c = srgb / 255
    return np.where(c <= 0.04045, c / 12.92, ((c + 0.055) / 1.055) ** 2.4)


def srgb(values):
    c = np.clip(values, 0, 1)
    return 255 * np.where(c <= 0.0031308, 12.92 * c, 1.055 * c ** (1 / 2.4) - 0.055)


def wrapped(index, size, mode):
    if mode == 33071:
        return np.clip(index, 0, size - 1)
    if mode == 33648:
        index = index % (2 * size)
        return np.minimum(index, 2 * size - 1 - index)
    return index % size


def bilinear(texture, uv, wrap=(33071, 33071)):
    """Values (n, channels) of a texture (h, w, channels) at UVs with v down."""
    height, width = texture.shape[:2]
    x, y = uv[:, 0] * width - 0.5, uv[:, 1] * height - 0.5
    x0, y0 = np.floor(x).astype(int), np.floor(y).astype(int)
    s, t = (x - x0)[:, None], (y - y0)[:, None]
    at = lambda dx, dy: texture[wrapped(y0 + dy, height, wrap[1]), wrapped(x0 + dx, width, wrap[0])]
    return (1 - t) * ((1 - s) * at(0, 0) + s * at(1, 0)) + t * ((1 - s) * at(0, 1) + s * at(1, 1))


def blended(weights, values):
    """Values (n, 3, width) at the corners, mixed by weights (n, 3)."""
    return np.einsum("nk,nkw->nw", weights, values)


class Procedural:
    """Noise of all sizes down to cells of four texels of a full atlas of 1024², and lines: a function of space."""

    def __init__(self, positions, side=1024, seed=7):
        e, f = positions[:, 1] - positions[:, 0], positions[:, 2] - positions[:, 0]
        area = 0.5 * np.linalg.norm(np.cross(e, f), axis=1).sum()
        self.positions, self.texel, self.seed = positions, area ** 0.5 / side, seed

    def noise(self, points, cell, seed):
        lattice = np.floor(points / cell).astype(np.int64)
        part = points / cell - lattice
        part = part * part * (3 - 2 * part)
        value = np.zeros((len(points), 3))
        for k in range(8):
            corner = np.array([k & 1, k >> 1 & 1, k >> 2])
            weight = np.where(corner, part, 1 - part).prod(1)
            value += weight[:, None] * self.hashed(lattice + corner, seed)
        return value

    def hashed(self, lattice, seed):
        h = (lattice * np.array([73856093, 19349663, 83492791])).sum(1) + seed * 2654435761
        channels = []
        for k in range(3):
            x = (h + k * 668265263) & 0xFFFFFFFF
            x = ((x ^ (x >> 15)) * 0x2C1B3C6D) & 0xFFFFFFFF
            x = ((x ^ (x >> 12)) * 0x297A2D39) & 0xFFFFFFFF
            channels.append(((x ^ (x >> 15)) & 0xFFFF) / 65535)
        return np.stack(channels, 1)

    def colors(self, faces, weights):
        """0 to 255."""
        points = blended(weights, self.positions[faces])
        value = np.full((len(points), 3), 0.5)
        for octave, cell in enumerate([128, 64, 32, 16, 8, 4]):
            value += 0.5 * 0.75 ** octave * (self.noise(points, cell * self.texel, self.seed + octave) - 0.5)
        spots = self.noise(points, 48 * self.texel, self.seed + 50)[:, :1]
        lines = np.exp(-((spots - 0.575) / 0.03) ** 2)
        value = value + lines * (1 - 2 * value)
        return 255 * np.clip(value, 0, 1)


class Textured:
    """Triangles of primitives with the base color textures that their materials have."""

    def __init__(self, glb, primitives):
        self.glb, self.parts = glb, []
        first = 0
        for primitive in primitives:
            n = len(corners(glb, primitive, "POSITION"))
            self.parts.append((first, first + n, self.part(primitive)))
            first += n

    def part(self, primitive):
        material = self.glb.json.get("materials", [{}])[primitive.get("material", 0)] if "material" in primitive else {}
        info = material.get("pbrMetallicRoughness", {}).get("baseColorTexture")
        if info is None:
            return None
        change = info.get("extensions", {}).get("KHR_texture_transform", {})
        uv = corners(self.glb, primitive, f"TEXCOORD_{change.get('texCoord', info.get('texCoord', 0))}")
        texture = self.glb.json["textures"][info["index"]]
        if uv is None or "source" not in texture:
            return None
        angle, scale = change.get("rotation", 0), np.array(change.get("scale", [1, 1]))
        turn = np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]])
        uv = (uv * scale) @ turn.T + np.array(change.get("offset", [0, 0]))
        sampler = self.glb.json["samplers"][texture["sampler"]] if "sampler" in texture else {}
        wrap = sampler.get("wrapS", 10497), sampler.get("wrapT", 10497)
        return linear(self.glb.image(texture["source"])[..., :3]), uv, wrap

    def colors(self, faces, weights):
        """0 to 255; white where there is no texture."""
        values = np.full((len(faces), 3), 255.0)
        for first, end, part in self.parts:
            own = (faces >= first) & (faces < end)
            if part is None or not own.any():
                continue
            texture, uv, wrap = part
            places = blended(weights[own], uv[faces[own] - first])
            values[own] = srgb(bilinear(texture, places, wrap))
        return values
