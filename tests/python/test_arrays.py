"""Meshes as arrays."""

import pickle

import numpy as np
import pytest
import unwrapd


def check(atlas, vertices, faces):
    assert atlas.vmapping.dtype == atlas.indices.dtype == atlas.charts.dtype == np.uint32
    assert atlas.uvs.dtype == np.float32
    assert atlas.indices.shape == faces.shape
    assert atlas.uvs.shape == (len(atlas.vmapping), 2)
    assert atlas.corner_uvs.shape == (len(faces), 3, 2)
    assert (vertices[atlas.vmapping][atlas.indices] == vertices[faces]).all()
    assert atlas.uvs.min() >= 0 and atlas.uvs.max() <= 1
    assert atlas.indices.max() + 1 == len(atlas.vmapping)


@pytest.mark.parametrize("index_type", [np.uint8, np.int32, np.uint32, np.int64, np.uint64])
@pytest.mark.parametrize("type", [np.float32, np.float64, np.int64])
def test_types(cube, type, index_type):
    vertices, faces = cube[0].astype(type), cube[1].astype(index_type)
    atlas = unwrapd.unwrap(vertices, faces)
    check(atlas, vertices, faces)
    assert atlas.certified
    assert (atlas.uvs == unwrapd.unwrap(*cube).uvs).all()


def test_layouts_are_taken_as_they_are(cube):
    vertices, faces = cube
    expected = unwrapd.unwrap(vertices, faces).uvs
    strided = np.repeat(vertices, 2, axis=0)[::2]
    assert not strided.flags.c_contiguous
    for given in [(strided, faces[::1]), (np.asfortranarray(vertices), np.asfortranarray(faces))]:
        assert (unwrapd.unwrap(*given).uvs == expected).all()
    assert (unwrapd.unwrap(vertices.tolist(), faces.tolist()).uvs == expected).all()
    big = vertices.astype(">f8"), faces.astype(">i4")
    assert (unwrapd.unwrap(*big).uvs == expected).all()


class Exported:
    """Something with `__dlpack__` and nothing else."""

    def __init__(self, array):
        self.array = array

    def __dlpack__(self, **arguments):
        return self.array.__dlpack__(**arguments)

    def __dlpack_device__(self):
        return self.array.__dlpack_device__()


class Converted:
    """Something with `__array__` and nothing else."""

    def __init__(self, array):
        self.array = array

    def __array__(self, dtype=None, copy=None):
        return self.array if dtype is None else self.array.astype(dtype)


@pytest.mark.parametrize("kind", [Exported, Converted])
def test_protocols(cube, kind):
    atlas = unwrapd.unwrap(kind(cube[0]), kind(cube[1]))
    assert (atlas.uvs == unwrapd.unwrap(*cube).uvs).all()


def test_meshes_with_attributes(cube):
    class Mesh:
        vertices, faces = cube

    assert (unwrapd.unwrap(Mesh).uvs == unwrapd.unwrap(*cube).uvs).all()


def test_several_share_one_atlas(cube, pyramid):
    meshes = [(cube[0], cube[1]), (pyramid[0] + 5, pyramid[1])]
    first, second = unwrapd.unwrap(meshes, padding=4)
    check(first, *meshes[0])
    check(second, *meshes[1])
    assert first.report == second.report
    assert set(first.charts).isdisjoint(second.charts)
    assert first.certified and first.report["groups"][0]["certificate"]["padding"]["kept"]
    whole = np.concatenate([first.corner_uvs, second.corner_uvs])
    vertices = np.concatenate([meshes[0][0], meshes[1][0]])
    faces = np.concatenate([meshes[0][1], meshes[1][1] + len(meshes[0][0])])
    assert unwrapd.verify(vertices, faces, whole, bijective=True, padding=4)["certified"]


def test_what_no_triangle_names_is_left_out(pyramid):
    vertices, faces = np.vstack([[[9, 9, 9]], pyramid[0]]), pyramid[1] + 1
    atlas = unwrapd.unwrap(vertices, faces)
    check(atlas, vertices, faces)
    assert 0 not in atlas.vmapping


