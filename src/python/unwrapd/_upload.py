"""Files and options as a form."""

from __future__ import annotations

import uuid

from . import _native
from ._files import Path, file_of


def form(kind: str, path: Path, options: str) -> tuple[bytes, str]:
    """A file, those that it refers to and options as a form, and the type of that."""
    file = file_of(path)
    parts = [('name="kind"', kind.encode()), ('name="options"', options.encode())]
    parts.append((_named("mesh", file["name"]), file["bytes"]))
    for name, content in _native.references(file):
        parts.append((_named("resource", name), content))
    boundary = uuid.uuid4().hex
    body = bytearray()
    for head, content in parts:
        body += f"--{boundary}\r\nContent-Disposition: form-data; {head}\r\n\r\n".encode()
        body += content
        body += b"\r\n"
    body += f"--{boundary}--\r\n".encode()
    return bytes(body), f"multipart/form-data; boundary={boundary}"


def _named(part: str, name: str) -> str:
    escaped = name.replace('"', "%22").replace("\r", "%0D").replace("\n", "%0A")
    return f'name="{part}"; filename="{escaped}"'
