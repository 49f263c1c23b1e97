"""Bodies that are pulled an iteration at a time."""

import os
import time

import numpy as np
import pytest
import unwrapd
from test_problem import grid


def held(side=10, **more):
    session = unwrapd.Session(*grid(side), energy="log(s1)^2 + log(s2)^2", **more)
    session.add({"center": (0, 0.5), "radius": 0.4, "to": (0, 0.5)})
    return session, session.add({"vertex": side * side - 1, "to": (1, 1)})


def test_a_drag_starts_from_the_map_before():
    session, corner = held()
    steps = []
    for target in np.linspace((1, 1), (1.3, 1.2), 5):
        session.move(corner, target)
        while session.step() == "moving":
            pass
        np.testing.assert_array_equal(session.x[99], target)
        assert session.worth["inverted"] == 0
        steps.append(session.summary["iterations"])
    assert max(np.diff(steps)) < 12 and session.stage == "settled"


def test_it_ends_where_a_problem_does():
    session, corner = held()
    session.move(corner, (1.4, 1.1))
    assert session.settle() == "settled"
    problem = unwrapd.Problem(*grid(10), energy="log(s1)^2 + log(s2)^2", units="normalized")
    handles = [
        {"center": (0, 0.5), "radius": 0.4, "to": (0, 0.5)},
        {"vertex": 99, "to": (1.4, 1.1)},
    ]
    np.testing.assert_allclose(session.x, problem.solve(handles, tolerance=1e-12).x, atol=1e-3)


def test_lines_lists_and_soft_handles_are_pulled():
    vertices, faces = grid(17)
    session = unwrapd.Session(vertices, faces)
    left = np.flatnonzero(vertices[:, 0] < 0.1)
    session.add({"vertices": left.tolist()})
    line = session.add({"line": [[0.5, 0.2], [0.5, 0.8]], "to": [[0.5, 0.2], [0.6, 0.5], [0.5, 0.8]]})
    session.add({"vertex": 288, "to": (1.2, 1.2), "weight": 0.5})
    assert session.settle() == "settled" and session.worth["inverted"] == 0
    np.testing.assert_array_equal(session.x[left], vertices[left])
    before = np.linalg.norm(session.x[288] - (1.2, 1.2))
    assert 1e-3 < before < np.linalg.norm(vertices[288] - (1.2, 1.2))
    session.move(line, (0.7, 0.5))
    assert session.settle() == "settled" and session.worth["inverted"] == 0


def test_undo_and_reset():
    session, corner = held()
    session.settle()
    before = session.x
    session.remember()
    session.move(corner, (1.2, 1.3))
    session.settle()
    after = session.x
    assert session.undo() and (session.x == before).all()
    assert session.redo() and (session.x == after).all() and not session.redo()
    session.reset()
    np.testing.assert_allclose(session.x, grid(10)[0], atol=1e-15)


def test_energies_are_exchanged():
    session, corner = held()
    session.move(corner, (1.5, 1.5))
    session.settle()
    before = session.x
    session.remodel(energy="arap")
    assert (session.x == before).all()
    session.settle()
    assert (session.x != before).any()
    with pytest.raises(unwrapd.InvalidInput) as raised:
        session.remodel(max_conformal=1.0001)
    assert raised.value.code == "outside_domain"


def test_handles_that_there_are_not():
    session, corner = held(3)
    session.remove(corner)
    for wrong in (lambda: session.move(corner, (0, 0)), lambda: session.remove(7)):
        with pytest.raises(unwrapd.InvalidInput) as raised:
            wrong()
        assert raised.value.code == "unknown_handle"
    with pytest.raises(unwrapd.InvalidInput) as raised:
        session.add({"vertex": 3, "at": 4})
    assert raised.value.code == "malformed_handles"


def test_settling_keeps_its_time():
    session, corner = held(120)
    session.move(corner, (3, 3))
    begin = time.monotonic()
    assert session.settle(time_budget=0.05) == "moving"
    # To settle takes minutes.
    assert time.monotonic() - begin < 20


@pytest.mark.filterwarnings("ignore:.*fork.*:DeprecationWarning")
def test_after_a_fork(forked):
    session, corner = held(40)
    session.move(corner, (1.4, 1.2))
    session.step()
    problem = unwrapd.Problem(*grid(40))
    problem.solve({0: (0, 0), 1599: (1.2, 1.2)})

    def is_solved():
        solved = problem.solve({0: (0, 0), 1599: (1.2, 1.2)}).status == "converged"
        return solved and session.settle() == "settled"

    assert forked(is_solved)


@pytest.mark.parametrize("threads", [1, 2, None])
def test_threads_make_no_difference(threads):
    sessions = [unwrapd.Session(*grid(30), threads=number) for number in (1, threads)]
    for session in sessions:
        session.add({"vertex": 0, "to": (0, 0)})
        session.add({"vertex": 899, "to": (1.2, 1.4)})
        session.settle()
    assert (sessions[0].x == sessions[1].x).all()
    with pytest.raises((ValueError, OverflowError)):
        unwrapd.Session(*grid(3), threads=0)


def test_the_docstring_is_true():
    import doctest

    assert doctest.testmod(unwrapd._session) == (0, 7)


def test_threads_stay_with_the_session():
    def threads():
        return set(os.listdir("/proc/self/task"))

    before = threads()
    session, corner = held(5, threads=2)
    mine = threads() - before
    assert len(mine) == 2
    session.move(corner, (5, 5))
    session.step()
    assert threads() - before == mine
    del session
    deadline = time.monotonic() + 60
    while threads() & mine and time.monotonic() < deadline:
        time.sleep(0.01)
    assert not threads() & mine
