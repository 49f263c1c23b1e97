"""glTF-Transform's unmodified `unwrap` with watlas and with unwrapd, and unwrapd's own transform, over glTF files.

    npm install --prefix DIR PACKAGE.tgz watlas @gltf-transform/{core,extensions,functions}
    python tests/bench/gltf_transform.py --packages DIR --metrics DIR_OF_UVMETRICS FILE…

PACKAGE.tgz is what `src/node/pack` makes. Each file is unwrapped by each in a process of its own, one atlas for a mesh,
and judged by uvmetrics, which shares no code with any of them: charts, mean symmetric Dirichlet energy (an isometry
has 4), seconds of the call, and faults of validity.
"""

import argparse
import json
import os
import pathlib
import re
import statistics
import subprocess
import sys
import tempfile

LIBRARIES = {"watlas": "`unwrap` with watlas", "unwrapd": "`unwrap` with unwrapd", "transform": "`unwrapd()`"}
FAULTS = ("flipped", "uv_degenerate", "uv_collapsed", "overlap_pairs")
SCRIPT = pathlib.Path(__file__).with_suffix(".mjs")


def judged(library, path, arguments):
    """What a library makes of a file: its charts, energy and faults, or why there is none."""
    with tempfile.TemporaryDirectory() as folder:
        out = f"{folder}/out.glb"
        environment = {**os.environ, "PACKAGES": str(arguments.packages.resolve())}
        command = ["node", "--no-warnings", SCRIPT, library, path, out]
        kept = {"capture_output": True, "text": True}
        try:
            made = subprocess.run(command, env=environment, timeout=arguments.timeout, **kept)
        except subprocess.TimeoutExpired:
            return {"failed": "timeout"}
        if made.returncode != 0:
            lines = [line for line in made.stderr.splitlines() if re.match(r"\w*Error: ", line)]
            return {"failed": lines[0][:60] if lines else f"exit {made.returncode}"}
        judge = [sys.executable, arguments.metrics / "uvmetrics.py", out, "--group-by", "mesh", "--json"]
        try:
            found = subprocess.run([*judge, "--res", "512"], timeout=arguments.timeout, check=True, **kept)
        except subprocess.SubprocessError:
            return {"failed": "not judged"}
        return {**json.loads(found.stdout), "seconds": float(made.stdout.split()[-1])}


def groups(found):
    """The judgments of the meshes that have faces."""
    every = [found] if "faces" in found else [group for group in found.values() if isinstance(group, dict)]
    return [group for group in every if "flipped" in group]


def cell(found):
    if "failed" in found:
        return found["failed"]
    faults = sum(group[name] for group in groups(found) for name in FAULTS)
    energies = [group["sym_dirichlet_mean"] for group in groups(found) if group["sym_dirichlet_mean"] is not None]
    energy = f"{statistics.mean(energies):.3f}" if energies else "–"
    return f"{charts(found)} / {energy} / {found['seconds']:.2f} s / {faults or 'valid'}"


def charts(found):
    return sum(group["charts"] for group in groups(found))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--packages", required=True, type=pathlib.Path)
    parser.add_argument("--metrics", required=True, type=pathlib.Path)
    parser.add_argument("--timeout", type=float, default=120.0, help="seconds for a call, and for its judgment")
    parser.add_argument("files", nargs="+")
    arguments = parser.parse_args()
    print(f"| file | {' | '.join(LIBRARIES.values())} |\n|---|{'---|' * len(LIBRARIES)}")
    ratios = []
    for path in arguments.files:
        rows = {library: judged(library, path, arguments) for library in LIBRARIES}
        print(f"| {pathlib.Path(path).name} | {' | '.join(map(cell, rows.values()))} |", flush=True)
        theirs, ours = rows["watlas"], rows["unwrapd"]
        if "failed" not in theirs and "failed" not in ours and charts(theirs):
            ratios.append(charts(ours) / charts(theirs))
    if ratios:
        print(f"\ncharts over those of watlas: {statistics.median(ratios):.3f} at the median of {len(ratios)}")


if __name__ == "__main__":
    main()
