"""The lines of the README run, and names are where it says."""

import ast
import inspect
import pathlib
import re
import subprocess
import sys

import pytest
import unwrapd
from service import Service, obj
from unwrapd._options import names

README = pathlib.Path(__file__).resolve().parents[2] / "src/python/README.md"


def test_the_readme_runs(monkeypatch, tmp_path, pyramid):
    pytest.importorskip("trimesh")
    monkeypatch.chdir(tmp_path)
    for name in ("chair", "table"):
        (tmp_path / f"{name}.obj").write_text(obj(*pyramid))
        unwrapd.unwrap_file(f"{name}.obj", f"{name}.glb")
    with Service(tmp_path / "data") as service:
        check_blocks(monkeypatch, README.read_text().replace("http://127.0.0.1:8080", service.url))
    assert unwrapd.verify_file("out/chair.glb", padding=8)["certified"]


def check_blocks(monkeypatch, text):
    scope = {}
    blocks = re.findall(r"```python\n(.*?)```", text, re.DOTALL)
    monkeypatch.setitem(__import__("sys").modules, "xatlas", None)
    for block in blocks:
        exec(compile(block, str(README), "exec"), scope)
    assert sum(len(block.splitlines()) for block in blocks) >= 10
    vertices = scope["vertices"]
    assert (vertices[scope["vmapping"]][scope["indices"]] == vertices[scope["faces"]]).all()


def test_docstrings_are_true():
    import doctest

    assert doctest.testmod(unwrapd).failed == 0


@pytest.mark.parametrize("name", unwrapd.__all__)
def test_everything_is_documented(name):
    assert inspect.getdoc(getattr(unwrapd, name))


def test_names_come_when_they_are_used():
    assert set(unwrapd.__all__) == {"options"}.union(*unwrapd._MODULES.values())
    assert set(unwrapd.__all__) <= set(dir(unwrapd))
    check = "import sys, unwrapd; sys.exit('numpy' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", check]).returncode == 0
    with pytest.raises(AttributeError, match="unwarp"):
        unwrapd.unwarp


def test_version():
    manifest = (README.parents[2] / "Cargo.toml").read_text()
    assert unwrapd.__version__ == re.search(r'\nversion = "(.*?)"', manifest).group(1)


def test_stubs_name_what_there_is():
    stubs = (README.parent / "unwrapd/_native.pyi").read_text()
    named = set(re.findall(r"^(?:def|class) (\w+)", stubs, re.MULTILINE)) - {"File"}
    assert named == {name for name in dir(unwrapd._native) if not name.startswith("_")}
    for kind in (unwrapd.Progress, unwrapd.Iterate, unwrapd._native.Problem, unwrapd._native.Session):
        stub = re.search(rf"^class {kind.__name__}:\n((?:    .*\n|\n)*)", stubs, re.MULTILINE).group(1)
        members = set(re.findall(r"^    (?:def )?(\w+)(?:\(|:)", stub, re.MULTILINE))
        assert {name for name in members if not name.startswith("_")} == {
            name for name in dir(kind) if not name.startswith("_")
        }


@pytest.mark.parametrize("function", ["unwrap", "repack", "measure", "verify", "Problem", "solve"])
def test_types_of_options_name_what_there_is(function):
    classes = {}
    for node in ast.parse((README.parent / "unwrapd/_option_types.pyi").read_text()).body:
        if isinstance(node, ast.ClassDef):
            own = {field.target.id for field in node.body if isinstance(field, ast.AnnAssign)}
            bases = [base.id for base in node.bases if base.id != "TypedDict"]
            classes[node.name] = own.union(*(classes[base] for base in bases))
    name = function.capitalize()
    assert classes[f"{name}Options"] == set(names(function, of_files=False))
    if f"{name}FileOptions" in classes:
        assert classes[f"{name}FileOptions"] | {"format"} == set(names(function)) | {"format"}
