"""The native part: arrays are contiguous, options are JSON objects with known names."""

from collections.abc import Callable
from typing import Any, TypedDict

import numpy as np

class File(TypedDict):
    name: str
    bytes: bytes
    resources: dict[str, bytes]
    folder: str | None

Mesh = tuple[np.ndarray, np.ndarray, np.ndarray | None, np.ndarray | None]
Welded = tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]
Listener = Callable[[Progress], Any]
Functions = tuple[Callable[[np.ndarray], np.ndarray], ...]

__version__: str

class Progress:
    """Where the work stands."""

    @property
    def stage(self) -> str:
        """read, cut, map, pack, bake, write or judge."""
    @property
    def fraction(self) -> float:
        """Share of the whole work done, 0 to 1; never falls."""
    @property
    def chart(self) -> int:
        """Charts mapped so far."""
    @property
    def charts(self) -> int:
        """Charts known so far."""
    @property
    def iteration(self) -> int:
        """Iteration of the chart that reported last."""
    @property
    def energy(self) -> float:
        """Its energy, barrier included."""
    @property
    def smallest(self) -> float:
        """Its smallest element over the rest size."""

class Iterate:
    """Where a minimization stands."""

    @property
    def iteration(self) -> int:
        """0 for the start, then 1, 2, …"""
    @property
    def energy(self) -> float:
        """The energy with its barriers."""
    @property
    def barrier(self) -> float:
        """The barrier's share of it."""
    @property
    def smallest(self) -> float:
        """The smallest element over its rest size; negative if it is inverted."""
    @property
    def step(self) -> float:
        """The length of the step that led here as a share of its direction."""
    @property
    def x(self) -> np.ndarray:
        """Positions, (V, D) float64."""

class Problem:
    def __init__(
        self,
        vertices: np.ndarray,
        elements: np.ndarray,
        start: np.ndarray | None,
        options: str,
        functions: Functions | None,
        is_normalized: bool,
    ) -> None: ...
    dim: int
    start: np.ndarray
    def value(self, x: np.ndarray) -> float: ...
    def gradient(self, x: np.ndarray) -> np.ndarray: ...
    def hessian(self, x: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]: ...
    def elements(self, x: np.ndarray) -> list[tuple[str, np.ndarray]]: ...
    def solve(
        self, handles: str, options: str, callback: Callable[[Iterate], Any] | None
    ) -> tuple[np.ndarray, str]: ...

class Session:
    def __init__(
        self,
        vertices: np.ndarray,
        elements: np.ndarray,
        start: np.ndarray | None,
        options: str,
        functions: Functions | None,
        threads: int | None,
    ) -> None: ...
    dim: int
    stage: str
    x: np.ndarray
    def add(self, handle: str) -> int: ...
    def move_to(self, number: int, to: list[float]) -> None: ...
    def remove(self, number: int) -> None: ...
    def remodel(self, options: str, functions: Functions | None) -> None: ...
    def step(self) -> str: ...
    def settle(self, seconds: float) -> str: ...
    def worth(self) -> str: ...
    def summary(self) -> str: ...
    def remember(self) -> None: ...
    def undo(self) -> bool: ...
    def redo(self) -> bool: ...
    def reset(self) -> None: ...

def option_names(function: str) -> list[str]: ...
def unwrap(
    meshes: list[Mesh], options: str, functions: Functions | None, progress: Listener | None
) -> tuple[list[Welded], str]: ...
def repack(
    meshes: list[Mesh], options: str, progress: Listener | None
) -> tuple[list[Welded], str]: ...
def measure(meshes: list[Mesh], options: str) -> str: ...
def verify(meshes: list[Mesh], options: str) -> str: ...
def unwrap_document(
    file: File,
    options: str,
    functions: Functions | None,
    stem: str | None,
    progress: Listener | None,
) -> tuple[list[tuple[str, bytes]], str]: ...
def repack_document(
    file: File, options: str, stem: str | None, progress: Listener | None
) -> tuple[list[tuple[str, bytes]], str]: ...
def measure_document(file: File, options: str) -> str: ...
def verify_document(file: File, options: str) -> str: ...
def untangle(
    vertices: np.ndarray,
    elements: np.ndarray,
    rest_vertices: np.ndarray | None,
    options: str,
) -> tuple[np.ndarray, np.ndarray, str]: ...
def references(file: File) -> list[tuple[str, bytes]]: ...
def bake(
    uvs: np.ndarray, values: np.ndarray, size: int, threads: int | None
) -> tuple[np.ndarray, np.ndarray]: ...
def run_command(arguments: list[str], python: str, launcher: list[str], engine: str) -> int: ...
