"""The Blender extension: what each operator makes of objects, and that it is one step of undo."""

import importlib.util
import pathlib
import sys

import bpy
import numpy as np
import pytest
import unwrapd

FOLDER = pathlib.Path(__file__).resolve().parents[3] / "src/blender"


@pytest.fixture(scope="session")
def extension():
    spec = importlib.util.spec_from_file_location(
        "unwrapd_extension", FOLDER / "__init__.py", submodule_search_locations=[str(FOLDER)]
    )
    module = importlib.util.module_from_spec(spec)
    sys.modules["unwrapd_extension"] = module
    spec.loader.exec_module(module)
    module.register()
    yield module
    module.unregister()


@pytest.fixture(autouse=True)
def empty(extension):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.ed.undo_push(message="empty")


def loops(thing):
    """UVs of loops (L, 2)."""
    layer = thing.data.uv_layers.active
    found = np.empty(2 * len(layer.uv), np.float32)
    layer.uv.foreach_get("vector", found)
    return found.reshape(-1, 2)


def triangles(thing):
    """Positions of vertices, triangles, and UVs of their corners."""
    data = thing.data
    data.calc_loop_triangles()
    at, faces = np.empty((len(data.loop_triangles), 3), int), np.empty((len(data.loop_triangles), 3), int)
    data.loop_triangles.foreach_get("loops", at.reshape(-1))
    data.loop_triangles.foreach_get("vertices", faces.reshape(-1))
    positions = np.array([thing.matrix_world @ vertex.co for vertex in data.vertices])
    return positions, faces, loops(thing)[at]


def certified(*things):
    return unwrapd.verify([triangles(thing) for thing in things], bijective=True)["certified"]


def n_islands(*things):
    return unwrapd.measure([triangles(thing) for thing in things])["groups"][0]["measures"]["charts"]


def select(*things):
    for thing in bpy.context.scene.objects:
        thing.select_set(thing in things)


def monkey():
    bpy.ops.mesh.primitive_monkey_add()
    return bpy.context.object


def cube():
    bpy.ops.mesh.primitive_cube_add()
    return bpy.context.object


def sphere():
    bpy.ops.mesh.primitive_uv_sphere_add(segments=16, ring_count=8)
    return bpy.context.object


@pytest.mark.parametrize("make, most", [(cube, 4), (monkey, 25), (sphere, 20)])
def test_unwrap(make, most):
    thing = make()
    before = len(thing.data.polygons)
    assert bpy.ops.unwrapd.unwrap() == {"FINISHED"}
    assert certified(thing) and len(thing.data.polygons) == before
    assert n_islands(thing) <= most


def test_a_mesh_without_uvs_gets_a_layer():
    thing = cube()
    thing.data.uv_layers.remove(thing.data.uv_layers.active)
    assert bpy.ops.unwrapd.unwrap() == {"FINISHED"}
    assert len(thing.data.uv_layers) == 1 and certified(thing)


def test_several_objects_share_an_atlas():
    first, second = cube(), monkey()
    second.location, second.scale = (5, 0, 0), (-2, 2, 2)
    bpy.context.view_layer.update()
    select(first, second)
    assert bpy.ops.unwrapd.unwrap(padding=4) == {"FINISHED"}
    # Mirrored in the world, and seen from the front in UVs.
    second.scale = (2, 2, 2)
    bpy.context.view_layer.update()
    assert certified(first, second)


def seam_where(thing, holds):
    """Marks the edges both of whose vertices are somewhere, and counts them."""
    vertices, count = thing.data.vertices, 0
    for edge in thing.data.edges:
        edge.use_seam = all(holds(vertices[v].co) for v in edge.vertices)
        count += edge.use_seam
    return count


def test_only_marked_seams_and_two_materials():
    thing = sphere()
    for name in ("a", "b"):
        thing.data.materials.append(bpy.data.materials.new(name))
    halves = [int(polygon.center.z > 0) for polygon in thing.data.polygons]
    thing.data.polygons.foreach_set("material_index", halves)
    assert seam_where(thing, lambda p: abs(p.z) < 1e-6) == 16
    assert bpy.ops.unwrapd.unwrap(along_seams=True) == {"FINISHED"}
    assert n_islands(thing) == 2 and certified(thing)
    assert [polygon.material_index for polygon in thing.data.polygons] == halves


