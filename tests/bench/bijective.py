#!/usr/bin/env python3
"""Problems of the plane solved with and without `bijective`: crossings of the boundary, targets, work.

    python3 tests/bench/bijective.py --reference DIR --unwrapd PROGRAM [NAME...]

DIR holds `problems/`; NAME is part of a problem's name, by default those in which arms and legs, or left and right, swap
places. Crossings are counted exactly on the positions that were written. Exits with 1 if one is left with `bijective`.
"""
import argparse
import json
import math
import sys
import tempfile
from pathlib import Path

from paper.problems import solve


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--reference", type=Path, required=True)
    parser.add_argument("--unwrapd", required=True)
    parser.add_argument("--limit", default="300", help="seconds for each problem")
    parser.add_argument("names", nargs="*", default=["swapAL_arap_spline", "swapLR_arap_spline"])
    arguments = parser.parse_args()
    problems = sorted((arguments.reference / "problems").glob("woody*.json"))
    left = 0
    print("problem | free: crossings | it | CPU s | bijective: crossings | status | farthest of way | E | it | fact | CPU s")
    with tempfile.TemporaryDirectory() as folder:
        for path in problems:
            if not any(name in path.stem for name in arguments.names):
                continue
            problem = json.loads(path.read_text())
            for key in ("mesh", "initial"):
                if problem.get(key):
                    problem[key] = str((path.parent / problem[key]).resolve())
            rows = []
            for bijective in (False, True):
                copy = Path(folder) / path.name
                copy.write_text(json.dumps({**problem, "bijective": bijective}))
                report, positions, seconds = solve(
                    arguments.unwrapd, copy, Path(folder), "--time-budget", arguments.limit)
                x = [[float(w) for w in line.split()] for line in positions.read_text().splitlines()]
                away = max(math.dist(x[v], t[:2]) for v, t in zip(problem["handles"], problem["targets"]))
                rows.append((report, seconds, away))
            (free, free_seconds, _), (kept, seconds, away) = rows
            left += kept["crossings"]
            print(f"{path.stem} | {free['crossings']} | {free['iterations']} | {free_seconds:.2f} | "
                  f"{kept['crossings']} | {kept['status']} | {away:.3g} | {kept['energy']:.6g} | {kept['iterations']} | "
                  f"{kept['factorizations']} | {seconds:.2f}", flush=True)
    return 1 if left else 0


if __name__ == "__main__":
    sys.exit(main())
