"""The package `unwrapd` beside `xatlas` and `uvunwrap`, by the calls that their users make.

    python tests/bench/wheel.py --metrics DIR_OF_UVMETRICS [--faces N] [--timeout S] FILE…

Each tool gets the same mesh (float32 positions, equal ones welded, faces that name a vertex twice left out) in a process of its
own. Validity, charts and overlaps are those of uvmetrics, which shares no code with any of them. Needs trimesh.
"""

import argparse
import json
import multiprocessing
import pathlib
import statistics
import sys
import time

import numpy as np

TOOLS = ["unwrapd", "xatlas", "uvunwrap"]


def welded(path):
    """Positions and faces of a file."""
    import trimesh

    mesh = trimesh.load(path, force="mesh", process=False)
    positions, index = np.unique(np.asarray(mesh.vertices, np.float32), axis=0, return_inverse=True)
    faces = index.reshape(-1)[np.asarray(mesh.faces)].astype(np.uint32)
    a, b, c = faces.T
    return positions, faces[(a != b) & (b != c) & (c != a)]


def called(tool, positions, faces):
    """UVs of the corners, and whether attributes go through the mapping as they are."""
    if tool == "uvunwrap":
        import uvunwrap

        atlas = uvunwrap.generate([uvunwrap.Mesh(positions, faces)])
        return np.array(atlas.meshes[0].corner_uvs).reshape(-1, 3, 2), True
    if tool == "unwrapd":
        from unwrapd import xatlas
    else:
        import xatlas
    mapping, indices, uvs = xatlas.parametrize(positions, faces)
    return uvs[indices], bool((positions[mapping][indices] == positions[faces]).all())


def row(tool, path, metrics, pipe):
    """What a tool makes of a file."""
    sys.path.insert(0, metrics)
    import uvmetrics

    positions, faces = welded(path)
    begin, cpu = time.perf_counter(), time.process_time()
    uvs, is_same = called(tool, positions, faces)
    found = {"seconds": time.perf_counter() - begin, "cpu": time.process_time() - cpu, "same": is_same}
    judged = uvmetrics.evaluate(positions.astype(float), faces.astype(int), uvs.astype(float), raster=False)
    for name in ["charts", "flipped", "uv_degenerate", "uv_collapsed", "overlap_pairs", "sym_dirichlet_mean"]:
        found[name] = judged[name]
    faults = ("flipped", "uv_degenerate", "uv_collapsed", "overlap_pairs")
    found["valid"] = found["same"] and all(judged[name] == 0 for name in faults)
    pipe.send(found)


def measured(tool, path, arguments):
    """The same, with a limit of its own; an exception is a row too."""
    ours, theirs = multiprocessing.Pipe()
    process = multiprocessing.get_context("spawn").Process(target=row, args=(tool, path, arguments.metrics, theirs))
    process.start()
    theirs.close()
    try:
        return ours.recv() if ours.poll(arguments.timeout) else {"failed": "timeout"}
    except EOFError:
        process.join()
        return {"failed": f"exit {process.exitcode}"}
    finally:
        process.kill()
        process.join()


def cell(found):
    if "failed" in found:
        return found["failed"]
    valid = "valid" if found["valid"] else "INVALID"
    energy = found["sym_dirichlet_mean"]
    stretched = "-" if energy is None else f"{energy:.3f}"
    return f"{found['charts']} / {stretched} / {found['cpu']:.2f} s / {valid}"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--metrics", required=True)
    parser.add_argument("--faces", type=int, default=25_000, help="larger meshes are left out")
    parser.add_argument("--timeout", type=float, default=120.0, help="seconds for a tool and its judgment")
    parser.add_argument("--jsonl", type=pathlib.Path)
    parser.add_argument("files", nargs="+")
    arguments = parser.parse_args()
    print(f"| mesh (faces) | {' | '.join(TOOLS)} |\n|---|{'---|' * len(TOOLS)}")
    ratios = []
    for path in arguments.files:
        try:
            n_faces = len(welded(path)[1])
        except Exception as error:
            print(f"{path}: not read: {type(error).__name__}: {error}", file=sys.stderr)
            continue
        if not 0 < n_faces <= arguments.faces:
            continue
        rows = {tool: measured(tool, path, arguments) for tool in TOOLS}
        print(f"| {pathlib.Path(path).stem} ({n_faces}) | {' | '.join(map(cell, rows.values()))} |", flush=True)
        if arguments.jsonl:
            with arguments.jsonl.open("a") as file:
                file.write(json.dumps({"file": path, "faces": n_faces, **rows}) + "\n")
        if all("charts" in rows[tool] for tool in TOOLS[:2]) and rows["xatlas"]["charts"]:
            ratios.append(rows["unwrapd"]["charts"] / rows["xatlas"]["charts"])
    if ratios:
        print(f"\ncharts over those of xatlas: {statistics.median(ratios):.3f} at the median of {len(ratios)}")


if __name__ == "__main__":
    main()
