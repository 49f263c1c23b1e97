"""Meshes with UVs, read from and written to the bytes of OBJ and glTF files."""
import base64
import json
import struct
from dataclasses import dataclass, field
from pathlib import Path
from urllib.parse import unquote

import numpy as np

COMPONENTS = {5120: np.int8, 5121: np.uint8, 5122: np.int16, 5123: np.uint16, 5125: np.uint32, 5126: np.float32}
WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}
TRIANGLES, STRIP, FAN = 4, 5, 6
COMPRESSED = ("KHR_draco_mesh_compression", "EXT_meshopt_compression", "KHR_meshopt_compression")


class Unreadable(Exception):
    """A file that these readers leave to others: compressed, or without UVs."""


@dataclass
class Mesh:
    """Triangles that share an atlas."""

    positions: np.ndarray
    faces: np.ndarray
    # UVs of the corners, (n, 3, 2), v as in the file.
    uv: np.ndarray
    name: str = "scene"
    materials: list = field(default_factory=list)


# OBJ.


@dataclass
class Polygons:
    """Lines of an OBJ file: corners are indices from 0, `texcoords` None without UVs."""

    positions: np.ndarray
    uvs: np.ndarray
    corners: list
    texcoords: list
    materials: list


def read_obj(path):
    positions, uvs, corners, texcoords, materials = [], [], [], [], []
    material = ""
    for line in Path(path).read_text(errors="replace").replace("\\\n", " ").splitlines():
        words = line.split()
        if not words:
            continue
        if words[0] == "v":
            positions.append([float(x) for x in words[1:4]])
        elif words[0] == "vt":
            uvs.append([float(x) for x in (words[1:3] + ["0"])[:2]])
        elif words[0] == "usemtl":
            material = " ".join(words[1:])
        elif words[0] == "f":
            indices = [word.split("/") for word in words[1:]]
            number = lambda text, n: int(text) - 1 if int(text) > 0 else n + int(text)
            corners.append([number(word[0], len(positions)) for word in indices])
            has_uv = all(len(word) > 1 and word[1] for word in indices)
            texcoords.append([number(word[1], len(uvs)) for word in indices] if has_uv else None)
            materials.append(material)
    uvs = np.array(uvs, float).reshape(-1, 2)
    return Polygons(np.array(positions, float).reshape(-1, 3), uvs, corners, texcoords, materials)


def doubled_area(a, b, c):
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def triangulation(uv):
    """Triangles of a polygon (n, 2), as indices: a fan, or where that folds, ears cut off one by one."""
    fan = [(0, k, k + 1) for k in range(1, len(uv) - 1)]
    areas = [doubled_area(*(uv[k] for k in triangle)) for triangle in fan]
    if min(areas) >= 0 or max(areas) <= 0:
        return fan
    sign = 1 if sum(areas) > 0 else -1
    left, found = list(range(len(uv))), []
    while len(left) > 3:
        ears = []
        for k in range(len(left)):
            a, b, c = (left[(k + d) % len(left)] for d in (-1, 0, 1))
            height = sign * doubled_area(uv[a], uv[b], uv[c])
            inside = lambda p: all(sign * doubled_area(uv[i], uv[j], uv[p]) >= 0 for i, j in ((a, b), (b, c), (c, a)))
            if height > 0 and not any(inside(p) for p in left if p not in (a, b, c)):
                ears.append((height, k, (a, b, c)))
        if not ears:
            return fan
        _, k, ear = max(ears)
        found.append(ear)
        del left[k]
    return [*found, tuple(left)]


def obj_mesh(path):
    """The polygons of an OBJ that have UVs, as triangles."""
    obj = read_obj(path)
    if all(texcoords is None for texcoords in obj.texcoords):
        raise Unreadable("no UVs")
    faces, uv, materials = [], [], []
    for corners, texcoords, material in zip(obj.corners, obj.texcoords, obj.materials):
        if texcoords is None:
            continue
        for triangle in triangulation(obj.uvs[texcoords].tolist()):
            faces.append([corners[k] for k in triangle])
            uv.append([texcoords[k] for k in triangle])
            materials.append(material)
    return Mesh(obj.positions, np.array(faces), obj.uvs[np.array(uv)], materials=materials)


