"""Progress of jobs, told to a function or shown by a bar."""

from __future__ import annotations

import contextlib
import importlib.util
from typing import Any, Callable, Iterator, Mapping, NamedTuple, Optional, Union


class JobProgress(NamedTuple):
    """Where a job of a service stands, as `Progress` says it, before its start too."""

    state: str
    stage: Optional[str]
    fraction: float
    chart: int
    charts: int

    @classmethod
    def of(cls, record: Mapping[str, Any]) -> JobProgress:
        """What a service tells of a job."""
        return cls(
            state=record["state"],
            stage=record.get("stage"),
            fraction=record.get("fraction", 0.0),
            chart=record.get("chart", 0),
            charts=record.get("charts", 0),
        )


Listener = Union[bool, Callable[[JobProgress], Any]]


@contextlib.contextmanager
def told(progress: Optional[Listener]) -> Iterator[Callable[[JobProgress], Any]]:
    """Who is told of progress."""
    if callable(progress):
        yield progress
        return
    with bar(bool(progress), total=1.0) as move:
        shown = 0.0

        def tell(now: JobProgress) -> None:
            nonlocal shown
            move(now.fraction - shown)
            shown = now.fraction

        yield tell


@contextlib.contextmanager
def heard(progress: Any) -> Iterator[Optional[Callable[[Any], Any]]]:
    """What the native part calls: a function as it is, a bar for True, nobody for None and False."""
    if progress is None or progress is False:
        yield None
        return
    with told(progress) as tell:
        yield tell


@contextlib.contextmanager
def bar(is_wanted: bool, **settings: Any) -> Iterator[Callable[[float], Any]]:
    """What moves a bar on, if one is wanted and ``tqdm`` is there."""
    found = importlib.util.find_spec("tqdm") if is_wanted else None
    if found is None:
        yield lambda _: None
        return
    with importlib.import_module("tqdm.auto").tqdm(**settings) as shown:
        yield shown.update
