"""UVs for meshes: what the operators do, without Blender."""

import numpy as np
import unwrapd

from .seams import around, of_loops, split

#: Times that seams are led around polygons before their number is told.
ATTEMPTS = 4


class Cut(Exception):
    """Polygons cannot be kept whole."""

    def __init__(self, count):
        super().__init__(f"{count} faces would be cut: triangulate them, or mark seams around them")


def unwrapped(meshes, along_seams, progress=None, **options):
    """UVs of the loops of each mesh, and the report. Islands with pinned loops stay as they are."""
    kept = [pinned(mesh) for mesh in meshes]
    free = [~mask for mask in kept]
    if not any(mask.any() for mask in free):
        raise unwrapd.InvalidInput("all islands are pinned", "no_triangles", 3)
    given = [(mesh.positions, mesh.faces[mask]) for mesh, mask in zip(meshes, free)]
    used = [number for number, mask in enumerate(free) if mask.any()]
    seams, options = marked(meshes, used), {**options, "progress": progress}
    cut = "seams" if along_seams else options.pop("cut", "auto")
    options.pop("cut", None)
    for _ in range(ATTEMPTS):
        atlases = unwrapd.unwrap([given[number] for number in used], cut=cut, seams=seams or None, **options)
        corners = [full(meshes[number], free[number], atlas) for number, atlas in zip(used, atlases)]
        n_cut = sum(len(split(meshes[number], uvs)) for number, uvs in zip(used, corners))
        if n_cut == 0:
            break
        offsets = np.cumsum([0] + [len(meshes[number].positions) for number in used])
        led = [np.array(around(meshes[number], uvs)).reshape(-1, 2) for number, uvs in zip(used, corners)]
        seams = seams + [pair for off, pairs in zip(offsets, led) for pair in (pairs + off).astype(int).tolist()]
        cut = "seams"
    else:
        raise Cut(n_cut)
    new = [mesh.uvs() for mesh in meshes]
    for number, uvs in zip(used, corners):
        loops = meshes[number].triangles[free[number]]
        present = new[number] if new[number] is not None else np.zeros((len(meshes[number].vertices), 2), np.float32)
        present[loops] = of_loops(meshes[number], uvs)[loops]
        new[number] = present
    if not any(mask.any() for mask in kept):
        return new, atlases[0].report
    return packed(meshes, new, kept, options)


def repacked(meshes, progress=None, **options):
    """UVs of loops with the islands laid out anew, and the report. Islands with pinned loops stay where they are."""
    present = [mesh.uvs() for mesh in meshes]
    if any(uvs is None for uvs in present):
        raise unwrapd.InvalidInput("a selected object has no UVs", "no_uvs", 3)
    return packed(meshes, present, [pinned(mesh) for mesh in meshes], {**options, "progress": progress})


def judged(meshes, **options):
    """What the present UVs are worth, and what is proven of them."""
    given = [(mesh.positions, mesh.faces, uvs[mesh.triangles]) for mesh in meshes if (uvs := mesh.uvs()) is not None]
    if not given:
        raise unwrapd.InvalidInput("no selected object has UVs", "no_uvs", 3)
    return unwrapd.measure(given, **options), unwrapd.verify(given, bijective=True, **options)


def packed(meshes, uvs, kept, options):
    """Islands laid out, around those of kept triangles."""
    given = [(mesh.positions, mesh.faces, each[mesh.triangles]) for mesh, each in zip(meshes, uvs)]
    staying = [
        {"primitive": number, "face": int(face), "move": [0.0, 0.0]}
        for number, (mesh, mask) in enumerate(zip(meshes, kept))
        for face in firsts(mesh, mask)
    ]
    known = {name: options[name] for name in ("progress", *unwrapd.options("repack")) if name in options}
    atlases = unwrapd.repack(given, islands=staying or None, **known)
    found = [of_loops(mesh, atlas.corner_uvs) for mesh, atlas in zip(meshes, atlases)]
    for mesh, new, old, mask in zip(meshes, found, uvs, kept):
        loops = mesh.triangles[mask]
        new[loops] = old[loops]
    return found, atlases[0].report


def marked(meshes, numbers):
    """The seams that users marked, as pairs of vertices counted over the meshes."""
    found, offset = [], 0
    for number in numbers:
        found += (meshes[number].seams + offset).tolist()
        offset += len(meshes[number].positions)
    return found


def full(mesh, mask, atlas):
    """UVs of the corners of all triangles (T, 3, 2); those that took no part have zeros."""
    found = np.zeros((len(mask), 3, 2), np.float32)
    found[mask] = atlas.corner_uvs
    return found


def pinned(mesh):
    """The triangles (T,) of islands of which a loop is pinned."""
    pins, uvs = mesh.pins(), mesh.uvs()
    if uvs is None or not pins.any():
        return np.zeros(len(mesh.triangles), bool)
    numbers = islands(mesh, uvs)
    has_pin = np.unique(numbers[pins[mesh.triangles].any(axis=1)])
    return np.isin(numbers, has_pin)


def firsts(mesh, mask):
    """One triangle of each island of those in the mask."""
    if not mask.any():
        return []
    numbers = islands(mesh, mesh.uvs())
    _, first = np.unique(numbers[mask], return_index=True)
    return np.flatnonzero(mask)[first]


def islands(mesh, uvs):
    """A number for each triangle (T,), the same within an island: triangles that share an edge and its UVs."""
    places = np.column_stack([mesh.vertices, uvs])
    _, corner = np.unique(places, axis=0, return_inverse=True)
    corners = corner.reshape(-1)[mesh.triangles]
    sides = np.sort(np.stack([corners, np.roll(corners, -1, axis=1)], 2).reshape(-1, 2), axis=1)
    _, side = np.unique(sides, axis=0, return_inverse=True)
    side = side.reshape(-1, 3)
    numbers = np.arange(len(side))
    while True:
        least = np.full(side.max() + 1, len(side))
        np.minimum.at(least, side, numbers[:, None])
        new = least[side].min(axis=1)
        new = np.minimum(new, new[new])
        if (new == numbers).all():
            return numbers
        numbers = new
