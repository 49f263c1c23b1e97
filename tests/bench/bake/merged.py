#!/usr/bin/env python3
"""glTF files of several materials and what `unwrapd unwrap --merge-materials all` makes of them, as three.js renders both.

    python3 tests/bench/bake/merged.py [--unwrapd target/release/unwrapd] [--pictures FOLDER] FILE...

Needs node, chromium and `npm install` in tests/render. Prints for each file PSNR over the pixels where the asset is seen, from one
camera with one light; the materials that surfaces use before and after, and how many stay apart; the draw calls of the file by
the report, and those of three.js, which leaves out what the camera does not see; and the sides of the textures.
"""
import argparse
import json
import math
import struct
import subprocess
import tempfile
from pathlib import Path

RENDERER = Path(__file__).parents[2] / "render" / "compare.mjs"


def merged(unwrapd, path, out):
    """The report on a file."""
    report = out.with_suffix(".json")
    command = [unwrapd, "unwrap", path, "-o", out, "--merge-materials", "all", "--report", report]
    subprocess.run(command, capture_output=True, check=True)
    return json.loads(report.read_text())


def rendered(pairs, pictures):
    text = "".join(f"{before}\t{after}\n" for before, after in pairs)
    command = ["node", RENDERER] + ([pictures] if pictures else [])
    done = subprocess.run(command, input=text, capture_output=True, text=True, check=True)
    return [json.loads(line) for line in done.stdout.splitlines()]


def materials(path):
    """The number of materials that surfaces of a glTF use; none counts as one."""
    data = path.read_bytes()
    if data[:4] == b"glTF":
        data = data[20:20 + struct.unpack_from("<I", data, 12)[0]]
    meshes = json.loads(data)["meshes"]
    return len({p.get("material") for mesh in meshes for p in mesh["primitives"] if p.get("mode", 4) >= 4})


def row(paths, report, answer):
    before, after = paths
    if "error" in answer:
        return f"{before.stem:40} | {answer['error']}"
    note = report["written"]["merged"]
    db = answer["db"] if answer["db"] is not None else math.inf
    numbers = f"{materials(before)} → {materials(after)} | {len(note['apart'])}"
    calls = f"{note['draw_calls_before']} → {note['draw_calls_after']} | {answer['calls'][0]} → {answer['calls'][1]}"
    sides = sorted({texture["texture"]: texture["side"] for texture in report["written"]["textures_baked"]}.values())
    return f"{before.stem:40} | {db:6.2f} | {numbers} | {calls} | {' '.join(map(str, sides))}"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("files", nargs="+", type=Path)
    parser.add_argument("--unwrapd", default="target/release/unwrapd")
    parser.add_argument("--pictures", type=Path)
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        outs = [Path(folder) / f"{number}.glb" for number in range(len(arguments.files))]
        reports = [merged(arguments.unwrapd, path, out) for path, out in zip(arguments.files, outs)]
        pairs = [(path.resolve(), out) for path, out in zip(arguments.files, outs)]
        answers = rendered(pairs, arguments.pictures)
        print("file | PSNR in dB | materials | apart | draw calls of the file | of three.js | sides of textures")
        for paths, report, answer in zip(pairs, reports, answers):
            print(row(paths, report, answer))


if __name__ == "__main__":
    main()
