"""Bodies in the hand."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any, Mapping, Optional

import numpy as np

from . import _bodies, _energy, _native
from ._options import to_json

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ._option_types import ProblemOptions


class Session:
    """A body that is pulled while someone watches: each iteration starts from the map before, and every map is valid.

    Takes `vertices`, `elements`, `start` and `**options` as `Problem` does; `barrier_strength` is meant in a unit in which the mean
    element has size 1. `threads` is how many work, by default all. A body starts at rest, a surface at its `start`. A session belongs
    to one thread at a time. An exception of a function of its `Energy` is raised and ends it: `x` stays the last valid map, and any
    further work is a RuntimeError.

    >>> import unwrapd
    >>> session = unwrapd.Session([[0, 0], [1, 0], [1, 1], [0, 1]], [[0, 1, 2], [0, 2, 3]])
    >>> _ = session.add({"vertex": 0, "to": (0, 0)})
    >>> corner = session.add({"vertex": 2, "to": (1, 1)})
    >>> session.move(corner, (1.5, 1.25))
    >>> session.settle()
    'settled'
    >>> session.x[2].tolist()
    [1.5, 1.25]
    """

    def __init__(
        self,
        vertices: Any,
        elements: Any,
        *,
        start: Any = None,
        threads: Optional[int] = None,
        **options: Unpack[ProblemOptions],
    ) -> None:
        body = _bodies.native(vertices, elements, start)
        texts, functions = _energy.split(options)
        self._native = _native.Session(*body, to_json("Problem", texts), functions, threads)

    def add(self, handle: Mapping[str, Any]) -> int:
        """Take hold, with a handle as files of handles have it; the number of the handle. Raises `InvalidInput`."""
        return self._native.add(_bodies.handle_json(handle))

    def move(self, handle: int, to: Any) -> None:
        """Give a handle another target, (D,). Raises `InvalidInput` if there is no such handle, or it contradicts another."""
        self._native.move_to(handle, [float(coordinate) for coordinate in to])

    def remove(self, handle: int) -> None:
        """Let go of a handle. Raises `InvalidInput` if there is no such."""
        self._native.remove(handle)

    def remodel(self, **options: Unpack[ProblemOptions]) -> None:
        """Exchange energy and barrier; map and handles stay. Raises `InvalidInput` if the map is outside their domain."""
        texts, functions = _energy.split(options)
        self._native.remodel(to_json("Problem", texts), functions)

    def step(self) -> str:
        """One iteration; ``"moving"`` if more of them change the map, ``"settled"`` or ``"unreachable"``."""
        return self._native.step()

    def settle(self, time_budget: float = float("inf")) -> str:
        """Iterations until nothing is left to do or the seconds are over; the stage. Ctrl-C ends it between two maps."""
        return self._native.settle(time_budget)

    @property
    def stage(self) -> str:
        """Where the handles stand."""
        return self._native.stage

    @property
    def x(self) -> np.ndarray:
        """Where the vertices are, (V, D) float64. Those at their targets are there to the bit."""
        return self._native.x.reshape(-1, self._native.dim)

    @property
    def worth(self) -> dict[str, Any]:
        """What the map is worth: `energy`, `barrier`, `residual`, `inverted`, `smallest`."""
        worth: dict[str, Any] = json.loads(self._native.worth())
        return worth

    @property
    def summary(self) -> dict[str, Any]:
        """What was done since the beginning: `iterations`, `factorizations`, `energy_first`, `energy_last`."""
        summary: dict[str, Any] = json.loads(self._native.summary())
        return summary

    def remember(self) -> None:
        """Remember positions and handles, as before a drag."""
        self._native.remember()

    def undo(self) -> bool:
        """Return to what was remembered last, to the bit; False if there is nothing."""
        return self._native.undo()

    def redo(self) -> bool:
        """Take an undo back; False if there is none."""
        return self._native.redo()

    def reset(self) -> None:
        """Return to rest, without handles."""
        self._native.reset()
