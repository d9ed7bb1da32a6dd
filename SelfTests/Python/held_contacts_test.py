"""Contacts between held grains, and what changes in a run give to contacts, against closed forms."""
import numpy as np
import pytest

import pendular
from conftest import glass_in

RADIUS, DEEP, STIFFNESS = 1e-3, 1e-5, 500  # m, m, N/m
FORCE, ENERGY = STIFFNESS * DEEP, STIFFNESS * DEEP**2 / 2


def linear(**options):
    scene = pendular.Scene()
    scene.glass = scene.add_species("LinearViscoelastic", density=2500, stiffness=STIFFNESS)
    scene.time_step = 2e-6
    scene.keep_energy_ledger()
    return scene


def held_pair():
    scene = linear()
    scene.add_grains(scene.glass, [[0, 0, 0], [2 * RADIUS - DEEP, 0, 0]], RADIUS, fixed=True)
    return scene


def test_held_grains_have_a_force_where_it_is_asked_for():
    scene = held_pair()
    scene.set_held_contacts("all")
    scene.run(steps=2)
    assert scene.contact_force[:, 0] == pytest.approx([-FORCE, FORCE], rel=1e-9)
    assert scene.force[:, 0] == pytest.approx([-FORCE, FORCE], rel=1e-9)
    assert scene.contacts()["normal_force_N"] == pytest.approx([FORCE], rel=1e-9)


def test_a_warning_tells_of_contacts_that_are_not_listed():
    scene = held_pair()
    scene.run(steps=2)
    with pytest.warns(pendular.SceneWarning, match=r"particle 0 and particle 1 overlap and are held.*set_held_contacts\('all'\)"):
        assert not scene.contact_force.any()


def test_another_setting_is_refused():
    with pytest.raises((ValueError, pendular.InputError), match="where_asked"):
        held_pair().set_held_contacts("some")


@pytest.mark.parametrize("fixed", [False, True])
def test_heat_flows_between_held_grains(fixed):
    """4 a k1 k2 / (k1 + k2) = 2 k a, with a = sqrt(R* d), from a wall to a bed and in it."""
    scene = pendular.Scene()
    still = scene.add_species("LinearViscoelastic", density=2500, stiffness=1e-30)
    scene.add_grains(still, [[0, 0, 0], [2 * RADIUS - DEEP, 0, 0]], RADIUS, fixed=fixed)
    scene.conduct_heat(300)
    scene.set_heat_material(still, conductivity=1, heat_capacity=800)
    scene.temperature = [300, 310]
    scene.time_step = 1e-3
    scene.run(steps=1)
    mass = 2500 * 4 / 3 * np.pi * RADIUS**3
    power = 2 * np.sqrt(RADIUS / 2 * DEEP) * 10
    assert (scene.temperature[0] - 300) * mass * 800 / 1e-3 == pytest.approx(power, rel=1e-8)


def booked(scene, change, given):
    """What a change gives is the driver's, and no error of the step."""
    before = scene.energy()
    change()
    scene.run(steps=1)
    after = scene.energy()
    assert after["given_by_driver_J"] - before["given_by_driver_J"] == pytest.approx(given, rel=1e-9)
    assert abs(after["step_error_J"] - before["step_error_J"]) < 1e-3 * abs(given)


def test_what_a_plane_gives_that_is_added():
    scene = linear()
    scene.add_grains(scene.glass, [[0, 0, 0]], RADIUS)
    scene.run(steps=3)
    booked(scene, lambda: scene.add_plane(scene.glass, (0, 0, -1), (0, 0, -RADIUS + DEEP)), ENERGY)
    # Without the touch "beginning" in the step, the force is that of the overlap.
    contact = scene.contacts()
    assert contact["normal_force_N"] == pytest.approx(STIFFNESS * contact["overlap_m"], rel=1e-9)


def test_what_a_grain_gives_that_is_added():
    scene = linear()
    scene.add_grains(scene.glass, [[0, 0, 0]], RADIUS)
    scene.run(steps=3)
    booked(scene, lambda: scene.add_grains(scene.glass, [[0, 0, 2 * RADIUS - DEEP]], RADIUS), ENERGY)


def test_what_a_stiffness_gives():
    scene = linear()
    scene.add_grains(scene.glass, [[0, 0, 0], [2 * RADIUS - DEEP, 0, 0]], RADIUS)
    scene.run(steps=1)
    stored = STIFFNESS * scene.contacts()["overlap_m"][0]**2 / 2
    booked(scene, lambda: scene.glass.set(stiffness=2 * STIFFNESS), stored)
