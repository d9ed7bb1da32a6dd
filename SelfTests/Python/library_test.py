"""A library of species that is loaded at run time: laws that the module does not have."""
import os
import subprocess
import sys

import pytest

LIBRARY = os.environ.get("PENDULAR_SPECIES_LIBRARY")
# In a process of its own: a library stays. F = c d^2 is conservative: two grains part with the speed with which they met.
CODE = f"""
import numpy as np
import pendular
pendular.load_species({LIBRARY!r})
assert {{"QuadraticSpring", "QuadraticSpringMindlin"}} <= set(pendular.species())
scene = pendular.Scene()
own = scene.add_species("QuadraticSpring", density=2500, force=1e-2, overlap=1e-5)
assert abs(own.get("coefficient") - 1e8) < 1
scene.add_grains(own, [[0, 0, 0], [2.001e-3, 0, 0]], 1e-3, velocity=[[0.05, 0, 0], [-0.05, 0, 0]])
scene.time_step = 0.05 * scene.stability_limit()
deepest = []
scene.every_steps(1, lambda s: deepest.append(s.contacts()["overlap_m"].max(initial=0)))
scene.run(2e-3)
# m* v^2 / 2 = c d^3 / 3, with m* of the pair and the relative speed v
mass = scene.mass[0] / 2
assert abs(max(deepest) / (1.5 * mass * 0.1**2 / 1e8) ** (1 / 3) - 1) < 1e-3, max(deepest)
assert np.allclose(scene.velocity[:, 0], [-0.05, 0.05], rtol=1e-4), scene.velocity
try:
    pendular.load_species({LIBRARY!r})
except pendular.InputError as error:
    print(error)
"""


@pytest.mark.skipif(not LIBRARY, reason="PENDULAR_SPECIES_LIBRARY is no library")
def test_library_of_species():
    done = subprocess.run([sys.executable, "-c", CODE], capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stderr
    assert "was loaded before" in done.stdout
