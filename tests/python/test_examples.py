"""The examples run."""

import pathlib
import subprocess
import sys

import pytest

EXAMPLES = pathlib.Path(__file__).resolve().parents[2] / "src/python/examples"

#: What each prints.
SAID = {
    "image_to_3d": ["knot.glb: certified"],
    "lightmaps": ["3 objects", "light from 0.15"],
    "own_energy": ["arap: converged", "log(s1)^2 + log(s2)^2: converged", "on arrays: converged", "dragged: settled"],
}


@pytest.mark.parametrize("name", sorted(path.stem for path in EXAMPLES.glob("*.py")))
def test_example(name, tmp_path):
    command = [sys.executable, str(EXAMPLES / f"{name}.py")]
    run = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, timeout=120)
    assert run.returncode == 0, run.stderr
    for text in SAID[name]:
        assert text in run.stdout


def test_examples_are_in_the_readme():
    readme = (EXAMPLES.parent / "README.md").read_text()
    assert all(f"examples/{name}.py" in readme for name in SAID)
