#!/usr/bin/env python3
"""What a bound on the distortion and a price of seams do to atlases of `unwrapd unwrap`: charts, seam and fill, as tables and curves.

    python3 tests/bench/curves.py --judge path/to/uvmetrics.py --unwrapd target/release/unwrapd [--picture P.png] MESH...

JUDGE is a program `JUDGE FILE --json` that prints its measures of a file's UVs. The interpreter needs numpy, and for the picture
matplotlib, from PyPI. Every mesh is unwrapped with each energy under each bound of the mean symmetric Dirichlet energy, with the
default energy also at a price at which no chart is cut for a fuller square; and under the default bound at each price. Seconds
are those of the processors; `spread` is the texel density of charts, p95 over p5 by area. Last: how often each energy kept
its bound, and the largest spread.
"""
import argparse
import math
import statistics
import tempfile
from pathlib import Path

from atlas import ours

ENERGIES = ["symmetric-dirichlet", "arap", "lscm"]
BOUNDS = {4.05: ["--quality", "smooth"], 4.1: ["--quality", "balanced"], 4.5: ["--quality", "few"]}
PRICES = ["0", "0.5", "1", "2", "4", "1000"]
MEASURES = {"charts": "charts", "seam": "seam length / √area", "fill": "share of the square"}
COLORS = ["#1f5fa8", "#d9822b", "#3c9a5f", "#7a869a", "#a05195"]


def series():
    """Per name of a curve its options."""
    curves = {energy: ["--energy", energy] for energy in ENERGIES}
    return curves | {"no cuts for the square": ["--seam-weight", PRICES[-1]]}


def measured(arguments, mesh, options, folder):
    arguments.options = options
    return ours(arguments, mesh, folder)


def show(mesh, curve, place, row):
    print(f"{mesh:20} | {curve:22} | {place:>5} | {row['charts']:4} | {row['seam']:6.2f} | {row['fill']:.3f} | {row['E']:.4f} | "
          f"{row['spread']:.3f} | {row['cpu']:6.2f}", flush=True)


def swept(arguments, mesh, folder):
    """Rows by curve and bound, and by price."""
    bounds, prices = {}, {}
    for curve, options in series().items():
        for bound, words in BOUNDS.items():
            bounds[curve, bound] = measured(arguments, mesh, [*options, *words], folder)
            show(mesh.stem, curve, bound, bounds[curve, bound])
    for price in PRICES:
        prices[price] = measured(arguments, mesh, ["--seam-weight", price], folder)
        show(mesh.stem, "price of a seam", price, prices[price])
    return bounds, prices


def summarize(sweeps):
    print()
    for curve in series():
        rows = [(bound, row) for bounds, _ in sweeps.values() for (name, bound), row in bounds.items() if name == curve]
        kept = sum(row["E"] <= bound for bound, row in rows)
        print(f"{curve}: bound kept {kept} of {len(rows)} times, most over it by {max(row['E'] - bound for bound, row in rows):+.4f}; "
              f"spread of the texel density at most {max(row['spread'] for _, row in rows):.3f}")


def panels(figure, title, places, lines):
    """Three graphs side by side; `lines` holds values by name and measure, at `places`, which are positions and their names."""
    for axis, (measure, label) in zip(figure.subplots(1, len(MEASURES)), MEASURES.items()):
        for (name, values), color in zip(lines.items(), COLORS):
            axis.plot(list(places), values[measure], "o-", color=color, markersize=3.5, label=name if measure == "charts" else None)
        axis.set_xticks(list(places), places.values())
        axis.set_title(label, fontsize=9)
        axis.grid(alpha=0.25)
        if measure != "fill":
            axis.set_ylim(bottom=0)
    figure.supxlabel(title, fontsize=8)
    figure.legend(loc="outside upper center", ncols=len(lines), frameon=False)


def drawn(sweeps, path):
    """Above the bounds, medians over the meshes; below the prices, a line for each mesh."""
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    plt.rcParams.update({"font.size": 8, "axes.spines.top": False, "axes.spines.right": False})
    canvas = plt.figure(figsize=(9, 5.6), layout="constrained")
    above, below = canvas.subfigures(2, hspace=0.06)
    middle = {curve: {m: [statistics.median(bounds[curve, b][m] for bounds, _ in sweeps.values()) for b in BOUNDS] for m in MEASURES}
              for curve in series()}
    panels(above, f"bound on the mean symmetric Dirichlet energy (medians of {len(sweeps)} meshes)",
           {math.log(b - 4): f"{b:g}" for b in BOUNDS}, middle)
    by_mesh = {mesh: {m: [prices[p][m] for p in PRICES] for m in MEASURES} for mesh, (_, prices) in sweeps.items()}
    panels(below, "price of a seam", dict(enumerate(PRICES)), by_mesh)
    canvas.savefig(path, dpi=120)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("meshes", nargs="+", type=Path)
    parser.add_argument("--judge", required=True, type=Path)
    parser.add_argument("--unwrapd", default="target/release/unwrapd")
    parser.add_argument("--picture", type=Path)
    arguments = parser.parse_args()
    print("mesh | curve | bound or price | charts | seam | fill | E | spread | cpu s")
    with tempfile.TemporaryDirectory() as folder:
        sweeps = {mesh.stem: swept(arguments, mesh, Path(folder)) for mesh in arguments.meshes}
    summarize(sweeps)
    if arguments.picture:
        drawn(sweeps, arguments.picture)


if __name__ == "__main__":
    main()
