"""What is refused leaves all as it was; what contradicts itself, or was never kept, is not answered by a number."""
import os

import numpy as np
import pytest

import pendular


def scene_of(grains=4):
    scene = pendular.Scene("run")
    sand = scene.add_species("LinearViscoelastic", density=2500, stiffness=300)
    scene.add_grains(sand, [[0, 0, 0.01 * k] for k in range(grains)], 1e-3)
    scene.time_step = 1e-6
    return scene, sand


def test_stress_before_the_run():
    scene, _ = scene_of()
    assert scene.grains(stress=True)["stress_Pa"].shape == (4, 3, 3) and not scene.grains(stress=True)["stress_Pa"].any()
    assert pendular.Scene().grains(stress=True)["stress_Pa"].shape[0] == 0


@pytest.mark.parametrize("orders", [(3, -1), (1000000, 0), (3, 3), (0, 5)])
def test_orders_of_mean_diameters(orders):
    with pytest.raises(pendular.InputError, match="orders"):
        pendular.even_sizes(1e-3, 2e-3).mean(*orders)


MASS = 2500 * 4 / 3 * np.pi * 1e-9


@pytest.mark.parametrize("type, values, field", [
    ("LinearViscoelastic", dict(stiffness=300, collision_time=1e-4, restitution_coefficient=0.5, mass=MASS), "stiffness"),
    ("LinearViscoelastic", dict(dissipation=0, collision_time=1e-4, restitution_coefficient=0.5, mass=MASS), "dissipation"),
    ("HertzianViscoelastic", dict(young_modulus=5e6, poisson_ratio=0.25, dissipation=0, restitution_coefficient=0.5),
     "dissipation"),
    ("HertzianViscoelastic", dict(young_modulus=5e6, poisson_ratio=0.25, effective_elastic_modulus=1e3, dissipation=0),
     "effective_elastic_modulus"),
])
def test_values_that_give_a_field_twice(type, values, field):
    scene = pendular.Scene()
    with pytest.raises(pendular.InputError, match=f"both give its {field}"):
        scene.add_species(type, density=2500, **values)
    assert scene.species == []


def test_values_of_a_material_are_all_or_none():
    scene, sand = scene_of()
    for wrong in (dict(density=2000, nonsense=1), dict(density=2000, stiffness=-1)):
        with pytest.raises(pendular.InputError):
            sand.set(**wrong)
        assert (sand.get("density"), sand.get("stiffness")) == (2500, 300)


def test_what_was_not_set_stays_so():
    scene = pendular.Scene()
    sand = scene.add_species("LinearViscoelastic", density=2500)
    with pytest.raises(pendular.InputError):
        sand.set(stiffness=300, dissipation=-1)
    assert np.isnan(sand.get("stiffness"))


@pytest.mark.parametrize("name, wrong", [
    ("velocity", [[1, 1, 1], [1, 1, 1], [np.nan, 1, 1], [1, 1, 1]]),
    ("position", [[1, 1, 1], [1, 1, 2], [np.inf, 1, 1], [1, 1, 4]]),
    ("radius", [5e-4, 5e-4, -1, 5e-4]),
])
def test_arrays_are_set_as_a_whole_or_not_at_all(name, wrong):
    scene, _ = scene_of()
    before = getattr(scene, name).copy()
    with pytest.raises(pendular.InputError):
        setattr(scene, name, wrong)
    assert (getattr(scene, name) == before).all()


def test_grains_are_removed_and_held_all_or_none():
    scene, sand = scene_of()
    with pytest.raises(pendular.InputError, match="0 twice"):
        scene.remove_grains([0, 0])
    assert len(scene.position) == 4
    with pytest.raises(pendular.InputError, match="99"):
        scene.hold([1, 99], "all")
    scene.velocity = np.ones((4, 3))
    scene.run(steps=1)
    assert scene.position[1, 0] > 0


@pytest.mark.parametrize("lowest, highest", [((-1, -1, -1), (1, np.nan, 1)), ((0, 0, 0), (1, -1, 1)), ((0, 0), (1, 1))])
def test_boxes_are_checked_before_their_first_wall(lowest, highest):
    scene, sand = scene_of()
    with pytest.raises(pendular.InputError, match="add_box"):
        scene.add_box(sand, lowest, highest)
    assert len(scene.walls) == 0


