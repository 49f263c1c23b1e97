"""Bodies and handles as users have them, as the native part takes them."""

from __future__ import annotations

import json
from typing import Any, Mapping, Optional, Tuple

import numpy as np

from . import _meshes
from ._options import plain

#: Positions, elements, flat start positions.
Native = Tuple[np.ndarray, np.ndarray, Optional[np.ndarray]]


def native(vertices: Any, elements: Any, start: Any) -> Native:
    """A body; the shapes say whether it is one of the plane, a surface, or tetrahedra."""
    positions = _meshes.array(vertices, "vertices")
    if positions.ndim != 2 or positions.shape[1] not in (2, 3):
        raise ValueError(f"vertices must have the shape (V, 2) or (V, 3), not {positions.shape}")
    width = _meshes.array(elements, "elements").shape[-1:]
    dim = int(positions.shape[1])
    if width not in ((3,), (4,)) or (width, dim) == ((4,), 2):
        raise ValueError(
            f"elements must have the shape (F, 3), or with positions in space (T, 4), not (…, {width[0] if width else 0})"
        )
    corners = _meshes.faces(elements, "elements", width[0])
    if start is None and (width, dim) == ((3,), 3):
        raise ValueError("triangles in space need a start: positions in the plane, (V, 2)")
    place = dim if width == (4,) else 2
    return (
        np.ascontiguousarray(positions, dtype=np.float64),
        corners,
        None if start is None else flat(start, len(positions), place, "start"),
    )


def flat(given: Any, n_vertices: int, dim: int, name: str) -> np.ndarray:
    """Positions (V, D) as a flat array of float64."""
    found = _meshes.array(given, name)
    if found.shape != (n_vertices, dim):
        raise ValueError(f"{name} must have the shape ({n_vertices}, {dim}), not {found.shape}")
    return np.ascontiguousarray(found, dtype=np.float64).reshape(-1)


def handles_json(handles: Any) -> str:
    """Handles as files of handles have them, from a list of those or a mapping of vertices to targets."""
    if isinstance(handles, Mapping):
        handles = [{"vertex": vertex, "to": to} for vertex, to in handles.items()]
    return json.dumps(list(handles), default=plain)


def handle_json(handle: Mapping[str, Any]) -> str:
    """One handle."""
    return json.dumps(handle, default=plain)
