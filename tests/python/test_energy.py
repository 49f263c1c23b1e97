"""Energies as functions on arrays."""

import threading
import time

import numpy as np
import pytest
import unwrapd
from test_problem import bent, dense, grid, tets  # noqa: F401

SYMMETRIC_DIRICHLET = unwrapd.Energy(
    lambda sigma: (sigma**2 + 1 / sigma**2).sum(1),
    lambda sigma: 2 * (sigma - 1 / sigma**3),
    lambda sigma: (2 + 6 / sigma**4)[:, :, None] * np.eye(sigma.shape[1]),
)
ARAP = unwrapd.Energy(
    lambda sigma: 0.5 * ((sigma - 1) ** 2).sum(1),
    lambda sigma: sigma - 1,
    lambda sigma: np.broadcast_to(np.eye(sigma.shape[1]), (len(sigma), *2 * sigma.shape[1:])),
)


def both(mesh, energy, name, **options):
    return [unwrapd.Problem(*mesh, energy=given, **options) for given in (energy, name)]


@pytest.mark.parametrize(("energy", "name"), [(SYMMETRIC_DIRICHLET, "symmetric-dirichlet"), (ARAP, "arap")])
def test_functions_are_the_energy_that_they_compute(energy, name, tets):  # noqa: F811
    for mesh in (grid(4), tets):
        own, named = both(mesh, energy, name)
        x = bent(mesh[0])
        assert own.energy(x) == pytest.approx(named.energy(x), rel=1e-12)
        np.testing.assert_allclose(own.gradient(x), named.gradient(x), rtol=1e-9, atol=1e-12)
        np.testing.assert_allclose(dense(own, x), dense(named, x), rtol=1e-9, atol=1e-9)
        for part, values in named.elements(x).items():
            np.testing.assert_allclose(own.elements(x)[part], values, rtol=1e-12)


def test_minima_are_those_of_the_named_energy_in_at_most_three_times_the_time():
    vertices, faces = grid(61)
    middle, corners = 30 * 61 + 30, (0, 60, 60 * 61, 61 * 61 - 1)
    handles = {**{corner: vertices[corner] for corner in corners}, middle: (0.7, 0.6)}
    own, named = both((vertices, faces), SYMMETRIC_DIRICHLET, "symmetric-dirichlet", units="normalized")
    seconds = []
    for problem in (own, named):
        runs = []
        for _ in range(3):
            begin = time.process_time()
            solution = problem.solve(handles, tolerance=1e-9, threads=1)
            runs.append(time.process_time() - begin)
        seconds.append(min(runs))
        assert solution.status == "converged"
        problem.found = solution
    assert own.found.energy == pytest.approx(named.found.energy, rel=1e-9)
    assert own.found.iterations == named.found.iterations
    np.testing.assert_allclose(own.found.x, named.found.x, atol=1e-9)
    assert seconds[0] <= 3 * seconds[1], seconds


def test_each_evaluation_is_one_call_for_all_elements():
    vertices, faces = grid(6)
    shapes = {name: [] for name in unwrapd.Energy._fields}

    def seen(name, function):
        def call(sigma):
            shapes[name].append(sigma.shape)
            assert sigma.dtype == np.float64
            return function(sigma)

        return call

    energy = unwrapd.Energy(*map(seen, unwrapd.Energy._fields, SYMMETRIC_DIRICHLET))
    problem = unwrapd.Problem(vertices, faces, energy=energy)
    for calls in shapes.values():
        calls.clear()
    solution = problem.solve({0: (0, 0), 35: (1.4, 1.2)})
    assert all(set(calls) == {(len(faces), 2)} for calls in shapes.values())
    assert len(shapes["hessian"]) <= 2 * solution.report["factorizations"] + 2


@pytest.mark.parametrize("method", ["projected", "levenberg"])
def test_inverted_elements_are_never_asked_for_outside_the_domain(method):
    vertices, faces = grid(4)

    def value(sigma):
        assert len(sigma) == 1 or (sigma > 0).all()
        return (np.log(sigma) ** 2).sum(1)

    hencky = unwrapd.Energy(
        value,
        lambda sigma: 2 * np.log(sigma) / sigma,
        lambda sigma: (2 * (1 - np.log(sigma)) / sigma**2)[:, :, None] * np.eye(2),
    )
    own, typed = both((vertices, faces), hencky, "log(s1)^2 + log(s2)^2", barrier="none")
    handles = {0: (0, 0), 3: (1, 0), 15: (0.4, 1.6)}
    found = [problem.solve(handles, method=method).energy for problem in (own, typed)]
    assert found[0] == pytest.approx(found[1], rel=1e-9)
    assert own.energy(vertices * (1, -1)) == np.inf
    assert (own.elements(vertices * (1, -1))["energy_density"] == np.inf).all()


