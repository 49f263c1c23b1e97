#!/usr/bin/env python3
"""Edits certified files at random and compares what `verify` says of them with an independent judge.

A chart is moved, flipped, scaled or laid on another one, or the record in the file is edited, taken from another file or deleted;
the digest of the record is renewed, so that it fits. Nothing that `verify --bijective` passes may be contradicted by the judge for
the same UV set and grouping.

    tests/bench/edited_records.py --unwrapd target/release/unwrapd --judge JUDGE.py [--edits 200] FILE...
"""

import argparse
import hashlib
import json
import random
import struct
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np


def read(path):
    raw = path.read_bytes()
    length = struct.unpack_from("<I", raw, 12)[0]
    document = json.loads(raw[20 : 20 + length])
    start = 20 + length
    body = bytearray(raw[start + 8 :]) if len(raw) > start else bytearray()
    return document, body


def write(path, document, body):
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    body = bytes(body) + b"\0" * (-len(body) % 4)
    total = 12 + 8 + len(text) + 8 + len(body)
    path.write_bytes(
        struct.pack("<4sII", b"glTF", 2, total)
        + struct.pack("<I4s", len(text), b"JSON")
        + text
        + struct.pack("<I4s", len(body), b"BIN\0")
        + body
    )


def array(document, body, index, dtype, width):
    """The numbers of a plain accessor, as a view into the body."""
    accessor = document["accessors"][index]
    view = document["bufferViews"][accessor["bufferView"]]
    start = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
    assert view.get("byteStride", 0) in (0, width * np.dtype(dtype).itemsize)
    return np.frombuffer(body, dtype, accessor["count"] * width, start).reshape(-1, width)


def triangles(document, body, primitive):
    assert primitive.get("mode", 4) == 4
    if "indices" not in primitive:
        count = document["accessors"][primitive["attributes"]["POSITION"]]["count"]
        return np.arange(count).reshape(-1, 3)
    kind = {5121: np.uint8, 5123: np.uint16, 5125: np.uint32}
    component = document["accessors"][primitive["indices"]]["componentType"]
    return array(document, body, primitive["indices"], kind[component], 1).reshape(-1, 3)


def charts(faces, n):
    """The vertices of each chart: connected by faces."""
    parent = list(range(n))

    def find(v):
        while parent[v] != v:
            parent[v] = parent[parent[v]]
            v = parent[v]
        return v

    for a, b, c in faces:
        parent[find(a)] = find(b)
        parent[find(b)] = find(c)
    groups = {}
    for v in set(faces.ravel().tolist()):
        groups.setdefault(find(v), []).append(v)
    return [np.array(sorted(group)) for _, group in sorted(groups.items())]


