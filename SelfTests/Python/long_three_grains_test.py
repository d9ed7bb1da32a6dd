"""The study ThreeGrains, against the exact bridge of two grains and an independent run of three; where Surface Evolver is."""
import importlib.util
import shutil
from pathlib import Path

import numpy as np
import pytest

pytestmark = pytest.mark.skipif(not shutil.which("evolver"), reason="evolver-nox is not installed")
PATH = Path(__file__).parents[2] / "Tools/Studies/ThreeGrains/three-grains.py"


def study():
    spec = importlib.util.spec_from_file_location("three_grains", PATH)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_bridge_between_two_is_the_exact_one():
    """V = 0.133 of a sphere, a gap of 0.625, 48 degrees: the exact solver has E = 1.601809 and p = 1.63149."""
    (_, coarse, _, _), (_, energy, pressure, volume) = study().relax(0.625, 48, 0.133 * 4 * np.pi / 3, 1, grains=2)
    assert energy == pytest.approx(1.601809, abs=1e-5) and coarse == pytest.approx(energy, abs=1e-4)
    assert pressure == pytest.approx(1.63149, abs=1e-4)
    assert volume == pytest.approx(0.133 * 4 * np.pi / 3, rel=1e-9)


def test_frames_and_faces_close():
    """Each edge between free faces is met once in each direction, each edge of a patch once."""
    module = study()
    for net in (module.prism(0.1), module.box(0.1)):
        met = [edge for face in net.faces for edge in face]
        for number, (_, _, grain) in enumerate(net.edges, 1):
            assert (met.count(number), met.count(-number)) == ((1, 0) if grain else (1, 1)), number
