"""The package `unwrapd` beside `xatlas`, `uvunwrap` and, if asked for, `autouv`, by the calls that their users make.

    python tests/bench/wheel.py --metrics DIR_OF_UVMETRICS [--tools NAMES] [--faces N] [--timeout S] FILE…

Each tool gets the same mesh (float32 positions, equal ones welded, faces that name a vertex twice left out) in a process of its
own. Validity, charts and overlaps are those of uvmetrics, which shares no code with any of them. A sliver is a chart whose mean
width, 2 A / L with its outline L, is below 4 texels of 1024, which is what padding usually is. Seconds are those of the call.
Needs trimesh, and usd-optimize for `autouv`.
"""

import argparse
import json
import multiprocessing
import pathlib
import statistics
import sys
import time

import numpy as np

TOOLS = ["unwrapd", "xatlas", "uvunwrap", "autouv"]
#: The width below which a chart is a sliver, as a share of the side of the texture.
THIN = 4 / 1024
#: What makes a map invalid.
FAULTS = ("flipped", "uv_degenerate", "uv_collapsed", "overlap_pairs")


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
    if tool == "autouv":
        return autouv(positions, faces), True
    if tool == "unwrapd":
        from unwrapd import xatlas
    else:
        import xatlas
    mapping, indices, uvs = xatlas.parametrize(positions, faces)
    return uvs[indices], bool((positions[mapping][indices] == positions[faces]).all())


def autouv(positions, faces):
    """UVs of the corners by `generateAtlasUVs`, at the distortion that is nearest to that of the others."""
    from pxr import Usd, UsdGeom, Vt
    from usd_optimize.core import ExecutionContext, UsdOptimizeCore

    stage = Usd.Stage.CreateInMemory()
    mesh = UsdGeom.Mesh.Define(stage, "/mesh")
    mesh.CreatePointsAttr(Vt.Vec3fArray.FromNumpy(positions))
    mesh.CreateFaceVertexCountsAttr(Vt.IntArray.FromNumpy(np.full(len(faces), 3, np.int32)))
    mesh.CreateFaceVertexIndicesAttr(Vt.IntArray.FromNumpy(faces.astype(np.int32).ravel()))
    mesh.CreateSubdivisionSchemeAttr("none")
    context = ExecutionContext()
    context.set_stage(stage)
    context.verbose = 0
    options = {
        "distortionThreshold": 1.5,
        "useWorldSpaceScales": False,
        "overwriteExisting": True,
        "enableAtlasPacking": True,
    }
    UsdOptimizeCore.getInstance().executeOperation("generateAtlasUVs", context, options)
    uvs = UsdGeom.PrimvarsAPI(mesh.GetPrim()).GetPrimvar("st").ComputeFlattened()
    made = np.array(mesh.GetFaceVertexIndicesAttr().Get()).reshape(-1, 3)
    if not np.array_equal(made, faces):
        raise ValueError("the faces are others")
    return np.array(uvs).reshape(-1, 3, 2)


def slivers(faces, uvs, chart):
    """Charts that are thinner than `THIN`."""
    a, b, c = uvs[:, 0], uvs[:, 1], uvs[:, 2]
    area = np.abs((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]) / 2
    # An edge of a chart that has no second side there is of its outline.
    ends = np.concatenate([np.stack([uvs[:, k], uvs[:, (k + 1) % 3]], 1) for k in range(3)])
    swapped = (ends[:, 0, 0] > ends[:, 1, 0]) | ((ends[:, 0, 0] == ends[:, 1, 0]) & (ends[:, 0, 1] > ends[:, 1, 1]))
    ends[swapped] = ends[swapped][:, ::-1]
    owner = np.concatenate([chart] * 3)
    keys = np.column_stack([ends.reshape(len(ends), 4), owner])
    _, first, count = np.unique(keys, axis=0, return_index=True, return_counts=True)
    rim = first[count == 1]
    length = np.linalg.norm(ends[rim, 1] - ends[rim, 0], axis=1)
    n = int(chart.max()) + 1 if len(chart) else 0
    areas = np.bincount(chart[chart >= 0], area[chart >= 0], n)
    outlines = np.bincount(owner[rim][owner[rim] >= 0], length[owner[rim] >= 0], n)
    side = float(np.ptp(uvs.reshape(-1, 2), axis=0).max())
    return int(((areas > 0) & (2 * areas < THIN * side * outlines)).sum())


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
    found["slivers"] = slivers(faces, uvs.astype(float), judged["_chart"])
    found["valid"] = found["same"] and all(judged[name] == 0 for name in FAULTS)
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
    seconds = f"{found['seconds']:.2f} s ({found['cpu']:.2f})"
    return f"{found['charts']} / {found['slivers']} / {stretched} / {seconds} / {valid}"


def median(values):
    return statistics.median(values) if values else float("nan")


def summary(rows):
    """What the tools are worth where xatlas gave an answer, a line each."""
    accepted = [row for row in rows if "charts" in row.get("xatlas", {})]
    print(f"\nOf {len(rows)} meshes xatlas accepts {len(accepted)}. There:")
    for tool in accepted[0] if accepted else []:
        answered = [row for row in accepted if "charts" in row[tool]]
        made = [row[tool] for row in answered]
        theirs = [row["xatlas"]["charts"] for row in answered]
        ratios = [found["charts"] / others for found, others in zip(made, theirs) if others]
        total = sum(found["charts"] for found in made)
        print(
            f"- {tool}: {len(made)} answers, {sum(found['valid'] for found in made)} valid,"
            f" {sum(found['same'] for found in made)} with attributes kept to the byte,"
            f" {median(ratios):.3f} of xatlas' charts at the median, {total} charts,"
            f" {sum(found['slivers'] for found in made)} slivers,"
            f" {median([found['seconds'] for found in made]):.2f} s at the median"
            f" ({median([found['cpu'] for found in made]):.2f} s of processors),"
            f" {sum(found['seconds'] for found in made):.0f} s in all"
        )


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--metrics", required=True)
    parser.add_argument("--tools", type=lambda names: names.split(","), default=TOOLS[:3])
    parser.add_argument("--faces", type=int, default=25_000, help="larger meshes are left out")
    parser.add_argument("--timeout", type=float, default=120.0, help="seconds for a tool and its judgment")
    parser.add_argument("--jsonl", type=pathlib.Path)
    parser.add_argument("files", nargs="+")
    arguments = parser.parse_args()
    print("Cells: charts / slivers / symmetric Dirichlet / seconds (of processors) / validity\n")
    print(f"| mesh (faces) | {' | '.join(arguments.tools)} |\n|---|{'---|' * len(arguments.tools)}")
    table = []
    for path in arguments.files:
        try:
            n_faces = len(welded(path)[1])
        except Exception as error:
            print(f"{path}: not read: {type(error).__name__}: {error}", file=sys.stderr)
            continue
        if not 0 < n_faces <= arguments.faces:
            continue
        rows = {tool: measured(tool, path, arguments) for tool in arguments.tools}
        print(f"| {pathlib.Path(path).stem} ({n_faces}) | {' | '.join(map(cell, rows.values()))} |", flush=True)
        if arguments.jsonl:
            with arguments.jsonl.open("a") as file:
                file.write(json.dumps({"file": path, "faces": n_faces, **rows}) + "\n")
        table.append(rows)
    summary(table)


if __name__ == "__main__":
    main()
