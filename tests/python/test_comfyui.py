"""The node of ComfyUI, with as much of ComfyUI and PyTorch as it imports."""

import asyncio
import importlib.util
import json
import pathlib
import sys
import types

import numpy as np
import pytest
import unwrapd

FOLDER = pathlib.Path(__file__).resolve().parents[2] / "src/comfyui"


class Tensor(np.ndarray):
    """An array with the methods of a tensor."""

    device = "cpu"

    def detach(self):
        return self

    cpu = detach

    def to(self, device):
        assert device == "cpu"
        return self

    def numpy(self):
        return np.asarray(self)


def tensor(values):
    return np.asarray(values).view(Tensor)


def pad_sequence(tensors, batch_first):
    assert batch_first and all(isinstance(values, Tensor) for values in tensors)
    longest = max(len(values) for values in tensors)
    widths = [(0, 0)] * (tensors[0].ndim - 1)
    return tensor(np.stack([np.pad(v, [(0, longest - len(v)), *widths]) for v in tensors]))


class Input:
    def __init__(self, name, **settings):
        self.name, self.settings = name, settings


class Output:
    def __init__(self, *values):
        self.values = values


class ProgressBar:
    seen = []

    def __init__(self, total):
        self.total = total

    def update_absolute(self, value):
        assert 0 <= value <= self.total
        self.seen.append(value / self.total)


class Schema:
    def __init__(self, **members):
        self.__dict__.update(members)


class Interrupted(Exception):
    pass


@pytest.fixture
def comfy(monkeypatch):
    """The package as ComfyUI loads it."""
    kind = types.SimpleNamespace(Input=Input, Output=Input)
    names = {name: kind for name in ("Mesh", "Combo", "Int", "Float", "String")}
    io = types.SimpleNamespace(ComfyNode=object, Schema=Schema, NodeOutput=Output, **names)
    management = types.ModuleType("comfy.model_management")
    management.throw_exception_if_processing_interrupted = lambda: None
    stubs = {
        "comfy": types.ModuleType("comfy"),
        "comfy.model_management": management,
        "comfy.utils": types.SimpleNamespace(ProgressBar=ProgressBar),
        "comfy_api": types.ModuleType("comfy_api"),
        "comfy_api.latest": types.SimpleNamespace(IO=io, ComfyExtension=object),
        "torch": types.SimpleNamespace(from_numpy=tensor, tensor=tensor),
        "torch.nn": types.ModuleType("torch.nn"),
        "torch.nn.utils": types.ModuleType("torch.nn.utils"),
        "torch.nn.utils.rnn": types.SimpleNamespace(pad_sequence=pad_sequence),
    }
    stubs["comfy"].model_management, stubs["comfy"].utils = management, stubs["comfy.utils"]
    for name, module in stubs.items():
        monkeypatch.setitem(sys.modules, name, module)
    spec = importlib.util.spec_from_file_location(
        "comfyui_unwrapd", FOLDER / "__init__.py", submodule_search_locations=[str(FOLDER)]
    )
    package = importlib.util.module_from_spec(spec)
    monkeypatch.setitem(sys.modules, "comfyui_unwrapd", package)
    spec.loader.exec_module(package)
    for name in ("node", "triple"):
        loaded = f"comfyui_unwrapd.{name}"
        monkeypatch.setitem(sys.modules, loaded, sys.modules.pop(loaded))
    return package


def node(comfy):
    (found,) = asyncio.run(asyncio.run(comfy.comfy_entrypoint()).get_node_list())
    return found


def mesh_of(vertices, faces, **members):
    names = ("uvs", "normals", "tangents", "vertex_colors", "vertex_counts", "face_counts", "texture")
    return types.SimpleNamespace(
        vertices=tensor(vertices.astype(np.float32)),
        faces=tensor(faces.astype(np.int32)),
        **{**dict.fromkeys(names), **members},
    )


def defaults(comfy):
    inputs = node(comfy).define_schema().inputs[1:]
    return {each.name: each.settings["default"] for each in inputs}


def areas(uvs):
    (b, c) = (uvs[:, k] - uvs[:, 0] for k in (1, 2))
    return b[:, 0] * c[:, 1] - b[:, 1] * c[:, 0]


