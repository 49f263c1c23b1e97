# SPDX-FileCopyrightText: The authors of unwrapd
# SPDX-License-Identifier: GPL-3.0-or-later

"""UVs for meshes: what the operators do, without Blender."""

import itertools
from dataclasses import dataclass, field
from typing import Optional

import numpy as np
import unwrapd

from .seams import around, of_loops, pairs, sides, split

#: Rounds in which seams are led around polygons on the shorter side only; from then on polygons that are cut become islands.
ATTEMPTS = 4

#: Why free islands cannot be laid out around the others: they get the square for themselves then.
NO_PLACE = ("island_off_page", "islands_too_near", "no_room", "no_valid_result", "island_named_twice", "unknown_face")


@dataclass
class Layout:
    """New UVs, and what is known of them."""

    #: For each mesh the UVs of its loops (L, 2), or None where the mesh stays as it is.
    uvs: list
    #: The report of the library; None if no mesh has changed.
    report: Optional[dict]
    #: By number of mesh the polygons that would have been cut.
    refused: dict = field(default_factory=dict)
    warnings: list = field(default_factory=list)


def unwrapped(meshes, along_seams, progress=None, **options):
    """Unwraps the faces that may change, but for islands with pinned loops. All others keep their UVs."""
    free = [mesh.is_free & ~pinned(mesh) for mesh in meshes]
    if not any(mask.any() for mask in free):
        raise unwrapd.InvalidInput("all islands are pinned", "no_triangles", 3)
    options["progress"] = progress
    corners, report, refused = around_polygons(meshes, free, along_seams, options)
    if report is None:
        return Layout([None] * len(meshes), None, refused)
    for number in refused:
        free[number] = np.zeros_like(free[number])
    new = [mesh.uvs() for mesh in meshes]
    for number, uvs in corners.items():
        mesh = meshes[number]
        loops = mesh.triangles[free[number]]
        if new[number] is None:
            new[number] = np.zeros((len(mesh.vertices), 2), np.float32)
        new[number][loops] = of_loops(mesh, uvs, free[number])[loops]
    return placed(meshes, new, free, options, Layout([], report, refused))


def repacked(meshes, progress=None, **options):
    """Lays out the islands of the faces that may change, but for those with pinned loops. All others stay where they are."""
    present = [mesh.uvs() for mesh in meshes]
    if any(uvs is None for uvs in present):
        raise unwrapd.InvalidInput("a selected object has no UVs", "no_uvs", 3)
    free = [mesh.is_free & ~pinned(mesh) for mesh in meshes]
    if not any(mask.any() for mask in free):
        raise unwrapd.InvalidInput("all islands are pinned", "no_triangles", 3)
    return placed(meshes, present, free, {**options, "progress": progress}, Layout([], None))


def around_polygons(meshes, free, along_seams, options):
    """Unwraps the triangles in the masks such that no polygon is cut.

    Returns the UVs of corners (T, 3, 2) by number of mesh, the report, and by number of mesh the polygons that would be cut
    though seams run all around them. The library sees triangles and cuts where that is cheapest; a seam through a polygon is
    led around it on the shorter side, on the other side if that is one already, and the library cuts along seams alone.
    """
    cut = "seams" if along_seams else options.get("cut", "auto")
    options = {name: value for name, value in options.items() if name != "cut"}
    seams = {number: marked(meshes[number], mask) for number, mask in enumerate(free) if mask.any()}
    refused = {}
    for attempt in itertools.count():
        numbers = sorted(seams)
        if not numbers:
            return {}, None, refused
        given = [(meshes[number].positions, meshes[number].faces[free[number]]) for number in numbers]
        atlases = unwrapd.unwrap(given, cut=cut, seams=joined(meshes, seams), **options)
        corners = {number: full(free[number], atlas) for number, atlas in zip(numbers, atlases)}
        cuts = {number: split(meshes[number], corners[number], free[number]) for number in numbers}
        if not any(len(polygons) for polygons in cuts.values()):
            return corners, atlases[0].report, refused
        for number in numbers:
            mesh, known = meshes[number], seams[number]
            stuck = [polygon for polygon in cuts[number] if sides(mesh, polygon) <= known]
            if stuck:
                refused[number] = stuck
                del seams[number]
                continue
            led = around(mesh, corners[number], free[number], known)
            if ATTEMPTS <= attempt:
                led = led.union(*(sides(mesh, polygon) for polygon in cuts[number]))
            seams[number] = known | led
        cut = "seams"


def judged(meshes, **options):
    """What the present UVs are worth, and what is proven of them."""
    given = [(mesh.positions, mesh.faces, uvs[mesh.triangles]) for mesh in meshes if (uvs := mesh.uvs()) is not None]
    if not given:
        raise unwrapd.InvalidInput("no selected object has UVs", "no_uvs", 3)
    return unwrapd.measure(given, **options), unwrapd.verify(given, bijective=True, **options)


