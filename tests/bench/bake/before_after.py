#!/usr/bin/env python3
"""Textured glTF files and what `unwrapd unwrap --rebake` makes of them, as three.js renders both.

    python3 tests/bench/bake/before_after.py [--unwrapd target/release/unwrapd] [--pictures FOLDER] FILE...

Needs node, chromium and `npm install` in tests/render. Prints for each file the mean difference of a channel where the asset is
seen, of 255, and over the whole picture; how many textures were resampled, and how large; and the seconds that this took.
"""
import argparse
import json
import statistics
import subprocess
import tempfile
from pathlib import Path

RENDERER = Path(__file__).parents[2] / "render" / "compare.mjs"


def rebaked(unwrapd, path, out):
    """The report, or none of a file that has nothing to unwrap."""
    report = out.with_suffix(".json")
    done = subprocess.run([unwrapd, "unwrap", path, "-o", out, "--rebake", "--report", report], capture_output=True)
    return json.loads(report.read_text()) if done.returncode == 0 else None


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("files", nargs="+", type=Path)
    parser.add_argument("--unwrapd", default="target/release/unwrapd")
    parser.add_argument("--pictures", type=Path)
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        pairs = []
        for number, path in enumerate(arguments.files):
            out = Path(folder) / f"{number}.glb"
            report = rebaked(arguments.unwrapd, path, out)
            if report and report["written"]["textures_baked"]:
                pairs.append((path.resolve(), out, report))
        text = "".join(f"{before}\t{after}\n" for before, after, _ in pairs)
        command = ["node", RENDERER] + ([arguments.pictures] if arguments.pictures else [])
        done = subprocess.run(command, input=text, capture_output=True, text=True, check=True)
    print("file | mean difference where seen | of the picture | textures | seconds")
    means = []
    for (path, _, report), line in zip(pairs, done.stdout.splitlines()):
        answer = json.loads(line)
        means.append(answer["mean"] / answer["covered"])
        sides = sorted({texture["texture"]: texture["side"] for texture in report["written"]["textures_baked"]}.values())
        print(f"{path.stem:40} | {means[-1]:.3f} | {answer['mean']:.3f} | {' '.join(map(str, sides))} | {report['seconds']['bake']:.2f}")
    print(f"{len(means)} files, where seen: median {statistics.median(means):.3f}, most {max(means):.3f}")


if __name__ == "__main__":
    main()
