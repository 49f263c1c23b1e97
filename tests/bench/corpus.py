#!/usr/bin/env python3
"""Unwraps every mesh below the given folders, in both modes, and has an independent judge look at what was written.

    python3 tests/bench/corpus.py --judge path/to/uvmetrics.py --out /tmp/corpus DIR|FILE...

The judge is a program `JUDGE FILE --texcoord N --group-by mesh --json` that prints its measures as JSON. Prints a line
per file and mode and a summary; exits with 1 if any output is missing, loses a face, or has a flipped, degenerate or
collapsed one, if faces overlap (with `disk`, of two charts), if a chart is mirrored, if charts are nearer than the padding of 2
texels at 1024, if the judge cannot read it, if the report and the judge differ by more than 1e-3, if a run takes
longer than --slow seconds, or if it is killed at the limit. A judge that crashes says nothing about what it was given: the line and the
summary tell it apart. On a busy machine the processors' seconds say more than those of the wall.
"""
import argparse
import json
import math
import os
import statistics
import subprocess
import sys
import threading
import time
from pathlib import Path

PADDING = 2  # texels at 1024: the default of the command
MESHES = {".glb", ".gltf", ".obj", ".off", ".ply", ".stl"}
COMPARED = """area_3d area_uv seam_length boundary_length L2_stretch Linf_stretch conformal_mean conformal_p99
conformal_max area_dist_mean area_dist_p99 area_dist_max sym_dirichlet_mean sym_dirichlet_median sym_dirichlet_p99
sym_dirichlet_max arap_mean density_p95_over_p5 pack_unit pack_square pack_rect gap_texels_1024""".split()
COUNTED = """faces charts seam_edges flipped uv_degenerate uv_collapsed faces_degenerate_3d mirrored_charts
overlap_pairs_exact edges_nonmanifold""".split()


def run(command, limit):
    """Exit status (negative if killed, as at the limit), seconds, those of the processors, peak memory in MiB, standard
    error."""
    begin = time.perf_counter()
    child = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    alarm = threading.Timer(limit, child.kill)
    alarm.start()
    error = child.stderr.read()
    _, status, usage = os.wait4(child.pid, 0)
    alarm.cancel()
    child.returncode = os.waitstatus_to_exitcode(status)
    seconds, cpu = time.perf_counter() - begin, usage.ru_utime + usage.ru_stime
    return child.returncode, seconds, cpu, usage.ru_maxrss / 1024, error.strip().splitlines()


def judge(program, path, texcoord, group_by, *options):
    command = [sys.executable, program, path, "--texcoord", str(texcoord), "--group-by", group_by, "--json",
               *options]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode == 2:
        return {"error": done.stderr.strip()}
    try:
        return json.loads(done.stdout)
    except json.JSONDecodeError:
        return {"crash": (done.stderr.strip() or "no output").splitlines()[-1]}


def differences(ours, theirs):
    """Keys on which the report and the judge disagree."""
    found = [k for k in COUNTED if k in theirs and ours.get(k) != theirs[k]]
    for key in COMPARED:
        a, b = ours.get(key), theirs.get(key)
        if (a is None) != (b is None):
            found.append(key)
        elif a is not None and not math.isclose(a, b, rel_tol=1e-3, abs_tol=1e-9):
            found.append(key)
    return found


def one(arguments, path, mode):
    name = f"{path.parent.name}_{path.stem}_{mode}".replace(" ", "_")
    suffix = ".obj" if path.suffix.lower() == ".obj" else ".glb"
    out, report = arguments.out / (name + suffix), arguments.out / (name + ".json")
    for old in (out, report):
        old.unlink(missing_ok=True)
    command = [arguments.unwrapd, "unwrap", path, "-o", out, "--cut", mode, "--report", report]
    if path.suffix.lower() in (".glb", ".gltf"):
        command += ["--group-by", "mesh"]  # as the judge does
    status, seconds, cpu, memory, error = run(command, arguments.limit)
    row = {"file": str(path), "mode": mode, "exit": status, "seconds": seconds, "cpu": cpu, "mib": memory}
    if status != 0:
        row["error"] = error[-1] if error else ""
        return row
    verified = subprocess.run([arguments.unwrapd, "verify", out, *texcoords(report)], capture_output=True, text=True)
    row["verify"] = verified.returncode
    data = json.loads(report.read_text())
    sums = dict.fromkeys(
        ["faces", "charts", "flipped", "uv_degenerate", "uv_collapsed", "overlap_pairs_exact", "overlap_pairs_between_charts",
         "mirrored_charts", "winding_inconsistent_faces"], 0)
    row["differs"] = []
    row["iterations"] = sum(c["iterations"] for g in data["groups"] for c in g["atlas"]["charts"])
    row["factorizations"] = sum(c["factorizations"] for g in data["groups"] for c in g["atlas"]["charts"])
    row["solver_seconds"] = sum(c["seconds"] for g in data["groups"] for c in g["atlas"]["charts"])
    row["components"] = sum(g["defects"]["components"] for g in data["groups"])
    judged = {}
    for group in data["groups"]:
        texcoord = set_of(data, group["name"])
        if texcoord not in judged:
            judged[texcoord] = judge(arguments.judge, out, texcoord, "mesh")
        theirs = judged[texcoord]
        theirs = theirs if "faces" in theirs else theirs.get(group["name"], theirs)
        if "error" in theirs:
            row["error"] = theirs["error"]
            return row
        if "crash" in theirs:
            row["judge_crash"] = theirs["crash"]
            return row
        row["differs"] += differences(group["measures"], theirs)
        for key in sums:
            sums[key] += theirs[key]
        row["sym_dirichlet"] = theirs["sym_dirichlet_mean"]
        row["pack"] = theirs["pack_unit"]
        gaps = [g for g in (row.get("gap"), theirs.get("gap_texels_1024")) if g is not None]
        row["gap"] = min(gaps, default=None)
    row.update(sums)
    return row


