"""Bodies that schemathesis cannot make up: meshes, pictures and drawings, some of them usable; and whose jobs are asked for."""
import os
import pathlib
import struct
import zlib

import schemathesis
from hypothesis import strategies as st


def picture(side):
    """A PNG of one color."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    rows = zlib.compress((b"\0" + b"\xff\0\0\xff" * side) * side)
    header = struct.pack(">IIBBBBB", side, side, 8, 6, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", rows) + chunk(b"IEND", b"")


TRIANGLE = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"
MEDIA_TYPES = [
    "model/gltf-binary", "model/gltf+json", "model/obj", "model/stl", "application/sla",
    "application/vnd.ms-pki.stl", "model/ply", "application/ply", "model/off", "text/plain",
    "application/octet-stream", "image/png", "image/jpeg", "image/webp", "image/svg+xml", "image/ktx2",
]
KTX2 = (pathlib.Path(__file__).parents[1] / "assets/ktx2/etc1s.ktx2").read_bytes()
BODIES = st.one_of(
    st.just(TRIANGLE),
    st.binary(max_size=200),
    st.binary(max_size=50).map(lambda tail: b"glTF\x02\x00\x00\x00" + tail),
    st.just(b'{"asset":{"version":"2.0"}}'),
    st.just(picture(8)),
    st.just(KTX2),
    st.integers(0, len(KTX2)).map(lambda length: KTX2[:length]),
    st.just(b'<svg xmlns="http://www.w3.org/2000/svg"><rect width="4" height="3"/></svg>'),
    st.just(b"4 1\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n0 1 2 3\n"),
)
for media_type in MEDIA_TYPES:
    schemathesis.openapi.media_type(media_type, BODIES)


@schemathesis.serializer(*MEDIA_TYPES)
def raw(ctx, value):
    """Sends bytes as they are."""
    return value if isinstance(value, bytes) else str(value).encode()


# What belongs to alice, where somebody else asks.
JOB, SESSION = os.environ.get("SECRET_JOB"), os.environ.get("SECRET_SESSION")


@schemathesis.hook
def map_path_parameters(context, path_parameters):
    """Asks for what belongs to another owner."""
    if JOB and path_parameters and "id" in path_parameters:
        path_parameters["id"] = SESSION if "/sessions/" in context.operation.path else JOB
    return path_parameters


@schemathesis.check
def nothing_of_another_owner(ctx, response, case):
    """What belongs to another owner does not exist. Other ids come from the caller's own list."""
    if JOB:
        assert b"alice" not in response.content
        asked = {JOB, SESSION}.intersection((case.path_parameters or {}).values())
        assert not asked or response.status_code >= 400