def write_obj(path, positions, polygons, uvs=None, materials=None, colors=None):
    """Writes polygons; `uvs` holds a list of UVs per polygon or None, `materials` a name, and `colors` belong to vertices."""
    lines, texcoord, last = [], 1, None
    colored = colors if colors is not None else [()] * len(positions)
    lines += ["v " + " ".join(repr(float(x)) for x in (*p, *c)) for p, c in zip(positions, colored)]
    for k, polygon in enumerate(polygons):
        if materials is not None and materials[k] != last:
            last = materials[k]
            lines.append(f"usemtl {last}")
        if uvs is None or uvs[k] is None:
            lines.append("f " + " ".join(str(v + 1) for v in polygon))
        else:
            lines += [f"vt {u!r} {v!r}" for u, v in np.asarray(uvs[k], float).tolist()]
            lines.append("f " + " ".join(f"{v + 1}/{texcoord + i}" for i, v in enumerate(polygon)))
            texcoord += len(polygon)
    Path(path).write_text("\n".join(lines) + "\n")


# glTF.


class Gltf:
    """A glTF file with its buffers."""

    def __init__(self, path):
        path = Path(path)
        data = path.read_bytes()
        self.bin = b""
        if data[:4] == b"glTF":
            length = struct.unpack_from("<I", data, 12)[0]
            self.json, self.bin = json.loads(data[20:20 + length]), data[28 + length:]
        else:
            self.json = json.loads(data)
        used = [name for name in self.json.get("extensionsUsed", []) if name in COMPRESSED]
        if used:
            raise Unreadable(f"compressed by {used[0]}")
        self.buffers = [self._buffer(path, buffer) for buffer in self.json.get("buffers", [])]

    def _buffer(self, path, buffer):
        uri = buffer.get("uri")
        if uri is None:
            return self.bin
        if uri.startswith("data:"):
            return base64.b64decode(uri.split(",", 1)[1])
        return (path.parent / unquote(uri)).read_bytes()

    def _rows(self, view, start, kind, width, count):
        view = self.json["bufferViews"][view]
        data = self.buffers[view["buffer"]]
        stride = view.get("byteStride") or kind.itemsize * width
        start += view.get("byteOffset", 0)
        if count == 0:
            return np.zeros((0, width), kind)
        raw = np.frombuffer(data, np.uint8, (count - 1) * stride + kind.itemsize * width, start)
        rows = np.lib.stride_tricks.as_strided(raw, (count, kind.itemsize * width), (stride, 1))
        return np.ascontiguousarray(rows).view(kind).reshape(count, width)

    def accessor(self, index):
        accessor = self.json["accessors"][index]
        kind, width = np.dtype(COMPONENTS[accessor["componentType"]]), WIDTHS[accessor["type"]]
        count = accessor["count"]
        if "bufferView" in accessor:
            values = self._rows(accessor["bufferView"], accessor.get("byteOffset", 0), kind, width, count).copy()
        else:
            values = np.zeros((count, width), kind)
        if "sparse" in accessor:
            sparse = accessor["sparse"]
            where, new, n = sparse["indices"], sparse["values"], sparse["count"]
            at = self._rows(where["bufferView"], where.get("byteOffset", 0), np.dtype(COMPONENTS[where["componentType"]]), 1, n)
            values[at[:, 0]] = self._rows(new["bufferView"], new.get("byteOffset", 0), kind, width, n)
        if accessor.get("normalized"):
            return np.maximum(values / np.iinfo(kind).max, -1.0)
        return values.astype(float) if kind.kind == "f" else values

    def primitives(self):
        """(mesh, primitive, positions, triangles) of each primitive of triangles."""
        for number, mesh in enumerate(self.json.get("meshes", [])):
            for primitive in mesh["primitives"]:
                if "POSITION" not in primitive["attributes"] or primitive.get("mode", TRIANGLES) < TRIANGLES:
                    continue
                positions = np.asarray(self.accessor(primitive["attributes"]["POSITION"]), float)
                indices = np.arange(len(positions))
                if "indices" in primitive:
                    indices = self.accessor(primitive["indices"])[:, 0].astype(int)
                yield number, primitive, positions, triangles(indices, primitive.get("mode", TRIANGLES))


