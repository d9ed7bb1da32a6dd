"""What a scene warns of is a warning of Python, by default and once; a scene that is right has none."""
import subprocess
import sys
import warnings

import numpy as np
import pytest

import pendular
from conftest import GLASS, glass_in, tower

WET = dict(GLASS, liquid_bridge_volume=1e-11, contact_angle=0, surface_tension=0.072)
LAWS = "HertzianViscoelasticMindlinLiquidBridgeBagheri"


def pair(species="HertzianViscoelasticMindlin", values=GLASS, gap=2e-3, speed=0.0, **options):
    """Two grains of 1 mm that fly towards each other."""
    scene = pendular.Scene(**options)
    scene.glass = scene.add_species(species, **values)
    scene.add_grains(scene.glass, [[0, 0, 0], [2e-3 + gap, 0, 0]], 1e-3, velocity=[[speed, 0, 0], [-speed, 0, 0]])
    scene.time_step = 0.1 * scene.stability_limit()
    return scene


def told(scene, steps=1):
    with warnings.catch_warnings(record=True) as found:
        warnings.simplefilter("always")
        scene.run(steps=steps)
    return [str(one.message) for one in found if one.category is pendular.SceneWarning]


def test_a_scene_that_is_right_has_none(capfd):
    assert not told(tower(), 20) and not told(pair(LAWS, WET))
    assert not "".join(capfd.readouterr()), "no progress and no summary without being asked"


@pytest.mark.parametrize("values, words", [
    (dict(GLASS, density=2.5), ["density = 2.5 kg/m^3", "1 g/cm^3 is 1000 kg/m^3"]),
    (dict(GLASS, young_modulus=70), ["effective_elastic_modulus = ", "1 GPa is 1e9 Pa"]),
    (dict(WET, surface_tension=72), ["surface_tension = 72 N/m", "1 mN/m is 0.001 N/m"]),
    (dict(WET, liquid_bridge_volume=15e-9), ["liquid_bridge_volume = 1.5e-08 m^3", "V* = V/R^3 = 15 "])])
def test_likely_slips(values, words):
    found = told(pair(LAWS if "surface_tension" in values else "HertzianViscoelasticMindlin", values))
    assert len(found) == 1, found
    for word in words:
        assert word in found[0]


def test_a_mesh_in_millimetres():
    """Its grains are in a small part of it. With the scale that it needs there is nothing to say."""
    corner = np.array([[[-50, -50, -9], [50, -50, -9], [50, 50, -9]]])  # mm
    for scale, count in ((1, 1), (1e-3, 0)):
        scene = pair()
        scene.add_mesh(scene.glass, scale * corner)
        found = told(scene)
        assert len(found) == count and (not found or "is 100 m long" in found[0] and "scale of 0.001" in found[0])


def test_deep_overlaps_once():
    """Hertz's theory is for overlaps up to 0.1 of R*; by energy, these are 0.3 of it."""
    scene = pair(values=dict(GLASS, restitution_coefficient=1), gap=1e-5)
    # E* = 5e6 / (2 (1 - 0.25^2)) Pa; m* v^2 / 2 = 8/15 E* sqrt(R*) d^(5/2), with v of both grains
    modulus, mass, radius = 5e6 / 1.875, 2500 * 2 / 3 * np.pi * 1e-9, 0.5e-3
    speed = np.sqrt(16 / 15 * modulus * np.sqrt(radius) * (0.3 * radius)**2.5 / mass)
    scene.velocity = [[speed / 2, 0, 0], [-speed / 2, 0, 0]]
    found = [told(scene, 500) for _ in range(4)]
    assert sum(map(len, found)) == 1 and "overlaps were above 0.1 of the effective radius" in sum(found, [])[0]


def test_where_the_script_called():
    with pytest.warns(pendular.SceneWarning) as found:
        pair(values=dict(GLASS, density=2.5)).run(steps=1)
    assert found[0].filename == __file__


def test_a_quiet_scene_has_none():
    assert not told(pair(values=dict(GLASS, density=2.5), quiet=True))


def test_a_filter_makes_them_errors():
    """run() raises, and the scene can go on."""
    scene = pair(values=dict(GLASS, density=2.5))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        with pytest.raises(pendular.SceneWarning, match="2.5 kg"):
            scene.run(steps=3)
    steps = scene.steps
    scene.run(steps=2)
    assert scene.steps == steps + 2


def test_an_unwanted_one_is_left_out_by_its_text():
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        warnings.filterwarnings("ignore", "species 0: density", pendular.SceneWarning)
        pair(values=dict(GLASS, density=2.5)).run(steps=1)


def test_files_of_another_script(tmp_path):
    code = ("import pendular\nscene = pendular.Scene('run')\n"
            "g = scene.add_species('LinearViscoelastic', density=2500, stiffness=300, dissipation=1e-3)\n"
            "scene.add_grains(g, [[0, 0, 0]], 1e-3)\nscene.time_step = 1e-5\nscene.keep_restart_file()\n"
            "scene.run(steps=2)\nscene.finish()\n")
    said = []
    for name in ("drum.py", "drum.py", "hopper.py"):
        (tmp_path / name).write_text(code)
        done = subprocess.run([sys.executable, name], capture_output=True, text=True, timeout=60)
        assert done.returncode == 0, done.stderr
        said.append(done.stderr)
    assert not said[0] and not said[1]
    assert "of another program, drum.py, and hopper.py" in said[2]
    assert (tmp_path / "run-restart-of-drum.py.h5").exists()


def test_each_run_says_how_it_ended():
    """Without write_summary(), too."""
    def state():
        return dict(line.split(",")[:2] for line in open("run-summary.csv"))["state"]

    scene = tower("run", quiet=True)
    scene.write_energy(1e-3)
    scene.run(0.002)
    assert state() == "on its way"
    scene.finish()
    assert state() == "at its end"
    scene = tower("run", quiet=True)
    scene.write_energy(1e-3)
    scene.every_steps(3, lambda _: 1 / 0)
    with pytest.raises(ZeroDivisionError):
        scene.run(0.002)
    assert state() == "stopped by an error"


def test_the_default_is_not_quiet():
    assert pendular.Scene().quiet is False and "quiet=False" in pendular.Scene.__doc__
    assert glass_in(pendular.Scene()).index == 0
