"""Requests to a service, repeated as long as that may help."""

from __future__ import annotations

import http.client
import json
import time
import urllib.error
import urllib.request
from typing import Any, Mapping, Optional
from urllib.parse import urlsplit

from ._errors import Error, InvalidInput, InvalidOptions, NoValidResult, ServiceError

#: Answers after which the same request may be answered otherwise.
_PASSING = frozenset((408, 429, 502, 503, 504, 507))
#: Seconds between the first two tries; then twice as long each time, up to the second number.
_PAUSES = (0.25, 30.0)
#: Seconds without a byte after which a request is tried again. The service holds no answer back for longer than a minute.
_SILENCE = 120.0


class Service:
    """A service, by its address."""

    def __init__(self, url: str, key: Optional[str], patience: float) -> None:
        address = urlsplit(url)
        if address.scheme not in ("http", "https") or not address.hostname:
            raise InvalidOptions(f"{url!r} is not the address of a service", "invalid_options", 2)
        self._root = url.rstrip("/")
        self._headers = {} if key is None else {"Authorization": f"Bearer {key}"}
        self._patience = patience

    def json(self, method: str, path: str, **more: Any) -> dict[str, Any]:
        """An answer in JSON."""
        found: dict[str, Any] = json.loads(self.content(method, path, **more))
        return found

    def content(
        self,
        method: str,
        path: str,
        body: Optional[bytes] = None,
        headers: Optional[Mapping[str, str]] = None,
        patience: Optional[float] = None,
    ) -> bytes:
        """The content of an answer to a request that may be repeated. What is refused for good is an exception, and so is what
        is not answered for `patience` seconds."""
        patience = self._patience if patience is None else patience
        begin, pause = time.monotonic(), _PAUSES[0]
        while True:
            wait: Optional[float] = None
            try:
                return self._once(method, path, body, headers or {})
            except urllib.error.HTTPError as answer:
                problem = _problem(answer)
                if answer.code not in _PASSING:
                    raise of_problem(problem) from None
                wait, cause = _retry_after(answer), of_problem(problem)
            except (OSError, http.client.HTTPException) as error:
                reason = getattr(error, "reason", None) or error
                text = f"no answer from {self._root}: {reason or type(error).__name__}"
                cause = ServiceError(text, "server_unavailable")
            wait = pause if wait is None else wait
            if time.monotonic() - begin + wait > patience:
                raise cause
            time.sleep(wait)
            pause = min(2 * pause, _PAUSES[1])

    def _once(
        self, method: str, path: str, body: Optional[bytes], headers: Mapping[str, str]
    ) -> bytes:
        request = urllib.request.Request(
            f"{self._root}/{path}", data=body, headers={**self._headers, **headers}, method=method
        )
        with urllib.request.urlopen(request, timeout=_SILENCE) as answer:
            content: bytes = answer.read()
            return content


def of_problem(problem: Mapping[str, Any]) -> Error:
    """The exception for a problem (RFC 9457) of an answer or of a job, of the class that the same problem has in this process."""
    code, status = str(problem["code"]), problem.get("status")
    text, column = str(problem.get("detail", code)), problem.get("column")
    if code == "no_valid_result":
        return NoValidResult(text, code, 4)
    if status == 400:
        return InvalidOptions(text, code, 2, column)
    if status in (413, 415, 422) and code != "out_of_memory":
        return InvalidInput(text, code, 3, column)
    return ServiceError(text, code, 1, None, status)


def _problem(answer: urllib.error.HTTPError) -> dict[str, Any]:
    with answer:
        try:
            problem: dict[str, Any] = json.load(answer)
            return {"status": answer.code, **problem, "code": problem["code"]}
        except (OSError, ValueError, TypeError, KeyError, http.client.HTTPException):
            detail = f"the server answers {answer.code}"
            return {"code": "server_unavailable", "status": answer.code, "detail": detail}


def _retry_after(answer: urllib.error.HTTPError) -> Optional[float]:
    text = answer.headers.get("Retry-After", "").strip()
    return float(text) if text.isdigit() else None
