"""The same calls against the package `xatlas` and against `unwrapd.xatlas`."""

import numpy as np
import pytest
import unwrapd.xatlas

original = pytest.importorskip("xatlas")


@pytest.fixture(params=[original, unwrapd.xatlas], ids=["xatlas", "unwrapd"])
def xatlas(request):
    return request.param


def check(result, vertices, faces):
    vmapping, indices, uvs = result
    assert type(result) is tuple
    assert vmapping.dtype == np.uint32 and vmapping.ndim == 1
    assert indices.dtype == np.uint32 and indices.shape == np.shape(faces)
    assert uvs.dtype == np.float32 and uvs.shape == (len(vmapping), 2)
    assert len(indices) == 0 or int(indices.max()) < len(vmapping)
    assert len(vmapping) == 0 or int(vmapping.max()) < len(vertices)
    assert np.array_equal(
        np.asarray(vertices)[vmapping][indices], np.asarray(vertices)[faces], equal_nan=True
    )
    assert len(uvs) == 0 or (uvs.min() >= 0 and uvs.max() <= 1)
    assert all(array.flags.c_contiguous and array.flags.writeable for array in result)


def areas(result):
    _, indices, uvs = result
    a, b, c = uvs[indices].astype(float).transpose(1, 0, 2)
    return (b[:, 0] - a[:, 0]) * (c[:, 1] - a[:, 1]) - (b[:, 1] - a[:, 1]) * (c[:, 0] - a[:, 0])


@pytest.mark.parametrize("index_type", [np.int32, np.uint32, np.int64, float])
@pytest.mark.parametrize("type", [np.float32, np.float64, int])
def test_types(xatlas, cube, type, index_type):
    vertices, faces = cube[0].astype(type), cube[1].astype(index_type)
    result = xatlas.parametrize(vertices, faces)
    check(result, vertices, cube[1])
    # Some charts of theirs are mirrored.
    is_as_wound = areas(result) > 0
    assert is_as_wound.all() if xatlas is unwrapd.xatlas else (areas(result) != 0).all()


def test_lists(xatlas, pyramid):
    vertices, faces = pyramid[0].tolist(), pyramid[1].tolist()
    check(xatlas.parametrize(vertices, faces), *pyramid)


def test_names_of_arguments(xatlas, pyramid):
    vertices, faces = pyramid
    check(xatlas.parametrize(positions=vertices, indices=faces, normals=None, uvs=None), *pyramid)
    check(xatlas.parametrize(vertices, faces, vertices, vertices[:, :2]), *pyramid)


@pytest.mark.parametrize(
    "error, text, arguments",
    [
        (ValueError, "Position array expected to be Nx3", lambda v, f: (v[:, :2], f)),
        (ValueError, "Position array expected to be Nx3", lambda v, f: (v.ravel(), f)),
        (ValueError, "Index array expected to be Nx3", lambda v, f: (v, f.ravel())),
        (ValueError, "Index array expected to be Nx3", lambda v, f: (v, f[:, :2])),
        (ValueError, "Normal array expected to be Nx3", lambda v, f: (v, f, v[:, :2])),
        (ValueError, "Normal .* first dimension", lambda v, f: (v, f, v[:2])),
        (ValueError, "Texture coordinate array expected to be Nx2", lambda v, f: (v, f, None, v)),
        (ValueError, "Texture coordinate .* first dimension", lambda v, f: (v, f, None, v[:2, :2])),
        (RuntimeError, "Index out of range", lambda v, f: (v, f + 3)),
        (RuntimeError, "Index out of range", lambda v, f: (v, f - 1)),
        (RuntimeError, "Invalid index count", lambda v, f: (v, np.zeros((0, 3), int))),
        (TypeError, None, lambda v, f: ("text", f)),
        (TypeError, None, lambda v, f: (v,)),
    ],
)
def test_exceptions(xatlas, pyramid, error, text, arguments):
    with pytest.raises(error, match=text):
        xatlas.parametrize(*arguments(*pyramid))


def test_hard_input(xatlas, pyramid):
    vertices, faces = pyramid
    check(
        xatlas.parametrize(np.zeros((0, 3)), np.zeros((0, 3), int)),
        np.zeros((0, 3)),
        np.zeros((0, 3), int),
    )
    nothing = np.vstack([vertices, [[9, 9, 9]]])
    assert 5 not in xatlas.parametrize(nothing, faces)[0]
    twice = np.vstack([faces, [[0, 0, 1]]])
    check(xatlas.parametrize(vertices, twice), vertices, twice)
    flat = vertices * [1, 0, 0]
    result = xatlas.parametrize(flat, faces)
    # Theirs are not numbers.
    check((*result[:2], np.nan_to_num(result[2])), flat, faces)
    three = np.vstack([faces, [[0, 1, 3]], [[0, 1, 2]]])
    check(xatlas.parametrize(vertices, three), vertices, three)


