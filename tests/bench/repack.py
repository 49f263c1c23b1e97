#!/usr/bin/env python3
"""Packs the islands of files with `unwrapd repack` and judges the written UVs.

    python3 tests/bench/repack.py --judge path/to/uvmetrics.py --unwrapd target/release/unwrapd FILE... [-- --rotate quarter]

JUDGE is a program `JUDGE FILE --json` that prints its measures of a file's UVs, and a module whose `load` reads them. Files are
OBJ or glTF with UVs. What stands after `--` goes to unwrapd.

Per file: islands, share of the square before and after, smallest gap of two islands in texels at 1024 before and after, seconds
of the processor, faults (faces flipped or without area, pairs that overlap), and what is not similar: for each island the
similarity that maps its UVs to those of the result best, all with one scale; the corners that lie farther from there than half a
step of the grid of 2^-23 along u or v, and the largest distance in steps.
"""
import argparse
import importlib.util
import json
import resource
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

STEP = 2.0**-23
# What the angle and the scale that are found may be wrong by, in steps at the ends of an island.
ROUNDED = 0.1


def judged(judge, path):
    out = subprocess.run([sys.executable, judge, path, "--json"], capture_output=True, text=True, check=False)
    return json.loads(out.stdout)


def repacked(unwrapd, path, out, options):
    """Seconds of the processor; None if there is no file."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run([unwrapd, "repack", path, "-o", out, *options], capture_output=True, check=False)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return seconds if Path(out).exists() else None


def islands(faces, uv):
    """For each face the number of its island: faces that have a corner in common, with the same UV."""
    _, corner = np.unique(np.column_stack([faces.reshape(-1), uv.reshape(-1, 2)]), axis=0, return_inverse=True)
    corner = corner.reshape(-1, 3)
    label = np.arange(corner.max() + 1)
    while True:
        least = label[corner].min(axis=1)
        new = label.copy()
        np.minimum.at(new, corner.reshape(-1), np.repeat(least, 3))
        new = new[new]
        if (new == label).all():
            return np.unique(label[corner[:, 0]], return_inverse=True)[1]
        label = new


def dissimilar(faces, before, after):
    """Corners that are not where the similarity of their island has them, and the largest distance in steps."""
    island = islands(faces, before)
    numbers = before[..., 0] + 1j * before[..., 1], after[..., 0] + 1j * after[..., 1]
    fits = []
    for k in range(island.max() + 1):
        p, q = (x[island == k].reshape(-1) for x in numbers)
        p, q = p - p.mean(), q - q.mean()
        size = np.vdot(p, p).real
        fits.append((p, q, np.vdot(p, q) / size if size > 0 else 0, size))
    total = sum(size for *_, size in fits)
    scale = sum(abs(turn) * size for *_, turn, size in fits) / total
    far = []
    for p, q, turn, _ in fits:
        left = (q - (scale * turn / abs(turn) if turn else 0) * p) / STEP
        for along in (left.real, left.imag):
            far.append(abs(along - (along.min() + along.max()) / 2))
    far = np.maximum(np.concatenate(far[::2]), np.concatenate(far[1::2]))
    return int((far > 0.5 + ROUNDED).sum()), float(far.max())


def main():
    arguments = sys.argv[1:]
    split = arguments.index("--") if "--" in arguments else len(arguments)
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--judge", required=True)
    parser.add_argument("--unwrapd", required=True)
    parser.add_argument("files", nargs="+")
    options = parser.parse_args(arguments[:split])
    spec = importlib.util.spec_from_file_location("judge", options.judge)
    judge = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(judge)
    gains = []
    print("file | islands | fill before | after | gap before | after | cpu s | faults | dissimilar | steps")
    for path in options.files:
        with tempfile.TemporaryDirectory() as folder:
            out = str(Path(folder) / f"out{Path(path).suffix}")
            seconds = repacked(options.unwrapd, path, out, arguments[split + 1 :])
            if seconds is None:
                print(f"{Path(path).name} | not written")
                continue
            old, new = judged(options.judge, path), judged(options.judge, out)
            if "pack_unit" not in new:
                print(f"{Path(path).name} | several atlases or no UVs")
                continue
            (_, _, faces, before), (_, _, _, after) = (judge.load(file)[0] for file in (path, out))
            n_far, farthest = dissimilar(faces, before, after)
        gaps = [measures.get("gap_texels_1024") for measures in (old, new)]
        faults = [new[key] for key in ("flipped", "uv_degenerate", "overlap_pairs_exact")]
        gains.append(new["pack_unit"] - (old["pack_unit"] or 0))
        shown = [f"{x:.2f}" if x is not None else "-" for x in gaps]
        fill = [f"{x:.3f}" if x is not None else "-" for x in (old["pack_unit"], new["pack_unit"])]
        print(f"{Path(path).name} | {new['charts']} | {' | '.join(fill)} | {' | '.join(shown)} | {seconds:.2f} | "
              f"{'+'.join(map(str, faults))} | {n_far} | {farthest:.2f}")
    if gains:
        print(f"median gain {statistics.median(gains):.3f}")


if __name__ == "__main__":
    main()
