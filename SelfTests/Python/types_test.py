"""mypy finds the types of the module, and no fault in the package and the examples that use it."""
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

import pendular

pytest.importorskip("mypy")
ROOT = Path(__file__).parents[2]
USE = '''
import numpy
import pendular
scene = pendular.Scene("run", threads=2)
glass: pendular.Species = scene.add_species("LinearViscoelastic", density=2500)
wall: pendular.Wall = scene.add_plane(glass, (0, 0, -1), [0, 0, 0], forces=True)
force: numpy.ndarray = wall.force
scene.velocity = [[1, 2, 3]]
scene.temperature = 300
warm: numpy.ndarray = scene.temperature
scene.add_fluid((0, 0, 0), (1, 1, 1), (1, 1, 5), density=1000, viscosity=1e-3)
step: float = scene.choose_time_step()
scene.run(0.1, progress=True).run(steps=3)
'''
WRONG = '''
import pendular
pendular.Scene(thread=2)
pendular.Scene().add_plane("glass", (0, 0, -1), (0, 0, 0))
pendular.Scene().time.real_time
'''


def mypy(*files):
    done = subprocess.run([sys.executable, "-m", "mypy", "--ignore-missing-imports", "--follow-imports=silent",
                           "--cache-dir", os.environ.get("PENDULAR_MYPY_CACHE", ".mypy_cache"), *map(str, files)],
                          capture_output=True, text=True, env={**os.environ, "MYPYPATH": str(Path(pendular.__file__).parents[1])})
    return done.stdout + done.stderr


def test_types(tmp_path):
    (tmp_path / "use.py").write_text(USE)
    examples = sorted((ROOT / "Tools/Python/Examples").glob("*.py"))
    package = Path(pendular.__file__).parent
    said = mypy(tmp_path / "use.py", *examples, *package.glob("*.py"), *package.glob("*.pyi"))
    assert "Success" in said, said
    (tmp_path / "wrong.py").write_text(WRONG)
    said = mypy(tmp_path / "wrong.py")
    assert "Found 3 errors" in said, said


def test_snippets(tmp_path):
    """All of the page; mypy takes the values of a dict that is unpacked for all arguments alike."""
    page = (ROOT / "Tools/Python/HOW-DO-I.md").read_text()
    first, *others = re.findall(r"```python\n(.*?)```", page, flags=re.S)
    for number, code in enumerate(others):
        (tmp_path / f"snippet{number}.py").write_text(first + code)
    said = mypy("--scripts-are-modules", *sorted(tmp_path.glob("snippet*.py")))
    assert len(others) > 60
    assert not [line for line in said.splitlines() if "error:" in line and 'type "**dict' not in line.lower()], said
