"""Exceptions: each has the stable code that the service and the command line give too."""

from __future__ import annotations

from typing import Any, Optional


class Error(Exception):
    """Why a mesh could not be worked on.

    `code` is a stable name for programs, such as ``"non_finite_position"``, the same as in the problems of the HTTP
    service. `exit_code` is the exit status of the command line. `column` is where a formula cannot be read, from 1.
    """

    code: str
    exit_code: int
    column: Optional[int]

    def __init__(
        self,
        message: str,
        code: str = "internal_error",
        exit_code: int = 1,
        column: Optional[int] = None,
    ) -> None:
        super().__init__(message)
        self.code = code
        self.exit_code = exit_code
        self.column = column

    def __reduce__(self) -> tuple[type[Error], tuple[Any, ...]]:
        return type(self), (str(self), self.code, self.exit_code, self.column)


class InvalidOptions(Error, ValueError):
    """An option is out of its range, of the wrong type, or without effect."""


class InvalidInput(Error, ValueError):
    """The mesh or the file cannot be used."""


class NoValidResult(Error):
    """No valid result was found."""


class ServiceError(Error):
    """A service did not do it, for a reason of its own: it refuses the key, is full, cannot be reached, or the job needs more
    memory than it may have. `status` is that of HTTP, if there was an answer."""

    status: Optional[int]

    def __init__(
        self,
        message: str,
        code: str = "internal_error",
        exit_code: int = 1,
        column: Optional[int] = None,
        status: Optional[int] = None,
    ) -> None:
        super().__init__(message, code, exit_code, column)
        self.status = status

    def __reduce__(self) -> tuple[type[Error], tuple[Any, ...]]:
        return type(self), (str(self), self.code, self.exit_code, self.column, self.status)


def of(code: str, exit_code: int, message: str, column: Optional[int] = None) -> Error:
    """The exception for an error of the library."""
    kind = {2: InvalidOptions, 3: InvalidInput, 4: NoValidResult}.get(exit_code, Error)
    return kind(message, code, exit_code, column)
