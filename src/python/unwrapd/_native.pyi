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

def option_names(function: str) -> list[str]: ...
def unwrap(
    meshes: list[Mesh], options: str, progress: Listener | None
) -> tuple[list[Welded], str]: ...
def repack(
    meshes: list[Mesh], options: str, progress: Listener | None
) -> tuple[list[Welded], str]: ...
def measure(meshes: list[Mesh], options: str) -> str: ...
def verify(meshes: list[Mesh], options: str) -> str: ...
def unwrap_document(
    file: File, options: str, stem: str | None, progress: Listener | None
) -> tuple[list[tuple[str, bytes]], str]: ...
def repack_document(
    file: File, options: str, stem: str | None, progress: Listener | None
) -> tuple[list[tuple[str, bytes]], str]: ...
def measure_document(file: File, options: str) -> str: ...
def verify_document(file: File, options: str) -> str: ...
def bake(
    uvs: np.ndarray, values: np.ndarray, size: int, threads: int | None
) -> tuple[np.ndarray, np.ndarray]: ...
