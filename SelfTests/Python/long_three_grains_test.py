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


def test_a_bridge_of_three_is_stable_up_to_a_gap():
    """Two modes that break the symmetry are alike, and change their sign between gaps of 0.4 and 0.6. A push of 2 % along one of
    them, and descent: the bridge comes back, or falls by much."""
    module = study()
    push = "set vertex x x + 0.02*y where not on_constraint 1 and not on_constraint 2 and not on_constraint 3"
    for gap, stands in ((0.4, True), (0.6, False)):
        lowest, second, third, _ = module.eigenvalues(gap, 40, 0.6)
        assert lowest == pytest.approx(second, rel=1e-5) and third > 2
        assert (lowest > 0) == stands
        said = module.evolve(gap, 40, 0.6, 3, ["U", *3 * ["hessian_seek"], *3 * ["hessian"], module.SHOW, push, "U", "{g 300}",
                                               module.SHOW])
        before, after = [float(line.split()[2]) for line in said.splitlines() if line.startswith("RESULT")][:2]
        assert abs(after - before) < 1e-5 if stands else after < before - 0.05


def test_frames_and_faces_close():
    """Each edge between free faces is met once in each direction, each edge of a patch once."""
    module = study()
    for net in (module.prism(0.1), module.box(0.1)):
        met = [edge for face in net.faces for edge in face]
        for number, (_, _, grain) in enumerate(net.edges, 1):
            assert (met.count(number), met.count(-number)) == ((1, 0) if grain else (1, 1)), number
