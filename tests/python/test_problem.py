"""Energies at any point, by name and formula, and what solvers make of them."""

import sys
import types

import numpy as np
import pytest
import unwrapd

ARAP = "((s1 - 1)^2 + (s2 - 1)^2)/2"


def grid(side):
    """A unit square of (side - 1)² squares."""
    x, y = np.meshgrid(np.linspace(0, 1, side), np.linspace(0, 1, side))
    at = np.arange(side * side).reshape(side, side)
    a, b, c, d = (part.reshape(-1) for part in (at[:-1, :-1], at[:-1, 1:], at[1:, 1:], at[1:, :-1]))
    faces = np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)])
    return np.stack([x.reshape(-1), y.reshape(-1)], 1), faces


@pytest.fixture
def tets():
    vertices = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 1]], float)
    return vertices, np.array([[0, 1, 2, 3], [1, 2, 3, 4]])


@pytest.fixture
def bumps():
    """A surface and a start of its map."""
    plane, faces = grid(5)
    x, y = plane.T
    return np.stack([x, y, 0.2 * np.sin(3 * x) * np.cos(2 * y)], 1), faces, plane


def bent(x, size=0.05):
    return x + size * np.random.default_rng(3).standard_normal(x.shape)


def dense(problem, x=None):
    """The Hessian, by the arrays that it consists of."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setitem(sys.modules, "scipy.sparse", None)
        data, indices, indptr = problem.hessian(x)
    full = np.zeros((len(indptr) - 1,) * 2)
    for row, (first, end) in enumerate(zip(indptr[:-1], indptr[1:])):
        full[row, indices[first:end]] = data[first:end]
    return full


def problems(tets, bumps):
    vertices, faces, start = bumps
    yield unwrapd.Problem(*grid(4), energy="log(s1)^2 + log(s2)^2")
    yield unwrapd.Problem(*grid(4), energy="green", bijective=True, barrier_strength=0.3)
    yield unwrapd.Problem(*tets, energy="neo-hookean", units="normalized")
    yield unwrapd.Problem(vertices, faces, start=start, energy="symmetric-dirichlet")


def test_derivatives_are_those_of_the_energy(tets, bumps):
    for problem in problems(tets, bumps):
        x = bent(problem.start, 0.01)
        direction = np.random.default_rng(5).standard_normal(x.shape)
        slope = np.vdot(problem.gradient(x), direction)
        bend = dense(problem, x) @ direction.reshape(-1)
        assert abs(slope) > 1e-3 and np.abs(bend).max() > 1e-3
        errors = []
        for h in (2e-4, 1e-4):
            change = (problem.energy(x + h * direction) - problem.energy(x - h * direction)) / (2 * h)
            turn = problem.gradient(x + h * direction) - problem.gradient(x - h * direction)
            errors.append((abs(change - slope), np.abs(turn.reshape(-1) / (2 * h) - bend).max()))
        for coarse, fine in zip(*errors):
            assert fine < 0.3 * coarse + 1e-7


def test_without_handles_the_energy_is_minimized_from_the_start():
    vertices, faces = grid(6)
    problem = unwrapd.Problem(vertices, faces, start=bent(1.5 * vertices, 0.02), energy="symmetric-dirichlet")
    solution = problem.solve()
    assert solution.status == "converged" and solution.report["inverted"] == 0
    # Up to a rigid motion, the minimum is the square itself.
    edges = vertices[faces] - vertices[np.roll(faces, 1, axis=1)]
    found = solution.x[faces] - solution.x[np.roll(faces, 1, axis=1)]
    np.testing.assert_allclose(np.linalg.norm(found, axis=2), np.linalg.norm(edges, axis=2), rtol=1e-2)


def test_an_isometry_has_a_symmetric_dirichlet_energy_of_4_in_the_plane_and_6_in_space(tets):
    vertices, faces = grid(4)
    plane = unwrapd.Problem(vertices, faces, energy="symmetric-dirichlet")
    assert plane.energy() == pytest.approx(4, rel=1e-12)
    assert plane.solve().energy == pytest.approx(4, rel=1e-12)
    np.testing.assert_allclose(plane.elements()["energy_density"], 4, rtol=1e-12)
    space = unwrapd.Problem(*tets, energy="symmetric-dirichlet")
    volume = 1 / 6 + 2 / 6
    assert space.energy() == pytest.approx(6 * volume, rel=1e-12)


def test_a_formula_is_the_energy_that_it_says():
    named, typed = (unwrapd.Problem(*grid(4), energy=energy) for energy in ("arap", ARAP))
    x = bent(named.start)
    assert abs(named.energy(x) - typed.energy(x)) <= 1e-10 * named.energy(x)
    np.testing.assert_allclose(named.gradient(x), typed.gradient(x), atol=1e-10)
    np.testing.assert_allclose(dense(named, x), dense(typed, x), atol=1e-10)
    handles = {0: (0, 0), 15: (1.5, 0.8)}
    one, other = named.solve(handles), typed.solve(handles)
    assert one.iterations == other.iterations
    np.testing.assert_allclose(one.x, other.x, atol=1e-10)


def test_hessians_are_scipys_if_scipy_is_there(monkeypatch):
    problem = unwrapd.Problem(*grid(3), energy="mips")
    made = dense(problem)
    assert made.shape == (18, 18) and (made == made.T).all()
    sparse = types.ModuleType("scipy.sparse")
    sparse.csr_matrix = lambda parts, shape: (parts, shape)
    monkeypatch.setitem(sys.modules, "scipy", types.ModuleType("scipy"))
    monkeypatch.setitem(sys.modules, "scipy.sparse", sparse)
    (data, indices, indptr), shape = problem.hessian()
    assert shape == (18, 18) and indptr[-1] == len(data) == len(indices)


def test_elements():
    vertices, faces = grid(2)
    problem = unwrapd.Problem(vertices, faces, energy=ARAP, barrier="none")
    elements = problem.elements(vertices * (2, 1))
    np.testing.assert_allclose(elements["singular_values"], [[2, 1], [2, 1]])
    np.testing.assert_allclose(elements["relative_size"], [2, 2])
    np.testing.assert_allclose(elements["energy_density"], [0.5, 0.5])
    assert problem.energy(vertices * (2, 1)) == pytest.approx(0.5)
    assert (problem.elements(vertices * (-1, 1))["relative_size"] < 0).all()
    assert "energy_density" not in unwrapd.Problem(vertices, faces, energy="laplacian").elements()


def image_of(vertices, faces, x, at):
    """Where a point of the plane is under the map `x`."""
    corners = vertices[faces]
    edges = corners[:, 1:] - corners[:, :1]
    weights = np.linalg.solve(edges.transpose(0, 2, 1), (at - corners[:, 0])[:, :, None])[:, :, 0]
    weights = np.column_stack([1 - weights.sum(1), weights])
    face = np.flatnonzero((weights >= -1e-12).all(1))[0]
    return weights[face] @ x[faces[face]]


def test_a_line_comes_to_the_line_drawn():
    vertices, faces = grid(17)
    line, to = [[0.13, 0.2], [0.87, 0.3]], [[0.1, 0.3], [0.5, 0.6], [0.9, 0.4]]
    solution = unwrapd.Problem(vertices, faces).solve([{"line": line, "to": to}])
    assert solution.status == "converged" and solution.report["inverted"] == 0
    for at, end in zip(line, (to[0], to[-1])):
        np.testing.assert_allclose(image_of(vertices, faces, solution.x, np.array(at)), end, atol=1e-6)


def test_lists_outlines_and_boxes_move_as_rigid_bodies():
    vertices, faces = grid(17)
    x, y = vertices.T
    corner = [[0, 0], [0.3, 0], [0.3, 0.15], [0.15, 0.15], [0.15, 0.3], [0, 0.3]]
    in_corner = ((x < 0.3) & (y < 0.15)) | ((x < 0.15) & (y < 0.3))
    in_box = (x >= 0.4) & (x <= 0.6) & (y >= 0.4) & (y <= 0.6)
    in_list = np.flatnonzero((x > 0.8) & (y > 0.8))
    handles = [
        {"outline": corner, "to": [0.1, 0.1], "turn": 10},
        {"low": [0.4, 0.4], "high": [0.6, 0.6], "to": [0.55, 0.5], "turn": 20},
        {"vertices": in_list.tolist(), "by": [0.2, 0.1]},
    ]
    solution = unwrapd.Problem(vertices, faces).solve(handles)
    assert solution.status == "converged" and solution.report["inverted"] == 0
    np.testing.assert_allclose(solution.x[in_list], vertices[in_list] + (0.2, 0.1), atol=1e-12)
    for members, degrees in ((in_corner, 10), (in_box, 20)):
        turn = np.deg2rad(degrees)
        rotation = np.array([[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]])
        before, after = vertices[members], solution.x[members]
        assert len(before) > 8
        np.testing.assert_allclose(after - after[0], (before - before[0]) @ rotation.T, atol=1e-12)


def test_a_soft_handle_comes_nearer_with_more_weight():
    vertices, faces = grid(9)
    problem = unwrapd.Problem(vertices, faces, units="normalized")
    held = [{"vertex": 0, "to": [0, 0]}, {"vertex": 8, "to": [1, 0]}]
    distances = []
    for weight in (0.1, 1, 10):
        solution = problem.solve([*held, {"vertex": 80, "to": [1.6, 1.5], "weight": weight}])
        distances.append(np.linalg.norm(solution.x[80] - (1.6, 1.5)))
        np.testing.assert_array_equal(solution.x[[0, 8]], [[0, 0], [1, 0]])
    assert 0.7 > distances[0] > distances[1] > distances[2] > 1e-4


def test_arrays_have_nothing_to_select_by():
    with pytest.raises(unwrapd.InvalidInput, match="needs a file to select from"):
        unwrapd.Problem(*grid(4)).solve([{"select": "material=Glass", "by": [1, 0]}])


def test_every_iterate_is_seen_and_valid():
    problem = unwrapd.Problem(*grid(8), energy="log(s1)^2 + log(s2)^2")
    seen = []
    solution = problem.solve({0: (0, 0), 7: (1, 0), 63: (0.4, 1.6)}, callback=seen.append)
    assert [iterate.iteration for iterate in seen] == list(range(solution.iterations + 1))
    assert all(iterate.smallest > 0 and iterate.x.shape == (64, 2) for iterate in seen)
    assert seen[-1].energy == pytest.approx(problem.energy(seen[-1].x))
    assert solution.status == "converged" and solution.report["inverted"] == 0
    np.testing.assert_array_equal(solution.x[63], (0.4, 1.6))


def test_a_callback_ends_or_cancels():
    problem = unwrapd.Problem(*grid(12))
    handles = {0: (0, 0), 143: (0.2, 0.2)}
    seen = []
    stopped = problem.solve(handles, callback=lambda iterate: seen.append(iterate) or len(seen) < 3)
    assert stopped.status == "stopped" and len(seen) == 3
    np.testing.assert_array_equal(stopped.x, seen[-1].x)

    def fail(iterate):
        raise KeyError(iterate.iteration)

    with pytest.raises(KeyError, match="0"):
        problem.solve(handles, callback=fail)
    assert problem.solve(handles, time_budget=0).status == "stopped"


def test_surfaces_and_tetrahedra_are_solved(tets, bumps):
    vertices, faces, start = bumps
    flat = unwrapd.Problem(vertices, faces, start=start, energy="symmetric-dirichlet", barrier="none")
    solution = flat.solve({0: start[0]})
    assert solution.energy < flat.energy() and solution.x.shape == (25, 2)
    assert np.abs(flat.gradient(solution.x)[1:]).max() < 1e-2
    body = unwrapd.Problem(*tets, energy="(s1 - 1)^2 + (s2 - 1)^2 + (s3 - 1)^2")
    pulled = body.solve([{"vertex": 0, "to": (0, 0, 0)}, {"vertex": 4, "to": np.array([1, 1, 2])}])
    np.testing.assert_array_equal(pulled.x[[0, 4]], [[0, 0, 0], [1, 1, 2]])
    both = [
        body.solve({0: (0, 0, 0), 4: (2, 1, 1)}, method=method).energy
        for method in ("projected", "levenberg")
    ]
    assert both[0] == pytest.approx(both[1], rel=1e-3)


@pytest.mark.parametrize(
    ("energy", "column"),
    [("steam", 1), ("s1 + s2 +", 10), ("(s1-2)^2 + (s2-2)^2", None), ("s1", None)],
)
def test_formulas_that_are_no_energies(energy, column):
    with pytest.raises(unwrapd.InvalidInput) as raised:
        unwrapd.Problem(*grid(2), energy=energy)
    assert (raised.value.code, raised.value.column) == ("invalid_formula", column)


def test_what_is_no_problem(tets):
    vertices, faces = grid(2)
    space = np.pad(vertices, ((0, 0), (0, 1)))
    for arguments, options, error in [
        ((vertices, faces + 9), {}, "index_out_of_range"),
        ((vertices * np.nan, faces), {}, "non_finite_position"),
        ((vertices * 0, faces), {}, "zero_size_element"),
        ((space * 0, faces), {"start": vertices}, "zero_size_element"),
        ((space, faces + 9), {"start": vertices}, "index_out_of_range"),
        (tets, {"energy": "lscm"}, "planar_energy"),
        (tets, {"energy": ARAP}, "invalid_formula"),
        ((vertices, faces), {"barrier_strength": -1.0}, "bad_parameter"),
    ]:
        with pytest.raises(unwrapd.Error) as raised:
            unwrapd.Problem(*arguments, **options)
        assert raised.value.code == error
    for wrong in [(space, faces), (vertices[:, 0], faces), (vertices, faces[:, :2])]:
        with pytest.raises(ValueError):
            unwrapd.Problem(*wrong)
    with pytest.raises(TypeError, match="did you mean 'energy'"):
        unwrapd.Problem(vertices, faces, energi="arap")
    problem = unwrapd.Problem(vertices, faces)
    with pytest.raises(ValueError, match="shape"):
        problem.energy(space)
    for handles, code in [({9: (0, 0)}, "unknown_handle"), ({0: (0, 0, 0)}, "bad_target")]:
        with pytest.raises(unwrapd.InvalidInput) as raised:
            problem.solve(handles)
        assert raised.value.code == code
    collapsed = unwrapd.Problem(vertices, faces, energy="symmetric-dirichlet")
    assert collapsed.energy(vertices * 0) == np.inf
    with pytest.raises(unwrapd.InvalidInput) as raised:
        collapsed.gradient(vertices * 0)
    assert raised.value.code == "outside_domain"