class Broken(Exception):
    pass


def failing(name, result, after=20):
    """The energy with a function that is another from some call on."""
    calls = iter(range(10**6))

    def call(sigma):
        return getattr(SYMMETRIC_DIRICHLET, name)(sigma) if next(calls) < after else result(sigma)

    return SYMMETRIC_DIRICHLET._replace(**{name: call})


def broken(sigma):
    raise Broken("by the user")


@pytest.mark.parametrize("name", unwrapd.Energy._fields)
def test_an_exception_of_a_function_is_raised_to_the_caller(name):
    problem = unwrapd.Problem(*grid(12), energy=failing(name, broken, after=60))
    x = problem.start
    with pytest.raises(Broken, match="by the user"):
        for _ in range(100):
            problem.solve({0: (0, 0), 143: (1.5, 1.2)})
    with pytest.raises(Broken):
        problem.energy(x), problem.gradient(x), problem.hessian(x)
    with pytest.raises(Broken):
        unwrapd.Problem(*grid(2), energy=failing(name, broken, after=0))


@pytest.mark.parametrize("name", unwrapd.Energy._fields)
@pytest.mark.parametrize(
    ("result", "message"),
    [
        (lambda sigma: np.ones(len(sigma) + 1), "shape"),
        (lambda sigma: 3.0, "shape"),
        (lambda sigma: np.full((len(sigma), *2 * sigma.shape[1:]), np.nan), "shape|finite"),
        (lambda sigma: np.full(sigma.shape, np.nan), "shape|finite"),
        (lambda sigma: np.full(len(sigma), np.nan), "shape|numbers"),
    ],
)
def test_results_that_are_no_numbers_or_have_another_shape(name, result, message):
    problem = unwrapd.Problem(*grid(12), energy=failing(name, result, after=60))
    with pytest.raises(unwrapd.InvalidInput, match=f"energy's {name} must return.*({message})") as raised:
        for _ in range(100):
            problem.solve({0: (0, 0), 143: (1.5, 1.2)})
    assert raised.value.code == "invalid_energy"
    # The problem itself is unharmed.
    assert unwrapd.Problem(*grid(12), energy=SYMMETRIC_DIRICHLET).energy() == pytest.approx(4)


def test_functions_that_are_no_energies(tets):  # noqa: F811
    uneven = ARAP._replace(value=lambda sigma: (sigma - 1) ** 2 @ np.arange(1, sigma.shape[1] + 1))
    elsewhere = ARAP._replace(value=lambda sigma: ((sigma - 2) ** 2).sum(1), gradient=lambda sigma: 2 * (sigma - 2))
    for energy, word in [(uneven, "symmetric"), (elsewhere, "minimal")]:
        for mesh in (grid(2), tets):
            with pytest.raises(unwrapd.InvalidInput, match=word) as raised:
                unwrapd.Problem(*mesh, energy=energy)
            assert raised.value.code == "invalid_formula"
    for wrong in [ARAP[:2], ARAP.value, 5, (1, 2, 3), [ARAP.value, "arap", ARAP.value]]:
        with pytest.raises(TypeError, match="three functions"):
            unwrapd.Problem(*grid(2), energy=wrong)


def test_a_bound_on_the_distortion_and_bijectivity_join_functions():
    handles = {0: (0, 0), 24: (1.6, 1.1), 4: (1, 0)}
    for options in ({"max_conformal": 4.0}, {"bijective": True}):
        own, named = (problem.solve(handles) for problem in both(grid(5), ARAP, "arap", **options))
        assert own.energy == pytest.approx(named.energy, rel=1e-9)


