"""What a figure is."""
from collections.abc import Callable
from dataclasses import dataclass


@dataclass(frozen=True)
class Figure:
    """`make(work, fault)` runs the commands; `check(made)` fails or says what was reached; `draw(made)` gives the picture."""
    number: int
    name: str
    caption: str
    make: Callable
    check: Callable
    draw: Callable
    faults: tuple[str, ...]
