#!/usr/bin/env python3
"""Unwraps meshes, quantizes what was written with the tools that others use, and has an independent judge count what survived.

    python3 tests/bench/quantized.py --judge path/to/uvmetrics.py --npm FOLDER --out /tmp/quantized DIR|FILE...

FOLDER is where `npm install @gltf-transform/cli gltfpack` was run; the judge needs numpy. Each atlas gets a material of its own with
a texture that uses the UVs, since gltfpack scales those that nothing uses as it likes; glTF-Transform `quantize` rounds the texture
coordinates alone to 12 bits, gltfpack (`-kv -km -kn -vpf`) those to 12 bits and keeps the positions. A file survives if no face is
flipped, degenerate, collapsed or overlapping afterward. Prints a line per file and the shares, once for the plain command and once
for `--quantization-safe BITS`; files of more than --faces faces are left out.
"""
import argparse
import base64
import json
import struct
import subprocess
import zlib
from pathlib import Path

from corpus import MESHES, judge

FAULTS = ["flipped", "uv_degenerate", "uv_collapsed", "overlap_pairs_exact"]


def pixel():
    """A PNG of one white pixel."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    header = struct.pack(">IIBBBBB", 1, 1, 8, 2, 0, 0, 0)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(b"\0\xff\xff\xff"))
            + chunk(b"IEND", b""))


def textured(path, out, sets, by_material):
    """The GLB with one named material per atlas, that is for each mesh or material, whose texture uses the set that was written."""
    data = path.read_bytes()
    size = struct.unpack_from("<I", data, 12)[0]
    document, rest = json.loads(data[20:20 + size]), data[20 + size:]
    uri = "data:image/png;base64," + base64.b64encode(pixel()).decode()
    document.update(images=[{"uri": uri}], textures=[{"source": 0}], materials=[])
    atlases = {}
    for index, mesh in enumerate(document["meshes"]):
        for primitive in mesh["primitives"]:
            name = f"material{primitive.get('material')}" if by_material else f"mesh{index}"
            primitive["material"] = atlases.setdefault(name, len(atlases))
            primitive.pop("extensions", None)
            if len(atlases) > len(document["materials"]):
                texture = {"index": 0, "texCoord": sets.get(index, 0)}
                document["materials"].append({"name": name, "pbrMetallicRoughness": {"baseColorTexture": texture}})
    for key in ("samplers", "extensions", "animations"):
        document.pop(key, None)
    for node in document.get("nodes", []):
        node.pop("extensions", None)
    for key in ("extensionsUsed", "extensionsRequired"):
        document[key] = [e for e in document.get(key, []) if e.startswith("KHR_mesh")]
        if not document[key]:
            del document[key]
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    out.write_bytes(struct.pack("<4sII", b"glTF", 2, 20 + len(text) + len(rest)) + struct.pack("<I4s", len(text), b"JSON")
                    + text + rest)


def survives(arguments, path, texcoords):
    """What is wrong with a quantized file, as text; nothing if it survived."""
    wrong = {}
    for texcoord in texcoords:
        judged = judge(arguments.judge, path, texcoord, "material", "--res", "64", "--no-gaps")
        if "error" in judged or "crash" in judged:
            return str(judged)[:80]
        groups = [judged] if "faces" in judged else judged.values()
        for group in (g for g in groups if isinstance(g, dict) and "faces" in g):
            for key in FAULTS:
                wrong[key] = wrong.get(key, 0) + group[key]
    return " ".join(f"{key}={n}" for key, n in wrong.items() if n)


def one(arguments, path, safe):
    name = f"{path.parent.name}_{path.stem}{'_safe' if safe else ''}".replace(" ", "_")
    out, report = arguments.out / f"{name}.glb", arguments.out / f"{name}.json"
    options = ["--quantization-safe", str(arguments.bits)] if safe else []
    done = subprocess.run([arguments.unwrapd, "unwrap", path, "-o", out, "--report", report, *options],
                          capture_output=True, text=True, timeout=arguments.limit)
    if done.returncode:
        return {"error": (done.stderr.strip() or "?").splitlines()[-1]}
    data = json.loads(report.read_text())
    row = {"faces": sum(g["measures"]["faces"] for g in data["groups"]), "safe_bits": data["proven"]["safe_bits"],
           "bits": data["proven"]["bits"], "pack": min(g["measures"]["pack_unit"] or 0 for g in data["groups"]),
           "sd": max(g["measures"]["sym_dirichlet_mean"] or 0 for g in data["groups"])}
    if row["faces"] > arguments.faces:
        return row
    sets = {note["mesh"]: note["texcoord"] for note in data["written"]["primitives"]}
    source = arguments.out / f"{name}_textured.glb"
    textured(out, source, sets, any(group["name"].startswith("material") for group in data["groups"]))
    tools = Path(arguments.npm) / "node_modules" / ".bin"
    commands = {
        "gltf-transform": [tools / "gltf-transform", "quantize", source, "OUT", "--pattern", "TEXCOORD_*",
                           "--quantize-texcoord", "12"],
        "gltfpack": [tools / "gltfpack", "-i", source, "-o", "OUT", "-kv", "-km", "-kn", "-vpf"],
    }
    for tool, command in commands.items():
        quantized = arguments.out / f"{name}_{tool}.glb"
        command = [quantized if word == "OUT" else word for word in command]
        done = subprocess.run(command, capture_output=True, text=True, timeout=arguments.limit)
        row[tool] = f"exit {done.returncode}" if done.returncode else survives(arguments, quantized, set(sets.values()))
        quantized.unlink(missing_ok=True)
    source.unlink()
    return row


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("inputs", nargs="+", type=Path)
    parser.add_argument("--judge", required=True, type=Path)
    parser.add_argument("--npm", required=True, type=Path)
    parser.add_argument("--unwrapd", default="target/release/unwrapd")
    parser.add_argument("--out", default=Path("/tmp/unwrapd-quantized"), type=Path)
    parser.add_argument("--bits", type=int, default=12)
    parser.add_argument("--safe-only", action="store_true", help="only the files made with --quantization-safe")
    parser.add_argument("--faces", type=int, default=100_000)
    parser.add_argument("--limit", type=float, default=300)
    arguments = parser.parse_args()
    arguments.out.mkdir(parents=True, exist_ok=True)
    files = [f for i in arguments.inputs for f in (sorted(i.rglob("*")) if i.is_dir() else [i])
             if f.suffix.lower() in MESHES]
    rows = []
    for path in files:
        for safe in (False, True)[arguments.safe_only:]:
            try:
                row = one(arguments, path, safe)
            except subprocess.TimeoutExpired:
                row = {"error": f"not done in {arguments.limit} s"}
            rows.append({"file": f"{path.parent.name}/{path.name}", "safe": safe, **row})
            print(json.dumps(rows[-1]), flush=True)
    for safe in (False, True)[arguments.safe_only:]:
        judged = [r for r in rows if r["safe"] == safe and "gltfpack" in r]
        share = {key: sum(not r[key] for r in judged) for key in ("gltf-transform", "gltfpack")}
        proven = sum(r["safe_bits"] is not None and r["safe_bits"] <= arguments.bits for r in judged)
        print(f"{'--quantization-safe' if safe else 'plain'}: {len(judged)} files; after gltf-transform {share['gltf-transform']}, "
              f"after gltfpack {share['gltfpack']} survive; {proven} proven at {arguments.bits} bits")


if __name__ == "__main__":
    main()
