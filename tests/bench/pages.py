#!/usr/bin/env python3
"""Unwraps each mesh on 1 to 10 pages: more pages never give less density.

    python3 tests/bench/pages.py --unwrapd target/release/unwrapd [--pages 10 --jobs 2] MESH...

Per mesh and number of pages: texels to a unit of length, charts, and CPU seconds of the process, which has one thread. A density
below that on fewer pages is marked by how much is lost; the exit code is 1 if there is any, or a run that fails.
"""
import argparse
import json
import os
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path


def density(unwrapd, mesh, pages):
    """Texels to the unit and charts of the first group, and CPU seconds; none where the run fails."""
    with tempfile.TemporaryDirectory() as folder:
        report = Path(folder) / "report.json"
        command = [unwrapd, "unwrap", mesh, "-o", f"{folder}/mesh.glb", "--report", report, "--pages", str(pages), "--threads", "1"]
        process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        _, status, used = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        if process.returncode:
            return None
        group = json.loads(report.read_text())["groups"][0]
        return group["texels_per_unit"], group["measures"]["charts"], used.ru_utime + used.ru_stime


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--unwrapd", required=True)
    parser.add_argument("--pages", type=int, default=10)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("meshes", nargs="+", type=Path)
    args = parser.parse_args()
    numbers = range(1, args.pages + 1)
    falls = failed = 0
    with ThreadPoolExecutor(args.jobs) as pool:
        for path in args.meshes:
            cells, most = [], 0.0
            for done in pool.map(lambda pages: density(args.unwrapd, path, pages), numbers):
                if done is None:
                    failed += 1
                    cells.append("failed")
                    continue
                texels, charts, seconds = done
                lost = f" -{1 - texels / most:.2%}" if texels < most else ""
                falls += bool(lost)
                most = max(most, texels)
                cells.append(f"{texels:.6g} ({charts}, {seconds:.1f} s){lost}")
            print(f"{path.stem:20}", " | ".join(cells), flush=True)
    print(f"falls: {falls}, failed: {failed}")
    return int(falls + failed > 0)


sys.exit(main())
