"""Bodies that schemathesis cannot make up: mesh files, some of them usable."""
import schemathesis
from hypothesis import strategies as st

TRIANGLE = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"
MEDIA_TYPES = [
    "model/gltf-binary", "model/gltf+json", "model/obj", "model/stl", "application/sla",
    "application/vnd.ms-pki.stl", "model/ply", "application/ply", "model/off", "text/plain",
    "application/octet-stream",
]
BODIES = st.one_of(
    st.just(TRIANGLE),
    st.binary(max_size=200),
    st.binary(max_size=50).map(lambda tail: b"glTF\x02\x00\x00\x00" + tail),
    st.just(b'{"asset":{"version":"2.0"}}'),
)
for media_type in MEDIA_TYPES:
    schemathesis.openapi.media_type(media_type, BODIES)


@schemathesis.serializer(*MEDIA_TYPES)
def raw(ctx, value):
    """Sends bytes as they are."""
    return value if isinstance(value, bytes) else str(value).encode()
