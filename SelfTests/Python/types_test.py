"""mypy finds the types of the module, and no fault in the package and the examples that use it."""
import os
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
    said = mypy(tmp_path / "use.py", *examples, *package.glob("*.py"))
    assert "Success" in said, said
    (tmp_path / "wrong.py").write_text(WRONG)
    said = mypy(tmp_path / "wrong.py")
    assert "Found 3 errors" in said, said
