"""Attributes of vertices as textures."""

import numpy as np
import pytest
import unwrapd


def test_a_linear_attribute_comes_back(cube):
    vertices, faces = cube
    atlas = unwrapd.unwrap(vertices, faces, resolution=256, padding=4)
    image, mask = unwrapd.bake(atlas, vertices, 256)
    assert image.shape == (256, 256, 3) and image.dtype == np.float32
    assert mask.shape == (256, 256) and mask.dtype == bool
    share = atlas.measures["area_uv"]
    assert abs(mask.mean() - share) < 0.02
    corners = atlas.corner_uvs
    for weights in ([1, 1, 1], [6, 1, 1], [1, 6, 1]):
        weights = np.array(weights) / sum(weights)
        uv = np.einsum("c,fcx->fx", weights, corners)
        expected = np.einsum("c,fcx->fx", weights, vertices[faces])
        column, row = (uv[:, 0] * 256).astype(int), ((1 - uv[:, 1]) * 256).astype(int)
        # A texel is about a hundredth of the cube's edge.
        assert np.abs(image[row, column] - expected).max() < 0.02


def test_between_charts_colors_go_on(cube):
    vertices, faces = cube
    atlas = unwrapd.unwrap(vertices, faces, cut="fast", padding=8)
    image, mask = unwrapd.bake(atlas, np.ones(len(vertices)), 64)
    assert image.shape == (64, 64) and not mask.all()
    assert np.abs(image - 1).max() < 1e-5


def test_several(cube, pyramid):
    meshes = [cube, (pyramid[0] + 3, pyramid[1])]
    atlases = unwrapd.unwrap(meshes)
    image, mask = unwrapd.bake(
        atlases, [np.full((len(v), 1), n + 1.0) for n, (v, _) in enumerate(meshes)], 128
    )
    assert image.shape == (128, 128, 1)
    values = image[mask][:, 0].round(5)
    assert set(values) == {1.0, 2.0}


def test_what_cannot_be(pyramid):
    atlas = unwrapd.unwrap(*pyramid)
    for size in (0, 1 << 20):
        with pytest.raises(ValueError, match="size"):
            unwrapd.bake(atlas, pyramid[0], size)
    with pytest.raises(ValueError, match="rows"):
        unwrapd.bake(atlas, pyramid[0][:2], 16)
    with pytest.raises(ValueError, match="shape"):
        unwrapd.bake(atlas, pyramid[0][None], 16)
    with pytest.raises(ValueError, match="attributes of 2"):
        unwrapd.bake([atlas], [pyramid[0], pyramid[0]], 16)