def triangles(indices, mode):
    if mode == TRIANGLES:
        return indices[:len(indices) // 3 * 3].reshape(-1, 3)
    n = max(len(indices) - 2, 0)
    if mode == FAN:
        return np.array([[indices[k + 1], indices[k + 2], indices[0]] for k in range(n)]).reshape(-1, 3)
    strip = [[indices[k], indices[k + 1 + k % 2], indices[k + 2 - k % 2]] for k in range(n)]
    return np.array(strip).reshape(-1, 3)


def gltf_meshes(path, texcoord=0):
    """The atlases of the primitives with UVs: one per material, and one per mesh for what has none."""
    gltf = Gltf(path)
    parts = {}
    for mesh, primitive, positions, faces in gltf.primitives():
        material = primitive.get("material")
        key = (0, material) if material is not None else (1, mesh)
        attribute = primitive["attributes"].get(f"TEXCOORD_{texcoord}")
        if attribute is None:
            continue
        uv = np.asarray(gltf.accessor(attribute), float)[faces].reshape(-1, 3, 2)
        parts.setdefault(key, []).append((positions, faces, uv))
    if not parts:
        raise Unreadable("no UVs")
    meshes = []
    for (kind, number), all_parts in parts.items():
        first = np.cumsum([0] + [len(positions) for positions, _, _ in all_parts])
        faces = np.concatenate([faces + n for (_, faces, _), n in zip(all_parts, first)])
        positions, uv = (np.concatenate([part[k] for part in all_parts]) for k in (0, 2))
        meshes.append(Mesh(positions, faces, uv, f"{('material', 'mesh')[kind]}{number}"))
    return meshes


def meshes_of(path, texcoord=0):
    if Path(path).suffix.lower() == ".obj":
        return [obj_mesh(path)]
    return gltf_meshes(path, texcoord)


def write_glb(path, primitives):
    """Writes primitives, dicts of `positions`, `uv` (per vertex, v down), `faces`, `material` (a name), `colors` (per vertex)."""
    blob, views, accessors, written, names = b"", [], [], [], []

    def add(array, kind, component, target, **more):
        nonlocal blob
        data = array.tobytes()
        views.append({"buffer": 0, "byteOffset": len(blob), "byteLength": len(data), "target": target})
        blob += data + b"\0" * (-len(data) % 4)
        accessors.append({"bufferView": len(views) - 1, "componentType": component, "count": len(array), "type": kind, **more})
        return len(accessors) - 1

    for primitive in primitives:
        positions = np.asarray(primitive["positions"], np.float32)
        bounds = {"min": positions.min(0).tolist(), "max": positions.max(0).tolist()}
        attributes = {"POSITION": add(positions, "VEC3", 5126, 34962, **bounds)}
        if primitive.get("uv") is not None:
            attributes["TEXCOORD_0"] = add(np.asarray(primitive["uv"], np.float32), "VEC2", 5126, 34962)
        if primitive.get("colors") is not None:
            attributes["COLOR_0"] = add(np.asarray(primitive["colors"], np.float32), "VEC3", 5126, 34962)
        faces = np.asarray(primitive["faces"], np.uint32).reshape(-1, 1)
        note = {"attributes": attributes, "indices": add(faces, "SCALAR", 5125, 34963)}
        if primitive.get("material") is not None:
            if primitive["material"] not in names:
                names.append(primitive["material"])
            note["material"] = names.index(primitive["material"])
        written.append(note)
    document = {
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": written}], "materials": [{"name": name} for name in names],
        "buffers": [{"byteLength": len(blob)}], "bufferViews": views, "accessors": accessors,
    }
    if not names:
        del document["materials"]
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    head = struct.pack("<III", 0x46546C67, 2, 28 + len(text) + len(blob))
    chunks = struct.pack("<II", len(text), 0x4E4F534A) + text + struct.pack("<II", len(blob), 0x004E4942) + blob
    Path(path).write_bytes(head + chunks)
