"""Folded meshes, and meshes without inversions from them."""

from __future__ import annotations

import json
from typing import Any, NamedTuple, Optional

import numpy as np

from . import _bodies, _meshes, _native


class Untangled(NamedTuple):
    """A mesh without inverted elements.

    Attributes
    ----------
    vertices : (V, D) float64
        Those that did not have to move are where they were, to the bit.
    elements : (E, D + 1) uint32
        The elements in their order, each with its corners in an order of positive size.
    report : dict
        `elements`, `inverted_before`, `turned` (elements given in the opposite order of their neighbors), `moved` (vertices),
        `smallest` (the smallest size of an element over its rest size) and `warnings`.
    """

    vertices: np.ndarray
    elements: np.ndarray
    report: dict[str, Any]


def untangle(
    vertices: Any,
    elements: Any,
    *,
    rest: str = "implied",
    rest_vertices: Any = None,
    boundary: str = "fixed",
    time_budget: Optional[float] = None,
    threads: Optional[int] = None,
) -> Untangled:
    """Move vertices of a folded mesh, as few as possible, until every element is positive in exact arithmetic.

    Parameters
    ----------
    vertices : (V, 2) or (V, 3) array
    elements : (E, 3) array of triangles in the plane, or (E, 4) of tetrahedra
    rest : "implied" or "regular"
        The rest shapes: each element's own if it is not inverted and a regular one otherwise, or regular ones of one size.
    rest_vertices : (V, D) array
        Positions without inversions that have the rest shapes, instead of `rest`.
    boundary : "fixed" or "free"
        Whether vertices of the boundary may move.
    time_budget : float
        Time limit in seconds. A mesh without inversions that is found by then is returned.

    Raises
    ------
    InvalidInput
        If this is no such mesh, if its fixed boundary contradicts every map without inversions, or if none is found.
    Error
        With the code ``"ended_early"``, if none is found within `time_budget`.
    InvalidOptions, TypeError, ValueError

    The interpreter is released meanwhile, and Ctrl-C ends the call at once.

    >>> import unwrapd
    >>> square = [[0, 0], [1, 0], [1, 1], [0, 1], [2, 0.5]]
    >>> fan = [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]]
    >>> untangled = unwrapd.untangle(square, fan)
    >>> untangled.report["inverted_before"], untangled.report["moved"]
    (1, 1)
    """
    places = _positions(vertices, "vertices")
    width = _meshes.array(elements, "elements").shape[-1:]
    dim = places.shape[1]
    if (width, dim) not in (((3,), 2), ((4,), 3)):
        raise ValueError("untangle takes triangles in the plane, (V, 2) and (E, 3), or tetrahedra, (V, 3) and (E, 4)")
    corners = _meshes.faces(elements, "elements", width[0])
    given = None
    if rest_vertices is not None:
        given = _bodies.flat(rest_vertices, len(places), dim, "rest_vertices").reshape(-1, dim)
        if not np.isfinite(given).all():
            raise ValueError("rest_vertices must be finite")
    options = {"rest": rest, "boundary": boundary, "time_budget": time_budget, "threads": threads}
    chosen = json.dumps({name: value for name, value in options.items() if value is not None})
    found, wound, report = _native.untangle(places, corners, given, chosen)
    return Untangled(found, wound, json.loads(report))


def _positions(given: Any, name: str) -> np.ndarray:
    found = _meshes.array(given, name)
    if found.ndim != 2 or found.shape[1] not in (2, 3):
        raise ValueError(f"{name} must have the shape (V, 2) or (V, 3), not {found.shape}")
    return np.ascontiguousarray(found, dtype=np.float64)
