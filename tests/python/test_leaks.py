"""Calls leave no memory behind; `tests/bench/leaks.py` makes as many as are asked for."""

import pathlib
import sys

import pytest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "bench"))
import leaks  # noqa: E402


@pytest.mark.parametrize("name", leaks.calls())
def test_calls_leave_nothing_behind(name):
    n_calls = 60 if name == "unwrap" else 400
    grown, _, _ = leaks.growth(leaks.calls()[name], n_calls)
    assert grown < leaks.MOST


def test_what_is_left_behind_is_seen():
    kept = []
    grown, _, _ = leaks.growth(lambda: kept.append(bytearray(b"x" * 100_000)), 400)
    assert grown > leaks.MOST