@pytest.mark.parametrize("answer", [False, np.bool_(False)])
def test_a_function_ends_a_part_of_the_run_by_any_false(answer):
    scene, _ = scene_of()
    scene.every_steps(10, lambda s: answer)
    scene.run(steps=100)
    assert scene.time == pytest.approx(1e-5)


@pytest.mark.parametrize("answer", [None, 0, True, np.bool_(True)])
def test_other_answers_do_not_end_it(answer):
    scene, _ = scene_of()
    scene.every_steps(10, lambda s: answer)
    scene.run(steps=100)
    assert scene.time == pytest.approx(1e-4)


def test_what_was_not_kept_is_refused():
    scene, _ = scene_of()
    scene.run(steps=2)
    for ask in (scene.energy, lambda: scene.energy_unaccounted):
        with pytest.raises(pendular.InputError, match="keep_energy_ledger"):
            ask()
    for ask in (scene.take_events, scene.event_counts):
        with pytest.raises(pendular.InputError, match="listen_to_contacts"):
            ask()


def test_names_of_columns_that_files_have():
    scene, _ = scene_of()
    with pytest.raises(pendular.InputError, match="position_m"):
        scene.add_column("position", "m")
    with pytest.raises(pendular.InputError, match="contact_point_m"):
        scene.add_contact_column("contact_point", "m")


@pytest.mark.parametrize("ask", [
    lambda s, g: s.add_outlet(region=pendular.box((0, 0, 0), (1, 1, 1)), least_age=np.nan),
    lambda s, g: s.add_outlet(region=pendular.box((0, 0, 0), (1, 1, 1)), least_age=-1),
    lambda s, g: s.add_inlet(g, pendular.one_size(1e-3), pendular.box((0, 0, 0), (1, 1, 1)), number_flow=1, end=np.nan),
    lambda s, g: s.add_plane(g, (0, 0, -1), (0, 0, -1)).keep_forces(about=(np.nan, 0, 0)),
    lambda s, g: pendular.even_sizes(1e-3, 2e-3).cumulative(np.nan),
    lambda s, g: s.restart_from(""),
])
def test_numbers_that_are_none(ask):
    with pytest.raises(pendular.InputError):
        ask(*scene_of())


def test_discs_are_a_matter_of_the_set_up():
    scene, _ = scene_of()
    scene.run(steps=1)
    with pytest.raises(pendular.InputError, match="before the run starts"):
        scene.set_grains_are_discs()


def remembering(**values):
    scene, _ = scene_of()
    scene.remembered.update(values)
    return scene


def test_types_of_what_is_remembered():
    scene = remembering(count=5, done=True, rows=np.array([1, 2, 3]), share=0.5, table=np.eye(2))
    scene.run(steps=3)
    scene.write_restart("r.h5")
    again = remembering(count=0, done=False, rows=np.zeros(3, dtype=np.int64), share=0.0, table=np.zeros((2, 2)))
    again.restart_from("r.h5")
    again.initialise()
    assert again.remembered["count"] == 5 and type(again.remembered["count"]) is int
    assert again.remembered["done"] is True and again.remembered["share"] == 0.5
    assert again.remembered["rows"].dtype == np.int64 and (again.remembered["rows"] == [1, 2, 3]).all()
    assert (again.remembered["table"] == np.eye(2)).all()


@pytest.mark.parametrize("there", [dict(), dict(count=5, more=1), dict(other=5)])
def test_names_of_what_is_remembered(there):
    scene = remembering(count=5)
    scene.run(steps=1)
    scene.write_restart("r.h5")
    again = remembering(**there)
    again.restart_from("r.h5")
    with pytest.raises(pendular.InputError, match="remembered"):
        again.initialise()


def test_names_that_no_file_can_have():
    for name in ("", "a/b"):
        scene = remembering(**{name: 1})
        scene.initialise()
        with pytest.raises(pendular.InputError, match="a name must have"):
            scene.write_restart("r.h5")


def test_a_copy_of_the_process_leaves_files_alone():
    scene, _ = scene_of()
    scene.keep_energy_ledger()
    scene.write_energy(1e-6)
    scene.run(steps=5)
    child = os.fork()
    if child == 0:
        del scene
        os._exit(0)
    os.waitpid(child, 0)
    scene.run(steps=5)
    scene.finish()
    assert len(pendular.table("run-energy.csv")) == 11

