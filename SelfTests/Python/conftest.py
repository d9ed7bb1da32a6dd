"""What the tests of the Python module share. CTest sets PYTHONPATH to the module of the build."""
import numpy as np
import pytest

import pendular

GLASS = dict(density=2500, young_modulus=5e6, poisson_ratio=0.25, restitution_coefficient=0.5,
             sliding_friction_coefficient=0.4)


@pytest.fixture(autouse=True)
def own_folder(tmp_path, monkeypatch):
    """Files of a test are in a folder of its own."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("MPLBACKEND", "Agg")


def glass_in(scene):
    return scene.add_species("HertzianViscoelasticMindlin", **GLASS)


def tower(name="", count=4, **options):
    """Grains that fall on a floor one above the other, a little aside."""
    scene = pendular.Scene(name, **options)
    glass = glass_in(scene)
    scene.add_plane(glass, (0, 0, -1), (0, 0, 0))
    k = np.arange(count)
    scene.add_grains(glass, np.stack([1e-4 * (k % 3), 0 * k, 1.2e-3 + 2.1e-3 * k], 1), 1e-3)
    scene.gravity = (0, 0, -9.81)
    scene.choose_time_step()
    scene.glass = glass
    return scene