def test_positions_that_are_not_finite(xatlas, pyramid):
    vertices = np.vstack([pyramid[0], pyramid[0] + 3])
    vertices[4] = np.nan
    faces = np.vstack([pyramid[1], pyramid[1] + 5])
    atlas = xatlas.Atlas()
    atlas.add_mesh(vertices, faces)
    atlas.generate()
    check(atlas.get_mesh(0), vertices, faces)
    atlas_index, chart_index = atlas.get_mesh_vertex_assignment(0)
    indices = atlas.get_mesh(0)[1]
    assert (chart_index[indices[:4]] == 0xFFFF_FFFF).all() and (
        atlas_index[indices[:4]] == 0xFFFF_FFFF
    ).all()
    assert (atlas_index[indices[4:]] == 0).all()


def test_an_empty_atlas(xatlas):
    atlas = xatlas.Atlas()
    assert len(atlas) == atlas.mesh_count == atlas.chart_count == atlas.atlas_count == 0
    assert atlas.width == atlas.height == 0 and atlas.texels_per_unit == 0
    assert atlas.generate() is None
    for call in [
        lambda: atlas[0],
        lambda: atlas.get_mesh(0),
        lambda: atlas.utilization,
        lambda: atlas.chart_image,
    ]:
        with pytest.raises(IndexError, match="out of bounds"):
            call()


def test_several_meshes(xatlas, pyramid, cube):
    meshes = [pyramid, cube, (pyramid[0] + 4, pyramid[1])]
    atlas = xatlas.Atlas()
    for vertices, faces in meshes:
        assert atlas.add_mesh(vertices, faces) is None
    assert len(atlas) == 0
    atlas.generate()
    assert len(atlas) == atlas.mesh_count == 3 and atlas.atlas_count == 1
    for index, (vertices, faces) in enumerate(meshes):
        check(atlas[index], vertices, faces)
        assert all((a == b).all() for a, b in zip(atlas[index], atlas.get_mesh(index)))
    assert len(list(atlas)) == 3
    assert atlas.width > 0 and atlas.height > 0 and atlas.texels_per_unit > 0
    assert 0.1 < atlas.utilization <= 1 and atlas.get_utilization(0) == atlas.utilization


def test_charts(xatlas, pyramid, cube):
    atlas = xatlas.Atlas()
    for vertices, faces in (pyramid, cube):
        atlas.add_mesh(vertices, faces)
    atlas.generate()
    counts = [atlas.get_mesh_chart_count(index) for index in range(2)]
    assert sum(counts) == atlas.chart_count and min(counts) >= 1
    first = 0
    for index, count in enumerate(counts):
        indices = atlas.get_mesh(index)[1]
        atlas_index, chart_index = atlas.get_mesh_vertex_assignment(index)
        assert atlas_index.dtype == chart_index.dtype == np.uint32
        charts = [atlas.get_mesh_chart(index, chart) for chart in range(count)]
        faces = np.concatenate([chart.faces for chart in charts])
        assert faces.dtype == np.uint32 and sorted(faces) == list(range(len(indices)))
        for number, chart in enumerate(charts):
            assert (chart_index[indices[chart.faces]] == first + number).all()
            assert chart.atlas_index == chart.material == 0 and chart.type.name in dir(
                xatlas.ChartType
            )
        first += count


def test_indices_out_of_bounds(xatlas, pyramid):
    atlas = xatlas.Atlas()
    atlas.add_mesh(*pyramid)
    atlas.generate()
    for call, error in [
        (lambda: atlas.get_mesh(1), IndexError),
        (lambda: atlas[5], IndexError),
        (lambda: atlas.get_mesh(-1), TypeError),
        (lambda: atlas.get_mesh(0.5), TypeError),
        (lambda: atlas.get_mesh_chart_count(1), IndexError),
        (lambda: atlas.get_mesh_chart(1, 0), IndexError),
        (lambda: atlas.get_mesh_chart(0, 99), IndexError),
        (lambda: atlas.get_mesh_vertex_assignment(1), IndexError),
        (lambda: atlas.get_utilization(1), IndexError),
        (lambda: atlas.get_chart_image(0), RuntimeError),
        (lambda: atlas.get_chart_image(1), IndexError),
    ]:
        with pytest.raises(error):
            call()


