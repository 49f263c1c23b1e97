"""A job of a service that has ended well."""

from __future__ import annotations

import json
import os
from functools import cached_property
from pathlib import PurePosixPath
from typing import Any, Union
from urllib.parse import quote

from ._errors import InvalidOptions, ServiceError
from ._files import write
from ._service import Service

Path = Union[str, "os.PathLike[str]"]


class Job:
    """What a service made of a file. Its files stay there until they expire, or `remove` is called."""

    def __init__(self, service: Service, record: dict[str, Any]) -> None:
        self._service = service
        #: The job as the service tells it.
        self.record = record

    def __repr__(self) -> str:
        return f"Job({self.id}, {self.record['kind']} of {self.record['filename']})"

    @property
    def id(self) -> str:
        """Its name at the service."""
        return str(self.record["id"])

    @property
    def certified(self) -> bool:
        """Whether all that was asked for is proven of the bytes of the result."""
        return bool(self.record.get("certified"))

    @property
    def warnings(self) -> list[dict[str, Any]]:
        """What is missing or was changed, each with a ``code`` and a ``detail``."""
        return list(self.record["warnings"])

    @cached_property
    def report(self) -> dict[str, Any]:
        """The report, which is that of `unwrap_file`."""
        found: dict[str, Any] = json.loads(self._file("report"))
        return found

    def read(self) -> bytes:
        """The bytes of the main file of the result."""
        return self._file("result")

    def save(self, output: Path) -> Job:
        """Write the result, with the files beside it that its format needs, and return the job.

        The name must end as the format does, which is glb unless ``format=`` said another.
        """
        folder, name = os.path.split(os.fspath(output))
        names = self._names()
        made = os.path.splitext(names["result"])[1]
        if os.path.splitext(name)[1].lower() != made:
            text = f"{name}: the result is {made}; ask for another with `format`"
            raise InvalidOptions(text, "invalid_options", 2)
        for role in names:
            if role.startswith("files/"):
                write(os.path.join(folder, *_inside(names[role])), self._file(role))
        write(os.fspath(output), self.read())
        return self

    def remove(self) -> None:
        """Remove the job and its files from the service."""
        self._service.content("DELETE", f"v1/jobs/{self.id}")

    def _names(self) -> dict[str, str]:
        """The names of its files by the ends of their paths."""
        links = self.record["links"]
        own = f"{links['self']}/"
        files = [file for file in links["files"] if file["href"].startswith(own)]
        return {file["href"][len(own) :]: file["name"] for file in files}

    def _file(self, role: str) -> bytes:
        return self._service.content("GET", f"v1/jobs/{self.id}/{quote(role, safe='/%')}")


def _inside(name: str) -> tuple[str, ...]:
    """The parts of a relative path that stays in its folder."""
    parts = PurePosixPath(name).parts
    if not parts or ".." in parts or name.startswith("/") or "\\" in name:
        raise ServiceError(f"the service names a file {name!r}, which is not beside the result")
    return parts
