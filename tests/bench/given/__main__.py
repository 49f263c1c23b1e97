#!/usr/bin/env python3
"""Files with UVs, stacks and rules for islands, judged from the bytes that unwrapd writes by code that shares none with it.

    python3 tests/bench/given [--unwrapd target/release/unwrapd] [--before OTHER] islands FILE...
    python3 tests/bench/given [--unwrapd target/release/unwrapd] stacks | control | polygons [FILE...]

The interpreter needs numpy and shapely. `islands` compares what the certificate calls each island with an own reading of the
file, and repacks it with the options off, also with the program OTHER; odd UV sets are made here. `stacks` unwraps models whose parts repeat, plants near
misses and overlaps, and finds the parts that coincide again. `control` has one scene per rule. `polygons` counts polygons of OBJ
files, made here or given, that are not written as they were. Exits with 1 if anything is not as it should be.
"""
import argparse
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
import control  # noqa: E402
import islands  # noqa: E402
import polygons  # noqa: E402
import stacks  # noqa: E402
from program import Program  # noqa: E402

SECTIONS = {"islands": islands.run, "stacks": stacks.run, "control": control.run, "polygons": polygons.run}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--unwrapd", default="target/release/unwrapd")
    parser.add_argument("--before")
    parser.add_argument("section", choices=SECTIONS)
    parser.add_argument("files", nargs="*", type=Path)
    arguments = parser.parse_args()
    before = Program(arguments.before) if arguments.before else None
    with tempfile.TemporaryDirectory() as folder:
        faults = SECTIONS[arguments.section](Program(arguments.unwrapd), before, arguments.files, Path(folder))
    print(f"faults: {faults}")
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
