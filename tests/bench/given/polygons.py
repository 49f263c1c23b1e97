"""Polygons of OBJ files that are not written as they were."""
import numpy as np

from files import doubled_area, read_obj, triangulation, write_obj
from scenes import polygon_meshes


def counted(program, path, folder, *options):
    """Polygons, those that are split or changed, those that fold in the square, and the exit status."""
    out = folder / "unwrapped.obj"
    before = read_obj(path)
    report, status = program.written("unwrap", path, out, *options)
    if report is None:
        return len(before.corners), len(before.corners), 0, status
    after = read_obj(out)
    written = {tuple(corners) for corners in after.corners}
    split = sum(tuple(corners) not in written for corners in before.corners)
    split += len(after.corners) != len(before.corners)
    folded = sum(is_folded(after.uvs[texcoords].tolist()) for texcoords in after.texcoords)
    return len(before.corners), split, folded, status


def is_folded(uv):
    areas = [doubled_area(*(uv[k] for k in triangle)) for triangle in triangulation(uv)]
    return min(areas) <= 0 <= max(areas)


def run(program, _before, files, folder):
    faults = 0
    print("mesh | polygons | of more than three sides | split | folded | exit")
    meshes = {path.stem: path for path in files}
    for name, part in polygon_meshes(np.random.default_rng(2)).items():
        meshes[name] = folder / f"{name}.obj"
        write_obj(meshes[name], part.positions, part.polygons)
    for name, path in meshes.items():
        n_polygons, split, folded, status = counted(program, path, folder)
        n_large = sum(len(corners) > 3 for corners in read_obj(path).corners)
        faults += split + folded
        print(f"{name} | {n_polygons} | {n_large} | {split} | {folded} | {status}", flush=True)
    return faults
