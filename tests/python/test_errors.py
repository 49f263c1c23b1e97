"""Errors have types and codes, and texts that help."""

import pickle

import numpy as np
import pytest
import unwrapd


def test_unknown_options(pyramid):
    with pytest.raises(TypeError, match="'qualty'; did you mean 'quality'"):
        unwrapd.unwrap(*pyramid, qualty="few")
    with pytest.raises(TypeError, match="'texcoord' for arrays: it concerns files"):
        unwrapd.unwrap(*pyramid, texcoord=1)


@pytest.mark.parametrize(
    "options",
    [
        {"padding": -1},
        {"padding": 1.5},
        {"padding": "4"},
        {"quality": "best"},
        {"resolution": 1000_000},
        {"resolution": (1000, 300)},
        {"seam_weight": float("nan")},
        {"time_budget": -1.0},
        {"threads": 0},
        {"max_distortion": 4.05, "cut": "fast"},
    ],
)
def test_invalid_options(pyramid, options):
    with pytest.raises(unwrapd.InvalidOptions) as raised:
        unwrapd.unwrap(*pyramid, **options)
    assert raised.value.code == "invalid_options" and raised.value.exit_code == 2
    assert isinstance(raised.value, (unwrapd.Error, ValueError))


def test_none_is_the_default(pyramid):
    assert unwrapd.unwrap(*pyramid, padding=None, time_budget=None).certified


def test_options_take_numpy_numbers(pyramid):
    atlas = unwrapd.unwrap(
        *pyramid, padding=np.int64(3), seam_weight=np.float32(2), resolution=(2048, 1024)
    )
    assert atlas.report["options"]["padding"] == 3
    assert atlas.report["options"]["resolution"] == "2048x1024"


def codes(pyramid):
    vertices, faces = pyramid
    broken = vertices.copy()
    broken[0, 0] = np.nan
    return [
        ("index_out_of_range", vertices, faces + 4),
        ("index_out_of_range", vertices, faces - 1),
        ("index_out_of_range", vertices, faces + 2**40),
        ("non_finite_position", broken, faces),
        ("no_triangles", vertices, faces[:0]),
        ("no_triangles", vertices, faces * 0),
        ("no_triangles", [], []),
    ]


def test_unusable_meshes(pyramid):
    for code, vertices, faces in codes(pyramid):
        with pytest.raises(unwrapd.InvalidInput) as raised:
            unwrapd.unwrap(vertices, faces)
        assert raised.value.code == code and raised.value.exit_code == 3


def test_an_index_of_another_mesh_is_out_of_range(pyramid):
    vertices, faces = pyramid
    with pytest.raises(unwrapd.InvalidInput) as raised:
        unwrapd.unwrap([(vertices, faces + 3), (vertices + 9, faces)])
    assert raised.value.code == "index_out_of_range"


@pytest.mark.parametrize(
    "wrong",
    [
        lambda v, f: (v[:, :2], f),
        lambda v, f: (v.ravel(), f),
        lambda v, f: (v, f.ravel()),
        lambda v, f: (v, f[:, :2]),
    ],
)
def test_shapes(pyramid, wrong):
    with pytest.raises(ValueError, match="shape"):
        unwrapd.unwrap(*wrong(*pyramid))


def test_types(pyramid):
    vertices, faces = pyramid
    with pytest.raises(TypeError, match="integers"):
        unwrapd.unwrap(vertices, faces.astype(float))
    with pytest.raises(TypeError, match="real numbers"):
        unwrapd.unwrap(vertices.astype(complex), faces)
    with pytest.raises(TypeError, match="faces are missing"):
        unwrapd.unwrap(vertices)
    with pytest.raises(ValueError, match="uvs"):
        unwrapd.repack(vertices, faces, vertices[:3, :2])


def test_too_small_a_texture(pyramid):
    with pytest.raises(unwrapd.InvalidInput) as raised:
        unwrapd.unwrap(*pyramid, texels_per_unit=1e6)
    assert raised.value.code == "texture_too_small"


def test_errors_can_be_pickled(pyramid):
    with pytest.raises(unwrapd.InvalidInput) as raised:
        unwrapd.unwrap(pyramid[0], pyramid[1] + 4)
    again = pickle.loads(pickle.dumps(raised.value))
    assert type(again) is unwrapd.InvalidInput
    assert (again.code, again.exit_code, str(again)) == ("index_out_of_range", 3, str(raised.value))


def test_options_are_listed():
    for function in ["unwrap", "repack", "measure", "verify"]:
        names = unwrapd.options(function)
        assert "threads" in names and len(names) == len(set(names))
    assert {"cut", "quality", "padding", "time_budget"} <= set(unwrapd.options("unwrap"))