def set_of(data, group):
    notes = data["written"]["primitives"]
    return next((n["texcoord"] for n in notes if f"mesh{n['mesh']}" == group), notes[0]["texcoord"])


def texcoords(report):
    sets = {note["texcoord"] for note in json.loads(report.read_text())["written"]["primitives"]}
    return ["--texcoord", str(sets.pop())] if len(sets) == 1 else []


def faults(row, slow):
    if row["exit"] != 0:
        return [] if "no_triangles" in row.get("error", "") else [f"exit {row['exit']}: {row.get('error', '')}"]
    wrong = ["flipped", "uv_degenerate", "uv_collapsed",
             "overlap_pairs_between_charts" if row["mode"] == "disk" else "overlap_pairs_exact"]
    if not row.get("winding_inconsistent_faces"):
        wrong.append("mirrored_charts")  # where half of a chart is wound the other way, either side is its back
    found = [f"{k}={row[k]}" for k in wrong if row.get(k)]
    if row.get("gap") is not None and row["gap"] < PADDING * (1 - 1e-6):
        found.append(f"gap of {row['gap']:.4f} texels")
    if row["seconds"] > slow:
        found.append(f"{row['seconds']:.1f} s")
    if row.get("verify"):
        found.append(f"verify exits {row['verify']}")
    if "error" in row:
        found.append(row["error"])
    if row["mode"] == "disk" and row.get("charts", 0) > row.get("components", 0):
        found.append(f"{row['charts']} charts for {row['components']} components")
    return found + ([f"report differs: {' '.join(sorted(set(row['differs'])))}"] if row.get("differs") else [])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("inputs", nargs="+", type=Path)
    parser.add_argument("--judge", required=True, type=Path)
    parser.add_argument("--unwrapd", default="target/release/unwrapd")
    parser.add_argument("--out", default=Path("/tmp/unwrapd-corpus"), type=Path)
    parser.add_argument("--modes", nargs="+", default=["auto", "disk"])
    parser.add_argument("--slow", type=float, default=60, help="seconds that no run shall need")
    parser.add_argument("--limit", type=float, default=300, help="seconds after which a run is killed")
    arguments = parser.parse_args()
    arguments.out.mkdir(parents=True, exist_ok=True)
    files = [f for i in arguments.inputs for f in (sorted(i.rglob("*")) if i.is_dir() else [i])
             if f.suffix.lower() in MESHES]
    rows, bad = [], 0
    for path in files:
        for mode in arguments.modes:
            row = one(arguments, path, mode)
            rows.append(row)
            wrong = faults(row, arguments.slow)
            bad += bool(wrong)
            text = (f"{row['charts']:6} charts {row['iterations']:5} it {row['seconds']:7.2f} s ({row['cpu']:6.2f} cpu) {row['mib']:6.0f} MiB  "
                    f"sd {row['sym_dirichlet'] or 0:8.4f} overlaps {row['overlap_pairs_exact']:6} gap {row['gap'] or 0:6.3f}"
                    if "charts" in row else f"exit {row['exit']} in {row['seconds']:.2f} s {row.get('error', '')}")
            if "judge_crash" in row:
                text += f"the judge crashed: {row['judge_crash']}"
            print(f"{path.parent.name + '/' + path.name:45} {mode:4} {text}  {'; '.join(wrong)}", flush=True)
    seconds, cpu = [row["seconds"] for row in rows], [row["cpu"] for row in rows]
    refused = sum("no_triangles" in row.get("error", "") for row in rows)
    crashes = sum("judge_crash" in row for row in rows)
    print(f"{len(files)} files, {len(rows)} runs, {refused} refused for having no triangle, {bad} at fault, "
          f"{crashes} not judged because the judge crashed; "
          f"seconds median {statistics.median(seconds):.2f}, max {max(seconds):.2f} "
          f"(of the processors {statistics.median(cpu):.2f} and {max(cpu):.2f}); "
          f"peak {max(row['mib'] for row in rows):.0f} MiB")
    (arguments.out / "rows.json").write_text(json.dumps(rows, indent=1))
    sys.exit(bool(bad))


if __name__ == "__main__":
    main()
