"""A service as a client sees it: files go there, and come back unwrapped."""

from __future__ import annotations

import collections
import contextlib
import itertools
import threading
import uuid
from concurrent.futures import FIRST_COMPLETED, Future, ThreadPoolExecutor, wait
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Deque, Iterable, Iterator, Mapping, Optional

from ._errors import Error, ServiceError
from ._job import Job, Path
from ._options import to_json
from ._progress import JobProgress, Listener, bar, told
from ._service import Service, of_problem
from ._upload import form

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ._option_types import (
        MeasureFileOptions,
        RepackFileOptions,
        UnwrapBytesOptions,
        VerifyFileOptions,
    )

#: Seconds that an answer waits for the end of a job. It is as long until progress is told and an end is noticed.
_WAIT = 1


@dataclass(frozen=True)
class Outcome:
    """What became of one file of `Client.map`."""

    path: Path
    job: Optional[Job] = None
    error: Optional[Exception] = None

    def result(self) -> Job:
        """The job, or its exception raised."""
        if self.job is None:
            raise self.error or ServiceError("the file was not sent")
        return self.job


class Client:
    """A service at an address.

    Parameters
    ----------
    url : str
        Where it is, such as ``http://127.0.0.1:8080``.
    key : str, optional
        The API key, if the service asks for one.
    patience : float
        Seconds for which a request is repeated while the service is busy, full, restarting or not there. Its ``Retry-After``
        is kept to. A submission that is repeated is still one job.

    Exceptions are those of `unwrap_file`, with the same codes; what only a service says is a `ServiceError`.
    """

    def __init__(self, url: str, key: Optional[str] = None, *, patience: float = 600.0) -> None:
        self._service = Service(url, key, patience)

    def unwrap(
        self,
        path: Path,
        *,
        progress: Optional[Listener] = None,
        **options: Unpack[UnwrapBytesOptions],
    ) -> Job:
        """Unwrap a file and the files that it refers to.

        ``progress`` is called about once a second; if it returns False, the job ends with its present valid map. True shows a
        bar if ``tqdm`` is there. An exception, and Ctrl-C, cancel the job.

        >>> client.unwrap("chair.glb", padding=8).save("out/chair.glb")  # doctest: +SKIP
        """
        return self._done("unwrap", path, options, progress)

    def repack(
        self,
        path: Path,
        *,
        progress: Optional[Listener] = None,
        **options: Unpack[RepackFileOptions],
    ) -> Job:
        """Pack the UV islands of a file anew."""
        return self._done("repack", path, options, progress)

    def measure(self, path: Path, **options: Unpack[MeasureFileOptions]) -> dict[str, Any]:
        """Measure the UVs of a file."""
        return self._done("measure", path, options).report

    def verify(self, path: Path, **options: Unpack[VerifyFileOptions]) -> dict[str, Any]:
        """Prove what the UVs of a file are."""
        return self._done("verify", path, options).report

    def map(
        self,
        paths: Iterable[Path],
        *,
        in_flight: int = 8,
        ordered: bool = True,
        progress: bool = False,
        **options: Unpack[UnwrapBytesOptions],
    ) -> Iterator[Outcome]:
        """Unwrap many files, at most `in_flight` at a time; paths are taken as places get free.

        Each has an `Outcome`, in the order of the paths or, unless ``ordered``, as they end: what one fails with does not stop
        the others. Closing the iterator cancels what is under way. ``progress=True`` shows a bar if ``tqdm`` is there.
        """
        to_json("unwrap", options, of_files=True)
        stop = threading.Event()
        pool = ThreadPoolExecutor(in_flight)

        def work(path: Path) -> Outcome:
            try:
                return Outcome(path, self._done("unwrap", path, options, stop=stop))
            except (Error, OSError) as error:
                return Outcome(path, error=error)

        total = len(paths) if isinstance(paths, collections.abc.Sized) else None
        try:
            with bar(progress, total=total, unit="file") as move:
                started = (pool.submit(work, path) for path in paths)
                for outcome in _ended(started, in_flight, ordered):
                    move(1)
                    yield outcome
        finally:
            stop.set()
            pool.shutdown(wait=True, cancel_futures=True)

    def _done(
        self,
        kind: str,
        path: Path,
        options: Mapping[str, Any],
        progress: Optional[Listener] = None,
        stop: Optional[threading.Event] = None,
    ) -> Job:
        """A job from its submission to its end."""
        body, kind_of_body = form(kind, path, to_json(kind, options, of_files=True))
        # The service answers a repetition of this request with the same job.
        headers = {"Content-Type": kind_of_body, "Idempotency-Key": uuid.uuid4().hex}
        record = self._service.json("POST", "v1/jobs", body=body, headers=headers)
        at = f"v1/jobs/{record['id']}"
        try:
            with told(progress) as tell:
                is_finishing = False
                while record["state"] in ("queued", "running"):
                    if stop is not None and stop.is_set():
                        raise ServiceError("cancelled by the client", "cancelled")
                    if tell(JobProgress.of(record)) is False and not is_finishing:
                        is_finishing = True
                        # It may have ended by itself.
                        with contextlib.suppress(ServiceError):
                            self._service.json("POST", f"{at}/finish")
                    record = self._service.json("GET", f"{at}?wait={_WAIT}")
        except BaseException:
            with contextlib.suppress(Error):
                self._service.content("DELETE", at, patience=0.0)
            raise
        if record["state"] == "failed":
            raise of_problem(record["error"])
        if record["state"] == "cancelled":
            raise ServiceError("somebody cancelled the job", "cancelled")
        return Job(self._service, record)


def _ended(started: Iterator[Future[Outcome]], in_flight: int, ordered: bool) -> Iterator[Outcome]:
    """What is started, as it ends, with a bound on what waits. In order, what ended early waits too."""
    running: Deque[Future[Outcome]] = collections.deque()
    places = 2 * in_flight if ordered else in_flight
    while True:
        running.extend(itertools.islice(started, places - len(running)))
        if not running:
            return
        first = running[0]
        if not ordered:
            first = next(iter(wait(running, return_when=FIRST_COMPLETED).done))
        running.remove(first)
        yield first.result()
