"""Meshes as users have them, as the native part takes them."""

from __future__ import annotations

from typing import Any, Optional, Tuple

import numpy as np

#: Positions, faces, UVs of corners, normals of corners.
Native = Tuple[np.ndarray, np.ndarray, Optional[np.ndarray], Optional[np.ndarray]]


def array(given: Any, name: str) -> np.ndarray:
    """Anything with `__array__` or `__dlpack__`, or nested lists, without a copy where that is possible."""
    if isinstance(given, np.ndarray):
        return given
    if hasattr(given, "__dlpack__") and not hasattr(given, "__array__"):
        return np.from_dlpack(given)
    if hasattr(given, "detach") and hasattr(given, "cpu"):
        given = given.detach().cpu()
    try:
        return np.asarray(given)
    except ValueError as error:
        raise ValueError(f"{name}: {error}") from None


def positions(given: Any, name: str = "vertices") -> np.ndarray:
    """Positions (V, 3), float32 or float64; other numbers become float64."""
    found = array(given, name)
    if found.size == 0 and found.ndim != 2:
        found = found.reshape(0, 3)
    if found.ndim != 2 or found.shape[1] != 3:
        raise ValueError(f"{name} must have the shape (V, 3), not {found.shape}")
    return np.ascontiguousarray(found, dtype=_real(found, name))


def faces(given: Any, name: str = "faces", width: int = 3) -> np.ndarray:
    """Vertices of triangles (F, 3), or of elements (E, width), as uint32; any integers are taken."""
    found = array(given, name)
    if found.size == 0:
        return np.zeros((0, width), dtype=np.uint32)
    if found.ndim != 2 or found.shape[1] != width:
        raise ValueError(f"{name} must have the shape (F, {width}), not {found.shape}")
    if found.dtype.kind not in "iu":
        raise TypeError(f"{name} must be integers, not {found.dtype}")
    if found.dtype.kind == "i" or found.dtype.itemsize > 4:
        low, high = int(found.min()), int(found.max())
        if low < 0 or high > 0xFFFF_FFFF:
            from ._errors import InvalidInput

            wrong = low if low < 0 else high
            raise InvalidInput(f"{name} name vertex {wrong}", "index_out_of_range", 3)
    if found.dtype == np.int32:
        found = found.view(np.uint32) if found.flags.c_contiguous else found
    return np.ascontiguousarray(found, dtype=np.uint32)


def corners(given: Any, triangles: np.ndarray, width: int, name: str) -> np.ndarray:
    """What corners have (F, 3, width) as float64, from that or from what vertices have (V, width)."""
    found = array(given, name)
    _real(found, name)
    if found.ndim == 2 and found.shape[1] == width:
        if triangles.size and int(triangles.max()) >= len(found):
            raise ValueError(
                f"{name} has {len(found)} rows, but faces name vertex {int(triangles.max())}"
            )
        found = found[triangles]
    if found.shape != (len(triangles), 3, width):
        raise ValueError(
            f"{name} must have the shape (V, {width}) or (F, 3, {width}), not {found.shape}"
        )
    return np.ascontiguousarray(found, dtype=np.float64)


def native(vertices: Any, triangles: Any, uvs: Any = None, normals: Any = None) -> Native:
    """A mesh as the native part takes it."""
    triangles = faces(triangles)
    return (
        positions(vertices),
        triangles,
        None if uvs is None else corners(uvs, triangles, 2, "uvs"),
        None if normals is None else corners(normals, triangles, 3, "normals"),
    )


def is_mesh(given: Any) -> bool:
    """Whether this is an object like those of trimesh, with `vertices` and `faces`."""
    return hasattr(given, "vertices") and hasattr(given, "faces")


def of(given: Any, with_uvs: bool = False) -> Native:
    """A mesh from such an object, or from a tuple (vertices, faces[, uvs])."""
    if not is_mesh(given):
        return native(*given)
    uvs = getattr(getattr(given, "visual", None), "uv", None) if with_uvs else None
    return native(given.vertices, given.faces, uvs)


def _real(found: np.ndarray, name: str) -> Any:
    if found.dtype.kind not in "fiu":
        raise TypeError(f"{name} must be real numbers, not {found.dtype}")
    return (
        found.dtype
        if found.dtype in (np.float32, np.float64) and found.dtype.isnative
        else np.float64
    )
