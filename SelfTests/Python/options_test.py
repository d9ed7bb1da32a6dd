"""Options of inlets, sprays, drying, insertions and files that a C++ driver sets by functions of its own: each does what it says."""
import numpy as np
import pytest

import pendular
from conftest import glass_in, tower

WET = dict(density=2500, stiffness=300, dissipation=2e-3, sliding_stiffness=80, sliding_friction_coefficient=0.4,
           liquid_bridge_volume_max=4e-11, contact_angle=0.3, surface_tension=0.072)


@pytest.mark.parametrize("random", [True, False])
def test_bodies_of_an_inlet_are_turned_at_random_or_not(random):
    scene = pendular.Scene()
    rod = pendular.clump([[0, 0, -0.4, 0.5], [0, 0, 0.4, 0.5]])
    scene.add_inlet(glass_in(scene), pendular.one_size(1e-3), pendular.box((0, 0, 0), (0.05, 0.05, 0.05)), shape=rod,
                    number_flow=1e5, random_turns=random, tries=50)
    scene.time_step = scene.stability_limit()
    scene.run(2e-4)
    turns = scene.bodies()["orientation"]
    assert len(turns) >= 10
    assert (np.ptp(turns, axis=0).max() > 0.5) if random else turns == pytest.approx(np.tile(turns[0], (len(turns), 1)), abs=1e-12)


def rain(**options):
    """Droplets that meet nothing."""
    scene = pendular.Scene()
    sand = scene.add_species("LinearViscoelasticSlidingFrictionLiquidMigrationWillett", **WET)
    scene.add_grains(sand, [[1, 1, 1]], 1e-3, fixed=True)
    scene.add_spray(nozzle=(0, 0, 0), direction=(0, 0, 1), cone_angle=0.1, droplet_radius=1e-4, speed=1, flow=4e-8, **options)
    scene.time_step, scene.end_time = 1e-5, 0.01
    return scene


def test_droplets_are_lost_after_their_longest_flight():
    short, long = rain(longest_flight=2e-3), rain()
    for scene in (short, long):
        scene.run(0.01)
    assert short.liquid()["lost_m3"] > 0 == long.liquid()["lost_m3"]
    speed = np.linalg.norm(short.droplets()["velocity_m_per_s"], axis=1)
    assert np.linalg.norm(short.droplets()["position_m"], axis=1).max() <= 2.1e-3 * speed.max()


def test_droplets_dry_by_the_d2_law():
    """a^2 = a0^2 - 2 D (rho_vs - rho_v) t / rho_l, by the way that each has flown."""
    scene = rain()
    scene.set_evaporation(flux=0, diffusivity=2.5e-5, vapour_difference=20, liquid_density=1000, interval=1)
    scene.run(0.01)
    drops = scene.droplets()
    age = np.linalg.norm(drops["position_m"], axis=1) / np.linalg.norm(drops["velocity_m_per_s"], axis=1)
    assert len(age) > 3 and drops["radius_m"].min() < 0.98e-4
    # Droplets come and dry at steps: a step of age, and less than a quantum of the volume.
    assert drops["radius_m"]**2 == pytest.approx(1e-8 - 2 * 2.5e-5 * 20 * age / 1000, abs=2 * 2.5e-5 * 20 * 1e-5 / 1000 + 1e-13)


def test_insertions_try_as_often_as_they_are_told():
    scene, region = pendular.Scene(), pendular.box((0, 0, 0), (0.02, 0.02, 0.02))
    glass = glass_in(scene)
    with pytest.raises(pendular.InputError, match="found room.*more tries"):
        scene.insert(glass, pendular.one_size(2e-3), region, solid_fraction=0.19, tries=1)
    made = scene.insert(glass, pendular.one_size(2e-3), region, solid_fraction=0.19)
    assert made["number"] == made["wanted"] and made["first_left_out_m"] == 0


def test_files_have_contact_points():
    scene = tower("run")
    scene.set_position([0, 0, 0.999e-3], identities=[0])
    scene.write_hdf5(1e-3, doubles=True, contact_points=True)
    scene.run(1e-3)
    scene.finish()
    points = [c["contact_point_m"] for _, c in pendular.frames("run-fields.h5", part="contacts") if len(c["wall"])]
    assert points and all(abs(p[0, 2]) < 1e-12 for p in points)  # on the floor


def test_fields_of_each_species_in_files():
    scene = tower("run")
    heavy = glass_in(scene)
    scene.add_grains(heavy, [[0.01, 0, 0.01]], 1e-3)
    box = ("Z", (-0.01, -0.01, 0), (0.02, 0.01, 0.02))
    scene.write_fields(*box, spacing=1e-3, width=1e-3, interval=1e-3, hdf5=True, by="species")
    scene.run(1e-3)
    scene.finish()
    (_, first), *_ = pendular.frames("run-coarse.h5", part="fields")
    now = scene.fields(*box, spacing=1e-3, width=1e-3, by="species")
    assert {n for n in now if n.startswith("species_")} == {n for n in first if n.startswith("species_")}
    parts = [first[f"species_{k}_density_kg_per_m3"] for k in (0, 1)]
    assert sum(parts) == pytest.approx(first["density_kg_per_m3"], rel=1e-6) and all(p.max() > 0 for p in parts)
