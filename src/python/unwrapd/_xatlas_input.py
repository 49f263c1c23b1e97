"""Arrays as the package `xatlas` takes them, with its errors."""

from __future__ import annotations

from typing import Any, Optional

import numpy as np


class Mesh:
    """A mesh that was added: faces with a position that is not finite take no part."""

    def __init__(
        self,
        positions: np.ndarray,
        faces: np.ndarray,
        normals: Optional[np.ndarray],
        uvs: Optional[np.ndarray],
        materials: Optional[np.ndarray],
    ) -> None:
        self.positions, self.faces, self.normals, self.uvs = positions, faces, normals, uvs
        self.materials = materials
        self.is_used = np.isfinite(positions).all(axis=1)[faces].all(axis=1)

    def area(self) -> float:
        """Of what takes part."""
        a, b, c = (self.positions[self.faces[self.is_used, k]].astype(np.float64) for k in range(3))
        return float(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum()) / 2.0

    def native(self, with_uvs: bool, with_normals: bool) -> tuple[Any, ...]:
        """What takes part, for `unwrapd.unwrap`."""
        uvs = self.uvs if with_uvs else None
        normals = self.normals if with_normals else None
        return self.positions, self.faces[self.is_used], uvs, normals


def taken(positions: Any, indices: Any, normals: Any = None, uvs: Any = None) -> Mesh:
    """A mesh from the arguments of `add_mesh`."""
    positions = table(positions, 3, "Position")
    faces = table(indices, 3, "Index", np.uint32)
    if normals is not None:
        normals = table(normals, 3, "Normal", n_rows=len(positions))
    if uvs is not None:
        uvs = table(uvs, 2, "Texture coordinate", n_rows=len(positions))
    _check(faces, len(positions))
    return Mesh(positions, faces, normals, uvs, None)


def taken_uvs(uvs: Any, indices: Any, face_materials: Any = None) -> Mesh:
    """A flat mesh from the arguments of `add_uv_mesh`."""
    uvs = table(uvs, 2, "Texture coordinate")
    faces = table(indices, 3, "Index", np.uint32)
    if face_materials is not None:
        # As there: a list of materials is refused, and so none can be given.
        table(face_materials, 1, "Face material ID", np.uint32, len(faces))
    _check(faces, len(uvs))
    flat = np.column_stack([uvs, np.zeros(len(uvs), uvs.dtype)])
    return Mesh(flat, faces, None, uvs, None)


def table(
    given: Any, width: int, name: str, dtype: Any = np.float32, n_rows: Optional[int] = None
) -> np.ndarray:
    """An array of rows; positions keep the precision that they have."""
    try:
        found = np.asarray(given)
        if dtype is np.uint32 or found.dtype != np.float64:
            with np.errstate(invalid="ignore"):
                found = found.astype(dtype)
    except (TypeError, ValueError) as error:
        raise TypeError(f"incompatible function arguments: {name.lower()} array: {error}") from None
    if found.ndim != 2 or found.shape[1] != width:
        raise ValueError(f"{name} array expected to be Nx{width}.")
    if n_rows is not None and len(found) != n_rows:
        raise ValueError(
            f"{name} array has invalid number of elements in the first dimension (expected {n_rows}, got {len(found)})"
        )
    return np.array(found)


def _check(faces: np.ndarray, n_vertices: int) -> None:
    if len(faces) == 0 and n_vertices > 0:
        raise RuntimeError("Adding mesh failed: Invalid index count")
    if len(faces) and int(faces.max()) >= n_vertices:
        raise RuntimeError("Adding mesh failed: Index out of range")
