"""Unwraps a folder or a bucket of meshes on Ray, with the Python package in the place of the command.

    pip install unwrapd 'ray[data]'
    python wheel_on_ray.py FOLDER DIR [--option NAME=VALUE]...

FOLDER and DIR are paths, or places such as s3://bucket/folder. For ASSET.obj, DIR gets ASSET.glb and then
its record, records/ASSET.json. Ray runs the tasks of a lost worker again: an asset with a record is not done
again, one without is. DIR/summary.csv names each asset, and the code of each that failed. The exit status is
0 if all are certified, otherwise 4.
"""

import argparse
import csv
import io
import json
import posixpath
import sys
import time
import uuid

import ray.data
from pyarrow import fs

import unwrapd

FIELDS = ("asset", "certified", "code", "message", "charts", "seconds")


class Place:
    """A folder or a bucket."""

    def __init__(self, name: str) -> None:
        self.files, self.root = fs.FileSystem.from_uri(name) if "://" in name else (fs.LocalFileSystem(), name)

    def read(self, name: str) -> bytes | None:
        """A file, if it is there."""
        try:
            with self.files.open_input_stream(posixpath.join(self.root, name)) as file:
                return file.read()
        except FileNotFoundError:
            return None

    def write(self, name: str, content: bytes) -> None:
        """A file is whole or not there: a bucket sees to that, in a folder it is renamed."""
        path = posixpath.join(self.root, name)
        if not isinstance(self.files, fs.LocalFileSystem):
            with self.files.open_output_stream(path) as file:
                file.write(content)
            return
        self.files.create_dir(posixpath.dirname(path))
        partial = posixpath.join(self.root, f".part-{uuid.uuid4().hex}")
        with self.files.open_output_stream(partial) as file:
            file.write(content)
        self.files.move(partial, path)

    def tidy(self) -> None:
        """Removes what killed workers left."""
        found = self.files.get_file_info(fs.FileSelector(self.root, allow_not_found=True))
        for file in found:
            if file.base_name.startswith(".part-"):
                self.files.delete_file(file.path)


def unwrapped(row: dict, place: str, options: dict) -> dict:
    """The record of an asset: the present one, or a new one."""
    there, name = Place(place), posixpath.basename(row["path"])
    asset = posixpath.splitext(name)[0]
    if (record := there.read(f"records/{asset}.json")) is not None:
        return json.loads(record)
    begin = time.monotonic()
    found = dict.fromkeys(FIELDS, "") | {"asset": name, "certified": False}
    try:
        content, report = unwrapd.unwrap_bytes(row["bytes"], name, threads=1, **options)
        there.write(f"{asset}.glb", content)
        charts = sum(group["measures"]["charts"] for group in report["groups"])
        found |= {"certified": report["certified"], "charts": str(charts)}
    except unwrapd.Error as error:
        found |= {"code": error.code, "message": str(error)}
    found["seconds"] = f"{time.monotonic() - begin:.3f}"
    there.write(f"records/{asset}.json", json.dumps(found).encode())
    return found


def given_option(text: str) -> tuple[str, object]:
    name, _, value = text.partition("=")
    try:
        return name, json.loads(value)
    except json.JSONDecodeError:
        return name, value


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("folder")
    parser.add_argument("dir")
    parser.add_argument("--option", type=given_option, action="append", default=[])
    parser.add_argument("--tasks", type=int, default=50, help="of which each does its share of the files")
    given = parser.parse_args()
    ray.init(include_dashboard=False, log_to_driver=False)
    ray.data.DataContext.get_current().enable_progress_bars = False
    files = ray.data.read_binary_files(given.folder, include_paths=True, override_num_blocks=given.tasks)
    rows = files.map(unwrapped, fn_kwargs={"place": given.dir, "options": dict(given.option)}, num_cpus=1).take_all()
    ray.shutdown()

    table = io.StringIO()
    writer = csv.DictWriter(table, FIELDS, lineterminator="\n")
    writer.writeheader()
    rows.sort(key=lambda row: row["asset"])
    writer.writerows({**row, "certified": str(row["certified"]).lower()} for row in rows)
    place = Place(given.dir)
    place.write("summary.csv", table.getvalue().encode())
    place.tidy()
    for row in rows:
        if row["code"]:
            print(f"{row['asset']}: {row['code']}: {row['message']}")
    n_certified = sum(row["certified"] for row in rows)
    print(f"{n_certified} of {len(rows)} certified")
    return 0 if n_certified == len(rows) else 4


if __name__ == "__main__":
    sys.exit(main())
