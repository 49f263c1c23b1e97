"""Meshes as arrays: unwrap, repack, measure, verify, bake."""

from __future__ import annotations

import json
import os
from typing import TYPE_CHECKING, Any, Callable, Optional, Union, overload

import numpy as np

from . import _energy, _meshes, _native
from ._atlas import Atlas
from ._options import to_json
from ._progress import heard

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ._option_types import (
        MeasureOptions,
        RepackOptions,
        UnwrapOptions,
        VerifyOptions,
    )

Listener = Union[bool, Callable[[_native.Progress], Any]]


@overload
def unwrap(
    mesh: list[Any],
    faces: None = None,
    *,
    progress: Optional[Listener] = None,
    **options: Unpack[UnwrapOptions],
) -> list[Atlas]: ...
@overload
def unwrap(
    mesh: Any,
    faces: Any = None,
    *,
    normals: Any = None,
    uvs: Any = None,
    progress: Optional[Listener] = None,
    **options: Unpack[UnwrapOptions],
) -> Atlas: ...


def unwrap(
    mesh: Any,
    faces: Any = None,
    *,
    normals: Any = None,
    uvs: Any = None,
    progress: Optional[Listener] = None,
    **options: Any,
) -> Any:
    """Unwrap a mesh, or several into one atlas.

    Parameters
    ----------
    mesh : (V, 3) array, or a mesh, or a list of meshes
        Positions, of float32 or float64; or, without `faces`, an object with `vertices` and `faces` as trimesh has, or
        a list of such objects and of tuples ``(vertices, faces[, uvs])``.
    faces : (F, 3) array of integers
    normals : (V, 3) or (F, 3, 3) array
        For ``seams="normals"``, which cuts along hard edges.
    uvs : (V, 2) or (F, 3, 2) array
        Present UVs, v up, for ``cut="keep"`` and ``cut="seams"``.
    progress : callable or bool
        True shows a bar if ``tqdm`` is there. A function is called now and then, on this thread, with a `Progress`. Returning False ends the work with the present map, which
        is valid; an exception cancels it.
    **options
        The options of ``unwrapd unwrap`` in snake case, such as ``cut="fast"``, ``quality="few"``, ``resolution=2048``,
        ``padding=4``, ``time_budget=10`` (seconds), ``threads=2``. `unwrapd.options("unwrap")` lists them. `energy` may be an
        `Energy`, too: its functions are called for all elements of a chart at once, and what they raise is raised to the caller.

    Returns
    -------
    Atlas, or for a list of meshes a list of those, which have one report.

    Raises
    ------
    InvalidOptions, InvalidInput, NoValidResult
        With the code of the service in `code`.
    TypeError
        For an unknown option; the message names the nearest.

    The interpreter is released meanwhile, and Ctrl-C ends the call at once.
    """
    meshes, is_list = _taken(mesh, faces, uvs, normals, options.get("cut") in ("keep", "seams"))
    texts, functions = _energy.split(options)
    given = to_json("unwrap", texts)
    with heard(progress) as listener:
        return _atlas(_native.unwrap(meshes, given, functions, listener), is_list)


@overload
def repack(
    mesh: list[Any], *, progress: Optional[Listener] = None, **options: Unpack[RepackOptions]
) -> list[Atlas]: ...
@overload
def repack(
    mesh: Any,
    faces: Any = None,
    uvs: Any = None,
    *,
    progress: Optional[Listener] = None,
    **options: Unpack[RepackOptions],
) -> Atlas: ...
def repack(
    mesh: Any,
    faces: Any = None,
    uvs: Any = None,
    *,
    progress: Optional[Listener] = None,
    **options: Any,
) -> Any:
    """Pack the UV islands of a mesh, or of several, into one atlas.

    Islands keep their shapes: they are rotated, shifted and scaled by one common factor. Parameters and results are those of
    `unwrap`; `uvs` are (V, 2) or (F, 3, 2), v up.
    """
    meshes, is_list = _taken(mesh, faces, uvs, None, True)
    given = to_json("repack", options)
    with heard(progress) as listener:
        return _atlas(_native.repack(meshes, given, listener), is_list)


def measure(
    mesh: Any, faces: Any = None, uvs: Any = None, **options: Unpack[MeasureOptions]
) -> dict[str, Any]:
    """Measure UVs: distortion, seams, density, packing, overlaps.

    Takes what `repack` takes and returns the report, as ``unwrapd measure --json`` prints it. UVs may come from anywhere.
    """
    meshes, _ = _taken(mesh, faces, uvs, None, True)
    report: dict[str, Any] = json.loads(_native.measure(meshes, to_json("measure", options)))
    return report


