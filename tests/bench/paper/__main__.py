"""The paper's tables and timings on our meshes, beside the published figures and those of the authors' code.

    python3 tests/bench/paper --reference DIR --unwrapd PROGRAM [--only table1,figures,bounded,twist] [--quick]

DIR holds `index.json`, `problems/` and `meshes/`. Needs the Python packages numpy, scipy, casadi (Ipopt) and clarabel. Prints
Markdown tables, each row as soon as it is measured. Seconds are processor seconds of the whole process, reading and writing
included; those of the authors' code are its own. `--quick` runs a small case of every table, to see that all of it still works.
Tables whose packages are absent are skipped.
"""
import argparse
import importlib
import json
import tempfile
from pathlib import Path

# Bars as screws, the turns from which to go on: reference meshes, and one of 240 layers that holds 20 turns.
SCREWS = [("bar_t", "green", 2.0), ("bar_t", "arap", 4.0), ("bar_c", "green", 0.5), ("bar_c", "arap", 0.5), (240, "arap", 20.0)]

# Bars of so many layers and so wide, their turns by dragging one end.
LONG_BARS = [(96, 3, 8, "arap"), (240, 1, 20, "arap")]

# Bars turned seven times and stretched: the mesh beside the problems, the energy, the length over that at rest.
STRETCHED = [(name, energy, factor) for name in ("../data/tet/bar.mesh", "../data/tet/square_beam.mesh", "meshes/bar_t.tet",
                                                 "meshes/bar_f.tet", "meshes/bar_m.tet", "meshes/bar_c.tet")
             for energy in ("green", "symmetric-dirichlet") for factor in (1.3, 1.5)]

# What `--only` says, the module that draws it, and its title.
TABLES = {"figures": ("figures", "Timings of the figures"), "table1": ("table1", "Table 1"),
          "bounded": ("bounded_distortion", "Figure 18"), "twist": ("twist", "Figure 20")}

# The small cases: problems whose names contain one of these.
SMALL_FIGURES = ("woody-hi_pt_bend_arap_spline",)
SMALL_TWISTS = ("bar_c_twist3_arap",)


def parsed():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--reference", type=Path, required=True)
    parser.add_argument("--unwrapd", type=Path, required=True)
    parser.add_argument("--only", default=",".join(TABLES), help="tables, with commas between")
    parser.add_argument("--quick", action="store_true", help="small cases")
    parser.add_argument("--ipopt-seconds", type=float, default=300.0, help="limit of each interior-point run; 0 leaves them out")
    parser.add_argument("--max-iterations", type=int, default=5000, help="limit of the paper's iteration")
    arguments = parser.parse_args()
    arguments.reference, arguments.unwrapd = arguments.reference.resolve(), arguments.unwrapd.resolve()
    arguments.meshes = [("woody-hi", 4844), ("woody-hi-x4", 48881)][:1 if arguments.quick else 2]
    arguments.rings = 6 if arguments.quick else 30
    arguments.turns = [45] if arguments.quick else [45, 90, 135]
    arguments.bounds = [0.9] if arguments.quick else [0.7, 0.9]
    arguments.long_bars = [(12, 1, 1, "arap")] if arguments.quick else LONG_BARS
    arguments.barriers = ("spline", "log") if arguments.quick else ("spline", "auglog", "neohookean", "log")
    arguments.stretched = [("meshes/bar_t.tet", "green", 1.4)] if arguments.quick else STRETCHED
    arguments.screws = [("bar_c", "arap", 1.0)] if arguments.quick else SCREWS
    if arguments.quick:
        arguments.ipopt_seconds, arguments.max_iterations = min(arguments.ipopt_seconds, 1.0), 20
    return arguments


def main():
    arguments = parsed()
    cases = json.loads((arguments.reference / "index.json").read_text())["cases"]
    if arguments.quick:
        cases = [case for case in cases if any(name in case["name"] for name in (*SMALL_FIGURES, *SMALL_TWISTS))]
    only = arguments.only.split(",")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name).resolve()
        for word, (module, title) in TABLES.items():
            if word not in only:
                continue
            try:
                table = importlib.import_module(module)
            except ModuleNotFoundError as error:
                print(f"skipped: {title}: {error}", flush=True)
                continue
            table.main(arguments, cases, folder)


if __name__ == "__main__":
    main()
