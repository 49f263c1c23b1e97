#!/usr/bin/env python3
"""What the number of cone singularities does to one-chart maps of `unwrapd unwrap --cut disk`, judged from the written files.

    python3 tests/bench/cones.py --judge path/to/uvmetrics.py --unwrapd target/release/unwrapd MESH...

JUDGE is a program `JUDGE FILE --json` that prints its measures of a file's UVs. Each mesh is mapped with the default energy, and with
the least-squares conformal energy and two pins. Per number of cones: charts, seam length over √area, mean symmetric Dirichlet energy
(4 is isometric), mean and 99th percentile of the conformal distortion σ₁/σ₂, flipped triangles, and seconds of the processor.
The row without a number is that of `cut` disk alone.
"""
import argparse
import tempfile
from pathlib import Path

from packers import timed

CONES = [None, 2, 4, 8, 16, 32, 64]
ENERGIES = {"default": [], "lscm": ["--energy", "lscm", "--pin", "2"]}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--judge", required=True)
    parser.add_argument("--unwrapd", required=True)
    parser.add_argument("meshes", nargs="+")
    options = parser.parse_args()
    from packers import module

    judge = module(options.judge)
    print("mesh | energy | cones | charts | seam | E | σ₁/σ₂ mean, p99 | flipped | cpu s", flush=True)
    for mesh in options.meshes:
        for name, energy in ENERGIES.items():
            for n in CONES:
                with tempfile.TemporaryDirectory() as folder:
                    out = f"{folder}/out.obj"
                    cones = [] if n is None else ["--cones", str(n)]
                    done, seconds = timed([options.unwrapd, "unwrap", mesh, "-o", out, "--cut", "disk", *cones, *energy])
                    row = f"{Path(mesh).name} | {name} | {n or '-'}"
                    if not Path(out).exists():
                        print(f"{row} | {done.stderr.strip().splitlines()[-1]}", flush=True)
                        continue
                    it = judge.evaluate(*judge.load(out)[0][1:], raster=False, pairs=False, gaps=False)
                print(f"{row} | {it['charts']} | {it['seam_length'] / it['area_3d'] ** 0.5:.2f} | {it['sym_dirichlet_mean']:.3f} | "
                      f"{it['conformal_mean']:.3f} {it['conformal_p99']:.3f} | {it['flipped']} | {seconds:.2f}", flush=True)


if __name__ == "__main__":
    main()
