#!/usr/bin/env python3
"""Sets least-squares conformal maps of `unwrapd unwrap` beside libigl's of the same disks and pins.

    python3 tests/bench/lscm.py [--program FILE] FILE... [-- OPTION...]

Needs numpy and libigl from PyPI. Each disk is mapped with `--cut disk --energy lscm --pin 2` and the options after `--`; overlaps
are not cut. libigl holds the same two vertices at the same places. Prints the conformal energy ½ Σ A (σ₁ − σ₂)², over the area of
the map, of both, their ratio, the flipped triangles of each, and processor seconds.
"""
import argparse
import resource
import subprocess
import sys
import tempfile
from pathlib import Path

import igl
import numpy as np

ROOT = Path(__file__).resolve().parents[2]


def processor(who):
    usage = resource.getrusage(who)
    return usage.ru_utime + usage.ru_stime


def read(path):
    """Positions and texture coordinates of the mapped vertices of an OBJ, and its triangles with an area in space."""
    rows = {"v": [], "vt": [], "f": []}
    for line in Path(path).read_text().splitlines():
        kind, *fields = line.split() or [""]
        if kind == "f":
            rows["f"].append([[int(index) - 1 for index in field.split("/")[:2]] for field in fields])
        elif kind in rows:
            rows[kind].append([float(field) for field in fields])
    corners = np.array(rows["f"]).reshape(-1, 2)
    pairs, triangles = np.unique(corners, axis=0, return_inverse=True)
    triangles = triangles.reshape(-1, 3)
    positions = np.array(rows["v"])[pairs[:, 0]]
    a, b, c = (positions[triangles[:, k]] for k in range(3))
    has_area = np.linalg.norm(np.cross(b - a, c - a), axis=1) > 0
    return positions, np.array(rows["vt"])[pairs[:, 1]], triangles[has_area]


def jacobians(positions, uv, triangles):
    """Jacobians, and the areas at rest."""
    a, b, c = (positions[triangles[:, k]] for k in range(3))
    length = np.linalg.norm(b - a, axis=1)
    x = ((b - a) * (c - a)).sum(1) / length
    height = np.linalg.norm(np.cross(b - a, c - a), axis=1) / length
    first = (uv[triangles[:, 1]] - uv[triangles[:, 0]]) / length[:, None]
    second = (uv[triangles[:, 2]] - uv[triangles[:, 0]] - first * x[:, None]) / height[:, None]
    return np.stack([first, second], axis=2), length * height / 2


def measured(positions, uv, triangles):
    """The conformal energy over the area of the map, and the flipped triangles."""
    jacobian, area = jacobians(positions, uv, triangles)
    det = np.linalg.det(jacobian)
    conformal = 0.5 * ((jacobian**2).sum((1, 2)) - 2 * det)
    return (area * conformal).sum() / (area * det).sum(), int((det <= 0).sum())


def pins(positions, uv, triangles):
    """The two vertices at which the gradient of the conformal energy is greatest: at its minimum it vanishes at all others."""
    gradient = -igl.cotmatrix(positions, triangles) @ uv
    turned = 0.5 * np.stack([uv[:, 1], -uv[:, 0]], axis=1)
    for k in range(3):
        here, there = triangles[:, k], triangles[:, (k + 1) % 3]
        np.subtract.at(gradient, here, turned[there])
        np.add.at(gradient, there, turned[here])
    return np.argsort(-np.linalg.norm(gradient, axis=1))[:2]


def main():
    arguments, options = sys.argv[1:], []
    if "--" in arguments:
        at = arguments.index("--")
        arguments, options = arguments[:at], arguments[at + 1 :]
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", default=str(ROOT / "target/release/unwrapd"))
    parser.add_argument("disks", nargs="+", metavar="FILE")
    given = parser.parse_args(arguments)
    print(f"{'disk':24} {'ours':>10} {'libigl':>10} {'ratio':>7} {'flips':>11} {'CPU s':>11}")
    for disk in given.disks:
        with tempfile.TemporaryDirectory() as folder:
            written = f"{folder}/map.obj"
            command = [given.program, "unwrap", disk, "-o", written, "--cut", "disk", "--energy", "lscm", "--pin", "2"]
            before = processor(resource.RUSAGE_CHILDREN)
            subprocess.run(command + options, capture_output=True, check=False)
            seconds = processor(resource.RUSAGE_CHILDREN) - before
            positions, uv, triangles = read(written)
        ours, flips = measured(positions, uv, triangles)
        held = pins(positions, uv, triangles)
        before = processor(resource.RUSAGE_SELF)
        try:
            theirs = igl.lscm(positions, triangles, held, uv[held])
        except RuntimeError:
            print(f"{Path(disk).name:24} {ours:10.3e} libigl fails; flips {flips}, CPU s {seconds:.2f}")
            continue
        seconds_igl = processor(resource.RUSAGE_SELF) - before
        energy, flips_igl = measured(positions, theirs[0] if isinstance(theirs, tuple) else theirs, triangles)
        print(
            f"{Path(disk).name:24} {ours:10.3e} {energy:10.3e} {ours / energy:7.4f} {flips:5}/{flips_igl:5}"
            f" {seconds:5.2f}/{seconds_igl:5.2f}"
        )


if __name__ == "__main__":
    main()
