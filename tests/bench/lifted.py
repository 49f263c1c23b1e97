#!/usr/bin/env python3
"""Solves the example inputs of three other programs for maps without inversions and judges the maps: lifted.py BINARY INPUT...

The repositories are duxingyi-charles/lifting_simplices_to_find_injectivity, Total-Lifted-Content-PN and
Constrained-Injective-Mappings; their inputs are the files named `input` under `example`, which are not copied here. Each has a rest
mesh, a map of it, the elements, and the vertices that are held where the map has them. `solve` minimizes the symmetric Dirichlet
energy from that map. A surface in space, which `solve` does not take at rest, is untangled as it lies in the plane, with the rest
shapes that its positive elements imply.

Solved means exit status 0, every held vertex in place and every signed size positive. Inputs of equal bytes are run once. Prints a
row per input. Needs NumPy.
"""
import argparse
import os
import pathlib
import subprocess
import tempfile

import numpy as np
from held import sizes, write


def read(path):
    """Rest positions, positions, elements and held vertices."""
    numbers, tables, at = path.read_text().split(), [], 0
    for _ in range(3):
        rows, columns = map(int, numbers[at : at + 2])
        at += 2 + rows * columns
        tables.append(np.array(numbers[at - rows * columns : at], float).reshape(rows, columns))
    rest, x, elements = tables
    return rest, x, elements.astype(int), np.array(numbers[at + 1 : at + 1 + int(numbers[at])], int)


def run(binary, folder, rest, x, elements, held):
    """Exit status, CPU seconds and positions, None without."""
    command = [binary, "solve", folder / "p.json"]
    if rest.shape[1] == x.shape[1]:
        write(folder, rest, elements, held, x[held], x)
    else:
        write(folder, x, elements, held, x[held], None)
        command = [binary, "untangle", folder / "m.obj"]
    command += ["-o", folder / "x.txt", "-q", "--threads", "1"]
    child = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    _, status, used = os.wait4(child.pid, 0)
    found = folder / "x.txt"
    found = np.loadtxt(found)[:, : x.shape[1]] if found.exists() else None
    return os.waitstatus_to_exitcode(status), used.ru_utime + used.ru_stime, found


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("binary")
    parser.add_argument("inputs", nargs="+", type=pathlib.Path)
    args = parser.parse_args()
    known, solved = set(), 0
    print("input | elements | held | inverted | inverted after | CPU s | result")
    for path in args.inputs:
        if (content := path.read_bytes()) in known:
            continue
        known.add(content)
        rest, x, elements, held = read(path)
        if rest.shape[1] == x.shape[1]:
            # Some inputs have the corners of all elements in the opposite order.
            turned = sizes(rest, elements) < 0
            elements[turned, -2:] = elements[turned, :-3:-1]
        with tempfile.TemporaryDirectory() as folder:
            code, cpu, found = run(args.binary, pathlib.Path(folder), rest, x, elements, held)
        before, after = (sizes(x, elements) <= 0).sum(), "-"
        wrong = [f"exit {code}"] * (code != 0)
        if found is not None:
            after = (sizes(found, elements) <= 0).sum()
            off = np.abs(found[held] - x[held]).max() / np.ptp(x, axis=0).max()
            wrong += ["inverted"] * bool(after) + [f"held off by {off:.1e}"] * bool(off > 1e-9)
        solved += not wrong
        print(f"{path} | {len(elements)} | {len(held)} | {before} | {after} | {cpu:.2f} | {', '.join(wrong) or 'solved'}", flush=True)
    print(f"{solved} of {len(known)} solved")


if __name__ == "__main__":
    main()