def test_a_problem_with_functions_works_on_any_thread():
    problem = unwrapd.Problem(*grid(8), energy=SYMMETRIC_DIRICHLET)
    found = []

    def work():
        found.append(problem.solve({0: (0, 0), 63: (1.3, 1.2)}).energy)

    threads = [threading.Thread(target=work) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(set(found)) == 1 and len(found) == 4


def dragged(energy):
    session = unwrapd.Session(*grid(30), energy=energy, threads=1)
    session.add({"center": (0, 0.5), "radius": 0.3, "to": (0, 0.5)})
    corner = session.add({"vertex": 899, "to": (1, 1)})
    begin = time.process_time()
    for target in np.linspace((1, 1), (1.4, 1.3), 10):
        session.move(corner, target)
        session.step()
    assert session.settle() == "settled"
    return session, time.process_time() - begin


def test_a_session_with_functions_is_one_with_the_named_energy_in_at_most_three_times_the_time():
    (own, seconds), (named, of_named) = dragged(SYMMETRIC_DIRICHLET), dragged("symmetric-dirichlet")
    np.testing.assert_allclose(own.x, named.x, atol=1e-9)
    assert own.summary["iterations"] == named.summary["iterations"]
    assert own.worth["energy"] == pytest.approx(named.worth["energy"], rel=1e-9)
    assert seconds <= 3 * of_named, (seconds, of_named)
    # Functions and names are exchanged for each other.
    for energy in (ARAP, "symmetric-dirichlet", SYMMETRIC_DIRICHLET):
        own.remodel(energy=energy)
        assert own.settle() == "settled"
    np.testing.assert_allclose(own.x, named.x, atol=1e-4)


@pytest.mark.parametrize("name", unwrapd.Energy._fields)
def test_an_exception_ends_a_session_with_its_last_map(name):
    session = unwrapd.Session(*grid(12), energy=failing(name, broken, after=60))
    session.add({"center": (0, 0.5), "radius": 0.3, "to": (0, 0.5)})
    corner = session.add({"vertex": 143, "to": (1, 1)})
    with pytest.raises(Broken, match="by the user"):
        for turn in range(200):
            before = session.x
            session.move(corner, (1.2 + 0.1 * np.cos(turn), 1.2 + 0.1 * np.sin(turn)))
            session.step()
    assert np.abs(session.x - before).max() < 0.3
    a, b, c = session.x[grid(12)[1]].transpose(1, 0, 2)
    assert (np.linalg.det(np.stack([b - a, c - a], 1)) > 0).all()
    with pytest.raises(RuntimeError, match="ended the session"):
        session.step()


def dome(side=40):
    vertices, faces = grid(side)
    x, y = vertices.T - 0.5
    return np.column_stack([vertices, np.exp(-8 * (x**2 + y**2))]), faces


@pytest.mark.parametrize("options", [{"cut": "disk"}, {}])
def test_unwrap_minimizes_functions_as_the_named_energy_in_at_most_three_times_the_time(options):
    found = []
    for energy in (SYMMETRIC_DIRICHLET, "symmetric-dirichlet"):
        begin = time.process_time()
        atlas = unwrapd.unwrap(*dome(), energy=energy, barrier_strength=0.02, threads=1, **options)
        found.append((atlas, time.process_time() - begin))
    (own, seconds), (named, of_named) = found
    assert own.certified and own.n_charts == named.n_charts
    np.testing.assert_allclose(own.uvs, named.uvs, atol=1e-6)
    energies = [atlas.measures["sym_dirichlet_mean"] for atlas in (own, named)]
    assert energies[0] == pytest.approx(energies[1], rel=1e-9)
    assert seconds <= 3 * of_named, (seconds, of_named)
    assert own.report["options"]["energy"] == "functions"


def test_unwrap_raises_what_a_function_raises(tmp_path):
    with pytest.raises(Broken, match="by the user"):
        unwrapd.unwrap(*dome(), energy=failing("gradient", broken, after=5))
    with pytest.raises(TypeError, match="three functions"):
        unwrapd.unwrap(*dome(), energy=ARAP[:2])
    vertices, faces = dome(8)
    mesh = tmp_path / "dome.obj"
    lines = [*("v {} {} {}".format(*v) for v in vertices), *("f {} {} {}".format(*f + 1) for f in faces)]
    mesh.write_text("\n".join(lines))
    with pytest.raises(Broken):
        unwrapd.unwrap_file(mesh, tmp_path / "out.glb", energy=failing("hessian", broken, after=5))
    assert not (tmp_path / "out.glb").exists()
    report = unwrapd.unwrap_file(mesh, tmp_path / "out.glb", energy=ARAP)
    assert report["certified"]
