"""What the Blender extension does with arrays: only faces that may change do, and no polygon is cut."""

import importlib
import importlib.machinery
import importlib.util
import pathlib
import sys
import tomllib

import numpy as np
import pytest

FOLDER = pathlib.Path(__file__).resolve().parents[2] / "src/blender"


@pytest.fixture(scope="module")
def layout():
    """The module `layout` of the extension, without those that need Blender."""
    spec = importlib.machinery.ModuleSpec("blender_extension", None, is_package=True)
    spec.submodule_search_locations = [str(FOLDER)]
    sys.modules["blender_extension"] = importlib.util.module_from_spec(spec)
    return importlib.import_module("blender_extension.layout")


class Quads:
    """A mesh of quadrilaterals as `meshes.Mesh` has one, each parted from its first to its third vertex."""

    name = "quads"

    def __init__(self, positions, quads, uvs=None):
        self.positions, self.present = np.asarray(positions, np.float32), uvs
        self.vertices = np.asarray(quads, np.int32).ravel()
        self.starts = np.arange(0, len(self.vertices) + 1, 4, dtype=np.int32)
        first = self.starts[:-1, None]
        self.triangles = np.concatenate([first + [0, 1, 2], first + [0, 2, 3]], 1).reshape(-1, 3)
        self.polygons = np.repeat(np.arange(len(quads)), 2)
        self.seams = np.zeros((0, 2), np.int32)
        self.is_free = np.ones(len(self.triangles), bool)
        a, b, c = np.moveaxis(self.positions[self.faces].astype(float), 1, 0)
        self.has_area = np.linalg.norm(np.cross(b - a, c - a), axis=1) > 0
        self.pinned = np.zeros(len(self.vertices), bool)

    @property
    def faces(self):
        return self.vertices[self.triangles]

    def uvs(self):
        return None if self.present is None else self.present.copy()

    def pins(self):
        return self.pinned


def crumpled(seed, n=7, height=0.8):
    """A closed torus of quadrilaterals that are far from flat."""
    random = np.random.default_rng(seed)
    u, v = (x.ravel() * 2 * np.pi / n for x in np.meshgrid(range(n), range(n), indexing="ij"))
    radius = 1 + height * random.uniform(-0.5, 0.5, n * n)
    positions = np.stack([(2 + radius * np.cos(v)) * np.cos(u), (2 + radius * np.cos(v)) * np.sin(u), 2 * radius * np.sin(v)], 1)
    at = np.arange(n * n).reshape(n, n)
    right, up = np.roll(at, -1, 0), np.roll(at, -1, 1)
    return positions, np.stack([at, right, np.roll(right, -1, 1), up], 2).reshape(-1, 4)


@pytest.mark.parametrize("seed", [4, 8, 15])
def test_no_polygon_is_cut_and_none_is_refused(layout, seed):
    """Of these a polygon is cut again after a seam was led around its shorter side."""
    mesh = Quads(*crumpled(seed, height=2.2))
    found = layout.unwrapped([mesh], along_seams=False)
    assert not found.refused and found.report["certified"]
    # One UV for each loop, and so for each corner of a quadrilateral.
    assert found.uvs[0].shape == (len(mesh.vertices), 2)


def test_other_faces_keep_their_uvs(layout):
    mesh = Quads(*crumpled(1))
    mesh.present = layout.unwrapped([mesh], along_seams=False).uvs[0] * np.float32(0.9)
    mesh.is_free = mesh.polygons % 4 == 0
    for found in (layout.unwrapped([mesh], along_seams=False), layout.repacked([mesh])):
        free = np.zeros(len(mesh.vertices), bool)
        free[mesh.triangles[mesh.is_free]] = True
        assert np.array_equal(found.uvs[0][~free], mesh.present[~free])
        assert not np.array_equal(found.uvs[0][free], mesh.present[free])


def test_pins_hold_the_islands_of_free_faces_alone(layout):
    mesh = Quads(*crumpled(2))
    mesh.present = layout.unwrapped([mesh], along_seams=False).uvs[0]
    mesh.is_free = mesh.polygons < 20
    mesh.pinned[4 * 40] = True
    assert not layout.pinned(mesh).any()
    mesh.pinned[0] = True
    assert layout.pinned(mesh)[0]


def test_a_face_that_cannot_be_kept_is_named_and_others_go_on(layout, monkeypatch):
    meshes = [Quads(*crumpled(3)), Quads(*crumpled(4, n=6))]
    original = layout.split
    monkeypatch.setattr(layout, "split", lambda mesh, *rest: [5] if mesh is meshes[1] else original(mesh, *rest))
    found = layout.unwrapped(meshes, along_seams=False)
    assert found.refused == {1: [5]}
    assert found.uvs[0] is not None and found.uvs[1] is None and found.report["certified"]
    found = layout.unwrapped(meshes[1:], along_seams=False)
    assert found.refused == {0: [5]} and found.uvs == [None] and found.report is None


def test_its_files_have_the_license_that_the_platform_requires():
    manifest = tomllib.loads((FOLDER / "blender_manifest.toml").read_text())
    assert manifest["license"] == ["SPDX:GPL-3.0-or-later"]
    assert "GNU GENERAL PUBLIC LICENSE" in (FOLDER / "LICENSE").read_text()
    for path in FOLDER.glob("*.py"):
        assert "SPDX-License-Identifier: GPL-3.0-or-later" in path.read_text(), path.name