def test_options_have_the_same_names_defaults_and_types():
    for name in ("ChartOptions", "PackOptions"):
        theirs, ours = getattr(original, name)(), getattr(unwrapd.xatlas, name)()
        names = {n for n in dir(theirs) if not n.startswith("_")}
        assert names == {n for n in dir(ours) if not n.startswith("_")}
        for option in names:
            assert getattr(theirs, option) == getattr(ours, option), option
            assert type(getattr(theirs, option)) is type(getattr(ours, option)), option


def test_options_are_typed(xatlas):
    options = xatlas.PackOptions()
    for name, value in [
        ("resolution", -1),
        ("resolution", 1.5),
        ("padding", "a"),
        ("texels_per_unit", "a"),
    ]:
        with pytest.raises(TypeError):
            setattr(options, name, value)
    with pytest.raises(AttributeError):
        options.colour = 1
    with pytest.raises(TypeError):
        xatlas.ChartOptions(max_cost=1)
    options.bilinear = 0
    assert options.bilinear is False
    atlas = xatlas.Atlas()
    with pytest.raises(TypeError):
        atlas.generate(options)
    with pytest.raises(TypeError):
        atlas.generate(pack_options=3)


def generated(xatlas, mesh, chart=(), **pack):
    chart_options, pack_options = xatlas.ChartOptions(), xatlas.PackOptions()
    for name, value in dict(chart).items():
        setattr(chart_options, name, value)
    for name, value in pack.items():
        setattr(pack_options, name, value)
    atlas = xatlas.Atlas()
    atlas.add_mesh(*mesh)
    atlas.generate(chart_options, pack_options)
    return atlas


def test_density(xatlas, cube):
    atlas = generated(xatlas, cube, texels_per_unit=40.0)
    assert atlas.atlas_count == 1 and abs(atlas.texels_per_unit - 40) < 0.4
    _, indices, uvs = atlas.get_mesh(0)
    texels = uvs[indices] * [atlas.width, atlas.height]
    (ax, ay), (bx, by) = (texels[:, 1] - texels[:, 0]).T, (texels[:, 2] - texels[:, 0]).T
    doubled = np.abs(ax * by - ay * bx)
    assert abs(np.sqrt(doubled.sum() / 2 / 6) - 40) < 2


def test_density_and_size(xatlas, cube):
    atlas = generated(xatlas, cube, texels_per_unit=60.0, resolution=96)
    assert (atlas.width, atlas.height) == (96, 96) and 2 <= atlas.atlas_count <= 6
    assert abs(atlas.texels_per_unit - 60) < 0.6
    atlas_index, _ = atlas.get_mesh_vertex_assignment(0)
    assert set(atlas_index) == set(range(atlas.atlas_count))
    check(atlas.get_mesh(0), *cube)
    assert all(0 < atlas.get_utilization(page) <= 1 for page in range(atlas.atlas_count))


def test_padding(xatlas, cube):
    def gap(padding):
        atlas = generated(xatlas, cube, chart=[("max_cost", 2.0)], resolution=256, padding=padding)
        _, indices, uvs = atlas.get_mesh(0)
        _, charts = atlas.get_mesh_vertex_assignment(0)
        points = uvs * [atlas.width, atlas.height]
        others = charts[:, None] != charts[None]
        return np.linalg.norm(points[:, None] - points[None], axis=2)[others].min(initial=np.inf)

    assert gap(8) >= 8


def test_images(xatlas, cube):
    atlas = generated(xatlas, cube, create_image=True, resolution=128)
    image = atlas.chart_image
    assert image.dtype == np.uint8 and image.shape == (atlas.height, atlas.width, 3)
    assert (image == atlas.get_chart_image(0)).all()
    _, indices, uvs = atlas.get_mesh(0)
    middles = (uvs[indices].mean(axis=1) * [atlas.width, atlas.height]).astype(int)
    assert (image[middles[:, 1], middles[:, 0]].sum(axis=1) > 0).all()
    charts = atlas.get_mesh_vertex_assignment(0)[1][indices[:, 0]]
    colors = image[middles[:, 1], middles[:, 0]]
    for chart in set(charts):
        assert len(np.unique(colors[charts == chart], axis=0)) == 1


