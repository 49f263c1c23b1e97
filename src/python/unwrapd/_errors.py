"""Exceptions: each has the stable code that the service and the command line give too."""

from __future__ import annotations


class Error(Exception):
    """Why a mesh could not be worked on.

    `code` is a stable name for programs, such as ``"non_finite_position"``, the same as in the problems of the HTTP
    service. `exit_code` is the exit status of the command line.
    """

    code: str
    exit_code: int

    def __init__(self, message: str, code: str = "internal_error", exit_code: int = 1) -> None:
        super().__init__(message)
        self.code = code
        self.exit_code = exit_code

    def __reduce__(self) -> tuple[type[Error], tuple[str, str, int]]:
        return type(self), (str(self), self.code, self.exit_code)


class InvalidOptions(Error, ValueError):
    """An option is out of its range, of the wrong type, or without effect."""


class InvalidInput(Error, ValueError):
    """The mesh or the file cannot be used."""


class NoValidResult(Error):
    """No valid result was found."""


def of(code: str, exit_code: int, message: str) -> Error:
    """The exception for an error of the library."""
    kind = {2: InvalidOptions, 3: InvalidInput, 4: NoValidResult}.get(exit_code, Error)
    return kind(message, code, exit_code)
