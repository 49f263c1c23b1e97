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


#: What the library expects, in Python's words.
_EXPECTED = {
    "u32": "a whole number from 0 on",
    "u64": "a whole number from 0 on",
    "usize": "a whole number from 0 on",
    "f64": "a number",
    "a boolean": "True or False",
    "a string": "a str",
    "a sequence": "a list",
}


def in_words(message: str) -> str:
    """What the library says of an option that it cannot read, as Python says it: the argument, what is allowed, the value."""
    import re

    wrong = re.fullmatch(
        r"`(\w+)`: invalid (?:type|value): (?:[a-z ]*?)(?:`(.*)`|(\".*\")|(sequence|map|null)), expected (.+?)"
        r"(?: at line \d+ column \d+)?",
        message,
    )
    if wrong:
        name, number, text, kind, expected = wrong.groups()
        given = {"true": "True", "false": "False"}.get(number or "", number) or text
        given = given or {"sequence": "a list", "map": "a dict", "null": "None"}[kind]
        return f"{name} must be {_EXPECTED.get(expected, expected)}, not {given}"
    unknown = re.fullmatch(r"`(\w+)`: unknown variant `(.*)`, expected (?:one of )?(.+)", message)
    if unknown:
        import difflib

        name, given, choices = unknown.groups()
        words = re.findall(r"`([^`]+)`", choices)
        listed = ", ".join(map(repr, words[:-1])) + (" or " if words[1:] else "") + repr(words[-1])
        near = difflib.get_close_matches(given, words, n=1)
        tip = f"; did you mean {near[0]!r}?" if near else ""
        return f"{name} must be {listed}, not {given!r}{tip}"
    return message


def of(code: str, exit_code: int, message: str, column: Optional[int] = None) -> Error:
    """The exception for an error of the library."""
    kind = {2: InvalidOptions, 3: InvalidInput, 4: NoValidResult}.get(exit_code, Error)
    if kind is InvalidOptions:
        message = in_words(message)
    return kind(message, code, exit_code, column)
