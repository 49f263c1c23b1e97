"""Meshes as OBJ files, as the package `xatlas` writes them."""

from __future__ import annotations

from typing import Any

import numpy as np

from ._xatlas_input import table


def export(
    path: str, positions: Any, indices: Any = None, uvs: Any = None, normals: Any = None
) -> None:
    """Write a mesh as OBJ."""
    if not isinstance(path, str):
        raise TypeError("export(): incompatible function arguments: path must be a str")
    positions = table(positions, 3, "Position")
    tables = [("v", positions)]
    faces = None if indices is None else table(indices, 3, "Index", np.uint32)
    if normals is not None:
        tables.append(("vn", table(normals, 3, "Normal", n_rows=len(positions))))
    if uvs is not None:
        tables.append(("vt", table(uvs, 2, "Texture coordinates", n_rows=len(positions))))
    corner = (
        "{0}"
        if len(tables) == 1
        else "{0}/{0}"
        if normals is None
        else "{0}//{0}"
        if uvs is None
        else "{0}/{0}/{0}"
    )
    try:
        file = open(path, "w", encoding="ascii")
    except OSError:
        raise ValueError(f"Cannot open path {path}") from None
    with file:
        for word, rows in tables:
            # Nine digits give back each float32.
            file.writelines(
                f"{word} {' '.join(format(x, '.9g') for x in row)}\n" for row in rows.tolist()
            )
        for face in [] if faces is None else (faces.astype(np.int64) + 1).tolist():
            file.write(f"f {' '.join(corner.format(v) for v in face)}\n")