def test_flat_meshes(xatlas, cube):
    vmapping, indices, uvs = xatlas.parametrize(*cube)
    atlas = xatlas.Atlas()
    atlas.add_uv_mesh(uvs, indices)
    atlas.add_uv_mesh(uvs, indices)
    atlas.generate()
    assert len(atlas) == 2
    for mesh in atlas:
        check(mesh, uvs, indices)
    with pytest.raises(RuntimeError, match="Adding mesh failed"):
        atlas.add_mesh(*cube)
    with pytest.raises(ValueError, match="Nx2"):
        atlas.add_uv_mesh(cube[0], cube[1])
    with pytest.raises(RuntimeError, match="out of range"):
        atlas.add_uv_mesh(uvs, indices + len(uvs))
    with pytest.raises(ValueError, match="Nx1"):
        atlas.add_uv_mesh(uvs, indices, np.zeros(len(indices), int))
    other = xatlas.Atlas()
    other.add_mesh(*cube)
    with pytest.raises(RuntimeError, match="Adding mesh failed"):
        other.add_uv_mesh(uvs, indices)


def test_export(xatlas, pyramid, tmp_path):
    vertices, faces = pyramid
    path = str(tmp_path / "mesh.obj")
    for arguments, kinds, face in [
        ((vertices,), {"v": 5}, None),
        ((vertices, faces), {"v": 5, "f": 4}, "f 1 2 5"),
        ((vertices, faces, vertices[:, :2]), {"v": 5, "vt": 5, "f": 4}, "f 1/1 2/2 5/5"),
        ((vertices, faces, None, vertices), {"v": 5, "vn": 5, "f": 4}, "f 1//1 2//2 5//5"),
        (
            (vertices, faces, vertices[:, :2], vertices),
            {"v": 5, "vn": 5, "vt": 5, "f": 4},
            "f 1/1/1 2/2/2 5/5/5",
        ),
    ]:
        assert xatlas.export(path, *arguments) is None
        lines = open(path).read().splitlines()
        assert {kind: sum(line.split()[0] == kind for line in lines) for kind in kinds} == kinds
        assert len(lines) == sum(kinds.values()) and (face is None or face in lines)
        assert "v 0.5 0.5 0.7" in lines
    with pytest.raises(ValueError, match="Cannot open path"):
        xatlas.export(str(tmp_path / "none" / "mesh.obj"), vertices)
    with pytest.raises(TypeError):
        xatlas.export(tmp_path / "mesh.obj", vertices)
    with pytest.raises(ValueError, match="Nx2"):
        xatlas.export(path, vertices, faces, vertices)


@pytest.mark.filterwarnings("error")
def test_what_has_no_effect_is_named(cube):
    for kind, name, value in [
        ("chart", "max_cost", 1.0),
        ("chart", "max_iterations", 4),
        ("chart", "roundness_weight", 1.0),
        ("pack", "blockAlign", True),
        ("pack", "rotate_charts", False),
        ("pack", "max_chart_size", 99),
    ]:
        with pytest.raises(UserWarning, match=f"{name} has no effect"):
            if kind == "chart":
                generated(unwrapd.xatlas, cube, chart=[(name, value)])
            else:
                generated(unwrapd.xatlas, cube, **{name: value})
    generated(unwrapd.xatlas, cube, bruteForce=True, bilinear=False, resolution=64, padding=1)
    with pytest.raises(UserWarning, match="resolution 8 has become 16"):
        generated(unwrapd.xatlas, cube, resolution=8)


def test_options_with_an_effect(cube):
    vertices, faces = cube
    corners = vertices[faces].reshape(-1, 3)
    normals = np.repeat(np.eye(3)[[0, 0, 1, 1, 2, 2]], 6, axis=0)
    triangles = np.arange(36).reshape(-1, 3)
    loose = [(corners, triangles, normals), (corners, triangles)]
    options = unwrapd.xatlas.ChartOptions()
    options.normal_seam_weight = 2000.0
    charts = []
    for arguments in loose[:1]:
        atlas = unwrapd.xatlas.Atlas()
        atlas.add_mesh(*arguments)
        atlas.generate(options)
        charts.append(atlas.chart_count)
    assert charts == [6]
    kept = unwrapd.xatlas.ChartOptions()
    kept.use_input_mesh_uvs = True
    fast = unwrapd.unwrap(vertices, faces, cut="fast")
    atlas = unwrapd.xatlas.Atlas()
    atlas.add_mesh(vertices[fast.vmapping], fast.indices, None, fast.uvs)
    atlas.generate(kept)
    assert atlas.chart_count == fast.n_charts
