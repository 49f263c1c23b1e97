"""Writes THIRD-PARTY-NOTICES.md: the crates in a native module, their licenses and the texts of those, equal ones once.

    python3 notices.py [CRATE FOLDER]
"""

import json
import pathlib
import subprocess
import sys

HERE = pathlib.Path(__file__).parent
HEAD = """# Third-party notices

The native module of `unwrapd` contains the crates listed here. Each is used under the terms that it names; the texts
that come with them follow.
"""


def packages(crate: str) -> list[dict]:
    """The crates that are linked into one, as cargo resolves them."""
    command = [
        "cargo",
        "metadata",
        "--format-version",
        "1",
        "--filter-platform",
        "x86_64-unknown-linux-gnu",
        "--locked",
    ]
    metadata = json.loads(subprocess.check_output(command, cwd=HERE))
    tree = [
        "cargo",
        "tree",
        "-p",
        crate,
        "-e",
        "normal",
        "--prefix",
        "none",
        "--format",
        "{p}",
        "--locked",
    ]
    lines = subprocess.check_output(tree, cwd=HERE, text=True).splitlines()
    linked = {tuple(line.split()[:2]) for line in lines if line}
    found = [
        package
        for package in metadata["packages"]
        if (package["name"], f"v{package['version']}") in linked
    ]
    return [package for package in found if package["source"] is not None]


def texts(package: dict) -> list[str]:
    """The license texts in a crate's folder."""
    folder = pathlib.Path(package["manifest_path"]).parent
    names = ("license", "licence", "copying", "notice", "unlicense", "copyright")
    files = [
        path for path in folder.iterdir() if path.is_file() and path.name.lower().startswith(names)
    ]
    return [path.read_text(errors="replace").strip() for path in sorted(files)]


def main(crate: str = "unwrapd-python", folder: str = str(HERE)) -> None:
    parts, owners = [HEAD], {}
    for package in sorted(packages(crate), key=lambda package: package["name"]):
        link = package["repository"] or ""
        parts.append(
            f"- {package['name']} {package['version']}: {package['license']} {link}".rstrip()
        )
        for text in texts(package):
            owners.setdefault(text, []).append(package["name"])
    for text, names in owners.items():
        parts.append(f"\n## {', '.join(names)}\n\n```text\n{text}\n```")
    (pathlib.Path(folder) / "THIRD-PARTY-NOTICES.md").write_text("\n".join(parts) + "\n")


if __name__ == "__main__":
    main(*sys.argv[1:])