def with_digest(document, body):
    """Renews the digest of the record."""
    record = document["asset"]["extras"]["unwrapd"]
    sets = record.get("texcoord", 0)
    digest, number = hashlib.sha256(), 0
    for mesh in document["meshes"]:
        for primitive in mesh["primitives"]:
            own = sets if isinstance(sets, int) else sets[number] if number < len(sets) else None
            number += 1
            name = f"TEXCOORD_{own}"
            if own is None or name not in primitive["attributes"]:
                continue
            uvs = array(document, body, primitive["attributes"][name], np.float32, 2)
            corners = uvs[triangles(document, body, primitive).ravel()].astype("<f8")
            digest.update(struct.pack("<I", own) + struct.pack("<Q", len(corners) // 3))
            digest.update(corners.tobytes())
    record["digest"] = digest.hexdigest()[:32]


def edit(rng, document, body, other):
    primitives = [p for mesh in document["meshes"] for p in mesh["primitives"]]
    record = document["asset"]["extras"]["unwrapd"]
    sets = record["texcoord"] if isinstance(record["texcoord"], int) else max(s or 0 for s in record["texcoord"])
    kind = rng.choice(["move", "flip", "scale", "duplicate", "record", "record", "copied", "deleted", "both", "both"])
    done = [kind]
    if kind in ("move", "flip", "scale", "duplicate", "both"):
        primitive = rng.choice(primitives)
        name = f"TEXCOORD_{sets}"
        if name in primitive["attributes"]:
            uvs = array(document, body, primitive["attributes"][name], np.float32, 2)
            uvs = uvs.copy()
            all_charts = charts(triangles(document, body, primitive), len(uvs))
            chart = rng.choice(all_charts)
            middle = uvs[chart].mean(axis=0)
            what = rng.choice(["move", "flip", "scale", "duplicate"]) if kind == "both" else kind
            if what == "move":
                uvs[chart] += np.array([rng.uniform(-0.5, 0.5), rng.uniform(-0.5, 0.5)], np.float32)
            elif what == "flip":
                uvs[rng.choice(chart.tolist())] = 2 * middle - uvs[chart[0]]
            elif what == "scale":
                uvs[chart] = middle + (uvs[chart] - middle) * np.float32(rng.uniform(1.2, 3))
            else:
                uvs[chart] += uvs[rng.choice(all_charts)].mean(axis=0) - middle
            accessor = document["accessors"][primitive["attributes"][name]]
            view = document["bufferViews"][accessor["bufferView"]]
            start = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
            body[start : start + uvs.nbytes] = uvs.tobytes()
            done.append(what)
    if kind == "copied":
        document["asset"]["extras"]["unwrapd"] = json.loads(json.dumps(other))
    if kind in ("record", "both"):
        field, value = rng.choice(
            [
                ("charts", [0]), ("charts", []), ("group_by", "primitive"), ("group_by", "mesh"), ("separate_nodes", True),
                ("overlaps", True), ("texcoord", [None] * len(primitives)), ("resolution", 65536), ("padding", 0), ("pages", 10),
                ("texcoord", [sets] + [None] * (len(primitives) - 1)), ("mips", 0), ("bits", None), ("aligned", False),
            ]
        )
        document["asset"]["extras"]["unwrapd"][field] = value
        done.append(f"{field}={value}")
    if kind == "deleted":
        del document["asset"]["extras"]["unwrapd"]
    elif rng.random() < 0.8:
        try:
            with_digest(document, body)
        except (KeyError, TypeError, IndexError, AssertionError):
            pass
    return sets, " ".join(done)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--unwrapd", required=True)
    parser.add_argument("--judge", required=True)
    parser.add_argument("--edits", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("files", nargs="+", type=Path)
    args = parser.parse_args()
    rng = random.Random(args.seed)
    passed = refused = contradicted = differs = skipped = 0
    with tempfile.TemporaryDirectory() as folder:
        certified = []
        for index, file in enumerate(args.files):
            out = Path(folder) / f"{index}.glb"
            done = subprocess.run([args.unwrapd, "unwrap", file, "-o", out, "-q", "--overwrite"], capture_output=True, check=False)
            if done.returncode == 0:
                certified.append(out)
        records = [read(file)[0]["asset"]["extras"]["unwrapd"] for file in certified]
        while passed + refused < args.edits:
            document, body = read(rng.choice(certified))
            try:
                sets, what = edit(rng, document, body, rng.choice(records))
            except AssertionError:
                skipped += 1
                continue
            out = Path(folder) / "edited.glb"
            write(out, document, body)
            group = rng.choice(["scene", "mesh", "primitive"])
            said = subprocess.run([args.unwrapd, "verify", out, "--bijective", "--group-by", group, "--json"], capture_output=True, text=True, check=False)
            judged = json.loads(said.stdout) if said.stdout.startswith("{") else {}
            named = judged.get("judged", {}).get("texcoord", sets)
            named = named if isinstance(named, int) else min(s for s in named if s is not None) if any(s is not None for s in named) else 0
            judge = subprocess.run([sys.executable, args.judge, out, "--texcoord", str(named), "--group-by", group, "--no-gaps", "--res", "256"], capture_output=True, check=False)
            if said.returncode == 0:
                passed += 1
                if judge.returncode != 0:
                    contradicted += 1
                    print(f"CONTRADICTED: {what}, by {group}: {judge.stdout.decode()[-300:]}")
            else:
                refused += 1
                if judge.returncode == 0:
                    differs += 1
                    reason = said.stderr.strip().splitlines()[-1] if said.stderr.strip() else ""
                    print(f"stricter: {what}, by {group}: {reason}")
    print(f"{passed} passed, {refused} refused, {contradicted} contradicted, {differs} refused beyond the judge, {skipped} skipped")
    return contradicted > 0


if __name__ == "__main__":
    sys.exit(main())
