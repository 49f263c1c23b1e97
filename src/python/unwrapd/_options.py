"""Options: names are checked here, values in the library."""

from __future__ import annotations

import json
import math
from typing import Any, Mapping

from . import _native
from ._errors import InvalidOptions

#: What of `unwrap` concerns files, and what the functions on files take from names.
_OF_FILES = frozenset(
    (
        "group_by",
        "texel_weight",
        "material_borders",
        "heatmap_measure",
        "format",
        "frames",
        "source_texcoord",
        "texcoord",
        "overwrite",
        "rebake",
        "bake_tiled",
        "bake_colors",
        "bake_size",
        "image_format",
        "merge_materials",
        "separate_nodes",
        "skip_missing",
    )
)


def names(function: str, of_files: bool = True) -> list[str]:
    """The options of `unwrap`, `repack`, `measure`, `verify`, `Problem` or `solve`, for files or for arrays."""
    return [name for name in _native.option_names(function) if of_files or name not in _OF_FILES]


def to_json(function: str, options: Mapping[str, Any], of_files: bool = False) -> str:
    """Options as JSON; those that are None are left out. A name that is none is a TypeError."""
    known = names(function, of_files)
    for name in options:
        if name not in known:
            raise TypeError(_unknown(function, name, known, of_files))
    given = {name: value for name, value in options.items() if value is not None}
    resolution = given.get("resolution")
    if isinstance(resolution, (tuple, list)) and len(resolution) == 2:
        given["resolution"] = f"{resolution[0]}x{resolution[1]}"
    for name, value in given.items():
        if isinstance(value, float) and not math.isfinite(value):
            raise InvalidOptions(
                f"{name} must be a finite number, not {value}", "invalid_options", 2
            )
    return json.dumps(given, default=plain)


def _unknown(function: str, name: str, known: list[str], of_files: bool) -> str:
    import difflib

    if not of_files and name in names(function):
        return f"{function}() has no option {name!r} for arrays: it concerns files"
    near = difflib.get_close_matches(name, known, n=1, cutoff=0.0)
    return f"{function}() has no option {name!r}; did you mean {near[0]!r}?"


def plain(value: Any) -> Any:
    """What NumPy's numbers and arrays are in JSON, of options and of handles."""
    if hasattr(value, "tolist"):
        return value.tolist()
    raise TypeError(f"a value cannot be of type {type(value).__name__}")
