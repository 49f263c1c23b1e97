"""The calls that public pipelines make of `xatlas`, made of both packages.

VAST-AI-Research/TripoSR (MIT), `tsr/bake_texture.py`: packs with a resolution and a padding and draws positions in UV space.
threestudio-project/threestudio (Apache-2.0), `threestudio/models/mesh.py`: sets options by name and views indices as int64.
mikedh/trimesh (MIT), `Trimesh.unwrap`: see test_trimesh.py.
"""

import numpy as np
import pytest
import unwrapd.xatlas

original = pytest.importorskip("xatlas")


@pytest.fixture(params=[original, unwrapd.xatlas], ids=["xatlas", "unwrapd"])
def xatlas(request):
    return request.param


@pytest.fixture
def noisy(sheet):
    """A rough sheet, as marching cubes make."""
    vertices, faces = sheet(24)
    noise = np.random.default_rng(1).normal(scale=0.004, size=vertices.shape)
    return (vertices + noise).astype(np.float32), faces


def test_positions_in_uv_space(xatlas, noisy):
    """Each texel at a face's middle gets the position of that middle: no other face is drawn over it."""
    vertices, faces = noisy
    size = 512
    atlas, options = xatlas.Atlas(), xatlas.PackOptions()
    options.resolution, options.padding, options.bilinear = size, round(max(2, size / 256)), True
    atlas.add_mesh(vertices, faces)
    atlas.generate(pack_options=options)
    vmapping, indices, uvs = atlas[0]
    drawn = np.full((size, size), -1)
    corners = uvs.flatten().astype("f4").reshape(-1, 2)[indices.flatten().astype("i4").reshape(-1, 3)]
    middles = np.floor(corners.mean(axis=1) * size).astype(int)
    for face, (column, row) in enumerate(middles):
        drawn[row, column] = face
    shown = drawn[middles[:, 1], middles[:, 0]]
    # Small faces may share a texel; those of other charts may not be near.
    gap = np.linalg.norm(vertices[vmapping][indices][shown].mean(axis=1) - vertices[faces].mean(axis=1), axis=1)
    assert gap.max() < 0.2


def test_options_by_name(xatlas, noisy):
    vertices, faces = noisy
    chart, pack = xatlas.ChartOptions(), xatlas.PackOptions()
    for name, value in {"fix_winding": True}.items():
        setattr(chart, name, value)
    for name, value in {"resolution": 1024, "padding": 1, "bruteForce": False}.items():
        setattr(pack, name, value)
    atlas = xatlas.Atlas()
    atlas.add_mesh(vertices, faces)
    atlas.generate(chart, pack)
    vmapping, indices, uvs = atlas.get_mesh(0)
    vmapping = vmapping.astype(np.uint64, casting="same_kind").view(np.int64)
    indices = indices.astype(np.uint64, casting="same_kind").view(np.int64)
    assert (vertices[vmapping][indices] == vertices[faces]).all()
    assert uvs.shape == (len(vmapping), 2) and uvs.min() >= 0 and uvs.max() <= 1
