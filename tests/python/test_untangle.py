"""Folded meshes as arrays."""

import numpy as np
import pytest
import unwrapd
from test_problem import grid


def sizes(vertices, elements):
    corners = vertices[elements.astype(int)]
    return np.linalg.det(corners[:, 1:] - corners[:, :1])


def crumpled(vertices, elements, random):
    """Inner vertices thrown to random places."""
    width = elements.shape[1]
    facets = np.sort(np.vstack([np.delete(elements, k, 1) for k in range(width)]), 1)
    found, counts = np.unique(facets, axis=0, return_counts=True)
    inner = np.setdiff1d(np.arange(len(vertices)), found[counts == 1])
    x = np.array(vertices, float)
    x[inner] = random.uniform(0.2, 0.8, (len(inner), x.shape[1]))
    return x, inner


def block(n):
    """A unit cube of n³ cubes, six tetrahedra each."""
    from itertools import permutations

    ticks = np.linspace(0, 1, n + 1)
    vertices = np.stack(np.meshgrid(ticks, ticks, ticks, indexing="ij"), -1).reshape(-1, 3)
    step, cells = np.array([(n + 1) ** 2, n + 1, 1]), []
    for cube in np.ndindex(n, n, n):
        for order in permutations(range(3)):
            cells.append(np.cumsum([np.dot(cube, step), *step[list(order)]]))
    cells = np.array(cells)
    is_left = sizes(vertices, cells) < 0
    cells[is_left] = cells[is_left][:, [0, 1, 3, 2]]
    return vertices, cells


@pytest.mark.parametrize("options", [{}, {"rest": "regular"}, {"rest_vertices": True}])
@pytest.mark.parametrize("mesh", [grid(12), block(4)], ids=["plane", "space"])
def test_a_folded_mesh_is_untangled_with_its_boundary_in_place(mesh, options):
    vertices, elements = np.array(mesh[0], float), np.array(mesh[1])
    x, inner = crumpled(vertices, elements, np.random.default_rng(7))
    inverted = (sizes(x, elements) <= 0).sum()
    assert inverted > 20
    if options.get("rest_vertices"):
        options = {"rest_vertices": vertices}
    found = unwrapd.untangle(x, elements, **options)
    assert (sizes(found.vertices, found.elements) > 0).all()
    np.testing.assert_array_equal(np.delete(found.vertices, inner, 0), np.delete(vertices, inner, 0))
    np.testing.assert_array_equal(found.elements, elements)
    assert found.report["inverted_before"] == inverted and 0 < found.report["moved"] <= len(inner)
    assert found.report["smallest"] > 0


def test_elements_are_wound_alike_and_what_is_positive_stays():
    vertices, elements = grid(5)
    mixed = np.array(elements)
    mixed[::3] = mixed[::3, [0, 2, 1]]
    found = unwrapd.untangle(vertices, mixed)
    assert found.report["turned"] == len(mixed[::3]) and found.report["moved"] == 0
    np.testing.assert_array_equal(found.vertices, vertices)
    assert (sizes(found.vertices, found.elements) > 0).all()


def test_a_time_budget_ends_the_work():
    vertices, elements = block(4)
    x, _ = crumpled(vertices, elements, np.random.default_rng(7))
    with pytest.raises(unwrapd.Error) as raised:
        unwrapd.untangle(x, elements, time_budget=0)
    assert (raised.value.code, raised.value.exit_code) == ("ended_early", 6)
    assert unwrapd.untangle(x, elements, time_budget=1000.0).report["warnings"] == []


def test_what_cannot_be_untangled_is_refused():
    vertices, elements = map(np.array, grid(4))
    flat = vertices * (1.0, 0.0)
    with pytest.raises(unwrapd.InvalidInput):
        unwrapd.untangle(flat, elements)
    with pytest.raises(unwrapd.InvalidInput):
        unwrapd.untangle(np.where(vertices == 0, np.nan, vertices), elements)
    with pytest.raises(unwrapd.InvalidInput):
        unwrapd.untangle(vertices, elements + len(vertices))
    for wrong in [{"rest": "other"}, {"boundary": "open"}]:
        with pytest.raises(unwrapd.InvalidOptions):
            unwrapd.untangle(vertices, elements, **wrong)
    for places in [np.zeros((16, 3)), np.zeros(5), vertices[:, :1]]:
        with pytest.raises(ValueError):
            unwrapd.untangle(places, elements)
    with pytest.raises(ValueError, match="rest_vertices"):
        unwrapd.untangle(vertices, elements, rest_vertices=vertices[1:])
    with pytest.raises(ValueError, match="finite"):
        unwrapd.untangle(vertices, elements, rest_vertices=vertices + np.inf)
