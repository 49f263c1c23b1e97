#!/usr/bin/env python3
"""Many files by the engines that exist, each with a task killed midway: what came of them, and how fast.

    tests/.venv/bin/python tests/bench/bulk.py --unwrapd target/release/unwrapd [--files 200] [--rings 21]

HyperQueue and Ray come from PyPI (`pip install hyperqueue 'ray[data]'`); one that is absent is left out, and so is the
last, the Python package on Ray, where that is not installed.
RAY_worker_niceness=0 gives its workers the priority of the others. Of those the CPU column knows nothing.
Every file is another closed surface of 80 (RINGS − 1) triangles. The baseline is `xargs -P2 unwrapd unwrap`.
"""

import argparse
import csv
import importlib.util
import math
import os
import resource
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

EXAMPLES = Path(__file__).resolve().parent.parent / "examples" / "bulk"
SEGMENTS = 40
NEEDED = {"hyperqueue": ["hyperqueue"], "ray": ["ray"], "wheel": ["ray", "unwrapd"]}


def bumpy_sphere(number: int, rings: int) -> str:
    """A sphere with bumps that no other number has, as OBJ."""
    points = [(0.0, 0.0, 1.0)]
    for ring in range(1, rings):
        t = math.pi * ring / rings
        for segment in range(SEGMENTS):
            p = 2 * math.pi * segment / SEGMENTS
            r = 1 + 0.25 * math.sin(3 * p + 0.1 * number) * math.sin(2 * t)
            r += 0.15 * math.cos(5 * t + 0.07 * number)
            points.append((r * math.sin(t) * math.cos(p), r * math.sin(t) * math.sin(p), r * math.cos(t)))
    points.append((0.0, 0.0, -1.1))
    at = lambda ring, segment: 2 + (ring - 1) * SEGMENTS + segment % SEGMENTS
    faces = []
    for segment in range(SEGMENTS):
        faces.append((1, at(1, segment), at(1, segment + 1)))
        faces.append((len(points), at(rings - 1, segment + 1), at(rings - 1, segment)))
        for ring in range(1, rings - 1):
            a, b = at(ring, segment), at(ring + 1, segment)
            c, d = at(ring + 1, segment + 1), at(ring, segment + 1)
            faces += [(a, b, c), (a, c, d)]
    lines = ["v %.6f %.6f %.6f" % point for point in points] + ["f %d %d %d" % face for face in faces]
    return "\n".join(lines) + "\n"


def records(out: Path) -> dict[str, tuple[int, int]]:
    """The records of finished assets, with what tells two writings apart."""
    found = {}
    for path in out.glob("**/records/**/*.json"):
        try:
            found[path.name] = (path.stat().st_ino, path.stat().st_mtime_ns)
        except FileNotFoundError:
            pass
    return found


def victims(word: str, out: Path) -> list[int]:
    """Processes whose command begins with a word and that belong to a run."""
    found = []
    for folder in Path("/proc").glob("[0-9]*"):
        try:
            command = (folder / "cmdline").read_bytes().replace(b"\0", b" ").decode()
        except OSError:
            continue
        if command.startswith(word) and (word.startswith("ray::") or str(out) in command):
            found.append(int(folder.name))
    return found


def run(name: str, command: list[str], out: Path, files: int, killed: str | None) -> None:
    """Runs a command, kills one of its processes at a third, and prints a row."""
    begin, before = time.monotonic(), resource.getrusage(resource.RUSAGE_CHILDREN)
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    seen, twice, kills = {}, set(), 0
    while True:
        ended = process.poll() is not None
        for record, inode in records(out).items():
            if seen.setdefault(record, inode) != inode:
                twice.add(record)
        if killed and kills == 0 and len(seen) >= files // 3 and (found := victims(killed, out)):
            os.kill(found[0], signal.SIGKILL)
            kills = 1
        if ended:
            break
        time.sleep(0.1)
    seconds = time.monotonic() - begin
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    cpu = sum(after[:2]) - sum(before[:2])
    there = len(list(out.glob("*.glb")))
    summary = out / "summary.csv"
    rows = list(csv.DictReader(summary.open())) if summary.exists() else []
    certified = sum(row["certified"] == "true" for row in rows)
    print(
        f"| {name} | {kills} | {there} | {certified if rows else '–'} | {len(twice) if rows else '–'} "
        f"| {seconds:.0f} | {cpu:.0f} | {3600 * there / seconds:.0f} | {process.returncode} |",
        flush=True,
    )


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--unwrapd", type=Path, required=True)
    parser.add_argument("--files", type=int, default=200)
    parser.add_argument("--rings", type=int, default=21)
    parser.add_argument("--only", action="append", help="xargs, batch, hyperqueue, ray or wheel; may be repeated")
    given = parser.parse_args()
    unwrapd = str(given.unwrapd.resolve())
    with tempfile.TemporaryDirectory() as folder:
        root = Path(folder)
        (root / "in").mkdir()
        for number in range(given.files):
            (root / "in" / f"{number:04}.obj").write_text(bumpy_sphere(number, given.rings))
        one = 'exec "$0" unwrap "$1" -o "$2/$(basename "$1" .obj).glb" -q --threads 1'
        xargs = f"find {root}/in -name '*.obj' | sort | xargs -P2 -I@ sh -c '{one}' {unwrapd} @ {root}/xargs"
        engine = lambda name: [sys.executable, str(EXAMPLES / f"on_{name}.py"), str(root / "in")]
        batch, mapped = f"{unwrapd} batch", "ray::ReadBinary->Map(unwrapped)"
        (root / "xargs").mkdir()
        runs = {
            "xargs": (["sh", "-c", xargs], None),
            "batch": ([unwrapd, "batch", str(root / "in"), "-o", str(root / "batch"), "--jobs", "2"], None),
            "hyperqueue": (engine("hyperqueue") + [str(root / "hyperqueue"), "--unwrapd", unwrapd], batch),
            "ray": (engine("ray") + [str(root / "ray"), "--unwrapd", unwrapd], "ray::unwrap"),
            "wheel": ([sys.executable, str(EXAMPLES / "wheel_on_ray.py"), str(root / "in"), str(root / "wheel")], mapped),
        }
        print("| engine | killed | outputs | certified | done twice | s | CPU s | assets an hour | exit |")
        print("|---|--:|--:|--:|--:|--:|--:|--:|--:|")
        for name, (command, killed) in runs.items():
            is_there = all(importlib.util.find_spec(package) for package in NEEDED.get(name, []))
            if is_there and (not given.only or name in given.only):
                run(name, command, root / name, given.files, killed)


if __name__ == "__main__":
    main()
