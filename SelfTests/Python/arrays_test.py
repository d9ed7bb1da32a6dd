"""Arrays: rows by identity, copies, views, shapes, fields by the names of the files."""
import numpy as np
import pytest

import pendular
from conftest import glass_in, tower


def test_rows_are_in_the_order_of_identities():
    """The store sorts grains in space; arrays do not show it."""
    scene = pendular.Scene()
    glass = glass_in(scene)
    place = np.random.default_rng(1).permutation(500)
    x = 3e-3 * np.stack([place % 10, place // 10 % 10, place // 100], 1)
    r = 1e-3 * (1 + 0.2 * np.sin(np.arange(500)))
    identities = scene.add_grains(glass, x, r)
    scene.choose_time_step()
    scene.run(steps=3)
    assert np.array_equal(identities, np.arange(500)) and np.array_equal(scene.identity, identities)
    assert np.array_equal(scene.position, x) and np.array_equal(scene.radius, r)
    scene.remove_grains([3, 499])
    kept = np.delete(np.arange(500), [3, 499])
    assert np.array_equal(scene.identity, kept) and np.array_equal(scene.position, x[kept])
    assert len(scene) == 498


def test_masses_and_forces():
    """m = 4/3 pi r^3 rho; grains that touch nothing have their weight."""
    scene = tower(count=3)
    scene.set_position((0, 0, 1), identities=[2])
    scene.run(steps=1)
    assert scene.mass == pytest.approx(4 / 3 * np.pi * 1e-9 * 2500 * np.ones(3), rel=1e-14)
    assert scene.force[2] == pytest.approx([0, 0, -9.81 * scene.mass[2]], rel=1e-12)


def test_arrays_are_copies():
    scene = tower()
    position = scene.position
    position[:] = 7
    assert scene.position.max() < 1
    given = np.zeros((4, 3))
    scene.velocity = given
    given[:] = 1
    assert not scene.velocity.any()


def test_what_is_set_is_read():
    scene = tower()
    rows = np.arange(12.0).reshape(4, 3)
    scene.velocity, scene.spin = rows, 2 * rows
    assert np.array_equal(scene.velocity, rows)
    scene.run(steps=0)  # with friction there are spins from the set-up on
    scene.spin = 2 * rows
    assert np.array_equal(scene.spin, 2 * rows)
    scene.set_velocity((1, 2, 3), identities=[1, 3])
    assert np.array_equal(scene.velocity[[0, 1, 2, 3]], [rows[0], [1, 2, 3], rows[2], [1, 2, 3]])
    scene.set_radius([0.9e-3, 0.8e-3], identities=[2, 0])
    assert scene.radius == pytest.approx([0.8e-3, 1e-3, 0.9e-3, 1e-3])


def test_any_kind_of_numbers_is_taken():
    scene = pendular.Scene()
    glass = glass_in(scene)
    scene.add_grains(glass, [(0, 0, 0)], 1e-3)
    scene.add_grains(glass, np.array([[0, 0, 1]], dtype=np.int32), np.float32(1e-3))
    scene.add_grains(glass, np.ones((2, 6))[:, ::2] * [[2], [3]], [1e-3, 2e-3])
    assert scene.position.tolist() == [[0, 0, 0], [0, 0, 1], [2, 2, 2], [3, 3, 3]]
    scene.add_grains(glass, np.zeros((0, 3)), 1e-3)
    assert len(scene) == 4


def test_view_has_no_copy_and_is_read_only():
    scene = tower(count=50)
    view = scene.view("position")
    assert view.base is not None and not view.flags.writeable and not view.flags.owndata
    order = np.argsort(scene.view("identity"))
    assert np.array_equal(view[order], scene.position)
    with pytest.raises(ValueError):
        view[0, 0] = 1
    scene.set_position((5, 5, 5), identities=[7])
    assert (view == 5).all(axis=1).sum() == 1  # it looks into the scene


def test_view_keeps_the_scene_alive():
    view = tower(count=5).view("radius")
    assert view.tolist() == [1e-3] * 5


@pytest.mark.parametrize("change", [
    lambda s: s.run(steps=1), lambda s: s.add_grains(s.glass, [[1, 1, 1]], 1e-3), lambda s: s.remove_grains([0]),
    lambda s: s.insert(s.glass, pendular.one_size(1e-3), pendular.sphere((1, 1, 1), 0.1), number=1),
    lambda s: s.initialise(), lambda s: s.finish(),
    lambda s: s.add_shape(s.glass, pendular.clump([[0, 0, 0, 1e-3]]), (1, 1, 1))])
def test_nothing_moves_the_memory_of_a_view(change):
    scene = tower()
    scene.run(steps=1)
    view = scene.view("velocity")
    with pytest.raises(BufferError, match="view"):
        change(scene)
    part = view[1:]
    del view
    with pytest.raises(BufferError):
        change(scene)
    del part
    scene.run(steps=1)


def test_a_function_must_not_keep_a_view():
    scene, kept = tower(), []
    scene.every_steps(2, lambda s: kept.append(s.view("position")))
    with pytest.raises(BufferError, match="kept"):
        scene.run(1)
    assert scene.steps == 2


def test_a_function_may_use_views():
    scene, tops = tower(), []
    scene.every_steps(2, lambda s: tops.append(float(s.view("position")[:, 2].max())))
    scene.run(steps=4)
    assert len(tops) == 2


def test_contacts():
    """Two grains that overlap by a hundredth of the radius: Hertz' force 4/3 E* sqrt(R*) d^1.5."""
    scene = pendular.Scene()
    scene.add_species("HertzianViscoelastic", density=2500, effective_elastic_modulus=2e6, dissipation=0)
    scene.add_grains(scene.add_species("HertzianViscoelastic", density=2500, effective_elastic_modulus=2e6,
                                       dissipation=0), [[0, 0, 0], [1.99e-3, 0, 0]], 1e-3)
    scene.choose_time_step()
    scene.initialise()
    contacts = scene.contacts()
    assert contacts["particle1"].tolist() == [0] and contacts["particle2"].tolist() == [1]
    assert contacts["wall"].tolist() == [-1]
    assert contacts["overlap_m"] == pytest.approx([1e-5], rel=1e-9)
    force = 4 / 3 * 2e6 * np.sqrt(0.5e-3) * 1e-5**1.5
    assert contacts["normal_force_N"] == pytest.approx([force], rel=1e-9)
    assert contacts["force_N"] == pytest.approx(np.array([[-force, 0, 0]]), rel=1e-9)
    assert contacts["contact_point_m"] == pytest.approx(np.array([[0.995e-3, 0, 0]]), rel=1e-9)


def test_columns_of_grains():
    scene = tower()
    scene.add_column("age", "s", initial=2)
    assert scene.column("age").tolist() == [2] * 4
    scene.set_column("age", [1, 2, 3, 4])
    assert scene.grains()["age_s"].tolist() == [1, 2, 3, 4]


def test_columns_of_contacts():
    scene = tower()
    scene.set_position((0, 0, 0.999e-3), identities=[0])
    scene.add_contact_column("age", "s")
    scene.run(steps=1)
    count = len(scene.contacts()["wall"])
    assert count >= 1
    scene.set_contact_column("age", 3 * np.arange(1, count + 1))
    assert scene.contacts()["age_s"].tolist() == (3 * np.arange(1, count + 1)).tolist()


def test_events():
    scene = tower()
    scene.listen_to_contacts()
    scene.run(0.05)
    events = scene.take_events()
    begun, counts = events["kind"] == 0, scene.event_counts()
    assert begun.sum() == counts["touches_begun"] > 0
    assert (np.diff(events["time_s"]) >= 0).all()
    assert events["wall"][begun][0] == 0 and events["particle1"][begun][0] == 0  # the lowest one meets the floor
    assert ((events["particle2"] == -1) == (events["wall"] >= 0)).all()
    between = events["particle2"] >= 0
    assert between.any() and (events["particle2"][between] < len(scene)).all() and (events["wall"][between] == -1).all()
    assert len(scene.take_events()["kind"]) == 0
    for k in range(len(scene)):
        seen = scene.contacts_of(k)
        assert ((seen["particle2"] == -1) == (seen["wall"] >= 0)).all() and (seen["particle2"] < len(scene)).all()


def test_fields_have_the_mass_of_the_grains():
    """The integral of the density over a box that holds all kernels is the mass."""
    scene = tower()
    scene.initialise()
    low, high = np.array([-0.02, -0.02, -0.02]), np.array([0.02, 0.02, 0.03])
    fields = scene.fields("XZ", low, high, spacing=5e-4, width=1e-3)
    assert fields["x_m"].shape == (80,) and fields["z_m"].shape == (100,)
    density = fields["density_kg_per_m3"]
    assert density.shape == (80, 100) and fields["velocity_m_per_s"].shape == (80, 100, 3)
    cell = (fields["x_m"][1] - fields["x_m"][0]) * (fields["z_m"][1] - fields["z_m"][0]) * 0.04
    assert np.nansum(density) * cell == pytest.approx(scene.mass.sum(), rel=1e-3)


def test_spring_energy_is_that_of_the_ledger():
    scenes = tower(), tower()
    scenes[0].keep_energy_ledger()
    scenes[1].keep_spring_energy()
    while scenes[0].steps < 100000 and (scenes[0].steps == 0 or scenes[0].spring_energy == 0):  # until two touch
        for scene in scenes:
            scene.run(steps=20)
    ledger = scenes[0].energy()
    springs = ledger["elastic_J"] + ledger["tangential_elastic_J"] + ledger["rolling_elastic_J"] + ledger["torsion_elastic_J"]
    assert scenes[1].spring_energy == scenes[0].spring_energy == springs > 0
    with pytest.raises(pendular.InputError, match="keep_energy_ledger"):
        scenes[1].energy()
    with pytest.raises(pendular.InputError, match="keep_spring_energy"):
        tower().spring_energy


def test_energy_closes():
    scene = tower()
    scene.keep_energy_ledger()
    scene.run(steps=0)
    start = sum(v for k, v in scene.energy().items() if not k.startswith("given"))
    scene.run(0.05)
    ledger = scene.energy()
    end = sum(v for k, v in ledger.items() if not k.startswith("given"))
    assert end - start == pytest.approx(0, abs=1e-9 * ledger["lost_in_normal_dashpots_J"])
    assert scene.kinetic_energy > 0


def test_bodies():
    scene = tower(count=2)
    body = scene.join([0, 1], mass=2e-5, centre=(0, 0, 2e-3), inertia=1e-11 * np.eye(3))
    assert scene.bodies()["mass_kg"].tolist() == [2e-5]
    assert scene.body_of(1) == body and scene.grains_of_body(body) == [0, 1]
    scene.set_body_velocity(body, velocity=(1, 0, 0))
    assert scene.bodies()["velocity_m_per_s"].tolist() == [[1, 0, 0]]
    scene.remove_body(body)
    assert len(scene) == 0
