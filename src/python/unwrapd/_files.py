"""Files: glTF, OBJ, OFF, PLY and STL in, glTF and OBJ out."""

from __future__ import annotations

import errno
import json
import os
from typing import TYPE_CHECKING, Any, Callable, Mapping, Optional, Union

from . import _energy, _native
from ._errors import InvalidOptions
from ._options import to_json
from ._progress import heard

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ._option_types import (
        MeasureFileOptions,
        RepackFileOptions,
        UnwrapBytesOptions,
        UnwrapFileOptions,
        VerifyFileOptions,
    )

Path = Union[str, "os.PathLike[str]"]
Listener = Union[bool, Callable[[_native.Progress], Any]]


def unwrap_file(
    input: Path,
    output: Path,
    *,
    progress: Optional[Listener] = None,
    **options: Unpack[UnwrapFileOptions],
) -> dict[str, Any]:
    """Unwrap every mesh of a file; everything else in it is preserved.

    Parameters
    ----------
    input : path of a .glb, .gltf, .obj, .off, .ply or .stl
        Files that it refers to are read from its folder.
    output : path of a .glb, .gltf or .obj
        Written when all is done, with the files beside it that the format needs. Its folder must exist.
    **options
        Those of ``unwrapd unwrap`` in snake case. `energy` may be an `Energy`, too, as in `unwrap`.

    Returns
    -------
    The report, whose certificate is of the written bytes.
    """
    texts, functions = _energy.split(options)

    def make(file: _native.File, given: str, stem: str, listener: Any) -> Any:
        return _native.unwrap_document(file, given, functions, stem, listener)

    return _converted("unwrap", make, input, output, texts, progress)


def repack_file(
    input: Path,
    output: Path,
    *,
    progress: Optional[Listener] = None,
    **options: Unpack[RepackFileOptions],
) -> dict[str, Any]:
    """Pack the UV islands of a file anew. As `unwrap_file`, with the options of ``unwrapd repack``."""
    return _converted("repack", _native.repack_document, input, output, options, progress)


def measure_file(input: Path, **options: Unpack[MeasureFileOptions]) -> dict[str, Any]:
    """Measure the UVs of a file, as ``unwrapd measure --json`` does."""
    return _parsed(
        _native.measure_document(file_of(input), to_json("measure", options, of_files=True))
    )


def verify_file(input: Path, **options: Unpack[VerifyFileOptions]) -> dict[str, Any]:
    """Prove in exact arithmetic what the UVs of a file are, as ``unwrapd verify --json`` does."""
    return _parsed(
        _native.verify_document(file_of(input), to_json("verify", options, of_files=True))
    )


def unwrap_bytes(
    data: bytes,
    name: str = "mesh.glb",
    *,
    resources: Optional[Mapping[str, bytes]] = None,
    progress: Optional[Listener] = None,
    **options: Unpack[UnwrapBytesOptions],
) -> tuple[bytes, dict[str, Any]]:
    """Unwrap a file in memory.

    Parameters
    ----------
    data : the bytes of the file
    name : its name, which tells the format where the bytes do not
    resources : the files that it refers to, by relative path
    **options
        Those of `unwrap_file`, and ``format="glb"`` (the default) or ``"obj"``.

    Returns
    -------
    The bytes of the result and the report.
    """
    if options.get("format") not in (None, "glb", "obj"):
        raise InvalidOptions(
            "`format` must be glb or obj: others consist of several files", "invalid_options", 2
        )
    file: _native.File = {
        "name": name,
        "bytes": bytes(data),
        "resources": dict(resources or {}),
        "folder": None,
    }
    texts, functions = _energy.split(options)
    given = to_json("unwrap", texts, of_files=True)
    with heard(progress) as listener:
        files, report = _native.unwrap_document(file, given, functions, None, listener)
    return files[0][1], _parsed(report)


def _converted(
    function: str,
    make: Any,
    source: Path,
    output: Path,
    options: Mapping[str, Any],
    progress: Optional[Listener],
) -> dict[str, Any]:
    folder, name = os.path.split(os.fspath(output))
    stem, extension = os.path.splitext(name)
    written_as = extension.lower().lstrip(".")
    if written_as not in ("glb", "gltf", "obj"):
        raise InvalidOptions(
            f"{name}: the name of the output must end in .glb, .gltf or .obj", "invalid_options", 2
        )
    if os.path.exists(output) and os.path.samefile(source, output):
        raise InvalidOptions(f"{name} would replace the input", "invalid_options", 2)
    given = to_json(function, {**options, "format": written_as}, of_files=True)
    if folder and not os.path.isdir(folder):
        raise FileNotFoundError(errno.ENOENT, "the directory does not exist", folder)
    with heard(progress) as listener:
        (main, *others), report = make(file_of(source), given, stem, listener)
    for relative, content in others:
        write(os.path.join(folder, relative), content)
    write(os.fspath(output), main[1])
    return _parsed(report)


def _parsed(report: str) -> dict[str, Any]:
    found: dict[str, Any] = json.loads(report)
    return found


def file_of(path: Path) -> _native.File:
    """A file as it is, with the folder of those that it refers to."""
    path = os.fspath(path)
    folder, name = os.path.split(path)
    with open(path, "rb") as file:
        content = file.read()
    return {"name": name, "bytes": content, "resources": {}, "folder": folder or "."}


def write(path: str, content: bytes) -> None:
    """A file is whole or not there."""
    os.makedirs(os.path.dirname(path) or ".", exist_ok=True)
    partial = f"{path}.{os.getpid()}.part"
    try:
        with open(partial, "wb") as file:
            file.write(content)
        os.replace(partial, path)
    except BaseException:
        if os.path.exists(partial):
            os.remove(partial)
        raise
