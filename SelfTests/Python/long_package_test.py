"""The wheel is made, installed into a virtual environment without a network, and used there."""
import os
import subprocess
import sys
from pathlib import Path

import pytest

import pendular
from conftest import tower

pytest.importorskip("pip")
pytest.importorskip("wheel")
PYTHON = Path(__file__).parents[2] / "Tools/Python"
USE = """
import pendular
scene = pendular.Scene()
glass = scene.add_species("HertzianViscoelasticMindlin", density=2500, young_modulus=5e6, poisson_ratio=0.25,
                          restitution_coefficient=0.5, sliding_friction_coefficient=0.4)
scene.add_plane(glass, (0, 0, -1), (0, 0, 0))
scene.add_grains(glass, [[1e-4 * (k % 3), 0, 1.2e-3 + 2.1e-3 * k] for k in range(4)], 1e-3)
scene.gravity = (0, 0, -9.81)
scene.choose_time_step()
scene.run(0.02)
print(pendular.__file__, scene.hash())
"""


def test_wheel_in_a_virtual_environment(tmp_path):
    """Of the build that is tested. It has the same bits, and the types."""
    environment = {**os.environ, "PENDULAR_BUILD": str(Path(pendular.__file__).parents[2]), "PIP_NO_INDEX": "1"}
    del environment["PYTHONPATH"]

    def run(*words):
        done = subprocess.run([*map(str, words)], cwd=tmp_path, env=environment, capture_output=True, text=True, timeout=900)
        assert done.returncode == 0, done.stdout + done.stderr
        return done.stdout

    run(sys.executable, "-m", "pip", "wheel", "--no-build-isolation", "--no-deps", "--wheel-dir", tmp_path, PYTHON)
    wheel, = tmp_path.glob("pendular-*.whl")
    run(sys.executable, "-m", "venv", "--system-site-packages", tmp_path / "venv")  # numpy is that of the system
    python = tmp_path / "venv/bin/python"
    run(python, "-m", "pip", "install", "--no-deps", wheel)
    file, bits = run(python, "-c", USE).split()
    assert str(tmp_path / "venv") in file
    assert (Path(file).parent / "_kernel.pyi").exists() and (Path(file).parent / "py.typed").exists()
    here = tower()
    here.run(0.02)
    assert bits == here.hash()
