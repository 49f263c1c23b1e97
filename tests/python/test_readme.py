"""The lines of the README run, and names are where it says."""

import inspect
import pathlib
import re

import numpy
import pytest
import unwrapd

README = pathlib.Path(__file__).resolve().parents[2] / "src/python/README.md"


def test_the_readme_runs(monkeypatch):
    pytest.importorskip("trimesh")
    names = {}
    blocks = re.findall(r"```python\n(.*?)```", README.read_text(), re.DOTALL)
    monkeypatch.setitem(__import__("sys").modules, "xatlas", None)
    for block in blocks:
        exec(compile(block, str(README), "exec"), names)
    assert sum(len(block.splitlines()) for block in blocks) >= 10
    assert (names["vertices"][names["vmapping"]][names["indices"]] == names["vertices"][names["faces"]]).all()


def test_docstrings_are_true():
    import doctest

    assert doctest.testmod(unwrapd).failed == 0


@pytest.mark.parametrize("name", unwrapd.__all__)
def test_everything_is_documented(name):
    assert inspect.getdoc(getattr(unwrapd, name))


def test_version():
    manifest = (README.parents[2] / "Cargo.toml").read_text()
    assert unwrapd.__version__ == re.search(r'\nversion = "(.*?)"', manifest).group(1)


def test_stubs_name_what_there_is():
    stubs = (README.parent / "unwrapd/_native.pyi").read_text()
    named = set(re.findall(r"^(?:def|class) (\w+)", stubs, re.MULTILINE)) - {"File"}
    assert named == {name for name in dir(unwrapd._native) if not name.startswith("_")}
    fields = set(re.findall(r"@property\n    def (\w+)", stubs))
    assert fields == {name for name in dir(unwrapd.Progress) if not name.startswith("_")}
    assert numpy.__version__
