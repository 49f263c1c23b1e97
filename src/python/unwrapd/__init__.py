"""unwrapd unwraps meshes: few charts, no flipped triangle, and a proof of it.

>>> import numpy, unwrapd
>>> vertices = numpy.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [.5, .5, .7]])
>>> faces = numpy.array([[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]])
>>> atlas = unwrapd.unwrap(vertices, faces)
>>> atlas.certified, atlas.n_charts
(True, 1)
>>> numpy.array_equal(vertices[atlas.vmapping][atlas.indices], vertices[faces])
True

`unwrapd.xatlas` has the calls of the package `xatlas`. `Problem` and `Session` minimize any energy of deformation, on triangles
and tetrahedra, with handles.
"""

from __future__ import annotations

import importlib

from . import _native

# What type checkers take for true. `typing` itself would be most of the time that the import takes.
TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

    from ._arrays import bake, measure, repack, unwrap, verify
    from ._atlas import Atlas
    from ._client import Client, Outcome
    from ._energy import Energy
    from ._errors import Error, InvalidInput, InvalidOptions, NoValidResult, ServiceError
    from ._files import measure_file, repack_file, unwrap_bytes, unwrap_file, verify_file
    from ._job import Job
    from ._native import Iterate, Progress
    from ._problem import Problem, Solution
    from ._progress import JobProgress
    from ._session import Session
    from ._untangle import Untangled, untangle

__version__: str = _native.__version__

#: Where names are: a module is imported when the first of its names is used, and NumPy with the first that needs it.
_MODULES = {
    "_arrays": ("bake", "measure", "repack", "unwrap", "verify"),
    "_atlas": ("Atlas",),
    "_client": ("Client", "Outcome"),
    "_energy": ("Energy",),
    "_errors": ("Error", "InvalidInput", "InvalidOptions", "NoValidResult", "ServiceError"),
    "_files": ("measure_file", "repack_file", "unwrap_bytes", "unwrap_file", "verify_file"),
    "_job": ("Job",),
    "_native": ("Iterate", "Progress"),
    "_problem": ("Problem", "Solution"),
    "_progress": ("JobProgress",),
    "_session": ("Session",),
    "_untangle": ("Untangled", "untangle"),
}


def options(function: str) -> list[str]:
    """The names of the options of a function, for arrays and files: ``"unwrap"``, ``"repack"``, ``"measure"``, ``"verify"``,
    ``"Problem"`` or ``"solve"``."""
    from ._options import names

    return names(function)


def __getattr__(name: str) -> Any:
    for module, names in _MODULES.items():
        if name in names:
            value = getattr(importlib.import_module(f".{module}", __name__), name)
            globals()[name] = value
            return value
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})


__all__ = [
    "Atlas",
    "Client",
    "Energy",
    "Error",
    "InvalidInput",
    "InvalidOptions",
    "Iterate",
    "Job",
    "JobProgress",
    "NoValidResult",
    "Outcome",
    "Problem",
    "Progress",
    "ServiceError",
    "Session",
    "Solution",
    "Untangled",
    "bake",
    "measure",
    "measure_file",
    "options",
    "repack",
    "repack_file",
    "untangle",
    "unwrap",
    "unwrap_bytes",
    "unwrap_file",
    "verify",
    "verify_file",
]