def test_marked_seams_among_others():
    bpy.ops.mesh.primitive_grid_add(x_subdivisions=4, y_subdivisions=4)
    thing = bpy.context.object
    assert bpy.ops.unwrapd.unwrap() == {"FINISHED"} and n_islands(thing) == 1
    assert seam_where(thing, lambda p: abs(p.x) < 1e-6) == 4
    assert bpy.ops.unwrapd.unwrap() == {"FINISHED"} and n_islands(thing) == 2


@pytest.mark.parametrize("operator", ["unwrap", "repack"])
def test_pinned_islands_stay(operator):
    thing = cube()
    bpy.ops.unwrapd.unwrap()
    # Each side an island of its own, the first small, in a corner, and pinned.
    layer = thing.data.uv_layers.active
    corners = np.array([[0, 0], [1, 0], [1, 1], [0, 1]])
    uvs = np.concatenate([0.2 * corners + [0.3 * k % 0.9, 0.3 * (k // 3)] for k in range(6)])
    layer.uv.foreach_set("vector", uvs.astype(np.float32).ravel())
    layer.pin_ensure() if hasattr(layer, "pin_ensure") else None
    for loop in range(4):
        layer.pin[loop].value = loop == 2
    kept = loops(thing)[:4].copy()
    assert getattr(bpy.ops.unwrapd, operator)() == {"FINISHED"}
    assert np.array_equal(loops(thing)[:4], kept)
    assert not np.array_equal(loops(thing)[4:], uvs[4:].astype(np.float32))
    assert certified(thing)


def test_repack_keeps_islands():
    thing = monkey()
    bpy.ops.unwrapd.unwrap()
    before = n_islands(thing)
    half = loops(thing) / 2
    thing.data.uv_layers.active.uv.foreach_set("vector", half.ravel())
    assert bpy.ops.unwrapd.repack() == {"FINISHED"}
    assert n_islands(thing) == before and certified(thing) and np.ptp(loops(thing)) > 0.9


def test_the_report_changes_nothing():
    thing = monkey()
    before = loops(thing)
    assert bpy.ops.unwrapd.report() == {"FINISHED"}
    assert np.array_equal(loops(thing), before)


def test_one_operator_is_one_step_of_undo():
    thing = cube()
    bpy.ops.ed.undo_push(message="a cube")
    name, before = thing.name, loops(thing)
    bpy.ops.unwrapd.unwrap("EXEC_DEFAULT", True)
    bpy.ops.unwrapd.repack("EXEC_DEFAULT", True)
    after = loops(bpy.data.objects[name])
    bpy.ops.ed.undo()
    bpy.ops.ed.undo()
    assert np.array_equal(loops(bpy.data.objects[name]), before)
    assert not np.array_equal(after, before)


def edit(*things, where=lambda polygon: True):
    """Selects objects, and in them some polygons, then enters edit mode."""
    bpy.ops.object.mode_set(mode="OBJECT")
    # With vertices the faces between the selected ones would be selected, too.
    bpy.context.scene.tool_settings.mesh_select_mode = (False, False, True)
    select(*things)
    for thing in things:
        thing.data.polygons.foreach_set("select", [where(polygon) for polygon in thing.data.polygons])
    bpy.context.view_layer.objects.active = things[0]
    bpy.ops.object.mode_set(mode="EDIT")


def of_polygons(thing, holds):
    """Which loops are of polygons that hold something."""
    found = np.zeros(len(thing.data.loops), bool)
    for polygon in thing.data.polygons:
        found[polygon.loop_start : polygon.loop_start + polygon.loop_total] = holds(polygon)
    return found


OPERATORS = {
    "unwrap": lambda: bpy.ops.unwrapd.unwrap(quality="few"),
    "repack": lambda: bpy.ops.unwrapd.repack(),
    "Blender's own": lambda: bpy.ops.uv.unwrap(),
}


@pytest.mark.parametrize("operator", OPERATORS)
def test_in_edit_mode_only_selected_faces_change(operator):
    thing = monkey()
    bpy.ops.unwrapd.unwrap(resolution=4096)

    def chosen(polygon):
        return polygon.index < 50

    # Off the grid of the packer, so that what moves at all is seen.
    thing.data.uv_layers.active.uv.foreach_set("vector", (0.9 * loops(thing)).ravel())
    before = loops(thing)
    edit(thing, where=chosen)
    assert OPERATORS[operator]() == {"FINISHED"}
    assert bpy.context.mode == "EDIT_MESH"
    bpy.ops.object.mode_set(mode="OBJECT")
    mask = of_polygons(thing, chosen)
    assert np.array_equal(loops(thing)[~mask], before[~mask])
    assert not np.array_equal(loops(thing)[mask], before[mask])
    assert [polygon.index for polygon in thing.data.polygons if polygon.select] == list(range(50))


def test_new_islands_are_laid_out_around_those_that_stay():
    thing = monkey()
    bpy.ops.unwrapd.unwrap(padding=6)
    thing.data.uv_layers.active.uv.foreach_set("vector", (0.5 * loops(thing)).ravel())
    edit(thing, where=lambda polygon: polygon.index < 50)
    assert bpy.ops.unwrapd.unwrap() == {"FINISHED"}
    bpy.ops.object.mode_set(mode="OBJECT")
    assert certified(thing)


def test_hidden_faces_stay():
    thing = monkey()
    bpy.ops.unwrapd.unwrap()
    thing.data.uv_layers.active.uv.foreach_set("vector", (0.7 * loops(thing)).ravel())
    before = loops(thing)
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.object.mode_set(mode="OBJECT")
    for polygon in thing.data.polygons:
        polygon.hide = polygon.index % 3 == 0
    hidden = of_polygons(thing, lambda polygon: polygon.index % 3 == 0)
    bpy.ops.object.mode_set(mode="EDIT")
    assert bpy.ops.unwrapd.unwrap(quality="few") == {"FINISHED"}
    bpy.ops.object.mode_set(mode="OBJECT")
    assert np.array_equal(loops(thing)[hidden], before[hidden])
    assert not np.array_equal(loops(thing)[~hidden], before[~hidden])


def test_pins_of_selected_faces_count():
    thing = cube()
    bpy.ops.unwrapd.unwrap()
    corners = np.array([[0, 0], [1, 0], [1, 1], [0, 1]])
    uvs = np.concatenate([0.2 * corners + [0.3 * k % 0.9, 0.3 * (k // 3)] for k in range(6)]).astype(np.float32)
    layer = thing.data.uv_layers.active
    layer.uv.foreach_set("vector", uvs.ravel())
    layer.pin_ensure() if hasattr(layer, "pin_ensure") else None
    layer.pin[0].value = True
    edit(thing, where=lambda polygon: polygon.index in (0, 1, 2))
    assert bpy.ops.unwrapd.unwrap() == {"FINISHED"}
    bpy.ops.object.mode_set(mode="OBJECT")
    assert np.array_equal(loops(thing)[:4], uvs[:4]) and np.array_equal(loops(thing)[12:], uvs[12:])
    assert not np.array_equal(loops(thing)[4:12], uvs[4:12])


def test_seams_of_faces_that_stay_and_of_loose_edges_do_not_matter():
    thing = monkey()
    for edge in thing.data.edges:
        edge.use_seam = True
    edit(thing, where=lambda polygon: polygon.center.z > 0)
    assert bpy.ops.unwrapd.unwrap() == {"FINISHED"}
    bpy.ops.object.mode_set(mode="OBJECT")
    wire = bpy.data.meshes.new("wire")
    wire.from_pydata([(0, 0, 0), (1, 0, 0), (0, 1, 0), (2, 2, 2)], [(0, 3)], [(0, 1, 2)])
    wire.edges[[edge.key for edge in wire.edges].index((0, 3))].use_seam = True
    loose = bpy.data.objects.new("wire", wire)
    bpy.context.collection.objects.link(loose)
    select(loose)
    assert bpy.ops.unwrapd.unwrap() == {"FINISHED"} and certified(loose)


def test_islands_that_overlap_or_leave_the_square_are_no_obstacle():
    thing = monkey()
    # All faces lie on the same triangle or quadrilateral, far outside.
    layer = thing.data.uv_layers.active
    for polygon in thing.data.polygons:
        for k, key in enumerate(polygon.loop_indices):
            layer.uv[key].vector = [(5, 5), (6, 5), (6, 6), (5, 6)][k]
    edit(thing, where=lambda polygon: polygon.index < 100)
    before = loops_of_edited(thing)
    assert bpy.ops.unwrapd.unwrap() == {"FINISHED"}
    bpy.ops.object.mode_set(mode="OBJECT")
    others = of_polygons(thing, lambda polygon: polygon.index >= 100)
    assert np.array_equal(loops(thing)[others], before[others])
    assert loops(thing)[~others].max() <= 1.0


def loops_of_edited(thing):
    """UVs of loops of a mesh that is being edited."""
    bpy.ops.object.mode_set(mode="OBJECT")
    found = loops(thing)
    bpy.ops.object.mode_set(mode="EDIT")
    return found


def test_only_objects_that_are_edited_change():
    first, second = cube(), sphere()
    second.location = (5, 0, 0)
    bpy.ops.object.mode_set(mode="OBJECT")
    before = loops(second)
    select(first)
    edit(first)
    second.select_set(True)
    assert bpy.ops.unwrapd.unwrap() == {"FINISHED"}
    assert [thing.name for thing in bpy.context.objects_in_mode] == [first.name]
    assert second.select_get()
    bpy.ops.object.mode_set(mode="OBJECT")
    assert np.array_equal(loops(second), before) and certified(first)


def test_nothing_selected_changes_nothing():
    thing = cube()
    before = loops(thing)
    edit(thing, where=lambda polygon: False)
    assert bpy.ops.unwrapd.unwrap() == {"CANCELLED"}
    assert bpy.ops.unwrapd.repack() == {"CANCELLED"}
    assert np.array_equal(loops_of_edited(thing), before)


@pytest.mark.parametrize("scale", [(2, 1, 1), (2, 1, -1), (2.3, 0.56, 0.55), (1.7, 0.9, 2.4)])
def test_default_primitives_side_by_side_are_not_refused(scale):
    first, second = cube(), monkey()
    second.location, second.scale = (3, 0, 0), scale
    bpy.context.view_layer.update()
    select(first, second)
    assert bpy.ops.unwrapd.unwrap() == {"FINISHED"}
    second.scale = np.abs(scale)
    bpy.context.view_layer.update()
    assert certified(first, second)


@pytest.mark.parametrize("is_edited", [False, True])
def test_a_face_that_cannot_be_kept_is_selected_and_other_objects_go_on(extension, monkeypatch, is_edited):
    layout = sys.modules["unwrapd_extension.layout"]
    original = layout.split
    monkeypatch.setattr(layout, "split", lambda mesh, *rest: [7] if len(mesh.starts) == 501 else original(mesh, *rest))
    first, second = cube(), monkey()
    second.location = (5, 0, 0)
    bpy.context.view_layer.update()
    before, others = loops(second), loops(first)
    edit(first, second) if is_edited else select(first, second)
    assert bpy.ops.unwrapd.unwrap() == {"FINISHED"}
    bpy.ops.object.mode_set(mode="OBJECT")
    assert np.array_equal(loops(second), before) and not np.array_equal(loops(first), others)
    assert certified(first)
    assert [polygon.index for polygon in second.data.polygons if polygon.select] == [7]
    select(second)
    with pytest.raises(RuntimeError, match=f"{second.data.name} stays as it is.*face 7"):
        bpy.ops.unwrapd.unwrap()
    assert np.array_equal(loops(second), before)


def test_while_a_mesh_is_edited():
    thing = monkey()
    bpy.ops.object.mode_set(mode="EDIT")
    assert bpy.ops.unwrapd.unwrap() == {"FINISHED"}
    assert bpy.context.mode == "EDIT_MESH"
    bpy.ops.object.mode_set(mode="OBJECT")
    assert certified(thing)


def test_errors_change_nothing():
    thing = cube()
    before = loops(thing)
    with pytest.raises(RuntimeError, match="texels|padding"):
        bpy.ops.unwrapd.unwrap(resolution=16, padding=200)
    assert np.array_equal(loops(thing), before)
    bpy.ops.object.select_all(action="DESELECT")
    with pytest.raises(RuntimeError, match="poll"):
        bpy.ops.unwrapd.unwrap()
