"""Meshes of a finished atlas, as the package `xatlas` gives them."""

from __future__ import annotations

from typing import Any, Optional

import numpy as np

from ._arrays import repack, unwrap
from ._atlas import Atlas
from ._errors import InvalidInput
from ._xatlas_input import Mesh
from ._xatlas_options import enlarge

#: The atlas and the chart of what has no place.
NONE = np.uint32(0xFFFF_FFFF)


class Done:
    """A mesh of a finished atlas."""

    def __init__(self, mesh: Mesh, unwrapped: Optional[Atlas], n_charts_before: int) -> None:
        n_faces = len(mesh.faces)
        used = np.zeros((0,), np.uint32)
        self.indices = np.zeros((n_faces, 3), np.uint32)
        self.uvs = np.zeros((0, 2), np.float32)
        self.chart_of_face = np.full(n_faces, NONE)
        self.n_charts = 0
        if unwrapped is not None:
            used, self.uvs = unwrapped.vmapping, unwrapped.uvs.copy()
            numbers, inverse = np.unique(unwrapped.charts, return_inverse=True)
            self.n_charts = len(numbers)
            self.indices[mesh.is_used] = unwrapped.indices
            self.chart_of_face[mesh.is_used] = n_charts_before + inverse
        else:
            mesh.is_used[:] = False
        # Vertices of faces that took no part come last, without a place.
        left, inverse = np.unique(mesh.faces[~mesh.is_used], return_inverse=True)
        self.indices[~mesh.is_used] = len(used) + inverse.reshape(-1, 3)
        self.vmapping = np.concatenate([used, left]).astype(np.uint32)
        self.uvs = np.concatenate([self.uvs, np.zeros((len(left), 2), np.float32)])
        self.chart_index = np.full(len(self.vmapping), NONE)
        self.chart_index[self.indices] = self.chart_of_face[:, None]
        self.atlas_index = np.where(self.chart_index == NONE, NONE, 0).astype(np.uint32)

    def divide_pages(self, n_pages: int) -> None:
        """UVs of each page begin at 0."""
        has_place = self.chart_index != NONE
        middles = self.uvs[self.indices].mean(axis=1)[:, 0]
        page = np.zeros(len(self.vmapping), np.uint32)
        page[self.indices] = np.clip(middles.astype(np.uint32), 0, n_pages - 1)[:, None]
        self.atlas_index[has_place] = page[has_place]
        self.uvs[:, 0] -= page


def on_page(done: Done, page: int) -> tuple[Atlas, np.ndarray]:
    """What of a mesh lies on a page, as an atlas to bake, and the charts of its vertices as numbers to bake."""
    is_here = (done.chart_of_face != NONE) & (done.atlas_index[done.indices[:, 0]] == page)
    own = np.arange(len(done.vmapping), dtype=np.uint32)
    atlas = Atlas(own, done.indices[is_here], done.uvs, done.chart_of_face[is_here], "")
    return atlas, done.chart_index.astype(np.float32)


def computed(
    meshes: list[Mesh],
    is_flat: bool,
    charting: dict[str, Any],
    given: dict[str, Any],
    is_fixed: bool,
) -> list[Optional[Atlas]]:
    """The unwrapped meshes; None for those of which no face takes part."""
    with_uvs, with_normals = is_flat or charting.get("cut") == "keep", "seams" in charting
    used = [mesh.native(with_uvs, with_normals) for mesh in meshes if mesh.is_used.any()]
    made: Optional[list[Atlas]] = None
    while used and made is None:
        try:
            made = repack(used, stack="off", **given) if is_flat else unwrap(used, **charting, **given)
        except InvalidInput as error:
            if error.code == "no_triangles":
                break
            if error.code != "texture_too_small" or not enlarge(given, is_fixed):
                raise
    found = iter(made or [])
    return [next(found, None) if mesh.is_used.any() else None for mesh in meshes]