def test_a_face_without_area_stays(pyramid):
    faces = np.vstack([pyramid[1], [[0, 0, 1]]])
    atlas = unwrapd.unwrap(pyramid[0], faces)
    check(atlas, pyramid[0], faces)
    assert atlas.certificate["exempt_faces"] == 1


def test_repack_keeps_islands(cube):
    atlas = unwrapd.unwrap(*cube, cut="fast")
    vertices, faces, uvs = cube[0][atlas.vmapping], atlas.indices, atlas.uvs * 0.5
    packed = unwrapd.repack(vertices, faces, uvs)
    check(packed, vertices, faces)
    assert packed.n_charts == atlas.n_charts and packed.certified
    again = unwrapd.repack([(vertices, faces, uvs)])
    assert (again[0].uvs == packed.uvs).all()


def test_kept_islands(cube):
    atlas = unwrapd.unwrap(*cube, cut="fast")
    kept = unwrapd.unwrap(*cube, uvs=atlas.corner_uvs, cut="keep")
    assert kept.n_charts == atlas.n_charts
    with pytest.raises(unwrapd.InvalidInput) as raised:
        unwrapd.unwrap(*cube, cut="keep")
    assert raised.value.code == "no_uvs"


def test_seams(cube):
    vertices, faces = cube
    normals = np.repeat(np.eye(3)[[0, 0, 1, 1, 2, 2]], 2, axis=0)[:, None].repeat(3, axis=1)
    atlas = unwrapd.unwrap(vertices, faces, normals=normals, seams="normals", cut="seams")
    assert atlas.n_charts == 6
    edges = [[0, 1], [1, 3], [3, 2], [2, 0]]
    atlas = unwrapd.unwrap(vertices, faces, seams=np.array(edges), cut="seams")
    assert atlas.n_charts == 2


def test_a_cube_unfolds_at_its_corners(cube):
    for cones, is_flat in [(np.arange(8), True), ([0, 3], False)]:
        atlas = unwrapd.unwrap(*cube, cut="disk", cone_vertices=cones)
        assert atlas.n_charts == 1
        energy = atlas.report["groups"][0]["measures"]["sym_dirichlet_mean"]
        assert (energy < 4 + 1e-6) == is_flat
    with pytest.raises(unwrapd.InvalidOptions):
        unwrapd.unwrap(*cube, cone_vertices=[0])


def test_measure_and_verify(pyramid):
    vertices, faces = pyramid
    flat = vertices[:, :2]
    assert unwrapd.verify(vertices, faces, flat, bijective=True)["certified"]
    flipped = np.where(faces[..., None] == 4, [0.5, 1.5], flat[faces])
    verdict = unwrapd.verify(vertices, faces, flipped)
    assert not verdict["certified"] and verdict["groups"][0]["certificate"]["flipped"] == 1
    report = unwrapd.measure(vertices, faces, flat)
    assert report["groups"][0]["measures"]["sym_dirichlet_mean"] > 4.1


def test_an_atlas_can_be_pickled(pyramid):
    atlas = unwrapd.unwrap(*pyramid)
    again = pickle.loads(pickle.dumps(atlas))
    assert (again.uvs == atlas.uvs).all() and again.report == atlas.report
    assert repr(again) == "<unwrapd.Atlas: 4 faces, 1 charts, certified>"


def test_threads_do_not_change_the_result(sheet):
    one = unwrapd.unwrap(*sheet(30), threads=1)
    assert (one.uvs == unwrapd.unwrap(*sheet(30), threads=2).uvs).all()


def test_words_may_have_underscores_in_the_place_of_hyphens(pyramid):
    uvs = pyramid[0][:, :2]
    atlas = unwrapd.unwrap(*pyramid, uvs=uvs, cut="keep", kept_maps="as_given")
    assert atlas.report["options"]["kept_maps"] == "as-given"
    with pytest.raises(unwrapd.InvalidOptions, match="kept_maps"):
        unwrapd.unwrap(*pyramid, kept_maps="as_givn")
