"""What ComfyUI's own unwrapping gives, by unwrapd: arrays in and out."""

from __future__ import annotations

from typing import Any, Callable, Optional

import numpy as np
import unwrapd

Triple = tuple[np.ndarray, np.ndarray, np.ndarray]


def uv_unwrap(
    positions: np.ndarray,
    indices: np.ndarray,
    weld_distance: float = 0.0,
    progress: Optional[Callable[[unwrapd.Progress], Any]] = None,
    **options: Any,
) -> tuple[Triple, dict[str, Any]]:
    """Unwrap a mesh: positions (V, 3), indices (F, 3).

    Vertices closer than `weld_distance`, a fraction of the extent, count as one. Other options are those of
    `unwrapd.unwrap`.

    Returns
    -------
    vmapping : (N,) int64
        For each vertex of the result that of the mesh.
    indices : (F, 3) int64
        Faces in vertices of the result.
    uvs : (N, 2) float32
        UVs of these, v up, in the unit square.

    And the report.
    """
    atlas = unwrapd.unwrap(welded(positions, weld_distance), indices, progress=progress, **options)
    triple = atlas.vmapping.astype(np.int64), atlas.indices.astype(np.int64), atlas.uvs
    return triple, atlas.report


def welded(positions: np.ndarray, weld_distance: float) -> np.ndarray:
    """Positions of which those in one cell of a grid are equal. Equal ones are one vertex for unwrapd."""
    if weld_distance <= 0.0 or len(positions) == 0:
        return positions
    cell = weld_distance * float(np.linalg.norm(np.ptp(positions, axis=0)))
    if not cell > 0.0:
        return positions
    cells = np.floor((positions - positions.min(axis=0)) / cell)
    _, first, inverse = np.unique(cells, axis=0, return_index=True, return_inverse=True)
    return positions[first[inverse.reshape(-1)]]
