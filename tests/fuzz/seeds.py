"""What the fuzzers begin with: small assets, options, a problem, forms and messages."""
import json
import pathlib
import sys

assets, folder = map(pathlib.Path, sys.argv[1:])
FORMATS = ["glb", "gltf", "obj", "off", "ply", "stl", "msh", "mesh", "tet"]
MOST_BYTES = 8000
SQUARE = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n"
TET = "4 1\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n0 1 2 3\n"
TEXTS = {
    "obj": SQUARE + "mtllib a.mtl\nusemtl b\no c\ng d\nvn 0 0 1\nf -1//1 -2//1 -3//1\n",
    "off": "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
    "ply": "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
           "property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
    "stl": "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid a\n",
    "msh": "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n$EndNodes\n"
           "$Elements\n1\n1 4 2 0 1 1 2 3 4\n$EndElements\n",
    "mesh": "MeshVersionFormatted 1\nDimension 3\nVertices\n4\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\nTetrahedra\n1\n1 2 3 4 0\nEnd\n",
    "tet": TET,
}
OPTIONS = [
    {"padding": 2, "resolution": 1024, "quality": "few", "group_by": "material", "cut": "disk"}, {"islands": [], "rotate": True}, {},
    {"certified": True}, {"threads": 1},
    {"handles": [{"vertex": 0, "to": [0, 0]}], "energy": "arap", "barrier": "inverse_spline", "cage": 8},
    {"handles": [{"at": [1, 2], "radius": 3, "to": [4, 5]}]}, {"anchors": [{"face": 0, "corner": 1, "to": [0.5, 0.5]}]}, {"bijective": True},
]
PROBLEM = {"mesh": "a.off", "handles": [0, 1], "targets": [[0, 0], [2, 0]], "energy": "arap", "barrier": "log", "beta": 0.1, "eps": 1e-4,
           "bijective": True, "sequence": [[[0, 0], [1, 0]]], "units": "given", "max_iter": 3}
MESSAGES = [
    {"n": 1, "add": {"name": 0, "handle": {"vertex": 0, "to": [0, 0]}}}, {"n": 2, "add": {"name": 1, "handle": {"vertex": 8, "to": [2, 2]}}},
    {"n": 3, "move": {"name": 1, "to": [3, 3]}}, {"n": 4, "remember": {}}, {"n": 5, "settings": {"energy": "arap"}},
    {"n": 6, "remove": {"name": 0}}, {"n": 7, "undo": {}}, {"n": 8, "redo": {}}, {"n": 9, "list": {}}, {"n": 10, "reset": {}},
]
PARTS = [("mesh", "a.obj", SQUARE), ("options", None, '{"padding":2}'), ("kind", None, "repack"), ("resource", "a.mtl", "newmtl b\n"),
         ("metadata", None, '{"a":1}'), ("accept", None, "certified,max_charts=3"), ("priority", None, "1")]


def seed(target, name, content):
    """Keeps a first input, where its fuzzer runs."""
    if (folder / target).is_dir():
        (folder / target / name).write_bytes(content)


for path in assets.rglob("*"):
    extension = path.suffix[1:]
    if path.is_file() and extension in FORMATS and path.stat().st_size < MOST_BYTES:
        seed("documents", path.name, bytes([FORMATS.index(extension)]) + path.read_bytes())
for extension, text in TEXTS.items():
    seed("documents", f"text.{extension}", bytes([FORMATS.index(extension)]) + text.encode())
for kind in range(9):
    for index, options in enumerate(OPTIONS):
        seed("options", f"{kind}-{index}", bytes([kind]) + json.dumps(options).encode())
seed("problems", "problem", json.dumps(PROBLEM).encode())
seed("messages", "all", "\n".join(map(json.dumps, MESSAGES)).encode())
form = ""
for name, file, content in PARTS:
    told = f'; filename="{file}"' if file else ""
    form += f'--x\r\nContent-Disposition: form-data; name="{name}"{told}\r\n\r\n{content}\r\n'
    seed("bodies", name, (form + "--x--\r\n").encode())
