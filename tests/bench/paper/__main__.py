"""The paper's tables and timings on our meshes, beside the published figures and those of the authors' code.

    python3 tests/bench/paper --reference DIR --unwrapd PROGRAM [--only table1,figures,bounded,twist] [--quick]

DIR holds `index.json`, `problems/` and `meshes/`. Needs the Python packages numpy, scipy, casadi (Ipopt) and clarabel. Prints
Markdown tables, each row as soon as it is measured. Seconds are processor seconds of the whole process, reading and writing
included; those of the authors' code are its own. `--quick` runs a small case of every table, to see that all of it still works.
"""
import argparse
import json
import tempfile
from pathlib import Path

import bounded_distortion
import figures
import table1
import twist

# Bars as screws, the turns from which to go on: reference meshes, and one of 240 layers that holds 20 turns.
SCREWS = [("bar_t", "green", 2.0), ("bar_t", "arap", 4.0), ("bar_c", "green", 0.5), ("bar_c", "arap", 0.5), (240, "arap", 20.0)]

TABLES = ("table1", "figures", "bounded", "twist")


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
    arguments.long_bars = [] if arguments.quick else [(96, 8, "arap")]
    arguments.screws = [("bar_c", "arap", 1.0)] if arguments.quick else SCREWS
    if arguments.quick:
        arguments.ipopt_seconds, arguments.max_iterations = min(arguments.ipopt_seconds, 1.0), 20
    return arguments


def main():
    arguments = parsed()
    cases = json.loads((arguments.reference / "index.json").read_text())["cases"]
    only = arguments.only.split(",")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name).resolve()
        if "figures" in only:
            figures.main(arguments, cases, folder)
        if "table1" in only:
            table1.main(arguments, cases, folder)
        if "bounded" in only:
            bounded_distortion.main(arguments, folder)
        if "twist" in only:
            twist.main(arguments, cases, folder)


if __name__ == "__main__":
    main()