def placed(meshes, uvs, free, options, found):
    """Lays out the islands of free triangles around those of all others that have UVs, and fills in the layout.

    Where they have no place there, as around islands that overlap or leave the square, they get the square for themselves.
    """
    kept = [~mask & has_area(mesh, new) for mesh, new, mask in zip(meshes, uvs, free)]
    is_alone = not any(mask.any() for mask in kept)
    found.uvs = [new if mask.any() else None for new, mask in zip(uvs, free)]
    if is_alone and found.report is not None:
        return found
    known = {name: options[name] for name in ("progress", *unwrapd.options("repack")) if name in options}
    try:
        new, report = packed(meshes, uvs, free, kept, known)
    except unwrapd.Error as error:
        if is_alone or error.code not in NO_PLACE:
            raise
        found.warnings.append("there is no room around the islands that stay: others may lie on them")
        if found.report is not None:
            return found
        new, report = packed(meshes, uvs, free, [np.zeros_like(mask) for mask in kept], known)
    found.uvs = [each if mask.any() else None for each, mask in zip(new, free)]
    found.report = report
    return found


def packed(meshes, uvs, free, kept, options):
    """UVs of loops with the islands of free triangles laid out around those of kept ones, and the report."""
    taken = [some | others for some, others in zip(free, kept)]
    numbers = [number for number, mask in enumerate(taken) if mask.any()]
    given = [
        (meshes[number].positions, meshes[number].faces[taken[number]], uvs[number][meshes[number].triangles[taken[number]]])
        for number in numbers
    ]
    staying = [
        {"primitive": place, "face": int(np.count_nonzero(taken[number][:face])), "move": [0.0, 0.0]}
        for place, number in enumerate(numbers)
        for face in firsts(meshes[number], uvs[number], kept[number])
    ]
    atlases = unwrapd.repack(given, islands=staying or None, **options)
    found = list(uvs)
    for number, atlas in zip(numbers, atlases):
        mesh, mask = meshes[number], free[number]
        loops = mesh.triangles[mask]
        found[number] = uvs[number].copy()
        found[number][loops] = of_loops(mesh, full(taken[number], atlas), mask)[loops]
    return found, atlases[0].report


def marked(mesh, mask):
    """The seams that users marked along sides of triangles in a mask, as pairs of vertices."""
    corners = mesh.faces[mask]
    present = {*pairs(np.stack([corners, np.roll(corners, -1, axis=1)], 2).reshape(-1, 2))}
    return present & {*pairs(mesh.seams)}


def joined(meshes, seams):
    """Seams by number of mesh as one list, with vertices counted over these meshes; None if there are none."""
    found, offset = [], 0
    for number in sorted(seams):
        found += [[v + offset, w + offset] for v, w in sorted(seams[number])]
        offset += len(meshes[number].positions)
    return found or None


def full(mask, atlas):
    """UVs of the corners of all triangles (T, 3, 2); those that took no part have zeros."""
    found = np.zeros((len(mask), 3, 2), np.float32)
    found[mask] = atlas.corner_uvs
    return found


def has_area(mesh, uvs):
    """Which triangles (T,) have an area in UVs."""
    if uvs is None:
        return np.zeros(len(mesh.triangles), bool)
    a, b, c = np.moveaxis(uvs[mesh.triangles].astype(np.float64), 1, 0)
    (du, dv), (eu, ev) = (b - a).T, (c - a).T
    return du * ev != dv * eu


def pinned(mesh):
    """The free triangles (T,) of islands of which a free loop is pinned."""
    pins, uvs, free = mesh.pins(), mesh.uvs(), mesh.is_free
    found = np.zeros(len(mesh.triangles), bool)
    has_pin = pins[mesh.triangles].any(axis=1) & free
    if uvs is not None and has_pin.any():
        numbers = islands(mesh, uvs, free)
        found[free] = np.isin(numbers, np.unique(numbers[has_pin[free]]))
    return found


def firsts(mesh, uvs, mask):
    """One triangle of each island of those in the mask."""
    if not mask.any():
        return []
    _, first = np.unique(islands(mesh, uvs, mask), return_index=True)
    return np.flatnonzero(mask)[first]


def islands(mesh, uvs, mask):
    """A number for each triangle in the mask, the same within an island: triangles that share an edge and its UVs."""
    places = np.column_stack([mesh.vertices, uvs])
    _, corner = np.unique(places, axis=0, return_inverse=True)
    corners = corner.reshape(-1)[mesh.triangles[mask]]
    ends = np.sort(np.stack([corners, np.roll(corners, -1, axis=1)], 2).reshape(-1, 2), axis=1)
    _, side = np.unique(ends, axis=0, return_inverse=True)
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