def test_a_mesh_with_attributes(comfy, cube):
    vertices, faces = cube
    colors, tangents = np.random.default_rng(1).random((8, 4)), np.ones((1, 8, 4))
    given = mesh_of(
        vertices[None], faces[None], vertex_colors=tensor(colors[None]), tangents=tensor(tangents), texture="t"
    )
    ProgressBar.seen = []
    mesh, report = node(comfy).execute(given, **defaults(comfy)).values
    assert json.loads(report)[0]["certified"]
    assert mesh.texture == "t" and mesh.tangents is None and mesh.vertex_counts is None
    new = np.asarray(mesh.faces[0])
    assert mesh.faces.dtype == np.int32 and mesh.uvs.dtype == np.float32
    assert np.array_equal(np.asarray(mesh.vertices[0])[new], vertices[faces])
    assert np.array_equal(np.asarray(mesh.vertex_colors[0])[new], colors[faces])
    # v points down, so triangles seen from the front turn the other way.
    assert (areas(np.asarray(mesh.uvs[0])[new].astype(float)) < 0).all()
    # The given mesh is as it was.
    assert given.uvs is None and given.vertices.shape == (1, 8, 3)
    assert ProgressBar.seen == sorted(ProgressBar.seen) and ProgressBar.seen[-1] <= 1


def test_a_batch_of_several_sizes(comfy, cube, pyramid):
    vertices, faces = np.zeros((2, 8, 3)), np.zeros((2, 12, 3), int)
    for number, (v, f) in enumerate((cube, pyramid)):
        vertices[number, : len(v)], faces[number, : len(f)] = v, f
    given = mesh_of(vertices, faces, vertex_counts=tensor([8, 5]), face_counts=tensor([12, 4]))
    mesh, report = node(comfy).execute(given, **defaults(comfy)).values
    assert len(json.loads(report)) == 2
    for number, (v, f) in enumerate((cube, pyramid)):
        new = np.asarray(mesh.faces[number][: int(mesh.face_counts[number])])
        assert new.max() < mesh.vertex_counts[number]
        assert np.array_equal(np.asarray(mesh.vertices[number])[new], v[f].astype(np.float32))


def test_the_triple(comfy, cube):
    vertices, faces = cube
    triple = sys.modules["comfyui_unwrapd.triple"].uv_unwrap
    (vmapping, indices, uvs), report = triple(vertices, faces, padding=4)
    assert vmapping.dtype == indices.dtype == np.int64 and uvs.dtype == np.float32
    assert np.array_equal(vertices[vmapping][indices], vertices[faces])
    assert report["certified"] and (areas(uvs[indices].astype(float)) > 0).all()


def test_vertices_that_are_close_count_as_one(comfy, cube):
    vertices, faces = cube
    soup = vertices[faces].reshape(-1, 3)
    soup = soup + np.random.default_rng(2).uniform(0, 1e-6, soup.shape)
    own = np.arange(len(soup)).reshape(-1, 3)
    triple = sys.modules["comfyui_unwrapd.triple"].uv_unwrap
    charts = [len(np.unique(triple(soup, own, d)[0][0])) for d in (0.0, 1e-3)]
    assert charts == [36, 36]
    n_charts = [triple(soup, own, d)[1]["groups"][0]["measures"]["charts"] for d in (0.0, 1e-3)]
    assert n_charts[0] == 12 and n_charts[1] < 6


def test_an_interruption_ends_the_work(comfy, sheet):
    def interrupt():
        raise Interrupted

    sys.modules["comfy.model_management"].throw_exception_if_processing_interrupted = interrupt
    vertices, faces = sheet(80)
    with pytest.raises(Interrupted):
        node(comfy).execute(mesh_of(vertices[None], faces[None]), **defaults(comfy))


def test_errors_are_those_of_the_package(comfy, cube):
    vertices, faces = cube
    with pytest.raises(unwrapd.InvalidInput):
        node(comfy).execute(mesh_of(np.full((1, 8, 3), np.nan), faces[None]), **defaults(comfy))
