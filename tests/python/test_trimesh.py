"""trimesh: its meshes as they are, and its own `unwrap`."""

import sys

import numpy as np
import pytest
import unwrapd
import unwrapd.xatlas

trimesh = pytest.importorskip("trimesh")


@pytest.fixture
def mesh():
    return trimesh.creation.icosphere(subdivisions=3)


def test_meshes_are_taken(mesh):
    atlas = unwrapd.unwrap(mesh)
    assert (atlas.uvs == unwrapd.unwrap(mesh.vertices, mesh.faces).uvs).all()
    first, second = unwrapd.unwrap([mesh, trimesh.creation.box()])
    assert len(first.indices) == len(mesh.faces) and len(second.indices) == 12


def test_its_uvs_are_taken(mesh):
    atlas = unwrapd.unwrap(mesh)
    mapped = trimesh.Trimesh(
        mesh.vertices[atlas.vmapping],
        atlas.indices,
        visual=trimesh.visual.TextureVisuals(uv=atlas.uvs),
        process=False,
    )
    assert unwrapd.verify(mapped, bijective=True)["certified"]
    assert unwrapd.repack(mapped, padding=8).n_charts == atlas.n_charts


def test_unwrap_of_trimesh(mesh, monkeypatch):
    monkeypatch.setitem(sys.modules, "xatlas", None)
    unwrapd.xatlas.install()
    result = mesh.unwrap()
    uvs, faces = result.visual.uv, np.asarray(result.faces)
    assert (result.triangles == mesh.triangles).all()
    assert unwrapd.verify(result.vertices, faces, uvs, bijective=True)["certified"]