def verify(
    mesh: Any, faces: Any = None, uvs: Any = None, **options: Unpack[VerifyOptions]
) -> dict[str, Any]:
    """Prove in exact arithmetic that UVs have no flipped or degenerate triangle.

    With ``bijective=True`` also that no two overlap. ``["certified"]`` is the answer, ``["lacking"]`` says what does not
    hold. Takes what `repack` takes.
    """
    meshes, _ = _taken(mesh, faces, uvs, None, True)
    verdict: dict[str, Any] = json.loads(_native.verify(meshes, to_json("verify", options)))
    return verdict


def bake(
    atlas: Any, attributes: Any, size: int, *, threads: Optional[int] = None
) -> tuple[np.ndarray, np.ndarray]:
    """Make a texture of what vertices have, such as colors.

    Parameters
    ----------
    atlas : Atlas, or list of Atlas that share an atlas
    attributes : (V,) or (V, C) array, or a list of those
        Numbers of the vertices of the given mesh.
    size : int
        Side of the texture in texels.

    Returns
    -------
    image : (size, size, C) or (size, size) float32
        The first row is the top, v = 1. What lies between charts is filled from their borders.
    mask : (size, size) bool
        Texels whose center lies in a chart.
    """
    atlases, lists = (
        ([atlas], [attributes]) if isinstance(atlas, Atlas) else (list(atlas), list(attributes))
    )
    if len(atlases) != len(lists):
        raise ValueError(f"{len(atlases)} meshes, but attributes of {len(lists)}")
    uvs = np.concatenate([atlas.corner_uvs for atlas in atlases]).astype(np.float64)
    found = [_meshes.array(given, "attributes") for given in lists]
    values = np.concatenate([_of_corners(*pair) for pair in zip(atlases, found)])
    image, mask = _native.bake(uvs, np.ascontiguousarray(values), size, threads)
    return (image[:, :, 0] if found[0].ndim == 1 else image), mask


def _of_corners(atlas: Atlas, attributes: np.ndarray) -> np.ndarray:
    table = attributes[:, None] if attributes.ndim == 1 else attributes
    if table.ndim != 2:
        raise ValueError(f"attributes must have the shape (V,) or (V, C), not {attributes.shape}")
    named = atlas.vmapping[atlas.indices]
    if named.size and int(named.max()) >= len(table):
        raise ValueError(
            f"attributes has {len(table)} rows, but faces name vertex {int(named.max())}"
        )
    values: np.ndarray = table[named].astype(np.float32)
    return values


def _taken(
    mesh: Any, faces: Any, uvs: Any, normals: Any, with_uvs: bool
) -> tuple[list[_meshes.Native], bool]:
    """The meshes, and whether a list was given."""
    if faces is not None:
        return [_meshes.native(mesh, faces, uvs, normals)], False
    if _meshes.is_mesh(mesh):
        taken = _meshes.of(mesh, with_uvs and uvs is None)
        if uvs is not None or normals is not None:
            taken = _meshes.native(taken[0], taken[1], uvs, normals)
        return [taken], False
    if uvs is not None or normals is not None:
        raise TypeError(
            "uvs and normals belong to one mesh; in a list use tuples (vertices, faces, uvs, normals)"
        )
    if isinstance(mesh, (list, tuple)) and all(_is_entry(entry) for entry in mesh):
        return [_meshes.of(entry, with_uvs) for entry in mesh], True
    raise TypeError(
        f"expected vertices and faces, a mesh with both, or a list of meshes, not {_named(mesh)}"
    )


def _named(given: Any) -> str:
    """What was given instead of a mesh, and what it is for."""
    if isinstance(given, (str, bytes, os.PathLike)):
        return f"{given!r}: a path is for unwrap_file(path, output)"
    if isinstance(given, dict):
        return "a dict: give its arrays of vertices and faces"
    if isinstance(given, tuple):
        return "a tuple: give its parts, as in unwrap(*mesh), or a list of such tuples"
    return f"{type(given).__name__} alone: faces are missing"


def _is_entry(entry: Any) -> bool:
    return _meshes.is_mesh(entry) or (isinstance(entry, tuple) and 2 <= len(entry) <= 4)


def _atlas(given: tuple[list[_native.Welded], str], is_list: bool) -> Any:
    meshes, report = given
    atlases = [Atlas(*mesh, report) for mesh in meshes]
    return atlases if is_list else atlases[0]
